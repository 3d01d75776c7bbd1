// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <coxeter/faces/faces.h>
#include <coxeter/placement.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/cells/strata.h>
#include <whitney/cells/subdivide.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/io/read_problem.h>
#include <whitney/topology/topology.h>
#include <whitney/tracing/cut_regularity.h>
#include <whitney/tracing/exact_pivot.h>
#include <whitney/tracing/trace.h>
#include "tracing/boundary_cases.h"

namespace whitney {
namespace {

using namespace boundary_cases;

// Against brute force: every simplex of a part of the lattice, every set of inequalities, for maps with small random
// integers as values, so that zeros are everywhere.

/// A fixed random integer at each point, in [-size, size].
int noise(Point x, int salt, int size) {
  std::uint64_t hash = 0x9e3779b97f4a7c15ull * static_cast<std::uint64_t>(salt + 1);
  for (double c : x) {
    hash ^= static_cast<std::uint64_t>(static_cast<std::int64_t>(std::llround(c)) + 1000);
    hash *= 0xff51afd7ed558ccdull;
    hash ^= hash >> 33;
  }
  return static_cast<int>(hash % (2 * size + 1)) - size;
}

using StratumPoint = std::pair<std::vector<int>, Simplex>;

std::set<StratumPoint> points_of(const CellComplex& complex, const std::vector<char>* wanted = nullptr) {
  std::set<StratumPoint> points;
  for (std::size_t i = 0; i < complex.num_cells(0); ++i)
    if (wanted == nullptr || (*wanted)[i])
      points.insert({complex.inequality_sets[complex.set_of(0, i)], complex.simplex(0, i)});
  return points;
}

/// All stratum points in the lattice box [-reach, reach]^d.
std::set<StratumPoint> brute_force(const Function& f, const Function& g, int reach) {
  const int d = f.ambient_dim(), k = f.codim(), m = g.codim(), n = d - k;
  std::vector<std::vector<int>> sets{{}};
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (int j = sets[i].empty() ? 0 : sets[i].back() + 1; j < m && int(sets[i].size()) < n; ++j) {
      sets.push_back(sets[i]);
      sets.back().push_back(j);
    }
  std::set<StratumPoint> found;
  std::set<Simplex> seen;
  std::vector<std::uint16_t> order(d + 1);
  std::vector<int> permutation(d);
  std::iota(permutation.begin(), permutation.end(), 0);
  std::vector<std::int32_t> z(d, -reach);
  auto examine = [&](const Simplex& sigma) {
    if (!seen.insert(sigma).second) return;
    std::vector<std::vector<double>> f_at, h_at;
    for (const auto& v : sigma.vertices()) {
      std::vector<double> x(v.begin(), v.end());
      f_at.emplace_back(k);
      h_at.emplace_back(m);
      f.evaluate(x, f_at.back());
      g.evaluate(x, h_at.back());
      for (double& value : h_at.back()) value = -value;
    }
    for (const std::vector<int>& set : sets) {
      if (sigma.dim() != k + int(set.size())) continue;
      std::vector<std::vector<double>> columns;
      for (std::size_t q = 0; q < f_at.size(); ++q) {
        columns.emplace_back();
        for (int j : set) columns.back().push_back(h_at[q][j]);
        columns.back().insert(columns.back().end(), f_at[q].begin(), f_at[q].end());
      }
      std::vector<const double*> pointers;
      for (const auto& column : columns) pointers.push_back(column.data());
      if (!exactly_hit(pointers)) continue;
      bool inside = true;
      for (int j = 0; j < m && inside; ++j) {
        if (std::binary_search(set.begin(), set.end(), j)) continue;
        std::vector<double> component;
        for (const auto& h : h_at) component.push_back(h[j]);
        const auto position = std::lower_bound(set.begin(), set.end(), j) - set.begin();
        inside = exactly_below(pointers, component, static_cast<int>(position));
      }
      if (inside) found.insert({set, sigma});
    }
  };
  for (;;) {
    do {
      for (int q = 0; q < d; ++q) order[permutation[q]] = static_cast<std::uint16_t>(q);
      order[d] = static_cast<std::uint16_t>(d);
      const Simplex full(coxeter::LatticeVertex(std::span<const std::int32_t>(z)),
                         coxeter::OrderedPartition::from_part_indices(order));
      for (int dim = k; dim <= d; ++dim) coxeter::for_each_face(full, dim, examine);
    } while (std::next_permutation(permutation.begin(), permutation.end()));
    int c = 0;
    while (c < d && ++z[c] == reach) z[c++] = -reach;
    if (c == d) return found;
  }
}

/// The complex of a set of stratum points.
CellComplex complex_of(const std::set<StratumPoint>& points, int d, int k) {
  std::set<std::vector<std::int32_t>> vertices;
  std::vector<std::int32_t> coordinates;
  for (const auto& [set, sigma] : points)
    for (const auto& v : sigma.vertices()) {
      // A base vertex of a coface is at most one step below.
      for (std::uint32_t below = 0; below < (1u << d); ++below) {
        std::vector<std::int32_t> z(v.begin(), v.end());
        for (int c = 0; c < d; ++c) z[c] -= below >> c & 1;
        vertices.insert(z);
      }
    }
  for (const auto& z : vertices) coordinates.insert(coordinates.end(), z.begin(), z.end());
  std::map<std::vector<std::int32_t>, std::uint32_t> number;
  for (const auto& z : vertices) number.emplace(z, static_cast<std::uint32_t>(number.size()));
  std::map<std::vector<int>, BoundarySimplices> by_set;
  for (const auto& [set, sigma] : points) {
    BoundarySimplices& list = by_set[set];
    list.inequalities = set;
    list.base.push_back(number.at(std::vector<std::int32_t>(sigma.base().begin(), sigma.base().end())));
    const auto parts = sigma.partition().part_indices();
    list.parts.insert(list.parts.end(), parts.data(), parts.data() + d);
    list.points.resize(list.points.size() + d);
  }
  const BoundarySimplices interior = by_set[{}];
  std::vector<BoundarySimplices> boundary;
  for (const auto& [set, list] : by_set)
    if (!set.empty()) boundary.push_back(list);
  std::stable_sort(boundary.begin(), boundary.end(),
                   [](const auto& a, const auto& b) { return a.inequalities.size() < b.inequalities.size(); });
  CrossedSimplices crossed;
  crossed.ambient_dim = d;
  crossed.codim = k;
  crossed.vertex_coordinates = coordinates;
  crossed.base = interior.base;
  const std::vector<std::uint8_t> parts(interior.parts.begin(), interior.parts.end());
  crossed.parts = parts;
  crossed.points = interior.points;
  crossed.boundary = boundary;
  crossed.num_given = 100;
  return cell_complex(crossed);
}

TEST(Boundary, AgreesWithBruteForceOnRandomIntegers) {
  struct Setting {
    int d, k, m, runs;
  };
  for (const auto& [d, k, m, runs] :
       {Setting{2, 1, 1, 8}, Setting{2, 1, 3, 8}, Setting{3, 1, 1, 4}, Setting{3, 1, 3, 6}, Setting{3, 2, 2, 4},
        Setting{4, 2, 3, 1}, Setting{4, 1, 2, 1}}) {
    int with_corners = 0;
    for (int run = 0; run < runs; ++run) {
      SCOPED_TRACE("d " + std::to_string(d) + " k " + std::to_string(k) + " m " + std::to_string(m) + " run " +
                   std::to_string(run));
      const int salt = 100 * run, reach = 3;
      const int of_d = d, of_k = k, of_m = m;
      const Function f = make_function(d, k, [=](Point x, Values v) {
        v[0] = -4 + noise(x, salt, 1);
        for (double c : x) v[0] += c * c;
        for (int r = 1; r < of_k; ++r) v[r] = x[r] + noise(x, salt + r, 1);
      });
      const Function g = make_function(d, m, [=](Point x, Values v) {
        for (int j = 0; j < of_m; ++j) v[j] = x[j % of_d] - (j / of_d) + noise(x, salt + 10 + j, 1);
      });
      const std::set<StratumPoint> expected = brute_force(f, g, reach);
      const CellComplex all = complex_of(expected, d, k);
      EXPECT_EQ(all.num_cells(0), expected.size());

      // Seeds at all points of the interior.
      TraceOptions options;
      options.inequalities = g;
      std::vector<double> seeds;
      for (const auto& [set, sigma] : expected) {
        if (!set.empty()) continue;
        const auto centre = coxeter::barycentre(sigma, integer_lattice(d));
        seeds.insert(seeds.end(), centre.begin(), centre.end());
      }
      if (seeds.empty()) continue;
      const TraceResult traced = trace(f, integer_lattice(d), seeds, options);
      const CellComplex complex = cell_complex(traced);
      const std::set<StratumPoint> found = points_of(complex);
      EXPECT_TRUE(std::includes(expected.begin(), expected.end(), found.begin(), found.end()));

      // Components of the whole: each is found or not, and those with an interior point are.
      std::vector<std::uint32_t> component(all.num_cells(0));
      std::iota(component.begin(), component.end(), 0u);
      auto root = [&](std::uint32_t i) {
        while (component[i] != i) i = component[i];
        return i;
      };
      for (std::size_t e = 0; e < all.num_cells(1); ++e) {
        const auto ends = all.facets[1][e];
        ASSERT_EQ(ends.size(), 2u);
        component[root(ends[0])] = root(ends[1]);
      }
      std::vector<char> wanted(all.num_cells(0), 0);
      for (std::uint32_t i = 0; i < all.num_cells(0); ++i)
        if (all.set_of(0, i) == 0) wanted[root(i)] = 1;
      std::vector<char> in_wanted(all.num_cells(0));
      for (std::uint32_t i = 0; i < in_wanted.size(); ++i) in_wanted[i] = wanted[root(i)];
      EXPECT_EQ(found, points_of(all, &in_wanted));
      expect_manifold(complex);
      expect_manifold(all);
      for (const auto& [set, sigma] : found) with_corners += set.size() > 1;
    }
    if (m > 1 && d - k > 1) {
      EXPECT_GT(with_corners, 0);
    }
  }
}

}  // namespace
}  // namespace whitney
