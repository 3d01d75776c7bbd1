// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/vertex_subsets.h>

#include <numeric>
#include <string>

#include <coxeter/base/error.h>

namespace whitney::perturbation {

VertexSubsets::VertexSubsets(int ambient_dim, int face_dim) : size(face_dim + 1) {
  if (face_dim < 0 || face_dim > ambient_dim || ambient_dim > 31)
    throw InvalidInput("faces of dimension " + std::to_string(face_dim) + " of a simplex of dimension " +
                       std::to_string(ambient_dim) + ": need 0 <= face_dim <= ambient_dim <= 31");
  double count = 1;  // C(d+1, m+1)
  for (int i = 1; i <= size; ++i) count *= (ambient_dim + 1 - size + i) / static_cast<double>(i);
  if (count > 1e6)
    throw InvalidInput("a simplex of dimension " + std::to_string(ambient_dim) + " has more than a million faces of " +
                       "dimension " + std::to_string(face_dim));
  std::vector<std::uint8_t> face(size);
  std::iota(face.begin(), face.end(), std::uint8_t{0});
  for (;;) {
    vertices.insert(vertices.end(), face.begin(), face.end());
    int i = size - 1;
    while (i >= 0 && face[i] == ambient_dim - (size - 1 - i)) --i;
    if (i < 0) return;
    ++face[i];
    for (int j = i + 1; j < size; ++j) face[j] = face[j - 1] + 1;
  }
}

}  // namespace whitney::perturbation
