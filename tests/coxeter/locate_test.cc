// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/locate.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <tests/coxeter/brute_force.h>

#include <coxeter/base/error.h>

namespace whitney::coxeter {
namespace {

using testing::random_simplex;

/// The point with barycentric coordinates 1/2, 1/4, .., and the last one twice: exact in doubles for small simplices.
std::vector<double> dyadic_interior_point(const Simplex& s) {
  std::vector<double> z(static_cast<std::size_t>(s.ambient_dim()), 0.0);
  double weight = 1;
  for (int q = 0; q <= s.dim(); ++q) {
    if (q < s.dim()) weight /= 2;
    const LatticeVertex v = s.vertex(q);
    for (std::size_t c = 0; c < z.size(); ++c) z[c] += weight * v[static_cast<int>(c)];
  }
  return z;
}

/// The barycentric coordinates of z in a d-simplex, from a chain of vertices: by the definition of the parts.
std::vector<double> barycentric(const Simplex& s, const std::vector<double>& z) {
  std::vector<double> height;  // z - base, part after part: parts are singletons
  for (int q = 0; q < s.dim(); ++q) {
    const auto c = s.partition().part(q)[0];
    height.push_back(z[c] - s.base()[c]);
  }
  std::vector<double> result{1 - height[0]};
  for (std::size_t q = 1; q < height.size(); ++q) result.push_back(height[q - 1] - height[q]);
  result.push_back(height.back());
  return result;
}

TEST(Locate, InteriorPointsExactly) {
  std::mt19937 gen(1);
  for (int d = 1; d <= 12; ++d)
    for (int m = 0; m <= d; ++m)
      for (int i = 0; i < 20; ++i) {
        const Simplex s = random_simplex(d, m, gen);
        const std::vector<double> z = dyadic_interior_point(s);
        EXPECT_EQ(locate_lattice(z), s);
        EXPECT_TRUE(s.is_face_of(locate_full_lattice(z)));
        EXPECT_EQ(locate_full_lattice(z).dim(), d);
      }
}

TEST(Locate, InteriorPointsThroughAnExactTriangulation) {
  std::mt19937 gen(2);
  const Triangulation t = freudenthal(9, 0.75);  // spacing 1/4
  for (int m = 0; m <= 9; ++m) {
    const Simplex s = random_simplex(9, m, gen);
    std::vector<double> x = dyadic_interior_point(s);
    for (double& c : x) c /= 4;
    EXPECT_EQ(locate(t, x), s);
  }
}

TEST(Locate, BarycentresOfAllDimensions) {
  std::mt19937 gen(3);
  for (const int d : {1, 2, 3, 5, 10, 50})
    for (const auto& t : {freudenthal(d, 0.3), coxeter_a(d, 0.3)})
      for (int m = 0; m <= d; m += 1 + d / 10) {
        const Simplex s = random_simplex(d, m, gen, 100);
        const std::vector<double> view = barycentre(s, t);
        // Rounding may move the point off s, but not out of its open star.
        EXPECT_TRUE(s.is_face_of(locate(t, view)));
        EXPECT_TRUE(s.is_face_of(locate_full(t, view)));
        if (m == d) {
          EXPECT_EQ(locate(t, view), s);
        }
      }
}

TEST(Locate, RandomPointsLieInTheirSimplex) {
  std::mt19937 gen(4);
  std::uniform_real_distribution<double> uniform(-10, 10);
  for (const int d : {1, 2, 3, 7, 400})
    for (int i = 0; i < 50; ++i) {
      std::vector<double> z(static_cast<std::size_t>(d));
      for (double& c : z) c = i % 2 ? uniform(gen) : std::round(4 * uniform(gen)) / 4;  // generic, and full of ties
      const Simplex full = locate_full_lattice(z), least = locate_lattice(z);
      const auto lambda = barycentric(full, z);
      for (const double l : lambda) EXPECT_GE(l, -1e-12);
      EXPECT_EQ(std::ranges::count_if(lambda, [](double l) { return l > 1e-12; }), least.dim() + 1);
      EXPECT_TRUE(least.is_face_of(full));
    }
}

TEST(Locate, TiesAreExact) {
  using Parts = std::vector<std::vector<int>>;
  auto simplex = [](LatticeVertex v, const Parts& parts) { return Simplex(v, OrderedPartition::from_parts(parts)); };
  // z - floor(z) rounds to 1 for both; they differ all the same.
  EXPECT_EQ(locate_lattice(std::vector{-1e-300, -2e-300}), simplex({-1, -1}, {{0}, {1}, {2}}));
  EXPECT_EQ(locate_lattice(std::vector{-1e-300, -1e-300}), simplex({-1, -1}, {{0, 1}, {2}}));
  EXPECT_EQ(locate_lattice(std::vector{1e-300, -1e-300}), simplex({0, -1}, {{1}, {0}, {2}}));
  // One half, from both sides of the even integers.
  EXPECT_EQ(locate_lattice(std::vector{0.5, 1.5, -0.5}), simplex({0, 1, -1}, {{0, 1, 2}, {3}}));
  EXPECT_EQ(locate_lattice(std::vector{0.5, std::nextafter(1.5, 2), -0.5}), simplex({0, 1, -1}, {{1}, {0, 2}, {3}}));
  EXPECT_EQ(locate_lattice(std::vector{0.5, std::nextafter(1.5, 1), -0.5}), simplex({0, 1, -1}, {{0, 2}, {1}, {3}}));
  EXPECT_EQ(locate_lattice(std::vector{-0.0, 3.0}), simplex({0, 3}, {{0, 1, 2}}));
  // Deterministic choice of the d-simplex: smaller index first.
  EXPECT_EQ(locate_full_lattice(std::vector{0.0, 0.5, 0.5, 0.0}), simplex({0, 0, 0, 0}, {{1}, {2}, {0}, {3}, {4}}));
}

TEST(Locate, RangeOfTheLattice) {
  EXPECT_EQ(locate_lattice(std::vector{-2147483648.0}).base()[0], std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(locate_lattice(std::vector{2147483646.5}).base()[0], 2147483646);
  EXPECT_THROW(locate_lattice(std::vector{2147483647.0}), LatticeOverflow);
  EXPECT_THROW(locate_lattice(std::vector{-2147483648.5}), LatticeOverflow);
  EXPECT_THROW(locate_lattice(std::vector{1e300}), LatticeOverflow);
  EXPECT_THROW(locate(freudenthal(1, 1e-300), std::vector{1e300}), LatticeOverflow);
}

TEST(Locate, RejectsBadInput) {
  const Triangulation t = coxeter_a(2, 1);
  EXPECT_THROW(locate(t, std::vector{1.0}), InvalidInput);
  EXPECT_THROW(locate(t, std::vector{1.0, std::nan("")}), InvalidInput);
  EXPECT_THROW(locate_full(t, std::vector<double>{1.0, INFINITY}), InvalidInput);
  EXPECT_THROW(locate_lattice(std::vector<double>{INFINITY}), InvalidInput);
  EXPECT_THROW(locate_lattice(std::vector<double>{}), InvalidInput);
}

}  // namespace
}  // namespace whitney::coxeter
