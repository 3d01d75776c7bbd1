// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/trace.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/cells/subdivide.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/topology/topology.h>
#include "trace_cases.h"

namespace whitney {
namespace {

using testing::TraceCase;

void expect_theory(const TraceCase& c, const coxeter::Triangulation& triangulation) {
  SCOPED_TRACE(c.name + ", edge length " + std::to_string(c.edge_length));
  const TraceResult traced = trace(c.function, triangulation, c.seeds);
  ASSERT_GT(traced.num_simplices(), 0u) << (traced.seeds.empty() ? "" : traced.seeds[0].reason);
  EXPECT_EQ(traced.stop_reason, StopReason::kNone);
  EXPECT_EQ(traced.evaluations, traced.num_vertices());
  const CellComplex complex = cell_complex(traced);
  const Topology of_cells = topology_of(complex.facets);
  EXPECT_EQ(of_cells.euler_characteristic, c.euler_characteristic);
  EXPECT_EQ(of_cells.components, c.components);
  EXPECT_TRUE(of_cells.orientable);  // a regular zero set always is
  std::vector<std::string> homology;
  for (const HomologyGroup& group : *of_cells.homology_z) homology.push_back(to_string(group));
  EXPECT_EQ(homology, c.homology);
  TopologyOptions links_only;
  links_only.homology = false;
  const Topology of_mesh = topology_of(pulled_subdivision(complex), links_only);
  EXPECT_TRUE(of_mesh.is_closed_manifold()) << (of_mesh.witness ? of_mesh.witness->reason : "");
  EXPECT_EQ(of_mesh.euler_characteristic, c.euler_characteristic);
}

class Theory : public ::testing::TestWithParam<int> {
 protected:
  TraceCase the_case() const { return testing::trace_cases()[GetParam()]; }
};

TEST_P(Theory, AtTwoEdgeLengths) {
  TraceCase c = testing::rotated_and_shifted(the_case());
  const int d = c.function.ambient_dim();
  expect_theory(c, coxeter::coxeter_a(d, c.edge_length));
  c.edge_length *= 0.8;
  expect_theory(c, coxeter::coxeter_a(d, c.edge_length));
}

TEST_P(Theory, InExactPositions) {
  // Unmoved, in the Freudenthal triangulation with offset 0: coordinate planes hold lattice vertices.
  const TraceCase c = the_case();
  expect_theory(c, coxeter::freudenthal(c.function.ambient_dim(), c.edge_length));
}

TEST_P(Theory, InOtherUnits) {
  const TraceCase c = testing::rotated_and_shifted(the_case());
  const int d = c.function.ambient_dim();
  for (double factor : {1e-12, 1e12})
    expect_theory(testing::with_values_times(c, factor), coxeter::coxeter_a(d, c.edge_length));
  for (double unit : {1e-9, 1e9}) {
    const TraceCase scaled = testing::in_other_lengths(c, unit);
    expect_theory(scaled, coxeter::coxeter_a(d, scaled.edge_length));
  }
}

TEST_P(Theory, WithVariablesPermuted) {
  TraceCase c = the_case();
  const int d = c.function.ambient_dim();
  std::vector<int> reversed(d);
  for (int i = 0; i < d; ++i) reversed[i] = d - 1 - i;
  c.function = permute_variables(c.function, reversed);
  c.seeds = testing::moved_points(c.seeds, d, [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return x.reverse(); });
  expect_theory(c, coxeter::coxeter_a(d, c.edge_length));
}

INSTANTIATE_TEST_SUITE_P(Cases, Theory, ::testing::Range(0, int(testing::trace_cases().size())), [](const auto& info) {
  std::string name = testing::trace_cases()[info.param].name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

TEST(Trace, CycloHeptaneIsClosedLoopsAsManyAtTwoEdgeLengths) {
  const NamedManifold m = cyclo_heptane();
  Box box;
  for (const auto& [lower, upper] : m.box) {
    box.lower.push_back(lower);
    box.upper.push_back(upper);
  }
  const FoundSeeds seeds = find_seeds(m.function, box);
  std::size_t components = 0;
  for (double edge_length : {0.5, 0.4}) {
    const TraceResult traced = trace(m.function, coxeter::coxeter_a(14, edge_length), seeds.points);
    const Topology t = topology_of(pulled_subdivision(cell_complex(traced)));
    EXPECT_TRUE(t.is_closed_manifold());
    EXPECT_EQ(t.euler_characteristic, 0);
    if (components == 0) components = t.components;
    EXPECT_EQ(t.components, components);
  }
}

TEST(Trace, LatticeVerticesOnTheSphere) {
  for (double radius : {1.0, 2.0, 3.0, 5.0, 7.0})
    for (int d : {3, 4}) {
      const TraceCase c{"sphere of integer radius",
                        sphere(2, d, radius).function,
                        sphere(2, d, radius).point,
                        std::sqrt(double(d)),
                        2,
                        1,
                        {"Z", "0", "Z"}};
      const TraceResult traced = trace(c.function, coxeter::freudenthal(d, c.edge_length), c.seeds);
      if (d == 4) {
        EXPECT_GT(traced.exact_decisions, 0u);
      }
      expect_theory(c, coxeter::freudenthal(d, c.edge_length));
    }
}

TEST(Trace, TheMotionOfAnExactPositionByRoundingErrorsChangesNothing) {
  for (double shift : {1e-16, 3e-16, 1e-15, 1e-14, 1e-13}) {
    TraceCase c{"nearly exact", sphere(2, 3, 5).function, sphere(2, 3, 5).point, std::sqrt(3.0), 2, 1, {"Z", "0", "Z"}};
    c.function = translate(c.function, std::vector{shift, 0.7 * shift, 0.49 * shift});
    expect_theory(c, coxeter::freudenthal(3, c.edge_length));
  }
}

TEST(Trace, ScalingByPowersOfTwoChangesNoBit) {
  const TraceCase c = testing::rotated_and_shifted(testing::trace_cases()[7]);
  const auto triangulation = coxeter::coxeter_a(4, c.edge_length);
  const TraceResult plain = trace(c.function, triangulation, c.seeds);
  const TraceResult scaled =
      trace(testing::with_values_times(c, std::ldexp(1.0, 300)).function, triangulation, c.seeds);
  EXPECT_TRUE(std::ranges::equal(plain.points(), scaled.points()));
}

bool same(const TraceResult& a, const TraceResult& b) {
  return std::ranges::equal(a.points(), b.points()) &&
         std::ranges::equal(a.vertex_coordinates(), b.vertex_coordinates()) &&
         std::ranges::equal(a.vertex_values(), b.vertex_values()) &&
         std::ranges::equal(a.parts<std::uint8_t>(), b.parts<std::uint8_t>());
}

TEST(Trace, TheResultDoesNotDependOnWhereItStarted) {
  const TraceCase c = testing::rotated_and_shifted(testing::trace_cases()[7]);
  const auto triangulation = coxeter::coxeter_a(4, c.edge_length);
  const TraceResult first = trace(c.function, triangulation, c.seeds);
  for (std::size_t i = 0; i < first.num_simplices(); i += first.num_simplices() / 7)
    EXPECT_TRUE(same(first, trace(c.function, triangulation, first.point(i))));
}

TEST(Trace, SeedsAreUsedMergedOrDroppedAndSaySo) {
  const NamedManifold two = two_spheres();
  const std::vector<double> seeds{3, 0, 0, -3, 0, 0, 2, 1, 0, 40, 0, 0};
  TraceOptions options;
  options.max_seed_simplices = 300;
  const TraceResult traced = trace(two.function, coxeter::coxeter_a(3, 0.3), seeds, options);
  ASSERT_EQ(traced.seeds.size(), 4u);
  EXPECT_EQ(traced.seeds[0].outcome, SeedReport::Outcome::kUsed);
  EXPECT_EQ(traced.seeds[1].outcome, SeedReport::Outcome::kUsed);
  EXPECT_EQ(traced.seeds[2].outcome, SeedReport::Outcome::kMerged);
}

TEST(Trace, ASeedFarFromAnyZeroIsDroppedWithAReason) {
  const Function none = make_function(3, 1, [](auto x, auto v) { v[0] = 1 + x[0] * x[0]; });
  const TraceResult traced = trace(none, coxeter::coxeter_a(3, 0.3), std::vector<double>{0, 0, 0});
  EXPECT_EQ(traced.num_simplices(), 0u);
  EXPECT_EQ(traced.seeds[0].outcome, SeedReport::Outcome::kDropped);
  EXPECT_FALSE(traced.seeds[0].reason.empty());
}

TEST(Trace, SeedsNeedNotLieInASimplexThatMeetsTheZeroSet) {
  // At d = 10 and a coarse edge, the d-simplex around a point of M misses the interpolant's zero set in a quarter of
  // all cases.
  const NamedManifold torus = flat_torus(10);
  TraceCase c = testing::rotated_and_shifted({"", torus.function, torus.point, 0.9, 0, 1, {}});
  const auto triangulation = coxeter::coxeter_a(10, 0.9);
  const TraceResult all = trace(c.function, triangulation, c.seeds);
  const Eigen::MatrixXd Q = testing::fixed_rotation(10);
  const Eigen::VectorXd b = testing::fixed_shift(10);
  std::vector<double> seeds;
  for (int i = 0; i < 40; ++i) {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(10);
    y.head(4) << std::cos(0.9 * i), std::sin(0.9 * i), std::cos(1.7 * i), std::sin(1.7 * i);
    const Eigen::VectorXd x = Q * y + b;
    seeds.insert(seeds.end(), x.data(), x.data() + 10);
  }
  const TraceResult traced = trace(c.function, triangulation, seeds);
  for (std::size_t i = 0; i < traced.seeds.size(); ++i)
    EXPECT_NE(traced.seeds[i].outcome, SeedReport::Outcome::kDropped) << i << traced.seeds[i].reason;
  EXPECT_EQ(traced.num_simplices(), all.num_simplices());
}

TEST(Trace, EveryVertexOnceAndNoVertexTwice) {
  std::size_t calls = 0;
  const Function f = make_function(4, 2, [&](std::span<const double> x, std::span<double> v) {
    ++calls;
    v[0] = x[0] * x[0] + x[1] * x[1] - 1.01;
    v[1] = x[2] * x[2] + x[3] * x[3] - 0.97;
  });
  const TraceResult traced = trace(f, coxeter::coxeter_a(4, 0.31), std::vector<double>{1, 0, 1, 0});
  EXPECT_EQ(traced.evaluations, traced.num_vertices());
  EXPECT_EQ(calls, traced.evaluations + traced.seed_evaluations);
  std::set<std::vector<std::int32_t>> distinct;
  for (auto z = traced.vertex_coordinates().begin(); z != traced.vertex_coordinates().end(); z += 4)
    distinct.insert({z, z + 4});
  EXPECT_EQ(distinct.size(), traced.num_vertices());
}

TEST(Trace, LimitsStopItAndSayWhich) {
  const NamedManifold torus = flat_torus(4);
  const auto triangulation = coxeter::coxeter_a(4, 0.1);
  TraceOptions few;
  few.run.max_simplices = 1000;
  TraceResult traced = trace(torus.function, triangulation, torus.point, few);
  EXPECT_EQ(traced.stop_reason, StopReason::kMaxSimplices);
  EXPECT_GE(traced.num_simplices(), 1000u);
  EXPECT_LT(traced.num_simplices(), 2000u);

  TraceOptions cancelled;
  std::size_t seen = 0;
  cancelled.run.progress = [&](const Progress& progress) { return (seen = progress.simplices) < 500; };
  traced = trace(torus.function, triangulation, torus.point, cancelled);
  EXPECT_EQ(traced.stop_reason, StopReason::kCancelled);
  EXPECT_GE(seen, 500u);

  TraceOptions no_time;
  no_time.run.time_limit = 0;
  EXPECT_EQ(trace(torus.function, triangulation, torus.point, no_time).stop_reason, StopReason::kTimeLimit);
}

TEST(Trace, NeverLeavesTheBoxByMoreThanAnEdge) {
  TraceOptions options;
  options.box = Box{{-2, -2, -2}, {2, 2, 0.3}};
  const Function f = make_function(3, 1, [](std::span<const double> x, std::span<double> v) {
    EXPECT_LE(x[2], 0.3 + 0.1 + 1e-12);
    v[0] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 1;
  });
  const TraceResult traced = trace(f, coxeter::coxeter_a(3, 0.1), std::vector<double>{0, 0, -1}, options);
  EXPECT_EQ(traced.stop_reason, StopReason::kBox);
  const CellComplex complex = cell_complex(traced);
  for (std::size_t i = 2; i < complex.points.size(); i += 3) EXPECT_LE(complex.points[i], 0.3 + 1e-12);
  const Topology t = topology_of(pulled_subdivision(complex));
  EXPECT_EQ(t.euler_characteristic, 1);  // a disc
  EXPECT_EQ(t.boundary_components, 1u);
  EXPECT_TRUE(t.is_manifold());

  const TraceResult outside = trace(f, coxeter::coxeter_a(3, 0.1), std::vector<double>{0, 0, 5}, options);
  EXPECT_EQ(outside.num_simplices(), 0u);
  EXPECT_EQ(outside.seeds[0].outcome, SeedReport::Outcome::kDropped);
}

TEST(Trace, UnboundedManifoldsEndAtALimit) {
  const Function plane = make_function(3, 1, [](auto x, auto v) { v[0] = x[0] - 0.3; });
  TraceOptions options;
  options.run.max_simplices = 5000;
  EXPECT_EQ(trace(plane, coxeter::freudenthal(3, 1), std::vector<double>{0.3, 0, 0}, options).stop_reason,
            StopReason::kMaxSimplices);
}

TEST(Trace, CoordinatesThatOverflowAreAnErrorNotAWrap) {
  const Function line = make_function(2, 1, [](auto x, auto v) { v[0] = x[0] - 0.3; });
  EXPECT_THROW(trace(line, coxeter::freudenthal(2, 1), std::vector<double>{0.3, 1.51850024e9}), LatticeOverflow);
  EXPECT_THROW(trace(line, coxeter::freudenthal(2, 1e-12), std::vector<double>{0.3, 0}), LatticeOverflow);
}

TEST(Trace, BadInputIsNamed) {
  const Function circle = sphere(1, 2).function;
  const auto plane = coxeter::coxeter_a(2, 0.1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(trace(circle, coxeter::coxeter_a(3, 0.1), std::vector<double>{1, 0}), InvalidInput);
  EXPECT_THROW(trace(circle, plane, std::vector<double>{1, 0, 3}), InvalidInput);
  EXPECT_THROW(trace(circle, plane, std::vector<double>{1, nan}), InvalidInput);
  const Function points = make_function(2, 2, [](auto x, auto v) { v[0] = x[0], v[1] = x[1]; });
  EXPECT_THROW(trace(points, plane, std::vector<double>{0, 0}), InvalidInput);
  TraceOptions empty_box;
  empty_box.box = Box{{0, 0}, {1, 0}};
  EXPECT_THROW(trace(circle, plane, std::vector<double>{1, 0}, empty_box), InvalidInput);

  const Function broken =
      make_function(2, 1, [=](auto x, auto v) { v[0] = x[0] > 0.5 ? nan : x[0] * x[0] + x[1] * x[1] - 1; });
  try {
    trace(broken, plane, std::vector<double>{-1, 0});
    FAIL() << "a NaN must not pass";
  } catch (const OracleError& error) {
    EXPECT_NE(std::string(error.what()).find("NaN at ("), std::string::npos) << error.what();
  }
}

TEST(Trace, MorePartsThanAByteCanCount) {
  // Codimension 255 and beyond uses two bytes a part: the line x_1 = .. = x_k up to shifts.
  const int d = 257;
  const Function line = make_function(d, d - 1, [=](auto x, auto v) {
    for (int i = 0; i + 1 < d; ++i) v[i] = x[i] + 0.001 * i + 0.0137;
  });
  std::vector<double> seed(d, 0.0);
  for (int i = 0; i + 1 < d; ++i) seed[i] = -0.001 * i - 0.0137;
  TraceOptions options;
  options.run.max_simplices = 20;
  options.max_seed_simplices = 3;
  const TraceResult traced = trace(line, coxeter::freudenthal(d, 40.0), seed, options);
  ASSERT_GT(traced.num_simplices(), 0u);
  EXPECT_TRUE(traced.has_wide_parts());
  std::vector<double> f(d - 1);
  line.evaluate(traced.point(3), f);
  for (double x : f) EXPECT_NEAR(x, 0, 1e-9);
}

}  // namespace
}  // namespace whitney
