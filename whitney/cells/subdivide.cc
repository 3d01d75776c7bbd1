// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/cells/subdivide.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include <coxeter/base/error.h>

namespace whitney {

namespace {

/// Appends the simplices of cells of one dimension; `ends`, unless null, gets the size of the list after each cell.
using SimplicesOf = std::function<void(int dim, std::span<const std::uint32_t> cells, std::vector<std::uint32_t>& out,
                                       std::vector<std::size_t>* ends)>;

/// `ends`: where the simplices of every n-cell end.
void add_strata(const Strata& strata, const SimplicesOf& simplices_of, std::span<const std::size_t> ends,
                SimplicialMesh& mesh) {
  NamedArray stratum{"stratum", 1, {}};
  for (std::size_t i = 0; i < ends.size(); ++i)
    stratum.values.resize(ends[i] / (mesh.dim + 1), strata.stratum_of[mesh.dim][i]);
  mesh.cell_data.push_back(std::move(stratum));
  for (std::size_t s = 0; s < strata.strata.size(); ++s) {
    if (strata.strata[s].dim == mesh.dim) continue;
    MeshStratum& piece = mesh.strata.emplace_back();
    piece.stratum = static_cast<int>(s);
    piece.dim = strata.strata[s].dim;
    simplices_of(piece.dim, strata.strata[s].cells, piece.simplices, nullptr);
  }
}

std::vector<std::uint32_t> all_cells(const CellComplex& complex) {
  std::vector<std::uint32_t> cells(complex.num_cells(complex.intrinsic_dim));
  std::iota(cells.begin(), cells.end(), std::uint32_t{0});
  return cells;
}

}  // namespace

SimplicialMesh barycentric_subdivision(const CellComplex& complex, const Strata* strata) {
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
  std::vector<std::uint32_t> chain;
  auto descend = [&](auto& self, int j, std::uint32_t cell, std::vector<std::uint32_t>& out) -> void {
    chain[j] = static_cast<std::uint32_t>(first[j] + cell);
    if (j == 0) {
      out.insert(out.end(), chain.begin(), chain.end());
      return;
    }
    for (std::uint32_t f : complex.facets[j][cell]) self(self, j - 1, f, out);
  };
  const auto simplices_of = [&](int dim, std::span<const std::uint32_t> cells, std::vector<std::uint32_t>& out,
                                std::vector<std::size_t>* ends) {
    chain.resize(dim + 1);
    for (std::uint32_t i : cells) {
      descend(descend, dim, i, out);
      if (ends != nullptr) ends->push_back(out.size());
    }
  };
  std::vector<std::size_t> ends;
  simplices_of(n, all_cells(complex), mesh.simplices, strata != nullptr ? &ends : nullptr);
  if (strata != nullptr) {
    NamedArray stratum{"stratum", 1, {}};
    for (const auto& of_dim : strata->stratum_of)
      stratum.values.insert(stratum.values.end(), of_dim.begin(), of_dim.end());
    mesh.point_data.push_back(std::move(stratum));
    add_strata(*strata, simplices_of, ends, mesh);
  }
  return mesh;
}

SimplicialMesh pulled_subdivision(const CellComplex& complex, const Strata* strata) {
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
  std::vector<std::uint32_t> simplex;
  // A facet contains the least vertex of the cell exactly when that is its own least vertex.
  auto pull = [&](auto& self, int j, std::uint32_t cell, std::vector<std::uint32_t>& out) -> void {
    simplex[simplex.size() - 1 - j] = least[j][cell];
    if (j == 0) {
      out.insert(out.end(), simplex.begin(), simplex.end());
      return;
    }
    for (std::uint32_t f : complex.facets[j][cell])
      if (least[j - 1][f] != least[j][cell]) self(self, j - 1, f, out);
  };
  const auto simplices_of = [&](int dim, std::span<const std::uint32_t> cells, std::vector<std::uint32_t>& out,
                                std::vector<std::size_t>* ends) {
    simplex.resize(dim + 1);
    for (std::uint32_t i : cells) {
      pull(pull, dim, i, out);
      if (ends != nullptr) ends->push_back(out.size());
    }
  };
  std::vector<std::size_t> ends;
  simplices_of(n, all_cells(complex), mesh.simplices, strata != nullptr ? &ends : nullptr);
  if (strata != nullptr) {
    const auto& of_points = strata->stratum_of[0];
    mesh.point_data.push_back({"stratum", 1, {of_points.begin(), of_points.end()}});
    add_strata(*strata, simplices_of, ends, mesh);
  }
  return mesh;
}

SimplicialMesh stratum_mesh(const SimplicialMesh& mesh, int stratum) {
  SimplicialMesh out;
  out.ambient_dim = mesh.ambient_dim;
  const auto piece = std::find_if(mesh.strata.begin(), mesh.strata.end(),
                                  [&](const MeshStratum& candidate) { return candidate.stratum == stratum; });
  if (piece != mesh.strata.end()) {
    out.dim = piece->dim;
    out.simplices = piece->simplices;
  } else {
    out.dim = mesh.dim;
    for (const NamedArray& array : mesh.cell_data) {
      if (array.name != "stratum") continue;
      for (std::size_t i = 0; i < array.values.size(); ++i)
        if (array.values[i] == stratum)
          out.simplices.insert(out.simplices.end(), mesh.simplices.begin() + i * (mesh.dim + 1),
                               mesh.simplices.begin() + (i + 1) * (mesh.dim + 1));
    }
  }
  if (out.simplices.empty()) throw InvalidInput("stratum_mesh: there is no stratum " + std::to_string(stratum));
  std::vector<std::uint32_t> used = out.simplices;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::uint32_t& v : out.simplices)
    v = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), v) - used.begin());
  const std::size_t d = mesh.ambient_dim;
  for (std::uint32_t v : used)
    out.points.insert(out.points.end(), mesh.points.begin() + v * d, mesh.points.begin() + (v + 1) * d);
  for (const NamedArray& array : mesh.point_data) {
    NamedArray& copy = out.point_data.emplace_back(array.name, array.components, std::vector<double>());
    for (std::uint32_t v : used)
      copy.values.insert(copy.values.end(), array.values.begin() + std::size_t{v} * array.components,
                         array.values.begin() + (std::size_t{v} + 1) * array.components);
  }
  return out;
}

PolygonMesh polygon_mesh(const CellComplex& complex, const Strata* strata) {
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
  if (strata != nullptr) {
    const auto &of_points = strata->stratum_of[0], &of_cells = strata->stratum_of[n];
    mesh.point_data.push_back({"stratum", 1, {of_points.begin(), of_points.end()}});
    mesh.cell_data.push_back({"stratum", 1, {of_cells.begin(), of_cells.end()}});
  }
  return mesh;
}

}  // namespace whitney
