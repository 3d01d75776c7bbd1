// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/cut_regularity.h>

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/triangulation.h>
#include <whitney/functions/expression.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/tracing/trace.h>

namespace whitney {
namespace {

struct Singular {
  std::string name;
  std::vector<std::string> equations;
  std::vector<double> seed;
  double edge_length;
  std::vector<double> place;  // one singular point
  bool isolated = true;
};

const std::vector<std::string> kVariables{"x", "y", "z"};

CutRegularity regularity_of(const std::vector<std::string>& equations, std::vector<double> seed, double edge_length,
                            double box = 3) {
  const int d = static_cast<int>(seed.size());
  const Function f = parse_equations(std::span(kVariables).first(d), equations);
  TraceOptions options;
  options.box = Box{std::vector<double>(d, -box), std::vector<double>(d, box)};
  const TraceResult traced = trace(f, coxeter::coxeter_a(d, edge_length), seed, options);
  EXPECT_GT(traced.num_simplices(), 0u);
  return check_interior(f, traced, edge_length);
}

TEST(CheckInterior, FindsSingularPoints) {
  const std::vector<Singular> cases{
      {"lemniscate", {"(x^2+y^2)^2-x^2+y^2"}, {1, 0}, 0.05, {0, 0}},
      {"nodal cubic", {"y^2-x^2*(x+1)"}, {-1, 0}, 0.05, {0, 0}},
      {"cusp", {"y^2-x^3"}, {1, 1}, 0.05, {0, 0}},
      {"horn torus", {"(x^2+y^2+z^2)^2-4*(x^2+y^2)"}, {2, 0, 0}, 0.2, {0, 0, 0}},
      {"cone", {"x^2+y^2-z^2"}, {1, 0, 1}, 0.2, {0, 0, 0}},
      {"Whitney's umbrella", {"x^2-y^2*z"}, {1, 1, 1}, 0.2, {0, 0, 0}, false},
      {"Viviani's curve", {"x^2+y^2+z^2-4", "(x-1)^2+y^2-1"}, {0, 0, 2}, 0.1, {2, 0, 0}},
      {"two planes", {"x*y"}, {1, 0, 0}, 0.3, {0, 0, 0}, false},
      {"touching spheres", {"(x^2+y^2+z^2-1)*((x-2)^2+y^2+z^2-1)"}, {-1, 0, 0}, 0.11, {1, 0, 0}},
      {"touching tori",
       {"((x^2+y^2+z^2+0.75)^2-4*(x^2+y^2))*((x^2+y^2+(z-1)^2+0.75)^2-4*(x^2+y^2))"},
       {1.5, 0, 0},
       0.17,
       {1, 0, 0.5},
       false},
  };
  for (const Singular& c : cases) {
    for (const double factor : {1.0, 0.61}) {
      SCOPED_TRACE(c.name + " at " + std::to_string(factor));
      const double L = factor * c.edge_length;
      const CutRegularity found = regularity_of(c.equations, c.seed, L);
      ASSERT_FALSE(found.singular.empty());
      if (c.isolated) {
        EXPECT_EQ(found.singular.size(), 1u);
      }
      for (const SingularCut& cut : found.singular) {
        EXPECT_LT(cut.singular_value, 1e-5);
        double square = 0;
        for (std::size_t i = 0; i < c.place.size(); ++i) square += std::pow(cut.point[i] - c.place[i], 2);
        if (c.isolated) {
          EXPECT_LT(std::sqrt(square), 0.05 * L);
        }
      }
    }
  }
}

TEST(CheckInterior, UnitsOfTheFunctionAndOfLengthDoNotMatter) {
  for (const std::string factor : {"1", "10^200", "10^(-200)"})
    EXPECT_EQ(regularity_of({factor + "*((x^2+y^2)^2-x^2+y^2)"}, {1, 0}, 0.05).singular.size(), 1u) << factor;
  EXPECT_EQ(regularity_of({"10^200*(x^2+y^2+z^2-4*10^(-18))", "10^(-200)*((x-10^(-9))^2+y^2-10^(-18))"}, {0, 0, 2e-9},
                          1e-10, 1e-8)
                .singular.size(),
            1u);
}

TEST(CheckInterior, RaisesNoFalseAlarm) {
  EXPECT_TRUE(regularity_of({"x^2+y^2+z^2-1"}, {1, 0, 0}, 0.1).singular.empty());
  EXPECT_TRUE(regularity_of({"10^200*(x^2+y^2+z^2-1)"}, {1, 0, 0}, 0.1).singular.empty());
  EXPECT_TRUE(regularity_of({"10^(-200)*(x^2+y^2+z^2-1)"}, {1, 0, 0}, 0.1).singular.empty());
  // Near misses, both ways: the neck is a fifth of an edge length wide, then a thousandth.
  for (const std::string c : {"0.0001", "-0.0001", "0.00000001", "-0.00000001"}) {
    EXPECT_TRUE(regularity_of({"(x^2+y^2)^2-x^2+y^2+" + c}, {1, 0}, 0.05).singular.empty()) << c;
    EXPECT_TRUE(regularity_of({"x^2+y^2-z^2+" + c}, {1, 0, 1}, 0.1).singular.empty()) << c;
  }
  for (const char* name :
       {"sphere", "flat_torus", "torus_of_revolution", "chair", "pentagon_linkage", "trefoil", "two_spheres"}) {
    const NamedManifold manifold = named_manifold(name);
    const int d = manifold.function.ambient_dim();
    TraceOptions options;
    options.run.max_simplices = 60000;
    for (const double L : {0.4, 0.2}) {
      const TraceResult traced = trace(manifold.function, coxeter::coxeter_a(d, L), manifold.point, options);
      EXPECT_TRUE(check_interior(manifold.function, traced, L).singular.empty()) << name << " " << L;
    }
  }
}

}  // namespace
}  // namespace whitney
