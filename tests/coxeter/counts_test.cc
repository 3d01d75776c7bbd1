// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/counts.h>

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <tests/coxeter/brute_force.h>

#include <coxeter/faces/cofaces.h>

namespace whitney::coxeter {
namespace {

TEST(Counts, OrderedPartitionsByListingMaps) {
  for (int n = 1; n <= 6; ++n)
    for (int j = 1; j <= n; ++j) {
      int surjections = 0, maps = 1;
      for (int i = 0; i < n; ++i) maps *= j;
      for (int map = 0; map < maps; ++map) {
        int image = 0;
        for (int i = 0, rest = map; i < n; ++i, rest /= j) image |= 1 << rest % j;
        surjections += image == (1 << j) - 1;
      }
      EXPECT_EQ(num_ordered_partitions(n, j), surjections);
    }
  EXPECT_EQ(num_ordered_partitions(3, 0), 0);
  EXPECT_EQ(num_ordered_partitions(3, 4), 0);
}

TEST(Counts, FacesOfTheReferenceTable) {
  EXPECT_EQ(num_faces(30, 22), 7888725);  // SoCG 2021, Table 1, prints 5852925; C(31, 23) is this
  EXPECT_EQ(num_faces(30, 26), 31465);
  EXPECT_EQ(num_faces(3, 4), 0);
  EXPECT_EQ(num_faces(3, -1), 0);
}

TEST(Counts, StarsByBruteForce) {
  for (int d = 1; d <= 4; ++d)
    for (int m = 0; m <= d; ++m) {
      const LatticeVertex origin(d);
      const auto star = testing::brute_force_cofaces({origin}, m);
      int based = 0;  // the origin is the least vertex in the lexicographic order, too
      for (const auto& s : star) based += *s.begin() == origin;
      EXPECT_EQ(num_simplices_in_star(d, m), double(star.size()));
      EXPECT_EQ(num_simplices_per_base(d, m), based);
    }
}

TEST(Counts, StarsByEnumeration) {
  const Simplex origin(LatticeVertex(7), OrderedPartition::from_parts({{0, 1, 2, 3, 4, 5, 6, 7}}));
  for (int m = 0; m <= 7; ++m) {
    double count = 0, based = 0;
    for_each_coface(origin, m, [&](const Simplex& s) {
      ++count;
      based += s.base() == origin.base();
    });
    EXPECT_EQ(num_simplices_in_star(7, m), count);
    EXPECT_EQ(num_simplices_per_base(7, m), based);
  }
  EXPECT_EQ(num_simplices_in_star(7, 7), 40320);
}

TEST(Counts, LargeOnesDoNotWrap) {
  EXPECT_NEAR(num_faces(400, 3) / (401.0 * 400 * 399 * 398 / 24), 1, 1e-15);
  EXPECT_EQ(num_simplices_in_star(400, 400), std::numeric_limits<double>::infinity());  // 401!
  std::mt19937 gen(1);
  const Simplex s = testing::random_simplex(400, 1, gen);
  EXPECT_FALSE(std::isnan(num_cofaces(s, 400)));
  EXPECT_GT(num_cofaces(s, 2), 1e18);
}

}  // namespace
}  // namespace whitney::coxeter
