// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/boundary_strands.h>

#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "atlas/glue_cases.h"

namespace whitney::internal {
namespace {

using namespace glue_cases;
using testing::ElementsAre;

TEST(BoundaryStrands, SidesOfASquareAreArcsFromCornerToCorner) {
  std::mt19937_64 random(1);
  const std::vector<ChartPiece> pieces{square({3, 1, 2, 1}, 0, random)};
  Quilt quilt(2, 2);
  const SeamNames names(pieces, {});
  const std::vector<Quilt::Vertex> first = add_patches(pieces, names, quilt);
  EXPECT_THAT(first, ElementsAre(0u));
  const StrandsBySide strands = boundary_strands(pieces, names, 2, quilt, first);
  ASSERT_EQ(strands.size(), 4u);
  // The ring: corners 0, 3, 4, 6; side 0 goes 0 1 2 3, side 2 goes 4 5 6.
  const BoundaryStrands& bottom = strands.at({0, 0});
  EXPECT_THAT(bottom.corners, ElementsAre(0u, 3u));
  ASSERT_EQ(bottom.arcs.size(), 1u);
  EXPECT_THAT(bottom.arcs[0], ElementsAre(0u, 1u, 2u, 3u));
  EXPECT_TRUE(bottom.loops.empty());
  const BoundaryStrands& top = strands.at({0, 2});
  EXPECT_THAT(top.corners, ElementsAre(4u, 6u));
  EXPECT_THAT(top.arcs[0], ElementsAre(4u, 5u, 6u));
}

TEST(BoundaryStrands, TheBoundaryOfADiscIsALoop) {
  std::mt19937_64 random(1);
  const std::vector<ChartPiece> pieces{disc(circle(random_angles(5, random), 0, random)),
                                       disc(circle(random_angles(7, random), 0, random))};
  Quilt quilt(2, 2);
  const SeamNames names(pieces, {});
  const std::vector<Quilt::Vertex> first = add_patches(pieces, names, quilt);
  EXPECT_THAT(first, ElementsAre(0u, 6u));
  const StrandsBySide strands = boundary_strands(pieces, names, 2, quilt, first);
  for (int c : {0, 1}) {
    const BoundaryStrands& part = strands.at({c, 0});
    EXPECT_TRUE(part.corners.empty());
    EXPECT_TRUE(part.arcs.empty());
    ASSERT_EQ(part.loops.size(), 1u);
    EXPECT_EQ(part.loops[0].size(), c == 0 ? 5u : 7u);
    for (Quilt::Vertex v : part.loops[0]) EXPECT_EQ(quilt.patch_of(v), c);
  }
}

TEST(BoundaryStrands, NamesInMessages) {
  std::vector<ChartPiece> pieces(2);
  pieces[1].name = "north";
  const std::vector<Seam> seams{{0, 3, 1, 4, {}}};
  const SeamNames names(pieces, seams);
  EXPECT_EQ(names.chart(0), "chart 0");
  EXPECT_EQ(names.side(1, 4), "chart north, inequality 4");
  EXPECT_EQ(names.seam(0), "seam 0 (chart 0, inequality 3, with chart north, inequality 4)");
}

}  // namespace
}  // namespace whitney::internal
