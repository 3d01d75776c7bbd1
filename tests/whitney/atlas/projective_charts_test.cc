// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/projective_charts.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <coxeter/triangulation.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/cells/strata.h>
#include <whitney/cells/subdivide.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/topology/topology.h>
#include <whitney/tracing/trace.h>

namespace whitney {
namespace {

using testing::HasSubstr;
using Strings = std::vector<std::string>;

std::vector<double> values(const Function& f, const std::vector<double>& x) {
  std::vector<double> y(f.codim());
  f.evaluate(x, y);
  return y;
}
std::vector<double> apply(const CoordinateMap& map, const std::vector<double>& x, int size) {
  std::vector<double> y(size);
  map(x, y);
  return y;
}
double norm(const std::vector<double>& x) {
  double squared = 0;
  for (const double v : x) squared += v * v;
  return std::sqrt(squared);
}
double distance(std::vector<double> x, const std::vector<double>& y) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= y[i];
  return norm(x);
}

struct Case {
  Field field;
  Strings variables, equations;
};
const std::vector<Case> kCases{
    {Field::kComplex, {"z1", "z2", "z3"}, {"z1^2*conj(z2) + z2^2*conj(z3) + z3^2*conj(z1)"}},
    {Field::kComplex, {"a", "b", "c", "d"}, {"a^3 + b^3 + c^3 + i*d^3", "a*conj(b) + c*conj(d)"}},
    {Field::kReal, {"x", "y", "z"}, {"x^3 + y^2*z - 2*z^3"}},
    {Field::kReal, {"a", "b", "c", "d"}, {"a*b + c*d - d^2"}},
};

TEST(ProjectiveCharts, Dimensions) {
  for (const Case& c : kCases) {
    const ChartAtlas atlas = projective_charts(c.variables, c.equations, {.field = c.field});
    const std::size_t count = c.variables.size(), width = c.field == Field::kComplex ? 2 : 1;
    ASSERT_EQ(atlas.charts.size(), count);
    EXPECT_EQ(atlas.seams.size(), count * (count - 1) / 2);
    EXPECT_EQ(atlas.ambient_dim(), width * (count - 1));
    EXPECT_EQ(atlas.codim(), width * c.equations.size());
    EXPECT_EQ(atlas.variables.size(), width * (count - 1));
    EXPECT_EQ(atlas.embeddings.size(), count);
    EXPECT_EQ(atlas.embedding_dim(), width == 2 ? count * count : count * (count + 1) / 2);
    for (const Chart& chart : atlas.charts) {
      EXPECT_EQ(chart.function.ambient_dim(), atlas.ambient_dim());
      EXPECT_EQ(chart.function.codim(), atlas.codim());
      ASSERT_TRUE(chart.inequalities);
      EXPECT_EQ(chart.inequalities->ambient_dim(), atlas.ambient_dim());
      EXPECT_EQ(chart.inequalities->codim(), count - 1);
      EXPECT_EQ(chart.box.size(), atlas.ambient_dim());
    }
  }
}

/// A point of projective space in all its charts agrees with itself.
TEST(ProjectiveCharts, ChartsAgree) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const Case& c : kCases) {
    const int count = static_cast<int>(c.variables.size());
    for (const bool weighted : {false, true}) {
      ProjectiveOptions options{.field = c.field};
      if (weighted) options.weights = {0.5, 1, 1.7, 0.8}, options.weights.resize(count);
      const ChartAtlas atlas = projective_charts(c.variables, c.equations, options);
      const int d = atlas.ambient_dim(), D = atlas.embedding_dim();
      for (int run = 0; run < 50; ++run) {
        std::vector<double> x(d);
        for (double& v : x) v = normal(random);
        // From chart 0 into the others, through the transitions.
        std::vector<std::vector<double>> in_chart{x};
        for (int b = 1; b < count; ++b) in_chart.push_back(apply(atlas.seams[b - 1].transition, x, d));
        // 1 / z_b^degree relates the values: they vanish together, and here their ratio is known.
        int inside = 0;
        for (int b = 0; b < count; ++b) {
          const Chart& chart = atlas.charts[b];
          const std::vector<double> g = values(*chart.inequalities, in_chart[b]);
          const bool here = *std::min_element(g.begin(), g.end()) >= 0;
          inside += here;
          for (int i = 0; here && i < d; ++i) {
            EXPECT_GT(in_chart[b][i], chart.box[i][0]);
            EXPECT_LT(in_chart[b][i], chart.box[i][1]);
          }
          EXPECT_LT(distance(apply(atlas.embeddings[b], in_chart[b], D), apply(atlas.embeddings[0], x, D)), 1e-13);
          EXPECT_NEAR(norm(apply(atlas.embeddings[b], in_chart[b], D)), 1, 1e-14);  // a projector of rank 1
        }
        EXPECT_EQ(inside, 1);  // generic points are in one domain: they cover, and overlap on seams only
      }
    }
  }
}

