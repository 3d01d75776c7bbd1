// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/exact_pivot.h>

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace {

using Columns = std::vector<std::vector<double>>;

std::vector<const double*> pointers(const Columns& columns, int without = -1) {
  std::vector<const double*> out;
  for (int i = 0; i < static_cast<int>(columns.size()); ++i)
    if (i != without) out.push_back(columns[i].data());
  return out;
}

// k + 2 random columns with entries from a few integers: ties, zeros and dependent columns galore.
Columns random_columns(int k, int largest, std::mt19937& rng) {
  Columns columns(k + 2, std::vector<double>(k));
  for (auto& column : columns)
    for (double& x : column) x = static_cast<int>(rng() % (2 * largest + 1)) - largest;
  return columns;
}

TEST(ExactPivot, EveryCofacetHasNoneOrTwoFacesThatAreHit) {
  std::mt19937 rng(1);
  for (int k = 1; k <= 6; ++k)
    for (int largest : {1, 2, 1000})
      for (int trial = 0; trial < 300; ++trial) {
        const Columns columns = random_columns(k, largest, rng);
        std::vector<int> hit;
        for (int without = 0; without < k + 2; ++without)
          if (whitney::exactly_hit(pointers(columns, without))) hit.push_back(without);
        ASSERT_TRUE(hit.empty() || hit.size() == 2) << "k " << k << " trial " << trial << ": " << hit.size();
        if (hit.empty()) continue;
        // From the face without vertex a, adding a, the vertex that leaves is b; and back.
        for (int side = 0; side < 2; ++side) {
          const int a = hit[side], b = hit[1 - side];
          const int leaving = whitney::exactly_leaving(pointers(columns, a), columns[a].data());
          EXPECT_EQ(leaving < a ? leaving : leaving + 1, b);
        }
      }
}

TEST(ExactPivot, PowersOfTwoPerComponentChangeNothing) {
  std::mt19937 rng(2);
  for (int trial = 0; trial < 200; ++trial) {
    const int k = 3;
    const Columns columns = random_columns(k, 1, rng);
    Columns scaled = columns;
    for (auto& column : scaled) {
      column[0] = std::ldexp(column[0], -900);
      column[1] = std::ldexp(column[1], 1000);
    }
    for (int without = 0; without < k + 2; ++without)
      EXPECT_EQ(whitney::exactly_hit(pointers(columns, without)), whitney::exactly_hit(pointers(scaled, without)));
  }
}

TEST(ExactPivot, TargetIsEpsilonNotZero) {
  // One equation: a zero counts as negative.
  const double zero = 0, plus = 1, minus = -1;
  EXPECT_TRUE(whitney::exactly_hit(std::vector{&zero, &plus}));
  EXPECT_FALSE(whitney::exactly_hit(std::vector{&zero, &minus}));
  EXPECT_FALSE(whitney::exactly_hit(std::vector{&zero, &zero}));
}

TEST(ExactPivot, WeightsAreBarycentricCoordinates) {
  // 0 = 1/2 (1,0) + 1/3 (-1,-1) + 1/6 (-1,2)
  const Columns columns{{1, 0}, {-1, -1}, {-1, 2}};
  const auto weights = whitney::exact_weights(pointers(columns));
  EXPECT_DOUBLE_EQ(weights[0], 1.0 / 2);
  EXPECT_DOUBLE_EQ(weights[1], 1.0 / 3);
  EXPECT_DOUBLE_EQ(weights[2], 1.0 / 6);
  // The smallest and the largest doubles in one column.
  const double tiny = 5e-324, huge = -1.7e308;
  const auto extreme = whitney::exact_weights(std::vector{&tiny, &huge});
  EXPECT_DOUBLE_EQ(extreme[0], 1.0);
  EXPECT_GE(extreme[1], 0.0);
}

}  // namespace
