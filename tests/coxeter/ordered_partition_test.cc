// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/ordered_partition.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>

namespace whitney::coxeter {
namespace {

using ::testing::ElementsAre;

TEST(OrderedPartition, SortsInsideParts) {
  const OrderedPartition p = OrderedPartition::from_parts({{3, 1}, {4}, {2, 0}});
  EXPECT_EQ(p.num_elements(), 5);
  EXPECT_EQ(p.num_parts(), 3);
  EXPECT_THAT(p.elements(), ElementsAre(1, 3, 4, 0, 2));
  EXPECT_THAT(p.ends(), ElementsAre(2, 3, 5));
  EXPECT_THAT(p.part(0), ElementsAre(1, 3));
  EXPECT_THAT(p.part(2), ElementsAre(0, 2));
  EXPECT_THAT(p.part_indices(), ElementsAre(2, 0, 2, 0, 1));
}

TEST(OrderedPartition, PartIndicesRoundTrip) {
  const OrderedPartition p = OrderedPartition::from_parts({{3, 1}, {4}, {2, 0}});
  const IndexArray indices = p.part_indices();
  EXPECT_EQ(OrderedPartition::from_part_indices({indices.data(), indices.size()}), p);
}

TEST(OrderedPartition, TheOrderOfPartsCounts) {
  EXPECT_NE(OrderedPartition::from_parts({{0}, {1}}), OrderedPartition::from_parts({{1}, {0}}));
  EXPECT_NE(OrderedPartition::from_parts({{0, 1}}), OrderedPartition::from_parts({{0}, {1}}));
  // Same concatenated array, different split into elements and ends.
  EXPECT_NE(OrderedPartition::from_parts({{0}}), OrderedPartition());
}

TEST(OrderedPartition, RejectsWhatIsNoPartition) {
  using Parts = std::vector<std::vector<int>>;
  EXPECT_THROW(OrderedPartition::from_parts(Parts{{0}, {}}), InvalidInput);
  EXPECT_THROW(OrderedPartition::from_parts(Parts{{0}, {0}}), InvalidInput);
  EXPECT_THROW(OrderedPartition::from_parts(Parts{{0}, {2}}), InvalidInput);
  EXPECT_THROW(OrderedPartition::from_parts(Parts{{-1, 0}}), InvalidInput);
  const std::vector<std::uint16_t> gap{0, 2}, huge{0, 65535};
  EXPECT_THROW(OrderedPartition::from_part_indices(gap), InvalidInput);
  EXPECT_THROW(OrderedPartition::from_part_indices(huge), InvalidInput);
}

}  // namespace
}  // namespace whitney::coxeter