TEST(ProjectiveCharts, EquationsAgree) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (const Case& c : kCases) {
    const ChartAtlas atlas = projective_charts(c.variables, c.equations, {.field = c.field});
    const int d = atlas.ambient_dim();
    const FoundSeeds found =
        find_seeds(atlas.charts[0].function, Box{std::vector<double>(d, -1.1), std::vector<double>(d, 1.1)});
    ASSERT_FALSE(found.points.empty());
    for (std::size_t at = 0; at < found.points.size(); at += d) {
      const std::vector<double> x(found.points.begin() + at, found.points.begin() + at + d);
      EXPECT_LT(norm(values(atlas.charts[0].function, x)), 1e-9);
      for (std::size_t b = 1; b < atlas.charts.size(); ++b) {
        const std::vector<double> y = apply(atlas.seams[b - 1].transition, x, d);
        const double scale = std::pow(1 + norm(y), 3);
        EXPECT_LT(norm(values(atlas.charts[b].function, y)), 1e-8 * scale);
      }
    }
  }
}

TEST(ProjectiveCharts, SeamsMatch) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (const Case& c : kCases) {
    const ChartAtlas atlas = projective_charts(c.variables, c.equations, {.field = c.field});
    const int d = atlas.ambient_dim(), width = c.field == Field::kComplex ? 2 : 1;
    for (const Seam& seam : atlas.seams) {
      const Function& g = *atlas.charts[seam.first_chart].inequalities;
      const Function& h = *atlas.charts[seam.second_chart].inequalities;
      for (int run = 0; run < 10; ++run) {
        std::vector<double> x(d);
        for (double& v : x) v = normal(random);
        // Scale one coordinate onto the seam: g = s - |w|^2.
        const int at = seam.first_inequality * width;
        const double squared = x[at] * x[at] + (width == 2 ? x[at + 1] * x[at + 1] : 0);
        const double scale = std::sqrt((values(g, x)[seam.first_inequality] + squared) / squared);
        for (int i = at; i < at + width; ++i) x[i] *= scale;
        EXPECT_NEAR(values(g, x)[seam.first_inequality], 0, 1e-13);
        const std::vector<double> y = apply(seam.transition, x, d);
        EXPECT_NEAR(values(h, y)[seam.second_inequality], 0, 1e-13);
        // The other inequalities have the same signs on both sides: the parts are the same set.
        const auto gx = values(g, x), hy = values(h, y);
        for (int j = 0; j < static_cast<int>(atlas.charts.size()); ++j) {
          if (j == seam.first_chart || j == seam.second_chart) continue;
          EXPECT_EQ(gx[j - (j > seam.first_chart)] > 0, hy[j - (j > seam.second_chart)] > 0);
        }
      }
    }
  }
}

