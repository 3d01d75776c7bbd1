// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <coxeter/base/disjoint_sets.h>
#include <whitney/io/formats/surface.h>
#include <whitney/topology/half_edges.h>

namespace whitney::io {

namespace {

/// Whether the cells, directions of corners included, are those of a half-edge mesh: no half-edge in two cells, and no
/// cell at a point that a closed fan of other cells surrounds. (Open fans that meet in a point are allowed.)
bool is_half_edge_mesh(const MeshView& mesh, const Incidence& cells) {
  std::vector<std::uint32_t> next(cells.index.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::uint32_t begin = cells.offset[c], end = cells.offset[c + 1];
    for (std::uint32_t slot = begin; slot < end; ++slot) next[slot] = slot + 1 == end ? begin : slot + 1;
  }
  // Fans are classes of corners (slots) at one point, linked across the edges there. A link within a class closes it.
  DisjointSets fans(cells.index.size());
  std::vector<std::uint32_t> num_fans(mesh.num_points(), 0);
  std::vector<bool> closed(mesh.num_points(), false);
  for (const std::uint32_t v : cells.index) ++num_fans[v];
  const auto link = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t v = cells.index[a];
    if (fans.unite(a, b)) {
      --num_fans[v];
    } else {
      closed[v] = true;
    }
  };
  const std::vector<HalfEdge> half_edges = sorted_half_edges(cells, mesh.num_points());
  for (std::size_t i = 1; i < half_edges.size(); ++i) {
    const HalfEdge &a = half_edges[i - 1], &b = half_edges[i];
    if (a.low != b.low || a.high != b.high) continue;
    // A third half-edge of this edge repeats the direction of the second or of the first.
    if (a.upward == b.upward) return false;
    if (i > 1 && half_edges[i - 2].low == b.low && half_edges[i - 2].high == b.high) return false;
    link(a.slot, next[b.slot]);
    link(b.slot, next[a.slot]);
  }
  for (std::size_t v = 0; v < mesh.num_points(); ++v) {
    if (closed[v] && num_fans[v] > 1) return false;
  }
  return true;
}

void normalize(double* vector) {
  const double length = std::sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
  if (length == 0) return;
  for (int k = 0; k < 3; ++k) vector[k] /= length;
}

}  // namespace

std::optional<std::vector<double>> vertex_normals(const MeshView& mesh) {
  if (!mesh.oriented || !is_half_edge_mesh(mesh, cells_of(mesh))) return std::nullopt;
  std::vector<double> normals(3 * mesh.num_points(), 0.0);
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    std::array<double, 3> normal = area_vector(mesh, c);
    normalize(normal.data());
    for (const std::uint32_t v : mesh.cell(c)) {
      for (std::size_t k = 0; k < 3; ++k) normals[3 * std::size_t{v} + k] += normal[k];
    }
  }
  for (std::size_t i = 0; i < normals.size(); i += 3) normalize(normals.data() + i);
  return normals;
}

}  // namespace whitney::io
