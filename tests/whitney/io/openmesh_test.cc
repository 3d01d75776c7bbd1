// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/openmesh.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_complexes.h"

namespace whitney {
namespace {

using ::testing::ElementsAre;
using testing::grid_surface;
using testing::Side;

struct DoubleTraits : OpenMesh::DefaultTraitsDouble {};
using Poly = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;
using Tri = OpenMesh::TriMesh_ArrayKernelT<>;  // points are floats
using Reason = RefusedCell::Reason;

/// A square of two triangles in R^4 with its boundary: two pieces that meet in two corners.
SimplicialMesh labelled_square() {
  SimplicialMesh mesh{4, 2, {}, {0, 1, 2, 2, 3, 0}};
  mesh.points = {0.1, 0, 0, 1e-17, 1, 0.2, 0, 2, 1, 1, 0.3, -3, 0, 1, 0, 1.0 / 3};
  mesh.point_data = {{"stratum", 1, {3, 1, 4, 2}}, {"flow", 2, {1, 2, 3, 4, 5, 6, 7, 8}}};
  mesh.cell_data = {{"stratum", 1, {0, 0}}, {"chart", 1, {5, 6}}};
  mesh.strata = {{1, 1, {0, 1, 2, 1}}, {2, 1, {2, 3, 3, 0}}, {3, 0, {0}}, {4, 0, {2}}};
  return mesh;
}

void expect_same(const std::vector<NamedArray>& a, const std::vector<NamedArray>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].components, b[i].components);
    EXPECT_EQ(a[i].values, b[i].values);
  }
}

/// The simplices of a stratum in an order of their own.
std::vector<std::vector<std::uint32_t>> sorted_simplices(const MeshStratum& stratum) {
  std::vector<std::vector<std::uint32_t>> sorted;
  const auto size = static_cast<std::ptrdiff_t>(stratum.dim) + 1;
  for (auto i = stratum.simplices.begin(); i != stratum.simplices.end(); i += size) sorted.emplace_back(i, i + size);
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

void expect_same(const SimplicialMesh& a, const SimplicialMesh& b) {
  EXPECT_EQ(a.ambient_dim, b.ambient_dim);
  EXPECT_EQ(a.dim, b.dim);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.simplices, b.simplices);
  expect_same(a.point_data, b.point_data);
  expect_same(a.cell_data, b.cell_data);
  ASSERT_EQ(a.strata.size(), b.strata.size());
  for (std::size_t i = 0; i < a.strata.size(); ++i) {
    EXPECT_EQ(a.strata[i].stratum, b.strata[i].stratum);
    EXPECT_EQ(a.strata[i].dim, b.strata[i].dim);
    EXPECT_EQ(sorted_simplices(a.strata[i]), sorted_simplices(b.strata[i]));
  }
}

template <class Mesh>
class OpenMeshAdaptor : public ::testing::Test {};
using Kinds = ::testing::Types<Poly, Tri>;
TYPED_TEST_SUITE(OpenMeshAdaptor, Kinds);

TYPED_TEST(OpenMeshAdaptor, EverythingComesBack) {
  const SimplicialMesh square = labelled_square();
  const auto result = to_openmesh<TypeParam>(square);
  EXPECT_TRUE(result.complete());
  EXPECT_TRUE(result.turned.empty());
  EXPECT_EQ(result.mesh.n_vertices(), 4U);
  EXPECT_EQ(result.mesh.n_edges(), 5U);
  EXPECT_EQ(result.mesh.n_faces(), 2U);
  expect_same(from_openmesh<SimplicialMesh>(result.mesh), square);

  const SimplicialMesh torus = grid_surface(6, 5, Side::kGlued, Side::kGlued);
  const auto closed = to_openmesh<TypeParam>(torus);
  EXPECT_TRUE(closed.complete());
  EXPECT_EQ(closed.mesh.n_edges(), 90U);
  SimplicialMesh back = from_openmesh<SimplicialMesh>(closed.mesh);
  for (const std::uint32_t c : closed.turned) std::swap(back.simplices[3 * c + 1], back.simplices[3 * c + 2]);
  expect_same(back, torus);
}

TYPED_TEST(OpenMeshAdaptor, PropertiesAreOpenMeshsOwn) {
  const auto result = to_openmesh<TypeParam>(labelled_square());
  OpenMesh::VPropHandleT<std::vector<double>> coordinates, flow;
  OpenMesh::FPropHandleT<double> chart;
  OpenMesh::HPropHandleT<int> stratum;
  ASSERT_TRUE(result.mesh.get_property_handle(coordinates, kOpenMeshCoordinates));
  ASSERT_TRUE(result.mesh.get_property_handle(flow, "flow"));
  ASSERT_TRUE(result.mesh.get_property_handle(chart, "chart"));
  ASSERT_TRUE(result.mesh.get_property_handle(stratum, kOpenMeshStratum));
  const OpenMesh::VertexHandle v0(0), v1(1), v2(2);
  EXPECT_THAT(result.mesh.property(coordinates, v2), ElementsAre(1, 1, 0.3, -3));
  EXPECT_THAT(result.mesh.property(flow, v1), ElementsAre(3, 4));
  EXPECT_EQ(result.mesh.property(chart, OpenMesh::FaceHandle(1)), 6);
  EXPECT_EQ(result.mesh.property(stratum, result.mesh.find_halfedge(v2, v1)), 1);
  EXPECT_EQ(result.mesh.property(stratum, result.mesh.find_halfedge(v1, v2)), -1);
  EXPECT_EQ(result.mesh.property(stratum, result.mesh.find_halfedge(v0, v2)), -1);
}

