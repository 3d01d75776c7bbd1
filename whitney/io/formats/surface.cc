// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/formats/surface.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <whitney/topology/incidence.h>
#include <whitney/topology/orientation.h>

namespace whitney::io {

namespace {

struct HalfEdge {
  std::uint32_t low, high;  ///< its ends
  std::uint32_t slot;       ///< of the corner where it begins
  bool upward;              ///< runs from low to high
};

/// All half-edges with those of one edge side by side: counting sort by the low end, then small sorts.
std::vector<HalfEdge> sorted_half_edges(const MeshView& mesh) {
  std::vector<std::size_t> bucket(mesh.num_points() + 1, 0);
  const auto for_each = [&mesh](auto visit) {
    std::uint32_t slot = 0;
    for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
      const auto cell = mesh.cell(c);
      for (std::size_t i = 0; i < cell.size(); ++i) {
        const std::uint32_t a = cell[i];
        const std::uint32_t b = cell[i + 1 == cell.size() ? 0 : i + 1];
        visit(HalfEdge{std::min(a, b), std::max(a, b), slot++, a < b});
      }
    }
  };
  for_each([&](const HalfEdge& h) { ++bucket[h.low + 1]; });
  for (std::size_t i = 1; i < bucket.size(); ++i) bucket[i] += bucket[i - 1];
  std::vector<HalfEdge> sorted(bucket.back());
  std::vector<std::size_t> next = bucket;
  for_each([&](const HalfEdge& h) { sorted[next[h.low]++] = h; });
  for (std::size_t v = 0; v + 1 < bucket.size(); ++v) {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(bucket[v]),
              sorted.begin() + static_cast<std::ptrdiff_t>(bucket[v + 1]), [](const HalfEdge& a, const HalfEdge& b) {
                return a.high != b.high ? a.high < b.high : a.slot < b.slot;
              });
  }
  return sorted;
}

}  // namespace

bool orient_cells(MeshView& mesh) {
  // The edges of a cell in the order of its corners; the sign of an edge is its direction in the cell.
  Incidence edges;
  for (std::size_t c = 0; c < mesh.num_cells(); ++c)
    edges.offset.push_back(edges.offset.back() + static_cast<std::uint32_t>(mesh.cell(c).size()));
  edges.index.resize(edges.offset.back());
  std::vector<std::int8_t> signs(edges.index.size());
  std::uint32_t num_edges = 0;
  const HalfEdge* last = nullptr;
  const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh);
  for (const HalfEdge& h : half_edges) {
    if (last == nullptr || last->low != h.low || last->high != h.high) ++num_edges;
    edges.index[h.slot] = num_edges - 1;
    signs[h.slot] = h.upward ? 1 : -1;
    last = &h;
  }
  const CellOrientation orientation = whitney::orient_cells(edges, signs, num_edges);
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    if (orientation.sign[c] > 0) continue;
    // The first corner stays first.
    std::reverse(mesh.corners.begin() + static_cast<std::ptrdiff_t>(edges.offset[c]) + 1,
                 mesh.corners.begin() + static_cast<std::ptrdiff_t>(edges.offset[c + 1]));
  }
  return orientation.all_orientable();
}

std::array<double, 3> area_vector(const MeshView& mesh, std::size_t cell) {
  std::array<double, 3> sum{};
  const auto corners = mesh.cell(cell);
  const auto origin = mesh.position(corners[0]);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const auto p = mesh.position(corners[i]);
    const auto q = mesh.position(corners[i + 1]);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      sum[k] += (p[a] - origin[a]) * (q[b] - origin[b]) - (p[b] - origin[b]) * (q[a] - origin[a]);
    }
  }
  return sum;
}

std::vector<double> corner_normals(const MeshView& mesh) {
  const auto dot = [](const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  std::vector<double> at_point(3 * mesh.num_points(), 0.0);
  std::vector<std::array<double, 3>> of_cell(mesh.num_cells());
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    of_cell[c] = area_vector(mesh, c);
    for (const std::uint32_t v : mesh.cell(c)) {
      double* sum = at_point.data() + 3 * std::size_t{v};
      // Where sides cannot be told apart globally, the first cell around the vertex decides.
      const double sign = !mesh.oriented && dot(sum, of_cell[c].data()) < 0 ? -1 : 1;
      for (std::size_t k = 0; k < 3; ++k) sum[k] += sign * of_cell[c][k];
    }
  }
  std::vector<double> result;
  result.reserve(3 * mesh.corners.size());
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    for (const std::uint32_t v : mesh.cell(c)) {
      const double* normal = at_point.data() + 3 * std::size_t{v};
      const double length = std::sqrt(dot(normal, normal));
      const double scale = length > 0 ? (dot(normal, of_cell[c].data()) < 0 ? -1 : 1) / length : 0;
      for (std::size_t k = 0; k < 3; ++k) result.push_back(scale * normal[k]);
    }
  }
  return result;
}

}  // namespace whitney::io
