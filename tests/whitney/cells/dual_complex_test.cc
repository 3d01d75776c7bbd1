// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/cells/dual_complex.h>

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>
#include <whitney/topology/topology.h>
#include "whitney_cases.h"

namespace whitney {
namespace {

struct Shape {
  const char* name;
  double edge_length;
  std::map<std::string, double> parameters;
};

TEST(DualComplex, HasTheTopologyOfTheComplex) {
  for (const Shape& shape :
       {Shape{"sphere", 0.4, {{"intrinsic_dim", 1}}}, Shape{"sphere", 0.5, {}}, Shape{"torus_of_revolution", 0.5, {}},
        Shape{"flat_torus", 0.3, {}}, Shape{"sphere", 0.7, {{"intrinsic_dim", 3}}}}) {
    SCOPED_TRACE(shape.name);
    const WhitneyCase c = whitney_case(shape.name, shape.edge_length, shape.parameters);
    const CellComplex& complex = c.result.complex;
    const int n = complex.intrinsic_dim;
    const DualComplex dual = dual_complex(complex);
    ASSERT_EQ(dual.points.size(), dual.num_cells(0) * dual.ambient_dim);
    // Poincare duality: Betti numbers mod 2 of the dual are those of the complex, backwards and forwards.
    // topology_of throws when the cells are not balls with spheres as boundaries, as far as it tests that.
    const Topology ours = topology_of(dual.facets), theirs = topology_of(complex.facets);
    EXPECT_EQ(ours.euler_characteristic, theirs.euler_characteristic);
    EXPECT_EQ(ours.components, theirs.components);
    EXPECT_EQ(ours.orientable, theirs.orientable);
    EXPECT_EQ(ours.boundary_faces, 0u);
    EXPECT_EQ(ours.branching_faces, 0u);
    EXPECT_EQ(ours.betti_z2, theirs.betti_z2);
    for (int j = 0; j <= n; ++j) EXPECT_EQ(dual.num_cells(j), complex.num_cells(n - j));
    for (int j = 1; j <= n; ++j)
      for (std::uint32_t i = 0; i < dual.num_cells(j); ++i)
        for (const std::uint32_t f : dual.facets[j][i])
          EXPECT_TRUE(std::ranges::find(dual.cofacets[j - 1][f], i) != dual.cofacets[j - 1][f].end());
  }
}

TEST(DualComplex, PolygonsOfASurface) {
  for (const Shape& shape :
       {Shape{"sphere", 0.4, {}}, Shape{"torus_of_revolution", 0.5, {}}, Shape{"klein_bottle", 0.45, {}}}) {
    SCOPED_TRACE(shape.name);
    const WhitneyCase c = whitney_case(shape.name, shape.edge_length, shape.parameters);
    const CellComplex& complex = c.result.complex;
    const PolygonMesh polygons = polygon_mesh(dual_complex(complex));
    ASSERT_EQ(polygons.num_cells(), complex.num_cells(0));
    ASSERT_EQ(polygons.num_points(), complex.num_cells(2));
    // Corners are the n-cells around the 0-cell, neighbours in the cycle share an edge at it. Coned from one point for
    // each polygon: a closed surface, with the right chi.
    SimplicialMesh cones{complex.ambient_dim, 2, polygons.points, {}};
    cones.points.insert(cones.points.end(), complex.points.begin(), complex.points.end());
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::uint32_t i = 0; i < polygons.num_cells(); ++i) {
      const std::uint32_t begin = polygons.offsets[i], end = polygons.offsets[i + 1];
      EXPECT_GE(end - begin, 3u);
      for (std::uint32_t k = begin; k < end; ++k) {
        const std::uint32_t a = polygons.corners[k], b = polygons.corners[k + 1 < end ? k + 1 : begin];
        cones.simplices.insert(cones.simplices.end(), {a, b, std::uint32_t(polygons.num_points() + i)});
        edges.insert(std::minmax(a, b));
        bool common = false;  // a 1-cell of both that has the 0-cell
        for (const std::uint32_t e : complex.facets[2][a])
          for (const std::uint32_t f : complex.facets[2][b])
            common |= e == f && std::ranges::find(complex.facets[1][e], i) != complex.facets[1][e].end();
        EXPECT_TRUE(common);
      }
    }
    TopologyOptions options;
    options.homology = false;
    const Topology topology = topology_of(cones, options),
                   expected = topology_of(barycentric_subdivision(complex), options);
    EXPECT_TRUE(topology.is_closed_manifold());
    EXPECT_EQ(topology.euler_characteristic, expected.euler_characteristic);
    EXPECT_EQ(topology.orientable, expected.orientable);
    EXPECT_EQ(edges.size(), complex.num_cells(1));
  }
}

TEST(DualComplex, ACurveIsDualToACurve) {
  const WhitneyCase c = whitney_case("sphere", 0.4, {{"intrinsic_dim", 1}});
  const PolygonMesh edges = polygon_mesh(dual_complex(c.result.complex));
  EXPECT_EQ(edges.dim, 1);
  EXPECT_EQ(edges.num_cells(), c.result.complex.num_cells(0));
  std::map<std::uint32_t, int> degree;
  for (const std::uint32_t v : edges.corners) ++degree[v];
  for (const auto& [v, count] : degree) EXPECT_EQ(count, 2);
}

TEST(DualComplex, Refusals) {
  const Submanifold manifold = named_submanifold("sphere");
  const auto triangulation = coxeter::coxeter_a(3, 0.3);
  TriangulateOptions options;
  options.scheme = TriangulateOptions::Scheme::kNone;
  options.run.max_simplices = 400;
  const TriangulateResult cut =
      triangulate(manifold, *manifold.bending(), triangulation, manifold.seed_points(), options);
  ASSERT_GT(cut.complex.num_cells(2), 0u);
  EXPECT_THROW(dual_complex(cut.complex), InvalidInput);
  DualComplex high;
  high.intrinsic_dim = 3;
  EXPECT_THROW(polygon_mesh(high), InvalidInput);
}

}  // namespace
}  // namespace whitney