TYPED_TEST(OpenMeshAdaptor, ThreeTrianglesAtAnEdge) {
  SimplicialMesh mesh{3, 2, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0}, {0, 1, 2, 1, 0, 3, 0, 1, 4}};
  mesh.cell_data = {{"chart", 1, {7, 8, 9}}};
  mesh.strata = {{1, 1, {1, 4, 0, 1}}};
  ::testing::internal::CaptureStderr();
  const auto result = to_openmesh<TypeParam>(mesh);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(result.refused, ElementsAre(RefusedCell{2, Reason::kEdge}));
  EXPECT_THAT(result.cell_of_face, ElementsAre(0, 1));
  EXPECT_FALSE(result.complete());
  ASSERT_EQ(result.refused_strata.size(), 1U);
  EXPECT_THAT(result.refused_strata[0].simplices, ElementsAre(1, 4));
  const SimplicialMesh back = from_openmesh<SimplicialMesh>(result.mesh);
  EXPECT_THAT(back.simplices, ElementsAre(0, 1, 2, 1, 0, 3));
  EXPECT_EQ(back.num_points(), 5U);
  EXPECT_THAT(back.cell_data.at(0).values, ElementsAre(7, 8));
  EXPECT_THAT(back.strata.at(0).simplices, ElementsAre(0, 1));
}

/// Two cones over triangles with a common tip, point 0, without their bases. Cells 0 - 2 and 3 - 5, or in turns.
SimplicialMesh two_cones(bool in_turns) {
  SimplicialMesh mesh{3, 2, {0, 0, 0, 1, 0, 1, 0, 1, 1, -1, -1, 1, 1, 0, -1, 0, 1, -1, -1, -1, -1}, {}};
  mesh.simplices = in_turns ? std::vector<std::uint32_t>{0, 1, 2, 0, 4, 5, 0, 2, 3, 0, 5, 6, 0, 3, 1, 0, 6, 4}
                            : std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 1, 0, 4, 5, 0, 5, 6, 0, 6, 4};
  return mesh;
}

TYPED_TEST(OpenMeshAdaptor, TwoConesAtAVertex) {
  ::testing::internal::CaptureStderr();
  const auto result = to_openmesh<TypeParam>(two_cones(false));
  const auto in_turns = to_openmesh<TypeParam>(two_cones(true));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(result.refused, ElementsAre(RefusedCell{3, Reason::kVertex}, RefusedCell{4, Reason::kVertex},
                                          RefusedCell{5, Reason::kVertex}));
  EXPECT_THAT(in_turns.refused, ElementsAre(RefusedCell{4, Reason::kFan}, RefusedCell{5, Reason::kFan}));
  // What was refused left no trace.
  EXPECT_EQ(in_turns.mesh.n_edges(), 10U);
  EXPECT_EQ(from_openmesh<SimplicialMesh>(in_turns.mesh).num_simplices(), 4U);
  EXPECT_TRUE(omerr().is_enabled());
}

TYPED_TEST(OpenMeshAdaptor, OneSidedSurfacesLoseCellsByName) {
  const SimplicialMesh moebius = grid_surface(7, 2, Side::kFlipped, Side::kOpen);
  const auto result = to_openmesh<TypeParam>(moebius);
  EXPECT_FALSE(result.refused.empty());
  EXPECT_EQ(result.refused.size() + result.mesh.n_faces(), moebius.num_simplices());
  EXPECT_EQ(result.cell_of_face.size(), result.mesh.n_faces());
}

TYPED_TEST(OpenMeshAdaptor, TurnsCellsOnlyWhenAsked) {
  SimplicialMesh square = labelled_square();
  std::swap(square.simplices[4], square.simplices[5]);
  EXPECT_THAT(to_openmesh<TypeParam>(square).turned, ElementsAre(1));
  EXPECT_TRUE(to_openmesh<TypeParam>(square).complete());
  ToOpenMeshOptions options;
  options.orient = false;
  EXPECT_THAT(to_openmesh<TypeParam>(square, options).refused, ElementsAre(RefusedCell{1, Reason::kEdge}));
}

