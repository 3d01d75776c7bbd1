// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace whitney::perturbation {

/// All subsets with m + 1 of the vertices 0 .. d of a d-simplex: its m-faces, in lexicographic order.
struct VertexSubsets {
  int size = 0;                        ///< m + 1
  std::vector<std::uint8_t> vertices;  ///< num x size, increasing within a face

  /// Throws InvalidInput unless 0 <= face_dim <= ambient_dim <= 31 and there are at most a million faces.
  VertexSubsets(int ambient_dim, int face_dim);
  VertexSubsets() = default;

  std::size_t num() const { return vertices.size() / size; }
  const std::uint8_t* operator[](std::size_t i) const { return vertices.data() + i * size; }
};

}  // namespace whitney::perturbation
