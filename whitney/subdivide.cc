// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/subdivide.h>

#include <algorithm>
#include <string>
#include <utility>

#include <coxeter/error.h>

namespace whitney {

SimplicialMesh barycentric_subdivision(const CellComplex& complex) {
  const int d = complex.ambient_dim, n = complex.intrinsic_dim;
  std::vector<std::size_t> first(n + 2, 0);  // index of the first vertex that stands for a j-cell
  for (int j = 0; j <= n; ++j) first[j + 1] = first[j] + complex.num_cells(j);

  SimplicialMesh mesh{d, n, complex.points, {}};
  mesh.points.resize(first[n + 1] * d);
  NamedArray cell_dim{"cell_dim", 1, std::vector<double>(first[n + 1])};
  for (int j = 1; j <= n; ++j) {
    // The mean of the points of the facets: in the interior, as they do not all lie on one facet.
    for (std::size_t i = 0; i < complex.num_cells(j); ++i) {
      double* x = &mesh.points[(first[j] + i) * d];
      const auto facets = complex.facets[j][i];
      for (std::uint32_t f : facets) {
        const double* y = &mesh.points[(first[j - 1] + f) * d];
        for (int c = 0; c < d; ++c) x[c] += y[c];
      }
      for (int c = 0; c < d; ++c) x[c] /= double(facets.size());
    }
    std::fill(cell_dim.values.begin() + first[j], cell_dim.values.begin() + first[j + 1], j);
  }
  mesh.point_data.push_back(std::move(cell_dim));

  // Chains below every cell, counted first so that the list is allocated once.
  std::vector<std::size_t> chains(complex.num_cells(0), 1);
  for (int j = 1; j <= n; ++j) {
    std::vector<std::size_t> next(complex.num_cells(j), 0);
    for (std::size_t i = 0; i < next.size(); ++i)
      for (std::uint32_t f : complex.facets[j][i]) next[i] += chains[f];
    chains.swap(next);
  }
  std::size_t total = 0;
  for (std::size_t count : chains) total += count;
  mesh.simplices.reserve(total * (n + 1));
  std::vector<std::uint32_t> chain(n + 1);
  auto descend = [&](auto& self, int j, std::uint32_t cell) -> void {
    chain[j] = static_cast<std::uint32_t>(first[j] + cell);
    if (j == 0) {
      mesh.simplices.insert(mesh.simplices.end(), chain.begin(), chain.end());
      return;
    }
    for (std::uint32_t f : complex.facets[j][cell]) self(self, j - 1, f);
  };
  for (std::uint32_t i = 0; i < complex.num_cells(n); ++i) descend(descend, n, i);
  return mesh;
}

SimplicialMesh pulled_subdivision(const CellComplex& complex) {
  const int n = complex.intrinsic_dim;
  std::vector<std::vector<std::uint32_t>> least(n + 1);  // least vertex of every cell
  for (int j = 0; j <= n; ++j) {
    least[j].resize(complex.num_cells(j));
    for (std::uint32_t i = 0; i < least[j].size(); ++i) {
      if (j == 0) {
        least[j][i] = i;
        continue;
      }
      std::uint32_t lowest = 0xffffffff;
      for (std::uint32_t f : complex.facets[j][i]) lowest = std::min(lowest, least[j - 1][f]);
      least[j][i] = lowest;
    }
  }
  SimplicialMesh mesh{complex.ambient_dim, n, complex.points, {}};
  std::vector<std::uint32_t> simplex(n + 1);
  // A facet contains the least vertex of the cell exactly when that is its own least vertex.
  auto pull = [&](auto& self, int j, std::uint32_t cell) -> void {
    simplex[n - j] = least[j][cell];
    if (j == 0) {
      mesh.simplices.insert(mesh.simplices.end(), simplex.begin(), simplex.end());
      return;
    }
    for (std::uint32_t f : complex.facets[j][cell])
      if (least[j - 1][f] != least[j][cell]) self(self, j - 1, f);
  };
  for (std::uint32_t i = 0; i < complex.num_cells(n); ++i) pull(pull, n, i);
  return mesh;
}

PolygonMesh polygon_mesh(const CellComplex& complex) {
  const int n = complex.intrinsic_dim;
  if (n > 2)
    throw InvalidInput("polygon_mesh: cells of dimension " + std::to_string(n) +
                       " are not polygons; take the pulled or the barycentric subdivision");
  PolygonMesh mesh;
  mesh.ambient_dim = complex.ambient_dim;
  mesh.dim = n;
  mesh.points = complex.points;
  for (std::size_t i = 0; i < complex.num_cells(n); ++i) {
    const auto facets = complex.facets[n][i];
    if (n == 1) {
      mesh.corners.insert(mesh.corners.end(), facets.begin(), facets.end());
    } else {
      // Walk round the edges from the first one.
      std::vector<std::uint32_t> left(facets.begin() + 1, facets.end());
      const auto ends = complex.facets[1][facets[0]];
      const std::uint32_t start = ends[0];
      std::uint32_t current = ends[1];
      mesh.corners.push_back(start);
      while (current != start) {
        mesh.corners.push_back(current);
        const auto next = std::find_if(left.begin(), left.end(), [&](std::uint32_t e) {
          return complex.facets[1][e][0] == current || complex.facets[1][e][1] == current;
        });
        if (next == left.end()) throw InvalidInput("polygon_mesh: the edges of a 2-cell are not one closed polygon");
        const auto edge = complex.facets[1][*next];
        current = edge[0] == current ? edge[1] : edge[0];
        left.erase(next);
      }
    }
    mesh.offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  return mesh;
}

}  // namespace whitney