TYPED_TEST(OpenMeshAdaptor, PointsAreTheFirstCoordinatesOrTheCallersProjection) {
  const SimplicialMesh square = labelled_square();
  EXPECT_EQ(to_openmesh<TypeParam>(square).mesh.point(OpenMesh::VertexHandle(1))[0], 1);
  ToOpenMeshOptions options;
  options.projection = [](std::span<const double> x) { return std::array<double, 3>{x[3], x[0], 0.5}; };
  const auto result = to_openmesh<TypeParam>(square, options);
  const auto point = result.mesh.point(OpenMesh::VertexHandle(2));
  EXPECT_THAT((std::vector<double>{point[0], point[1], point[2]}), ElementsAre(-3, 1, 0.5));
  FromOpenMeshOptions own;
  own.own_points = true;
  const SimplicialMesh moved = from_openmesh<SimplicialMesh>(result.mesh, own);
  EXPECT_EQ(moved.ambient_dim, 3);
  EXPECT_THAT(std::vector<double>(moved.points.begin() + 6, moved.points.begin() + 9), ElementsAre(-3, 1, 0.5));
}

TYPED_TEST(OpenMeshAdaptor, DeletedAndAddedElements) {
  auto result = to_openmesh<TypeParam>(labelled_square());
  result.mesh.request_vertex_status();
  result.mesh.request_edge_status();
  result.mesh.request_halfedge_status();
  result.mesh.request_face_status();
  result.mesh.delete_vertex(OpenMesh::VertexHandle(1));
  const SimplicialMesh back = from_openmesh<SimplicialMesh>(result.mesh);
  EXPECT_THAT(back.simplices, ElementsAre(1, 2, 0));
  EXPECT_EQ(back.num_points(), 3U);
  EXPECT_THAT(back.point_data.at(0).values, ElementsAre(3, 4, 2));
  EXPECT_THAT(back.cell_data.at(1).values, ElementsAre(6));
  // A new vertex has no place in R^4 until somebody gives it one.
  result.mesh.add_vertex(typename TypeParam::Point(0, 0, 0));
  EXPECT_THROW(from_openmesh<SimplicialMesh>(result.mesh), InvalidInput);
}

TYPED_TEST(OpenMeshAdaptor, RefusesBrokenMeshes) {
  const auto expect_refused = [](auto change) {
    SimplicialMesh mesh = labelled_square();
    change(mesh);
    EXPECT_THROW(to_openmesh<TypeParam>(mesh), InvalidInput);
  };
  expect_refused([](SimplicialMesh& m) { m.simplices[0] = 4; });
  expect_refused([](SimplicialMesh& m) { m.simplices[0] = 1; });
  expect_refused([](SimplicialMesh& m) { m.simplices.pop_back(); });
  expect_refused([](SimplicialMesh& m) { m.points.pop_back(); });
  expect_refused([](SimplicialMesh& m) { m.ambient_dim = 0; });
  expect_refused([](SimplicialMesh& m) { m.dim = 1; });
  expect_refused([](SimplicialMesh& m) { m.point_data[1].components = 3; });
  expect_refused([](SimplicialMesh& m) { m.cell_data[0].name = kOpenMeshCoordinates; });
  expect_refused([](SimplicialMesh& m) { m.strata[0].simplices[0] = 4; });
  expect_refused([](SimplicialMesh& m) { m.strata[0].dim = 2; });
}

TEST(OpenMeshPolygons, ComeBack) {
  PolygonMesh mesh;
  mesh.ambient_dim = 2;
  mesh.points = {0, 0, 1, 0, 1, 1, 0, 1, 2, 0, 2, 2};
  mesh.corners = {0, 1, 2, 3, 2, 1, 4, 5, 2, 3, 5};
  mesh.offsets = {0, 4, 8, 11};
  mesh.point_data = {{"height", 1, {0, 1, 2, 3, 4, 5}}};
  mesh.cell_data = {{"stratum", 1, {2, 3, 4}}};
  const auto result = to_openmesh<Poly>(mesh);
  EXPECT_THAT(result.turned, ElementsAre(2));
  EXPECT_TRUE(result.complete());
  EXPECT_EQ(result.mesh.point(OpenMesh::VertexHandle(5))[2], 0);
  const PolygonMesh back = from_openmesh<PolygonMesh>(result.mesh);
  EXPECT_EQ(back.ambient_dim, 2);
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(back.offsets, mesh.offsets);
  EXPECT_THAT(back.corners, ElementsAre(0, 1, 2, 3, 2, 1, 4, 5, 2, 5, 3));
  expect_same(back.point_data, mesh.point_data);
  expect_same(back.cell_data, mesh.cell_data);
  EXPECT_THROW(from_openmesh<SimplicialMesh>(result.mesh), InvalidInput);
  EXPECT_THROW(to_openmesh<Tri>(mesh), InvalidInput);
}

TEST(OpenMeshPolygons, MeshesThatOthersMade) {
  Poly mesh;
  std::vector<OpenMesh::VertexHandle> face;
  for (int i = 0; i < 3; ++i) face.push_back(mesh.add_vertex(Poly::Point(i, i * i, 0.1)));
  mesh.add_face(face);
  const PolygonMesh ours = from_openmesh<PolygonMesh>(mesh);
  EXPECT_EQ(ours.ambient_dim, 3);
  EXPECT_THAT(ours.points, ElementsAre(0, 0, 0.1, 1, 1, 0.1, 2, 4, 0.1));
  EXPECT_THAT(ours.corners, ElementsAre(0, 1, 2));
  EXPECT_TRUE(ours.point_data.empty());
}

}  // namespace
}  // namespace whitney
