// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/half_edges.h>

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace whitney {
namespace {

TEST(HalfEdges, ThoseOfAnEdgeSideBySide) {
  // A square and a triangle on its side 1 2, run through in the same direction.
  const Incidence polygons{{0, 4, 7}, {0, 1, 2, 3, 1, 2, 4}};
  std::vector<std::vector<std::uint32_t>> found;
  for (const HalfEdge& h : sorted_half_edges(polygons, 5)) found.push_back({h.low, h.high, h.slot, h.upward});
  EXPECT_EQ(found,
            (std::vector<std::vector<std::uint32_t>>{
                {0, 1, 0, 1}, {0, 3, 3, 0}, {1, 2, 1, 1}, {1, 2, 4, 1}, {1, 4, 6, 0}, {2, 3, 2, 1}, {2, 4, 5, 1}}));
}

TEST(HalfEdges, OrientsPolygons) {
  const CellOrientation orientation = orient_polygons({{0, 4, 7}, {0, 1, 2, 3, 1, 2, 4}}, 5);
  EXPECT_EQ(orientation.sign, (std::vector<std::int8_t>{1, -1}));
  EXPECT_TRUE(orientation.all_orientable());
  EXPECT_EQ(sorted_half_edges({}, 0).size(), 0U);
}

}  // namespace
}  // namespace whitney
