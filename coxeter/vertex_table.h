// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <coxeter/growing_array.h>
#include <coxeter/hash_slots.h>

namespace whitney::coxeter {

/// Lattice vertices, each stored once and known by its index (order of first appearance).
///
/// The hash of z is mix64 of a linear form z -> sum_i weight_i z_i mod 2^64 with fixed odd weights, and
/// weight_d = -(weight_0 + .. + weight_{d-1}). So the form of z + e(U) is the form of z plus the sum of the weights
/// over U, also when U contains d: neighbours are looked up without a pass over their coordinates.
class VertexTable {
 public:
  explicit VertexTable(int ambient_dim);

  int ambient_dim() const { return dim_; }
  std::size_t size() const { return forms_.size(); }

  /// Coordinates of vertex `index`, d of them. Invalidated by insertions.
  const std::int32_t* coordinates(std::uint32_t index) const { return coordinates_.data() + std::size_t{index} * dim_; }
  std::uint64_t form(std::uint32_t index) const { return forms_[index]; }
  /// weights()[j] is the form of e_j, j = 0..d.
  const std::uint64_t* weights() const { return weights_.data(); }
  std::uint64_t form_of(const std::int32_t* z) const;

  /// The index of z, or HashSlots::kNone. form must be form_of(z). kDim: the ambient dimension where it is known at
  /// compile time, else 0.
  template <int kDim = 0>
  std::uint32_t find(const std::int32_t* z, std::uint64_t form) const {
    const int dim = kDim > 0 ? kDim : dim_;
    return slots_.find(mix64(form), [&](std::uint32_t index) {
      if (forms_[index] != form) return false;
      const std::int32_t* known = coordinates_.data() + std::size_t{index} * dim;
      std::int32_t difference = 0;
      for (int c = 0; c < dim; ++c) difference |= known[c] ^ z[c];
      return difference == 0;
    });
  }

  /// The index of z, entered if it is new (then it is size() - 1 afterwards).
  /// Throws LatticeOverflow when a coordinate of a new vertex is so large that a neighbour's would not fit in 32 bits.
  template <int kDim = 0>
  std::uint32_t intern(const std::int32_t* z, std::uint64_t form) {
    const std::uint32_t found = find<kDim>(z, form);
    return found != HashSlots::kNone ? found : enter(z, form);
  }

  void prefetch(std::uint64_t form) const { slots_.prefetch(mix64(form)); }

  /// Hands the coordinates over (num x d) and leaves the table unusable.
  GrowingArray<std::int32_t> take_coordinates();

 private:
  std::uint32_t enter(const std::int32_t* z, std::uint64_t form);

  int dim_;
  std::vector<std::uint64_t> weights_;
  GrowingArray<std::int32_t> coordinates_;
  GrowingArray<std::uint64_t> forms_;
  HashSlots slots_;
};

}  // namespace whitney::coxeter
