// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/growing_array.h>

#include <cstddef>
#include <utility>

#include <gtest/gtest.h>

namespace whitney::coxeter {
namespace {

TEST(GrowingArray, ValuesSurviveGrowthIntoLargeBlocks) {
  GrowingArray<int> array;
  constexpr int kCount = 3'000'000;
  for (int i = 0; i < kCount; ++i) array.push_back(i);
  ASSERT_EQ(array.size(), static_cast<std::size_t>(kCount));
  for (int i = 0; i < kCount; i += 997) EXPECT_EQ(array[i], i);
}

TEST(GrowingArray, CopiesAreApartAndMovesLeaveNothing) {
  GrowingArray<int> array;
  array.resize(3, 7);
  GrowingArray<int> copy = array;
  copy[0] = 1;
  EXPECT_EQ(array[0], 7);
  const GrowingArray<int> moved = std::move(copy);
  EXPECT_EQ(moved.size(), 3u);
  EXPECT_EQ(moved[0], 1);
  EXPECT_TRUE(copy.empty());
  array.truncate(1);
  array.resize(2, 5);
  EXPECT_EQ(array[1], 5);
}

}  // namespace
}  // namespace whitney::coxeter
