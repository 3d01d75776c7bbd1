// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/seed_start.h>

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/triangulation.h>
#include <whitney/functions/expression.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/tracing/trace.h>

namespace whitney {
namespace {

const std::vector<std::string> kVariables{"x", "y", "z"};

Function unit_sphere_and_speck(const std::string& x) {
  const std::vector<std::string> equation{"(x^2+y^2+z^2-1)*((x-" + x + ")^2+y^2+z^2-0.0001)"};
  return parse_equations(kVariables, equation);
}

TEST(SeedStarter, SeedsOnAPartTooSmallToBeSeenSaySo) {
  for (const std::string x : {"0.1", "2.2", "10"}) {
    const Function f = unit_sphere_and_speck(x);
    const double at = std::stod(x);
    const std::vector<double> seeds{0.6, 0.8, 0, at + 0.01, 0, 0, at, 0.01, 0};
    const TraceResult traced = trace(f, coxeter::coxeter_a(3, 0.3), seeds);
    EXPECT_EQ(traced.seeds[0].outcome, SeedReport::Outcome::kUsed);
    for (const std::size_t i : {1, 2}) {
      const SeedReport& seed = traced.seeds[i];
      EXPECT_EQ(seed.outcome, SeedReport::Outcome::kTooSmall) << x;
      ASSERT_EQ(seed.unseen.size(), 3u);
      EXPECT_NEAR(std::hypot(seed.unseen[0] - at, seed.unseen[1], seed.unseen[2]), 0.01, 1e-6);
      EXPECT_GT(seed.finer_edge_length, 0.001);
      EXPECT_LT(seed.finer_edge_length, 0.1);
      // That edge length does it.
      const TraceResult finer =
          trace(f, coxeter::coxeter_a(3, seed.finer_edge_length), std::span(seeds).subspan(3 * i, 3));
      EXPECT_EQ(finer.seeds[0].outcome, SeedReport::Outcome::kUsed);
      EXPECT_LT(finer.num_simplices(), 2000u);
    }
  }
}

TEST(SeedStarter, WhatIsSeenIsNotCalledTooSmall) {
  for (const char* name : {"sphere", "flat_torus", "torus_of_revolution", "chair", "pentagon_linkage", "two_spheres"}) {
    const NamedManifold manifold = named_manifold(name);
    const int d = manifold.function.ambient_dim();
    const std::vector<double> lower(d, -4), upper(d, 4);
    FindSeedsOptions options;
    options.num_starts = options.num_critical = 60;
    const FoundSeeds found = find_seeds(manifold.function, Box{lower, upper}, options);
    const TraceResult traced = trace(manifold.function, coxeter::coxeter_a(d, 0.4), found.points);
    for (const SeedReport& seed : traced.seeds) EXPECT_NE(seed.outcome, SeedReport::Outcome::kTooSmall) << name;
  }
}

TEST(SeedStarter, ASingularSeedIsNoPartTooSmall) {
  const std::vector<std::string> squares{"(x-0.1)^2+(y-0.05)^2+z^2"};
  const TraceResult traced =
      trace(parse_equations(kVariables, squares), coxeter::coxeter_a(3, 0.3), std::vector<double>{0.1, 0.05, 0});
  EXPECT_EQ(traced.seeds[0].outcome, SeedReport::Outcome::kDropped);
}

TEST(SeedStarter, UnitsOfEachEquationDoNotMatter) {
  const std::vector<std::string> plain{"x^2+y^2+z^2-10^(-18)", "x-z-0.37*10^(-10)"};
  const std::vector<std::string> scaled{"10^200*(x^2+y^2+z^2-10^(-18))", "10^(-200)*(x-z-0.37*10^(-10))"};
  const std::vector<double> seed{0.8e-9, 0, 0.7e-9};
  const auto triangulation = coxeter::coxeter_a(3, 1e-10);
  const TraceResult a = trace(parse_equations(kVariables, plain), triangulation, seed);
  const TraceResult b = trace(parse_equations(kVariables, scaled), triangulation, seed);
  EXPECT_GT(a.num_simplices(), 20u);
  EXPECT_EQ(a.num_simplices(), b.num_simplices());
  EXPECT_EQ(b.seeds[0].outcome, SeedReport::Outcome::kUsed);
}

}  // namespace
}  // namespace whitney
