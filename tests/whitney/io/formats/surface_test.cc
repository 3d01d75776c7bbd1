// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/formats/surface.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <whitney/io/openmesh.h>
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

/// What vertex_normals stands in for; nothing where OpenMesh refuses a cell.
std::optional<std::vector<double>> openmesh_normals(const SimplicialMesh& mesh) {
  using HalfEdgeMesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
  ToOpenMeshOptions options;
  options.orient = false;
  auto result = to_openmesh<HalfEdgeMesh>(mesh, options);
  if (!result.refused.empty()) return std::nullopt;
  result.mesh.request_face_normals();
  result.mesh.request_vertex_normals();
  result.mesh.update_normals();
  std::vector<double> normals;
  for (const auto v : result.mesh.vertices()) {
    const auto normal = result.mesh.normal(v);
    normals.insert(normals.end(), normal.data(), normal.data() + 3);
  }
  return normals;
}

TEST(Surface, VertexNormalsAreOpenMeshs) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const SimplicialMesh octahedron =
      testing::mesh_of(2, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}});
  int with_normals = 0, without = 0;
  for (int round = 0; round < 3000; ++round) {
    // Pieces of an octahedron, a further one glued to it somewhere, cells in any order: surfaces, fans that meet in
    // points, closed fans that meet, and edges in several cells.
    std::vector<std::vector<std::uint32_t>> cells;
    std::vector<std::uint32_t> other(6);
    for (std::uint32_t& v : other) v = generator() % (round % 2 == 0 ? 12 : 8);
    std::sort(other.begin(), other.end());
    const bool glued = std::adjacent_find(other.begin(), other.end()) == other.end();
    std::shuffle(other.begin(), other.end(), generator);
    for (std::size_t i = 0; i < octahedron.simplices.size(); i += 3) {
      const std::uint32_t* v = octahedron.simplices.data() + i;
      if (generator() % 8 != 0) cells.push_back({v[0], v[1], v[2]});
      if (glued && generator() % 8 != 0) cells.push_back({other[v[0]], other[v[1]], other[v[2]]});
    }
    std::shuffle(cells.begin(), cells.end(), generator);
    SimplicialMesh mesh{3, 2, std::vector<double>(3 * 12), {}};
    for (double& x : mesh.points) x = coordinate(generator);
    for (const auto& cell : cells) mesh.simplices.insert(mesh.simplices.end(), cell.begin(), cell.end());
    MeshView view = view_of(mesh);
    view.xyz = mesh.points;
    view.oriented = true;
    const auto ours = vertex_normals(view);
    const auto theirs = openmesh_normals(mesh);
    ASSERT_EQ(ours.has_value(), theirs.has_value()) << round;
    ++(ours ? with_normals : without);
    for (std::size_t i = 0; ours && i < ours->size(); ++i) ASSERT_NEAR((*ours)[i], (*theirs)[i], 1e-11) << round;
    view.oriented = false;
    EXPECT_FALSE(vertex_normals(view));
  }
  EXPECT_GT(with_normals, 300);
  EXPECT_GT(without, 300);
}

TEST(Surface, NoVertexNormalsWhereTwoCellsRunTheSameWay) {
  const SimplicialMesh mesh{3, 2, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0}, {0, 1, 2, 0, 1, 3}};
  MeshView view = view_of(mesh);
  view.xyz = mesh.points;
  view.oriented = true;
  EXPECT_FALSE(vertex_normals(view));
  view.corners = {0, 1, 2, 1, 0, 3};
  EXPECT_TRUE(vertex_normals(view));
}

}  // namespace
}  // namespace whitney::io
