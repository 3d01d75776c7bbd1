// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/inline_array.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace whitney::coxeter {
namespace {

using Array = InlineArray<int, 3>;
using ::testing::ElementsAre;

Array counted(int n) {
  Array a;
  for (int i = 0; i < n; ++i) a.push_back(i);
  return a;
}

TEST(InlineArray, GrowsBeyondItsPlace) {
  EXPECT_TRUE(counted(0).empty());
  EXPECT_THAT(counted(3), ElementsAre(0, 1, 2));
  EXPECT_THAT(counted(7), ElementsAre(0, 1, 2, 3, 4, 5, 6));
}

TEST(InlineArray, CopiesAndMovesBetweenAllSizes) {
  for (const int from : {0, 2, 3, 4, 9})
    for (const int to : {0, 2, 3, 4, 9}) {
      Array a = counted(from), b = counted(to);
      b = a;
      EXPECT_EQ(b, counted(from));
      b.push_back(5);  // the copy owns its values
      EXPECT_EQ(a, counted(from));
      Array c = counted(to);
      c = std::move(a);
      EXPECT_EQ(c, counted(from));
      EXPECT_TRUE(a.empty());  // NOLINT: the moved-from state is documented by this test
      a = counted(to);         // and can be used again
      EXPECT_EQ(a, counted(to));
      const Array d(std::move(c));
      EXPECT_EQ(d, counted(from));
    }
}

TEST(InlineArray, ComparesSizesToo) { EXPECT_FALSE(counted(2) == counted(3)); }

}  // namespace
}  // namespace whitney::coxeter
