// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/half_edges.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace whitney {

std::vector<HalfEdge> sorted_half_edges(const Incidence& polygons, std::size_t num_points) {
  // Counting sort by the low end, then small sorts.
  std::vector<std::size_t> bucket(num_points + 1, 0);
  const auto for_each = [&polygons](auto visit) {
    std::uint32_t slot = 0;
    for (std::size_t c = 0; c < polygons.size(); ++c) {
      const auto cell = polygons[c];
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

CellOrientation orient_polygons(const Incidence& polygons, std::size_t num_points) {
  // The edges of a polygon in the order of its corners; the sign of an edge is its direction in the polygon.
  Incidence edges;
  edges.offset = polygons.offset;
  edges.index.resize(polygons.index.size());
  std::vector<std::int8_t> signs(edges.index.size());
  std::uint32_t num_edges = 0;
  const std::vector<HalfEdge> half_edges = sorted_half_edges(polygons, num_points);
  const HalfEdge* last = nullptr;
  for (const HalfEdge& h : half_edges) {
    if (last == nullptr || last->low != h.low || last->high != h.high) ++num_edges;
    edges.index[h.slot] = num_edges - 1;
    signs[h.slot] = h.upward ? 1 : -1;
    last = &h;
  }
  return orient_cells(edges, signs, num_edges);
}

}  // namespace whitney
