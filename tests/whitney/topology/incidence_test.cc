// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/incidence.h>

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace whitney {
namespace {

using List = std::vector<std::uint32_t>;

List list_of(const Incidence& lists, std::size_t i) { return {lists[i].begin(), lists[i].end()}; }

TEST(Incidence, Transposed) {
  const Incidence lists{{0, 2, 2, 5}, {3, 1, 0, 1, 4}};
  ASSERT_EQ(lists.size(), 3u);
  EXPECT_EQ(list_of(lists, 0), (List{3, 1}));
  EXPECT_TRUE(lists[1].empty());
  const Incidence reverse = transposed(lists, 6);
  ASSERT_EQ(reverse.size(), 6u);
  EXPECT_EQ(list_of(reverse, 0), List{2});
  EXPECT_EQ(list_of(reverse, 1), (List{0, 2}));
  EXPECT_TRUE(reverse[2].empty());
  EXPECT_EQ(list_of(reverse, 3), List{0});
  EXPECT_EQ(list_of(reverse, 4), List{2});
  EXPECT_TRUE(reverse[5].empty());
  // Twice: each list sorted.
  const Incidence again = transposed(reverse, 3);
  EXPECT_EQ(again.offset, lists.offset);
  EXPECT_EQ(again.index, (List{1, 3, 0, 1, 4}));
}

TEST(Incidence, EmptyLists) {
  const Incidence none = empty_lists(3);
  EXPECT_EQ(none.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(none[i].empty());
  EXPECT_EQ(empty_lists(0).size(), 0u);
  EXPECT_EQ(transposed(Incidence(), 2).size(), 2u);
}

}  // namespace
}  // namespace whitney
