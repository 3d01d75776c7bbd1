// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <whitney/topology/mesh.h>

namespace whitney::io {

/// What every writer gets: simplices or polygons, checked, with a place in R^3 for every point.
struct MeshView {
  int ambient_dim = 0;
  int dim = 0;
  bool polygons = false;  ///< cells of dimension 2 that may have more than three corners
  std::span<const double> points;
  std::vector<std::uint32_t> corners;      ///< all cells, one after the other
  std::span<const std::uint32_t> offsets;  ///< of polygon meshes; simplices all have dim + 1 corners
  std::span<const NamedArray> point_data;
  std::span<const NamedArray> cell_data;
  std::span<const MeshStratum> strata;
  std::vector<std::string> variables;  ///< d names
  std::vector<double> xyz;             ///< num_points x 3
  std::vector<double> color;           ///< one value in [0, 1] per point, or empty
  bool oriented = false;               ///< dim == 2 and neighbours agree everywhere
  bool normals = true;                 ///< the user wants normals

  std::size_t num_points() const { return points.size() / static_cast<std::size_t>(ambient_dim); }
  std::size_t num_cells() const {
    return offsets.empty() ? corners.size() / (static_cast<std::size_t>(dim) + 1) : offsets.size() - 1;
  }
  std::span<const std::uint32_t> cell(std::size_t i) const {
    const auto size = static_cast<std::size_t>(dim) + 1;
    if (offsets.empty()) return {corners.data() + i * size, size};
    return {corners.data() + offsets[i], corners.data() + offsets[i + 1]};
  }
  std::span<const double> position(std::size_t i) const { return {xyz.data() + 3 * i, 3}; }
};

}  // namespace whitney::io
