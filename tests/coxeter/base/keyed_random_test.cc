// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/keyed_random.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace whitney::coxeter {
namespace {

using Vertex = std::vector<std::int32_t>;

TEST(KeyedRandom, IsAFunctionOfItsKeys) {
  const Vertex z{3, -1, 4};
  KeyedRandom a(7, z), b(7, z);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.bits(), b.bits());
}

TEST(KeyedRandom, DiffersBetweenKeys) {
  std::set<std::uint64_t> first;
  std::size_t streams = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed)
    for (std::int32_t x = -3; x <= 3; ++x)
      for (std::int32_t y = -3; y <= 3; ++y, ++streams) {
        const Vertex z{x, y};
        first.insert(KeyedRandom(seed, z).bits());
      }
  EXPECT_EQ(first.size(), streams);
  // The order of the coordinates counts.
  const Vertex z{1, 2}, reversed{2, 1};
  EXPECT_NE(KeyedRandom(1, z).bits(), KeyedRandom(1, reversed).bits());
}

TEST(KeyedRandom, DrawsFromTheDistributionsItNames) {
  const Vertex z{1};
  KeyedRandom random(1, z);
  const int n = 100'000;
  double mean = 0, square = 0;
  std::vector<int> counts(5, 0);
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    ASSERT_GT(u, 0);
    ASSERT_LE(u, 1);
    mean += u / n;
    const double g = random.normal();
    square += g * g / n;
    const int k = random.below(5);
    ASSERT_GE(k, 0);
    ASSERT_LT(k, 5);
    ++counts[k];
  }
  // Five standard deviations of a mean of n draws.
  EXPECT_NEAR(mean, 0.5, 5 / std::sqrt(12.0 * n));
  EXPECT_NEAR(square, 1, 5 * std::sqrt(2.0 / n));
  for (const int count : counts) EXPECT_NEAR(count, n / 5, 5 * std::sqrt(n * 0.2 * 0.8));
}

TEST(KeyedRandom, FillsTheBall) {
  const Vertex z{2, 2};
  for (const int d : {1, 2, 5}) {
    KeyedRandom random(1, z);
    const int n = 20'000;
    int inside_half = 0;  // of the volume
    for (int i = 0; i < n; ++i) {
      std::vector<double> x(d);
      random.in_ball(3, x);
      double squared = 0;
      for (const double c : x) squared += c * c;
      ASSERT_LE(std::sqrt(squared), 3 * (1 + 1e-12));
      inside_half += std::pow(std::sqrt(squared) / 3, d) <= 0.5;
    }
    EXPECT_NEAR(inside_half, n / 2, 5 * std::sqrt(n * 0.25)) << d;
  }
}

}  // namespace
}  // namespace whitney::coxeter
