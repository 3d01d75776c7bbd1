// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/tables/vertex_table.h>

#include <cstring>
#include <limits>
#include <string>

#include <coxeter/base/error.h>

namespace whitney::coxeter {

VertexTable::VertexTable(int ambient_dim, int num_values)
    : dim_(ambient_dim),
      num_values_(num_values),
      stride_(1 + padded_dim(ambient_dim) / 2 + num_values),
      weights_(ambient_dim + 1) {
  std::uint64_t sum = 0;
  for (int i = 0; i < dim_; ++i) {
    weights_[i] = mix64(0x9e3779b97f4a7c15ull * (i + 1)) | 1;
    sum += weights_[i];
  }
  weights_[dim_] = 0 - sum;
}

std::uint64_t VertexTable::form_of(const std::int32_t* z) const {
  std::uint64_t form = 0;
  for (int i = 0; i < dim_; ++i) form += weights_[i] * static_cast<std::uint64_t>(std::int64_t{z[i]});
  return form;
}

std::uint32_t VertexTable::enter(const std::int32_t* z, std::uint64_t form) {
  constexpr std::int32_t kLargest = std::numeric_limits<std::int32_t>::max() - 2;
  for (int i = 0; i < dim_; ++i)
    if (z[i] > kLargest || z[i] < -kLargest)
      throw LatticeOverflow("lattice coordinate " + std::to_string(i + 1) + " has reached " + std::to_string(z[i]) +
                            ": the manifold is unbounded, or the edge length is too small for its size");
  const auto index = static_cast<std::uint32_t>(size());
  std::uint64_t* added = records_.extend(stride_ + kSlackWords);
  records_.truncate(records_.size() - kSlackWords);
  added[0] = form;
  added[padded_dim(dim_) / 2] = added[padded_dim(dim_) / 2 - 1] = 0;
  std::memcpy(added + 1, z, dim_ * sizeof *z);
  ++size_;
  slots_.insert(mix64(form), index);
  return index;
}

}  // namespace whitney::coxeter
