// SPDX-License-Identifier: GPL-3.0-or-later
// Manifolds with boundary and corners: boundary_trace.h, strata.h, cut_regularity.h and cell_complex.h together.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <coxeter/faces/faces.h>
#include <coxeter/placement.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/cells/strata.h>
#include <whitney/cells/subdivide.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/io/read_problem.h>
#include <whitney/topology/topology.h>
#include <whitney/tracing/cut_regularity.h>
#include <whitney/tracing/exact_pivot.h>
#include <whitney/tracing/trace.h>
#include "tracing/boundary_cases.h"

namespace whitney {
namespace {

using namespace boundary_cases;

TEST(Boundary, OctantOfTheSphereHasOneFaceThreeArcsThreeCorners) {
  const std::map<int, int> expected{{2, 1}, {1, 3}, {0, 3}};
  // Coarse: few or no vertices in the interior. Integer radius in the integer lattice: corners at lattice vertices.
  struct Position {
    double radius;
    coxeter::Triangulation triangulation;
  };
  for (const auto& [radius, triangulation] :
       {Position{1, coxeter::coxeter_a(3, 0.1)}, Position{1, coxeter::coxeter_a(3, 0.5)},
        Position{1, coxeter::coxeter_a(3, 1.3)}, Position{1, coxeter::freudenthal(3, 0.1)},
        Position{2, integer_lattice(3)}, Position{3, integer_lattice(3)}, Position{7, integer_lattice(3)}}) {
    SCOPED_TRACE(radius);
    const double c = radius / std::sqrt(3.0);
    const Cut octant = cut(sphere_function(3, radius), coordinates(3, 3), triangulation, {c, c, c});
    EXPECT_EQ(count_by_dim(octant.strata), expected);
    EXPECT_EQ(octant.topology.euler_characteristic, 1);
    EXPECT_EQ(octant.topology.boundary_components, 1u);
    EXPECT_EQ(octant.strata.boundary_components, 1u);
    EXPECT_EQ(octant.strata.cut_components, 0u);
    // The graph: the face has all arcs; each arc two corners, each corner two arcs.
    EXPECT_EQ(octant.strata.strata[0].faces, (std::vector<std::uint32_t>{1, 2, 3}));
    std::map<std::uint32_t, int> arcs_at;
    for (int arc : {1, 2, 3}) {
      EXPECT_EQ(octant.strata.strata[arc].faces.size(), 2u);
      for (std::uint32_t corner : octant.strata.strata[arc].faces) ++arcs_at[corner];
    }
    EXPECT_EQ(arcs_at, (std::map<std::uint32_t, int>{{4, 2}, {5, 2}, {6, 2}}));
    // Each stratum as a mesh: a disc, three arcs, three points.
    for (const SimplicialMesh& mesh :
         {pulled_subdivision(octant.complex, &octant.strata), barycentric_subdivision(octant.complex, &octant.strata)})
      for (int s = 0; s < 7; ++s) {
        const SimplicialMesh piece = stratum_mesh(mesh, s);
        EXPECT_EQ(piece.dim, s == 0 ? 2 : s < 4 ? 1 : 0);
        EXPECT_EQ(topology_of(piece).euler_characteristic, 1);
        EXPECT_EQ(topology_of(piece).components, 1u);
      }
    // Points lie where their inequalities vanish, within the error of the interpolation.
    for (const BoundarySimplices& stratum : octant.traced.boundary)
      for (std::size_t i = 0; i < stratum.size(); ++i)
        for (int j : stratum.inequalities) EXPECT_NEAR(stratum.points[3 * i + j], 0, 1e-12);
  }
}

TEST(Boundary, OrthantOfTheThreeSphere) {
  // A curved tetrahedron: its strata are those of a simplex.
  for (const auto& triangulation : {coxeter::coxeter_a(4, 0.4), coxeter::freudenthal(4, 0.5)}) {
    const Cut orthant = cut(sphere_function(4, 1), coordinates(4, 4), triangulation, {.5, .5, .5, .5});
    EXPECT_EQ(count_by_dim(orthant.strata), (std::map<int, int>{{3, 1}, {2, 4}, {1, 6}, {0, 4}}));
    EXPECT_EQ(orthant.topology.euler_characteristic, 1);
    EXPECT_EQ(to_string((*orthant.topology.homology_z)[1]), "0");
  }
}

TEST(Boundary, CurvesWithEnds) {
  const Cut arc = cut(sphere_function(2, 1), coordinates(2, 1), coxeter::coxeter_a(2, 0.1), {1, 0});
  EXPECT_EQ(count_by_dim(arc.strata), (std::map<int, int>{{1, 1}, {0, 2}}));
  EXPECT_EQ(arc.topology.euler_characteristic, 1);
  EXPECT_EQ(arc.strata.boundary_components, 2u);
  // In R^4: the quarter x_0, x_2 >= 0 of a circle.
  const Function circle = make_function(4, 3, [](Point x, Values v) {
    v[0] = x[0] * x[0] + x[2] * x[2] - 1;
    v[1] = x[1];
    v[2] = x[3];
  });
  const Function both = make_function(4, 2, [](Point x, Values v) { v[0] = x[0], v[1] = x[2]; });
  const Cut quarter = cut(circle, both, coxeter::freudenthal(4, 0.4), {1, 0, 0, 0});
  EXPECT_EQ(count_by_dim(quarter.strata), (std::map<int, int>{{1, 1}, {0, 2}}));
}

TEST(Boundary, CutTorus) {
  for (double edge_length : {0.2, 0.3}) {
    const Cut disc = cut(torus_function(), torus_cut(3), coxeter::coxeter_a(4, edge_length), {1, 0, 1, 0});
    EXPECT_EQ(disc.topology.euler_characteristic, 1);
    EXPECT_EQ(disc.topology.boundary_components, 1u);
    // Beyond the singular value 4 what is cut away is a disc.
    const Cut rest = cut(torus_function(), torus_cut(5), coxeter::coxeter_a(4, edge_length), {1, 0, 1, 0});
    EXPECT_EQ(rest.topology.euler_characteristic, -1);
    EXPECT_EQ(rest.topology.boundary_components, 1u);
    EXPECT_EQ(to_string((*rest.topology.homology_z)[1]), "Z^2");
  }
}

TEST(Boundary, SingularCutsAreFoundAndOthersAreNot) {
  for (double c : {3.0, 3.9, 3.99, 4.0, 4.01, 5.0}) {
    TraceOptions options;
    options.inequalities = torus_cut(c);
    const double edge_length = 0.3;
    const auto traced =
        trace(torus_function(), coxeter::coxeter_a(4, edge_length), std::vector<double>{1, 0, 1, 0}, options);
    const CutRegularity regularity = check_cuts(torus_function(), traced, edge_length);
    EXPECT_EQ(regularity.singular.size(), c == 4 ? 2u : 0u) << c;
    // cos a + cos b = 0 crosses itself at (0, pi) and (pi, 0).
    for (const SingularCut& singular : regularity.singular) {
      EXPECT_NEAR(std::abs(singular.point[0]), 1, 1e-6);
      EXPECT_NEAR(singular.point[0] + singular.point[2], 0, 1e-6);
      EXPECT_LT(singular.singular_value, 1e-6);
    }
    EXPECT_LE(regularity.smallest_singular_value, 1);
    if (c == 3) {
      EXPECT_GT(regularity.smallest_singular_value, 0.3);
    }
  }
  // Two inequalities that are tangent to each other on the sphere: z >= 0 and the plane through the same circle.
  TraceOptions options;
  options.inequalities = make_function(3, 2, [](Point x, Values v) { v[0] = x[2], v[1] = x[2] + x[0] * x[0] - 1; });
  const auto traced =
      trace(sphere_function(3, 1), coxeter::coxeter_a(3, 0.1), std::vector<double>{0.6, 0, 0.8}, options);
  EXPECT_FALSE(check_cuts(sphere_function(3, 1), traced, 0.1).singular.empty());
}

TEST(Boundary, ADomainThatMeetsNothing) {
  const auto triangulation = coxeter::coxeter_a(3, 0.2);
  const std::vector<double> seed{1, 0, 0};
  TraceOptions everywhere, nowhere;
  everywhere.inequalities = make_function(3, 1, [](Point x, Values v) { v[0] = 3 - x[2]; });
  nowhere.inequalities = make_function(3, 1, [](Point x, Values v) { v[0] = x[2] - 3; });
  EXPECT_EQ(bytes_of(trace(sphere_function(3, 1), triangulation, seed, everywhere)),
            bytes_of(trace(sphere_function(3, 1), triangulation, seed)));
  const TraceResult none = trace(sphere_function(3, 1), triangulation, seed, nowhere);
  EXPECT_EQ(none.num_points(), 0u);
  EXPECT_EQ(none.seeds[0].outcome, SeedReport::Outcome::kDropped);
  EXPECT_NE(none.seeds[0].reason.find("inside the domain"), std::string::npos) << none.seeds[0].reason;
  // Touching from inside, at a lattice vertex on the sphere: the closed domain holds all of it.
  TraceOptions touching;
  touching.inequalities = make_function(3, 1, [](Point x, Values v) { v[0] = 3 - x[2]; });
  const Topology t = topology_of(pulled_subdivision(
      cell_complex(trace(sphere_function(3, 3), integer_lattice(3), std::vector<double>{3, 0, 0}, touching))));
  EXPECT_TRUE(t.is_closed_manifold());
  EXPECT_EQ(t.euler_characteristic, 2);
}

TEST(Boundary, SeveralInequalitiesThroughTheSameLatticeVertex) {
  // Five planes through the point (0, 0, 5) of the sphere and the lattice; two of them redundant.
  const Function g = make_function(3, 5, [](Point x, Values v) {
    v[0] = x[0];
    v[1] = x[1];
    v[2] = x[0] + x[1];
    v[3] = 2 * x[0] + x[1];
    v[4] = x[2];
  });
  const Cut octant = cut(sphere_function(3, 5), g, integer_lattice(3), {3, 3, 3});
  EXPECT_EQ(octant.topology.euler_characteristic, 1);
  EXPECT_EQ(octant.strata.boundary_components, 1u);
}

TEST(Boundary, UnitsDoNotMatter) {
  const auto reference = cut(torus_function(), torus_cut(3), coxeter::freudenthal(4, 0.4), {1, 0, 1, 0});
  for (double of_f : {1e-12, 1e12})
    for (double of_g : {1e-12, 1e12}) {
      const Function f = torus_function(), g = torus_cut(3);
      auto times = [](const Function& function, double factor) {
        return make_function(function.ambient_dim(), function.codim(), [=](Point x, Values v) {
          function.evaluate(x, v);
          for (double& value : v) value *= factor;
        });
      };
      const auto scaled = cut(times(f, of_f), times(g, of_g), coxeter::freudenthal(4, 0.4), {1, 0, 1, 0});
      EXPECT_EQ(scaled.topology.f_vector, reference.topology.f_vector);
    }
  for (double unit : {1e-9, 1e9}) {
    const Function f = make_function(4, 2, [=](Point x, Values v) {
      v[0] = x[0] * x[0] + x[1] * x[1] - unit * unit;
      v[1] = x[2] * x[2] + x[3] * x[3] - unit * unit;
    });
    const Function g = make_function(4, 1, [=](Point x, Values v) {
      v[0] =
          3 * unit * unit - (x[0] - unit) * (x[0] - unit) - x[1] * x[1] - (x[2] - unit) * (x[2] - unit) - x[3] * x[3];
    });
    const auto scaled = cut(f, g, coxeter::freudenthal(4, 0.4 * unit), {unit, 0, unit, 0});
    EXPECT_EQ(scaled.topology.euler_characteristic, 1);
  }
}

/// f in the coordinates y = Q^T (x - b) of a random motion.
Function moved(const Function& f, const Eigen::MatrixXd& Q, const Eigen::VectorXd& b) {
  return make_function(f.ambient_dim(), f.codim(), [=](Point x, Values v) {
    const Eigen::VectorXd y = Q.transpose() * (Eigen::Map<const Eigen::VectorXd>(x.data(), b.size()) - b);
    f.evaluate({y.data(), std::size_t(y.size())}, v);
  });
}

TEST(Boundary, MovedCopiesHaveTheSameStrata) {
  struct Setting {
    Function f, g;
    std::vector<double> seed;
    double edge_length;
    std::map<int, int> strata;
  };
  for (const auto& [f, g, seed, edge_length, strata] :
       {Setting{sphere_function(3, 1), coordinates(3, 3), {.6, .6, .6}, 0.2, {{2, 1}, {1, 3}, {0, 3}}},
        Setting{torus_function(), coordinates(4, 4), {.7, .7, .7, .7}, 0.3, {{2, 1}, {1, 4}, {0, 4}}},
        Setting{torus_function(), torus_cut(3), {1, 0, 1, 0}, 0.3, {{2, 1}, {1, 1}}},
        Setting{sphere_function(4, 1), coordinates(4, 2), {.6, .6, .6, .6}, 0.5, {{3, 1}, {2, 2}, {1, 1}}}}) {
    const int d = f.ambient_dim();
    for (int run = 0; run < 4; ++run) {
      const Eigen::MatrixXd Q = as_eigen(coxeter::random_rotation(d, 7 + run));
      Eigen::VectorXd b(d);
      for (int c = 0; c < d; ++c) b[c] = std::cos(1.0 + c + 3 * run);
      const Eigen::VectorXd start = Q * Eigen::Map<const Eigen::VectorXd>(seed.data(), d) + b;
      const Cut copy =
          cut(moved(f, Q, b), moved(g, Q, b), coxeter::coxeter_a(d, edge_length), {start.begin(), start.end()});
      EXPECT_EQ(count_by_dim(copy.strata), strata);
      EXPECT_EQ(copy.topology.euler_characteristic, 1);
      // Variables in another order, and the inequalities too.
      const int m = g.codim();
      const Function reversed = make_function(d, m, [=, g = g](Point x, Values v) {
        std::vector<double> y(x.rbegin(), x.rend());
        g.evaluate(y, v);
        std::reverse(v.begin(), v.end());
      });
      const Function f_reversed = make_function(d, f.codim(), [=, f = f](Point x, Values v) {
        std::vector<double> y(x.rbegin(), x.rend());
        f.evaluate(y, v);
      });
      if (run == 0) {
        EXPECT_EQ(
            count_by_dim(
                cut(f_reversed, reversed, coxeter::freudenthal(d, edge_length), {seed.rbegin(), seed.rend()}).strata),
            strata);
      }
    }
  }
}

TEST(Boundary, ABoxIsASetOfInequalitiesMarkedAsACut) {
  const auto triangulation = coxeter::coxeter_a(3, 0.1);
  const Box box{{-2, -2, -2}, {0.3, 2, 2}};
  const Cut boxed = cut(sphere_function(3, 1), {}, triangulation, {-1, 0, 0}, box);
  const Cut given = cut(sphere_function(3, 1), make_function(3, 1, [](Point x, Values v) { v[0] = 0.3 - x[0]; }),
                        triangulation, {-1, 0, 0});
  EXPECT_EQ(boxed.traced.stop_reason, StopReason::kBox);
  EXPECT_EQ(given.traced.stop_reason, StopReason::kNone);
  EXPECT_EQ(boxed.complex.points, given.complex.points);
  EXPECT_EQ(boxed.strata.boundary_components, 0u);
  EXPECT_EQ(boxed.strata.cut_components, 1u);
  EXPECT_EQ(given.strata.boundary_components, 1u);
  EXPECT_EQ(given.strata.cut_components, 0u);
  for (const BoundarySimplices& stratum : boxed.traced.boundary) {
    EXPECT_TRUE(boxed.traced.domain.is_box_side(stratum.inequalities[0]));
    for (std::size_t i = 0; i < stratum.size(); ++i) EXPECT_NEAR(stratum.points[3 * i], 0.3, 1e-12);
  }

  // The hyperboloid x^2 + y^2 - z^2 = 1, unbounded: a cylinder, cut twice by the box and once by an inequality.
  const Function hyperboloid =
      make_function(3, 1, [](Point x, Values v) { v[0] = x[0] * x[0] + x[1] * x[1] - x[2] * x[2] - 1; });
  const Box cube{{-4, -4, -2}, {4, 4, 2}};
  const Cut tube = cut(hyperboloid, {}, coxeter::coxeter_a(3, 0.3), {1, 0, 0}, cube);
  EXPECT_EQ(tube.topology.euler_characteristic, 0);
  EXPECT_EQ(tube.strata.cut_components, 2u);
  const Cut half = cut(hyperboloid, coordinates(3, 1), coxeter::coxeter_a(3, 0.3), {1, 0, 0}, cube);
  EXPECT_EQ(half.topology.euler_characteristic, 1);
  EXPECT_EQ(half.strata.cut_components, 2u);
  EXPECT_EQ(half.strata.boundary_components, 2u);
  EXPECT_EQ(count_by_dim(half.strata), (std::map<int, int>{{2, 1}, {1, 4}, {0, 4}}));
  // A symmetric position: the cube's faces are lattice planes.
  const Cut exact = cut(make_function(3, 1, [](Point x, Values v) { v[0] = x[0] * x[0] + x[1] * x[1] - 9; }), {},
                        integer_lattice(3), {3, 0, 0}, Box{{-5, -5, -2}, {5, 5, 2}});
  EXPECT_EQ(exact.topology.euler_characteristic, 0);
  EXPECT_EQ(exact.strata.cut_components, 2u);
}

TEST(Boundary, WholeCellsAreLeftOutWhereFHasNoValueOutsideTheBox) {
  const Function f = make_function(2, 1, [](Point x, Values v) { v[0] = x[1] - std::sqrt(x[0]); });
  TraceOptions options;
  options.box = Box{{0, -1}, {1, 2}};
  const TraceResult traced = trace(f, coxeter::coxeter_a(2, 0.1), std::vector<double>{0.5, 0.7}, options);
  EXPECT_EQ(traced.stop_reason, StopReason::kBox);
  EXPECT_FALSE(traced.whole);
  const Topology t = topology_of(pulled_subdivision(cell_complex(traced)));
  EXPECT_TRUE(t.is_manifold());
  EXPECT_EQ(t.euler_characteristic, 1);
  EXPECT_THROW(trace(f, coxeter::coxeter_a(2, 0.1), std::vector<double>{0.5, 0.7}), OracleError);
}

TEST(Boundary, InHighDimensions) {
  // Beyond d = 15 parts are lists (see short_partition.h). A quarter of a circle, a quarter of a sphere.
  for (const auto& [d, n, edge_length] : {std::tuple{17, 1, 0.8}, {17, 2, 1.2}, {33, 1, 1.0}}) {
    auto y = [](Point x, int c) { return x[c] - 0.01 * std::cos(1.0 + c); };
    const Function f = make_function(d, d - n, [=, d = d, n = n](Point x, Values v) {
      v[0] = -1;
      for (int c = 0; c <= n; ++c) v[0] += y(x, c) * y(x, c);
      for (int c = n + 1; c < d; ++c) v[c - n] = y(x, c);
    });
    const Function g = make_function(d, 2, [](Point x, Values v) {
      v[0] = x[0] + 0.1 * x[1];
      v[1] = x[1] - 0.07 * x[0];
    });
    std::vector<double> seed(d, 0.0);
    seed[0] = seed[1] = std::sqrt(0.5);
    const Cut quarter = cut(f, g, coxeter::coxeter_a(d, edge_length), seed);
    EXPECT_EQ(count_by_dim(quarter.strata),
              n == 1 ? (std::map<int, int>{{1, 1}, {0, 2}}) : (std::map<int, int>{{2, 1}, {1, 2}, {0, 2}}));
    EXPECT_EQ(quarter.topology.euler_characteristic, 1);
  }
}

TEST(Boundary, TheResultDoesNotDependOnTheSeed) {
  TraceOptions options;
  options.inequalities = coordinates(4, 4);
  std::set<std::string> results;
  for (const std::vector<double>& seed : std::vector<std::vector<double>>{
           {.8, .6, .6, .8}, {.1, 1, 1, .1}, {0, 1, 0, 1}, {1, 0, 1, 0}, {1, 0, 1, 0, .7, .7, .7, .7}})
    results.insert(bytes_of(trace(torus_function(), coxeter::freudenthal(4, 0.3), seed, options)));
  EXPECT_EQ(results.size(), 1u);
}

TEST(Boundary, LimitsLeaveAPartOfIt) {
  TraceOptions options;
  options.inequalities = coordinates(3, 3);
  for (std::size_t limit : {1, 10, 100, 500, 900}) {
    options.run.max_simplices = limit;
    const TraceResult traced =
        trace(sphere_function(3, 1), coxeter::coxeter_a(3, 0.1), std::vector<double>{.6, .6, .6}, options);
    EXPECT_EQ(traced.stop_reason, StopReason::kMaxSimplices);
    EXPECT_FALSE(traced.whole);
    EXPECT_NO_THROW(topology_of(pulled_subdivision(cell_complex(traced))));
  }
}

TEST(Boundary, BadInputIsNamed) {
  const auto triangulation = coxeter::coxeter_a(3, 0.1);
  const std::vector<double> seed{1, 0, 0};
  TraceOptions options;
  options.inequalities = coordinates(4, 1);
  EXPECT_THROW(trace(sphere_function(3, 1), triangulation, seed, options), InvalidInput);
  options.inequalities = make_function(3, 2, [](Point x, Values v) {
    v[0] = 1;
    v[1] = x[2] > 0.3 ? std::numeric_limits<double>::quiet_NaN() : 1;
  });
  try {
    trace(sphere_function(3, 1), triangulation, seed, options);
    FAIL() << "a NaN must not pass";
  } catch (const OracleError& error) {
    EXPECT_NE(std::string(error.what()).find("inequality 1 is NaN at ("), std::string::npos) << error.what();
  }
}

TEST(Boundary, SeedsOnEveryComponentOfTheDomain) {
  // Six caps of the sphere: max |x_i| >= 0.8.
  const Function caps = make_function(3, 1, [](Point x, Values v) {
    v[0] = std::pow(x[0], 10) + std::pow(x[1], 10) + std::pow(x[2], 10) - std::pow(0.8, 10);
  });
  const Domain domain(3, caps, Box{{-2, -2, -2}, {2, 2, 2}});
  const FoundSeeds seeds = find_seeds(sphere_function(3, 1), domain);
  const Cut pieces = cut(sphere_function(3, 1), caps, coxeter::coxeter_a(3, 0.1), seeds.points);
  EXPECT_EQ(pieces.topology.components, 6u);
  EXPECT_EQ(pieces.strata.boundary_components, 6u);
  // Slivers that no start point falls into: found on the boundary.
  const Function slivers = make_function(3, 1, [](Point x, Values v) { v[0] = x[0] * x[0] - 0.9999 * 0.9999; });
  const FoundSeeds few = find_seeds(sphere_function(3, 1), Domain(3, slivers, Box{{-2, -2, -2}, {2, 2, 2}}));
  EXPECT_EQ(cut(sphere_function(3, 1), slivers, coxeter::coxeter_a(3, 0.005), few.points).topology.components, 2u);
}

}  // namespace
}  // namespace whitney
