// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <whitney/topology/mesh.h>

namespace whitney::io {

/// Throws FileError "path: reason", or "path:line: reason" for a line counted from 1.
[[noreturn]] void fail_reading(const std::string& path, const std::string& reason);
[[noreturn]] void fail_reading(const std::string& path, std::size_t line, const std::string& reason);

/// Collects what a reader finds, and checks it.
class MeshBuilder {
 public:
  explicit MeshBuilder(int ambient_dim) { mesh_.ambient_dim = ambient_dim; }

  /// Returns nothing, or why the coordinate cannot be taken.
  const char* add_coordinate(double value);
  std::size_t num_points() const { return mesh_.num_points(); }
  std::size_t num_cells() const { return offsets_.size() - 1; }

  /// A cell by its points, counted from 0. Returns "", or what is wrong with it.
  std::string add_cell(std::span<const std::uint64_t> points);

  /// Cells of one size as simplices (if `simplices`, or if they have at most three corners), else as polygons. Cells of
  /// lower dimension are left out if they are faces of others: edges and points, with `simplices` triangles too.
  /// Throws FileError naming `path`, also for other mixtures of dimensions.
  SimplicialMesh finish(const std::string& path, bool simplices);

 private:
  void drop_lower_cells(const std::string& path, bool simplices);

  SimplicialMesh mesh_;
  std::vector<std::size_t> offsets_{0};
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint64_t> sorted_;  // scratch
};

}  // namespace whitney::io
