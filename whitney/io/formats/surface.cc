// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/formats/surface.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <whitney/topology/half_edges.h>

namespace whitney::io {

Incidence cells_of(const MeshView& mesh) {
  Incidence cells;
  cells.offset.reserve(mesh.num_cells() + 1);
  for (std::size_t c = 0; c < mesh.num_cells(); ++c)
    cells.offset.push_back(cells.offset.back() + static_cast<std::uint32_t>(mesh.cell(c).size()));
  cells.index = mesh.corners;
  return cells;
}

bool orient_cells(MeshView& mesh) {
  const Incidence cells = cells_of(mesh);
  const CellOrientation orientation = orient_polygons(cells, mesh.num_points());
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    if (orientation.sign[c] > 0) continue;
    // The first corner stays first.
    std::reverse(mesh.corners.begin() + static_cast<std::ptrdiff_t>(cells.offset[c]) + 1,
                 mesh.corners.begin() + static_cast<std::ptrdiff_t>(cells.offset[c + 1]));
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
