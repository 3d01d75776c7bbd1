// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/quilt.h>

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>

namespace whitney::internal {
namespace {

using Vertex = Quilt::Vertex;

/// Two triangles 012 and 132 in the plane.
SimplicialMesh two_triangles() {
  return {.ambient_dim = 2, .dim = 2, .points = {0, 0, 1, 0, 0, 1, 1, 1}, .simplices = {0, 1, 2, 1, 3, 2}};
}

std::set<std::set<Vertex>> simplices_of(const Quilt& quilt) {
  std::set<std::set<Vertex>> result;
  for (std::size_t s = 0; s < quilt.num_simplices(); ++s) {
    std::set<Vertex> simplex;
    for (const Vertex v : quilt.simplex(s)) simplex.insert(quilt.representative(v));
    result.insert(simplex);
  }
  return result;
}

TEST(Quilt, SplitsInnerAndBoundaryEdges) {
  Quilt quilt(2, 2);
  EXPECT_EQ(quilt.add_patch(two_triangles()), 0);
  EXPECT_EQ(quilt.boundary_edges().size(), 4);
  const Vertex inner = quilt.split(1, 2, 0.25);
  EXPECT_EQ(quilt.num_simplices(), 4);
  EXPECT_EQ(quilt.point(inner)[0], 0.75);
  EXPECT_EQ(quilt.point(inner)[1], 0.25);
  const Vertex outer = quilt.split(1, 0, 0.5);
  EXPECT_EQ(
      simplices_of(quilt),
      (std::set<std::set<Vertex>>{{0, outer, inner}, {outer, 1, inner}, {0, inner, 2}, {1, 3, inner}, {inner, 3, 2}}));
  EXPECT_EQ(quilt.boundary_edges().size(), 5);
  EXPECT_EQ(quilt.patch_of(outer), 0);
}

TEST(Quilt, OrientationsStay) {
  Quilt quilt(2, 2);
  quilt.add_patch(two_triangles());
  for (int i = 0; i < 5; ++i) {
    const auto s = quilt.simplex(i);
    quilt.split(s[i % 3], s[(i + 1) % 3], 0.4);
  }
  for (std::size_t s = 0; s < quilt.num_simplices(); ++s) {
    const auto v = quilt.simplex(s);
    const auto a = quilt.point(v[0]), b = quilt.point(v[1]), c = quilt.point(v[2]);
    EXPECT_GT((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0);
  }
}

TEST(Quilt, SewnEdgesAreSplitTogether) {
  // The square with its lower edge sewn to the upper one, and the left to the right.
  Quilt quilt(2, 2);
  quilt.add_patch(two_triangles());
  quilt.sew({0, 1}, {2, 3});
  quilt.sew({0, 2}, {1, 3});
  for (Vertex v = 0; v < 4; ++v) EXPECT_EQ(quilt.representative(v), 0);
  const Vertex m = quilt.split(3, 2, 0.25);
  EXPECT_EQ(quilt.point(m)[0], 0.75);
  const Vertex n = m + 1;
  EXPECT_EQ(quilt.point(n)[0], 0.75);
  EXPECT_EQ(quilt.point(n)[1], 0);
  EXPECT_EQ(quilt.representative(m), quilt.representative(n));
  // The halves are sewn, too.
  quilt.split(n, 1, 0.5);
  EXPECT_EQ(quilt.num_simplices(), 6);
  quilt.make_simplicial();
  // No edge twice, no loop.
  const auto simplices = simplices_of(quilt);
  EXPECT_EQ(simplices.size(), quilt.num_simplices());
  for (const auto& simplex : simplices) EXPECT_EQ(simplex.size(), 3);
}

TEST(Quilt, RepresentativesAreOfTheLowestPatch) {
  Quilt quilt(1, 1);
  const SimplicialMesh edge{.ambient_dim = 1, .dim = 1, .points = {0, 1}, .simplices = {0, 1}};
  quilt.add_patch(edge);
  quilt.add_patch(edge);
  quilt.unite(3, 2);
  const Vertex m = quilt.split(0, 1, 0.5);
  quilt.unite(m, 2);
  EXPECT_EQ(quilt.representative(3), m);  // a later vertex, but of patch 0
  EXPECT_EQ(quilt.degree(m), 2);
}

TEST(Quilt, RejectsWhatIsNoSurface) {
  const auto add = [](std::vector<std::uint32_t> simplices) {
    Quilt quilt(2, 2);
    SimplicialMesh mesh = two_triangles();
    mesh.simplices = std::move(simplices);
    quilt.add_patch(mesh);
  };
  EXPECT_NO_THROW(add({0, 1, 2}));
  EXPECT_THROW(add({0, 1, 4}), InvalidInput);
  EXPECT_THROW(add({0, 1, 1}), InvalidInput);
  EXPECT_THROW(add({0, 1, 2, 0, 1, 3, 0, 1, 2}), InvalidInput);
  Quilt quilt(1, 2);
  SimplicialMesh curve = two_triangles();
  curve.dim = 1;
  curve.simplices = {0, 1, 0, 2, 0, 3};
  EXPECT_THROW(quilt.add_patch(curve), InvalidInput);
}

}  // namespace
}  // namespace whitney::internal
