// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/formats/surface.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "test_complexes.h"

namespace whitney::io {
namespace {

using testing::Side;

MeshView view_of(const SimplicialMesh& mesh) {
  MeshView view;
  view.ambient_dim = mesh.ambient_dim;
  view.dim = mesh.dim;
  view.points = mesh.points;
  view.corners = mesh.simplices;
  return view;
}

/// Every edge in two cells is run through in both directions.
bool neighbours_agree(const MeshView& view) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t c = 0; c < view.num_cells(); ++c) {
    const auto cell = view.cell(c);
    for (std::size_t i = 0; i < cell.size(); ++i) edges.emplace_back(cell[i], cell[(i + 1) % cell.size()]);
  }
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

TEST(Surface, TurnsCellsUntilNeighboursAgree) {
  std::mt19937 generator(1);
  const SimplicialMesh torus = testing::grid_surface(5, 4, Side::kGlued, Side::kGlued);
  for (int round = 0; round < 20; ++round) {
    MeshView view = view_of(torus);
    for (std::size_t i = 0; i < view.corners.size(); i += 3) {
      if (generator() % 2) std::swap(view.corners[i + 1], view.corners[i + 2]);
    }
    const std::vector<std::uint32_t> first(view.corners.begin(), view.corners.begin() + 3);
    EXPECT_TRUE(orient_cells(view));
    EXPECT_TRUE(neighbours_agree(view));
    EXPECT_TRUE(std::equal(first.begin(), first.end(), view.corners.begin()));
    const std::vector<std::uint32_t> oriented = view.corners;
    EXPECT_TRUE(orient_cells(view));
    EXPECT_EQ(view.corners, oriented);
  }
}

TEST(Surface, OneSidedComponentsStayAsTheyWere) {
  const SimplicialMesh moebius = testing::grid_surface(7, 2, Side::kFlipped, Side::kOpen);
  MeshView view = view_of(moebius);
  EXPECT_FALSE(orient_cells(view));
  EXPECT_EQ(view.corners, moebius.simplices);
}

TEST(Surface, PolygonsAndSheetsThatMeetInAnEdge) {
  // Two squares with a common side, run through in the same direction; and three triangles at one edge.
  const std::vector<double> points(3 * 11);
  const std::vector<std::uint32_t> offsets{0, 4, 8, 11, 14, 17};
  MeshView view;
  view.ambient_dim = 3;
  view.dim = 2;
  view.polygons = true;
  view.points = points;
  view.offsets = offsets;
  view.corners = {0, 1, 2, 3, 1, 2, 5, 4, 6, 7, 8, 6, 7, 9, 6, 7, 10};
  EXPECT_TRUE(orient_cells(view));
  EXPECT_EQ(view.corners, (std::vector<std::uint32_t>{0, 1, 2, 3, 1, 4, 5, 2, 6, 7, 8, 6, 7, 9, 6, 7, 10}));
}

}  // namespace
}  // namespace whitney::io
