// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/formats/surface.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whitney::io {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

struct HalfEdge {
  std::uint32_t low, high;  ///< its ends
  std::uint32_t cell;
  bool upward;  ///< runs from low to high
};

/// All half-edges with those of one edge side by side: counting sort by the low end, then small sorts.
std::vector<HalfEdge> sorted_half_edges(const MeshView& mesh, std::vector<std::size_t>& bucket) {
  bucket.assign(mesh.num_points() + 1, 0);
  const auto for_each = [&mesh](auto visit) {
    for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
      const auto cell = mesh.cell(c);
      for (std::size_t i = 0; i < cell.size(); ++i) {
        const std::uint32_t a = cell[i];
        const std::uint32_t b = cell[i + 1 == cell.size() ? 0 : i + 1];
        visit(HalfEdge{std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(c), a < b});
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
                return a.high != b.high ? a.high < b.high : a.cell < b.cell;
              });
  }
  return sorted;
}

struct Neighbour {
  std::uint32_t cell = kNone;
  bool agrees = false;
};

}  // namespace

bool orient_cells(MeshView& mesh) {
  const std::size_t num_cells = mesh.num_cells();
  std::vector<std::size_t> first(num_cells + 1, 0);
  for (std::size_t c = 0; c < num_cells; ++c) first[c + 1] = first[c] + mesh.cell(c).size();

  // The neighbours of a cell, in any order, in the slots of its corners.
  std::vector<Neighbour> neighbours(mesh.corners.size());
  {
    std::vector<std::size_t> bucket;
    const std::vector<HalfEdge> edges = sorted_half_edges(mesh, bucket);
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < edges.size();) {
      std::size_t j = i + 1;
      while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) ++j;
      if (j - i == 2) {
        const bool agree = edges[i].upward != edges[i + 1].upward;
        neighbours[next[edges[i].cell]++] = {edges[i + 1].cell, agree};
        neighbours[next[edges[i + 1].cell]++] = {edges[i].cell, agree};
      }
      i = j;
    }
  }

  bool all_orientable = true;
  std::vector<char> seen(num_cells, 0), turned(num_cells, 0);
  std::vector<std::uint32_t> component;
  for (std::uint32_t start = 0; start < num_cells; ++start) {
    if (seen[start]) continue;
    component.assign(1, start);
    seen[start] = 1;
    bool orientable = true;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const std::uint32_t c = component[i];
      for (std::size_t k = first[c]; k < first[c + 1] && neighbours[k].cell != kNone; ++k) {
        const auto [other, agrees] = neighbours[k];
        const char wanted = agrees ? turned[c] : static_cast<char>(!turned[c]);
        if (!seen[other]) {
          seen[other] = 1;
          turned[other] = wanted;
          component.push_back(other);
        } else if (turned[other] != wanted) {
          orientable = false;
        }
      }
    }
    if (!orientable) {
      for (const std::uint32_t c : component) turned[c] = 0;
      all_orientable = false;
    }
  }
  for (std::size_t c = 0; c < num_cells; ++c) {
    if (turned[c]) {
      // The first corner stays first.
      std::reverse(mesh.corners.begin() + static_cast<std::ptrdiff_t>(first[c]) + 1,
                   mesh.corners.begin() + static_cast<std::ptrdiff_t>(first[c + 1]));
    }
  }
  return all_orientable;
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
