// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/perturbed_triangulation.h>

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <tests/perturbation/circle_oracle.h>
#include <tests/perturbation/sphere_oracle.h>

#include <coxeter/base/error.h>

namespace whitney::perturbation {
namespace {

using coxeter::coxeter_a;

TEST(PerturbedTriangulation, NeighboursShareAFacetAndKnowEachOther) {
  for (const int d : {2, 3, 5}) {
    const auto triangulation = coxeter_a(d, 1);
    const SphereOracle oracle(d, 1);
    PerturbedTriangulation near(triangulation, oracle);
    const std::uint32_t s = near.locate(std::vector<double>(d, 0.21));
    for (int q = 0; q <= d; ++q) {
      const std::uint32_t other = near.neighbour(s, q);
      ASSERT_NE(other, s);
      std::set<std::uint32_t> mine(near.corners(s), near.corners(s) + d + 1), shared;
      mine.erase(near.corners(s)[q]);
      for (int i = 0; i <= d; ++i)
        if (mine.count(near.corners(other)[i])) shared.insert(near.corners(other)[i]);
      EXPECT_EQ(shared, mine);
      bool back = false;
      for (int i = 0; i <= d; ++i) back = back || near.neighbour(other, i) == s;
      EXPECT_TRUE(back);
    }
  }
}

TEST(PerturbedTriangulation, MovesVerticesAndPutsThemBack) {
  const auto triangulation = coxeter_a(2, 0.2);
  const CircleOracle circle(0.013, 0.027, 1);
  PerturbedTriangulation near(triangulation, circle);
  const std::uint32_t s = near.locate(std::vector<double>{1, 0});
  const std::uint32_t v = near.corners(s)[0];
  const std::vector<double> home(near.position(v), near.position(v) + 2), none(2, 0.0), u{0.03, -0.02};
  const Evaluation before = near.evaluate(s, 10);
  const std::uint64_t version = near.version(v);
  const std::size_t calls = near.oracle_calls();
  near.evaluate(s, 10);
  EXPECT_EQ(near.oracle_calls(), calls);  // remembered

  near.set_displacement(v, u);
  EXPECT_DOUBLE_EQ(near.position(v)[0], home[0] + u[0]);
  EXPECT_DOUBLE_EQ(near.position(v)[1], home[1] + u[1]);
  EXPECT_NE(near.version(v), version);
  EXPECT_NE(near.evaluate(s, 10).margin, before.margin);

  near.restore(v, none, version);
  near.remember(s, before);
  EXPECT_EQ(near.position(v)[0], home[0]);
  EXPECT_EQ(near.evaluate(s, 0).margin, before.margin);
  near.forget();
  EXPECT_EQ(near.evaluate(s, 10).margin, before.margin);
}

TEST(PerturbedTriangulation, TakesDisplacementsFromAMap) {
  const auto triangulation = coxeter_a(2, 1);
  const CircleOracle circle(0, 0, 1);
  PerturbedTriangulation near(triangulation, circle);
  DisplacementMap map(2);
  const std::vector<double> u{0.1, 0.05};
  coxeter::LatticeVertex z(2);
  map.set(z, u);
  near.displace(map);
  ASSERT_EQ(near.num_vertices(), 1u);
  EXPECT_EQ(near.displacement(0)[0], 0.1);
  EXPECT_EQ(near.displacement(0)[1], 0.05);
}

TEST(PerturbedTriangulation, TheFeetOfASimplexAreThoseOfItsPoints) {
  const auto triangulation = coxeter_a(2, 0.2);
  const CircleOracle circle(0.013, 0.027, 1);
  PerturbedTriangulation near(triangulation, circle);
  const std::uint32_t s = near.locate(std::vector<double>{1, 0});
  const double* v[3];
  for (int q = 0; q <= 2; ++q) v[q] = near.position(near.corners(s)[q]);
  // Barycentre, vertices, midpoints of 01, 02, 12.
  const double weights[7][3] = {
      {1. / 3, 1. / 3, 1. / 3}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {.5, .5, 0}, {.5, 0, .5}, {0, .5, .5}};
  for (std::uint16_t candidate = 0; candidate < 7; ++candidate) {
    double x[2], point[2], frame[4];
    for (int c = 0; c < 2; ++c) {
      x[c] = 0;
      for (int q = 0; q <= 2; ++q) x[c] += weights[candidate][q] * v[q][c];
    }
    FootErrors errors;
    ASSERT_TRUE(circle.foot(x, point, frame, errors));
    FootView foot{};
    ASSERT_TRUE(near.foot(s, candidate, foot));
    EXPECT_NEAR(foot.point[0], point[0], 1e-14) << candidate;
    EXPECT_NEAR(foot.point[1], point[1], 1e-14) << candidate;
  }
}

TEST(PerturbedTriangulation, NeedsOneAmbientDimension) {
  const auto triangulation = coxeter_a(3, 1);
  const CircleOracle circle(0, 0, 1);
  EXPECT_THROW(PerturbedTriangulation(triangulation, circle), InvalidInput);
}

}  // namespace
}  // namespace whitney::perturbation
