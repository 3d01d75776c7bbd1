// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/inside.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <tests/perturbation/circle_oracle.h>
#include <tests/perturbation/sphere_oracle.h>

#include <coxeter/base/error.h>
#include <coxeter/quality.h>
#include <perturbation/hit_walk.h>

namespace whitney::perturbation {
namespace {

using coxeter::coxeter_a;

TEST(Inside, BarycentricCoordinatesOfABall) {
  const double a[] = {0, 0}, b[] = {1, 0}, c[] = {0, 1}, point[] = {0.25, 0.25};
  const double* const vertices[] = {a, b, c};
  const BarycentricBounds exact = barycentric_bounds(vertices, 2, point, 0);
  EXPECT_NEAR(exact.coordinates[0], 0.5, 1e-15);
  EXPECT_NEAR(exact.coordinates[1], 0.25, 1e-15);
  EXPECT_LT(exact.slack, 1e-14);
  EXPECT_TRUE(exact.inside());
  // lambda_0 = 1 - x - y changes by up to sqrt(2) times the way; what is proved may be coarser by a constant.
  const BarycentricBounds wide = barycentric_bounds(vertices, 2, point, 0.1);
  EXPECT_GE(wide.slack, 0.1 * std::sqrt(2.0));
  EXPECT_LE(wide.slack, 0.21);
  const double* const flat[] = {a, b, b};
  EXPECT_EQ(barycentric_bounds(flat, 2, point, 0).slack, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(proved_inside(flat, 2, point, 0));
  EXPECT_FALSE(proved_inside(vertices, 2, point, std::numeric_limits<double>::infinity()));
}

/// T~ with every vertex about the start moved by almost the half of the width.
void displace_all(PerturbedTriangulation& near, std::uint32_t s) {
  const int d = near.ambient_dim();
  for (int q = 0; q <= d; ++q) near.neighbour(s, q);
  const double rho = 0.499 * coxeter::simplex_width(near.triangulation()) / std::sqrt(d);
  for (std::uint32_t v = 0; v < near.num_vertices(); ++v) {
    std::vector<double> u(d);
    for (int c = 0; c < d; ++c) u[c] = (v + c) % 2 == 0 ? rho : -rho;
    near.set_displacement(v, u);
  }
}

TEST(Inside, ABallInsideASimplexIsCoveredByIt) {
  for (const int d : {2, 3, 5}) {
    const auto triangulation = coxeter_a(d, 1);
    const SphereOracle oracle(d, 1);
    PerturbedTriangulation near(triangulation, oracle);
    std::vector<double> x(d, 0.21);
    const std::uint32_t s = near.locate(x);
    displace_all(near, s);
    std::fill(x.begin(), x.end(), 0.0);
    for (int q = 0; q <= d; ++q)
      for (int c = 0; c < d; ++c) x[c] += near.position(near.corners(s)[q])[c] / (d + 1);
    EXPECT_EQ(proved_cover(near, x, 1e-12), std::vector<std::uint32_t>{s}) << d;
  }
}

TEST(Inside, ABallAboutAVertexIsCoveredByItsStar) {
  const int simplices_around[] = {0, 2, 6, 24};  // (d + 1)!
  for (const int d : {2, 3}) {
    const auto triangulation = coxeter_a(d, 1);
    const SphereOracle oracle(d, 1);
    PerturbedTriangulation near(triangulation, oracle);
    const std::uint32_t s = near.locate(std::vector<double>(d, 0.21));
    displace_all(near, s);
    const std::uint32_t v = near.corners(s)[1];
    const std::vector<double> x(near.position(v), near.position(v) + d);
    const auto cover = proved_cover(near, x, 1e-13);
    EXPECT_EQ(cover.size(), static_cast<std::size_t>(simplices_around[d])) << d;
    for (const std::uint32_t t : cover)
      EXPECT_NE(std::find(near.corners(t), near.corners(t) + d + 1, v), near.corners(t) + d + 1);
    EXPECT_TRUE(proved_cover(near, x, 1e-13, 3).empty());  // more than allowed
  }
}

TEST(Inside, ALargeBallNeedsManySimplices) {
  const auto triangulation = coxeter_a(2, 1);
  const CircleOracle oracle(0, 0, 1);
  PerturbedTriangulation near(triangulation, oracle);
  const std::vector<double> x{0.3, 0.2};
  EXPECT_GT(proved_cover(near, x, 0.5).size(), 4u);
  EXPECT_TRUE(proved_cover(near, x, 100).empty());
  EXPECT_TRUE(proved_cover(near, x, std::numeric_limits<double>::infinity()).empty());
  EXPECT_THROW(proved_cover(near, x, -1), InvalidInput);
  EXPECT_THROW(proved_cover(near, x, std::nan("")), InvalidInput);
  EXPECT_THROW(proved_cover(near, std::vector<double>{1}, 0), InvalidInput);
}

TEST(Inside, ASeedOnTheManifoldLiesInTheCertifiedUnionAndOneElsewhereDoesNot) {
  const auto triangulation = coxeter_a(2, 0.2);
  const CircleOracle circle(0.013, 0.027, 1);
  PerturbedTriangulation near(triangulation, circle);
  const std::vector<double> seed{1.013, 0.027};
  const std::uint32_t start = find_start(near, seed);
  const HitWalk walk = walk_hit_facets(near, std::span(&start, 1));
  ASSERT_GT(walk.simplices.size(), 20u);
  std::vector<double> points;
  for (int i = 0; i < 12; ++i) points.insert(points.end(), {0.013 + std::cos(i + 0.5), 0.027 + std::sin(i + 0.5)});
  points.insert(points.end(), {3, 3});  // another component, say
  points.insert(points.end(), {0.02, 0.01});
  points.insert(points.end(), {1.013, 0.027});
  std::vector<double> errors(15, 1e-14);
  errors[14] = 1;  // as good as unknown
  const std::vector<bool> proved = proved_in_union(near, walk.simplices, points, errors);
  ASSERT_EQ(proved.size(), 15u);
  for (int i = 0; i < 12; ++i) EXPECT_TRUE(proved[i]) << i;
  EXPECT_FALSE(proved[12]);
  EXPECT_FALSE(proved[13]);
  EXPECT_FALSE(proved[14]);
  EXPECT_THROW(proved_in_union(near, walk.simplices, points, std::vector<double>(3)), InvalidInput);
}

}  // namespace
}  // namespace whitney::perturbation