TEST(ProjectiveCharts, Errors) {
  const Strings variables{"z1", "z2", "z3"}, equations{"z1^2+z2^2+z3^2"};
  const auto error_of = [&](const ProjectiveOptions& options) {
    try {
      projective_charts(variables, equations, options);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error_of({.weights = {1, 1}}), HasSubstr("2 numbers for 3"));
  EXPECT_THAT(error_of({.weights = {1, 1, 0}}), HasSubstr("positive"));
  EXPECT_THAT(error_of({.weights = {1, 1, std::numeric_limits<double>::infinity()}}), HasSubstr("positive"));
  EXPECT_THAT(error_of({.weights = {1, 1, 1e-300}}), HasSubstr("range"));
  EXPECT_THROW(projective_charts(variables, Strings{"z1 + 1"}), InvalidInput);
}

/// Every chart traced in its domain, with the boundary that the tracer found.
GluedMesh traced_and_glued(const ChartAtlas& atlas, double edge_length) {
  const int d = atlas.ambient_dim();
  std::vector<ChartPiece> pieces;
  for (const Chart& chart : atlas.charts) {
    TraceOptions options;
    options.inequalities = chart.inequalities;
    options.box.emplace();
    for (const auto& [lower, upper] : chart.box) {
      options.box->lower.push_back(lower);
      options.box->upper.push_back(upper);
    }
    std::vector<double> offset(d);
    for (int i = 0; i < d; ++i) offset[i] = 0.0123 * (i + 1);
    const auto triangulation = coxeter::coxeter_a(d, edge_length).transformed(Matrix::identity(d), offset);
    const std::vector<double> seeds = find_seeds(chart.function, Domain(d, options.inequalities, options.box)).points;
    const CellComplex complex = cell_complex(trace(chart.function, triangulation, seeds, options));
    const Strata strata = strata_of(complex);
    pieces.push_back(chart_piece(chart.name, pulled_subdivision(complex, &strata), strata));
  }
  GlueOptions options;
  options.embeddings = atlas.embeddings;
  options.embedding_dim = atlas.embedding_dim();
  return glue_charts(pieces, atlas.seams, options);
}

/// Curves whose genus is known.
TEST(ProjectiveCharts, CurvesOfKnownGenus) {
  struct Curve {
    const char* equation;
    std::int64_t chi;
    double edge_length;
  };
  const Strings variables{"z1", "z2", "z3"};
  for (const Curve& curve : {Curve{"z1^2 + z2^2 + z3^2", 2, 0.25}, Curve{"z1^3 + z2^3 + z3^3", 0, 0.2},
                             Curve{"z1^3*z2 + z2^3*z3 + z3^3*z1", -4, 0.2}}) {
    SCOPED_TRACE(curve.equation);
    const GluedMesh glued = traced_and_glued(projective_charts(variables, Strings{curve.equation}), curve.edge_length);
    const Topology topology = topology_of(glued.mesh, {.homology = false});
    EXPECT_EQ(topology.euler_characteristic, curve.chi);
    EXPECT_EQ(topology.manifold, ManifoldKind::kClosed);
    EXPECT_EQ(topology.components, 1);
    EXPECT_TRUE(topology.orientable);
    for (const SeamReport& seam : glued.seams) EXPECT_LT(seam.worst_distance, 0.3 * curve.edge_length);
  }
}

TEST(ProjectiveCharts, RealSurfacesAndCurves) {
  // A quadric of signature (2, 2) in RP^3 is a torus, of signature (3, 1) a sphere; the plane is RP^2.
  const Strings variables{"a", "b", "c", "d"};
  for (const auto& [equation, chi, orientable] :
       {std::tuple("a^2 + b^2 - c^2 - d^2", 0, true), std::tuple("a^2 + b^2 + c^2 - 2*d^2 + a*d", 2, true),
        std::tuple("a + 2*b - 0.7*c + 0.3*d", 1, false)}) {
    SCOPED_TRACE(equation);
    const ChartAtlas atlas = projective_charts(variables, Strings{equation}, {.field = Field::kReal});
    const Topology topology = topology_of(traced_and_glued(atlas, 0.2).mesh);
    EXPECT_EQ(topology.euler_characteristic, chi);
    EXPECT_EQ(topology.orientable, orientable);
    EXPECT_EQ(topology.manifold, ManifoldKind::kClosed);
    EXPECT_EQ(topology.components, 1);
  }
  // A smooth real cubic curve with an oval: two loops.
  const ChartAtlas cubic =
      projective_charts(Strings{"x", "y", "z"}, Strings{"y^2*z - x^3 + x*z^2"}, {.field = Field::kReal});
  const Topology topology = topology_of(traced_and_glued(cubic, 0.05).mesh);
  EXPECT_EQ(topology.components, 2);
  EXPECT_EQ(topology.manifold, ManifoldKind::kClosed);
}

}  // namespace
}  // namespace whitney
