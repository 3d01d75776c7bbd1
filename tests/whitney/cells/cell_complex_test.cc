// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/cells/cell_complex.h>

#include <algorithm>
#include <map>
#include <ranges>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <coxeter/faces/cofaces.h>
#include <coxeter/faces/faces.h>
#include <coxeter/simplex.h>
#include <whitney/cells/subdivide.h>
#include <whitney/topology/topology.h>
#include <whitney/tracing/exact_pivot.h>
#include "trace_cases.h"

namespace whitney {
namespace {

using coxeter::Simplex;

/// Brute force: every simplex of every dimension whose vertices lie in the cube |z_i| <= size, and whether it is hit.
std::set<Simplex> all_hit(const Function& f, const coxeter::Triangulation& triangulation, int size, int dim) {
  const int d = f.ambient_dim(), k = f.codim();
  std::set<Simplex> carriers;
  std::vector<std::int32_t> z(d, -size);
  for (;;) {
    const Simplex vertex =
        Simplex::from_vertices(std::vector{coxeter::LatticeVertex(std::span<const std::int32_t>(z))});
    coxeter::for_each_coface(vertex, k, [&](const Simplex& simplex) {
      std::vector<double> values;
      for (const auto& v : simplex.vertices()) {
        std::vector<double> x(d), value(k);
        triangulation.cartesian({v.data(), std::size_t(d)}, x);
        f.evaluate(x, value);
        values.insert(values.end(), value.begin(), value.end());
      }
      std::vector<const double*> columns;
      for (int q = 0; q <= k; ++q) columns.push_back(&values[q * k]);
      if (!exactly_hit(columns)) return;
      coxeter::for_each_coface(simplex, dim, [&](const Simplex& coface) { carriers.insert(coface); });
    });
    int i = 0;
    while (i < d && z[i] == size) z[i++] = -size;
    if (i == d) return carriers;
    ++z[i];
  }
}

TEST(CellComplex, HasExactlyTheSimplicesThatBruteForceFinds) {
  for (const auto& [n, d, radius] : {std::tuple{1, 2, 2.3}, {2, 3, 2.0}, {1, 3, 1.9}, {2, 4, 1.0}, {3, 4, 1.0}}) {
    const NamedManifold m = sphere(n, d, radius);
    for (const bool exact : {true, false}) {
      const auto triangulation = exact ? coxeter::freudenthal(d, std::sqrt(double(d))) : coxeter::coxeter_a(d, 1.3);
      const CellComplex complex = cell_complex(trace(m.function, triangulation, m.point));
      for (int j = 0; j <= n; ++j) {
        std::set<Simplex> found;
        for (std::size_t i = 0; i < complex.num_cells(j); ++i) found.insert(complex.simplex(j, i));
        EXPECT_EQ(found.size(), complex.num_cells(j));
        EXPECT_EQ(found, all_hit(m.function, triangulation, d == 4 ? 3 : 5, d - n + j))
            << "n " << n << " d " << d << " j " << j;
      }
    }
  }
}

TEST(CellComplex, FacesOfCellsAreTheCellsOfFaces) {
  const auto c = testing::rotated_and_shifted(testing::trace_cases()[4]);  // S^3 in R^4
  const CellComplex complex = cell_complex(trace(c.function, coxeter::coxeter_a(4, c.edge_length), c.seeds));
  for (int j = 1; j <= 3; ++j) {
    std::map<Simplex, std::uint32_t> below;
    for (std::uint32_t i = 0; i < complex.num_cells(j - 1); ++i) below[complex.simplex(j - 1, i)] = i;
    for (std::size_t i = 0; i < complex.num_cells(j); ++i) {
      std::set<std::uint32_t> expected;
      coxeter::for_each_facet(complex.simplex(j, i), [&](const Simplex& facet) {
        const auto at = below.find(facet);
        if (at != below.end()) expected.insert(at->second);
      });
      const auto facets = complex.facets[j][i];
      EXPECT_EQ(std::set<std::uint32_t>(facets.begin(), facets.end()), expected);
      for (std::uint32_t facet : facets) {
        const auto around = complex.cofacets[j - 1][facet];
        EXPECT_EQ(std::count(around.begin(), around.end(), i), 1);
      }
    }
    EXPECT_EQ(complex.facets[j].index.size(), complex.cofacets[j - 1].index.size());
  }
}

TEST(CellComplex, CellsComeInTheCanonicalOrder) {
  const auto c = testing::rotated_and_shifted(testing::trace_cases()[8]);
  const CellComplex complex = cell_complex(trace(c.function, coxeter::coxeter_a(10, c.edge_length), c.seeds));
  for (int j = 0; j <= 2; ++j)
    for (std::size_t i = 1; i < complex.num_cells(j); ++i) ASSERT_LT(complex.simplex(j, i - 1), complex.simplex(j, i));
}

TEST(CellComplex, AStoppedTraceLeavesAPureComplexOfWholeCells) {
  for (std::size_t limit : {1, 100, 1000, 3000}) {
    TraceOptions options;
    options.run.max_simplices = limit;
    const auto c = testing::trace_cases()[5];  // S^3 in R^6
    const CellComplex complex = cell_complex(trace(c.function, coxeter::coxeter_a(6, 0.7), c.seeds, options));
    EXPECT_GT(complex.num_dropped, 0u);
    for (int j = 1; j <= 3; ++j)
      for (std::size_t i = 0; i < complex.num_cells(j); ++i) EXPECT_GE(complex.facets[j][i].size(), std::size_t(j + 1));
    const Topology t = topology_of(complex.facets);  // rejects what is no regular CW complex
    EXPECT_TRUE(t.pure);
    for (int j = 0; j < 3; ++j)
      for (std::size_t i = 0; i < complex.num_cells(j); ++i) EXPECT_FALSE(complex.cofacets[j][i].empty());
  }
}

TEST(Subdivide, BothAreTheSameManifold) {
  for (const auto& original : testing::trace_cases()) {
    if (original.function.ambient_dim() > 6) continue;
    const auto c = testing::rotated_and_shifted(original);
    SCOPED_TRACE(c.name);
    const CellComplex complex =
        cell_complex(trace(c.function, coxeter::coxeter_a(c.function.ambient_dim(), 1.2 * c.edge_length), c.seeds));
    const SimplicialMesh pulled = pulled_subdivision(complex), barycentric = barycentric_subdivision(complex);
    const Topology of_cells = topology_of(complex.facets), a = topology_of(pulled), b = topology_of(barycentric);
    EXPECT_EQ(pulled.num_points(), complex.num_cells(0));
    for (const Topology* t : {&a, &b}) {
      EXPECT_TRUE(t->is_closed_manifold());
      EXPECT_EQ(t->euler_characteristic, of_cells.euler_characteristic);
      EXPECT_EQ(*t->homology_z, *of_cells.homology_z);
    }
  }
}

TEST(Subdivide, PolygonsWalkRoundTheirEdges) {
  const auto c = testing::trace_cases()[2];
  const CellComplex complex = cell_complex(trace(c.function, coxeter::coxeter_a(3, c.edge_length), c.seeds));
  const PolygonMesh mesh = polygon_mesh(complex);
  ASSERT_EQ(mesh.num_cells(), complex.num_cells(2));
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& e : std::views::iota(std::size_t{0}, complex.num_cells(1)))
    edges.insert(std::minmax(complex.facets[1][e][0], complex.facets[1][e][1]));
  for (std::size_t i = 0; i < mesh.num_cells(); ++i) {
    const std::uint32_t first = mesh.offsets[i], last = mesh.offsets[i + 1];
    EXPECT_EQ(last - first, complex.facets[2][i].size());
    for (std::uint32_t at = first; at < last; ++at) {
      const std::uint32_t next = at + 1 == last ? first : at + 1;
      EXPECT_TRUE(edges.contains(std::minmax(mesh.corners[at], mesh.corners[next])));
    }
  }
  const auto three = testing::trace_cases()[4];
  EXPECT_THROW(polygon_mesh(cell_complex(trace(three.function, coxeter::coxeter_a(4, 1.0), three.seeds))),
               InvalidInput);
}

}  // namespace
}  // namespace whitney
