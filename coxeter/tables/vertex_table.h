// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <coxeter/base/growing_array.h>
#include <coxeter/base/hash_slots.h>

namespace whitney::coxeter {

/// Lattice vertices, each stored once and known by its index (order of first appearance), with room for a few values of
/// the caller's beside the coordinates.
///
/// The hash of z is mix64 of a linear form z -> sum_i weight_i z_i mod 2^64 with fixed odd weights, and
/// weight_d = -(weight_0 + .. + weight_{d-1}). So the form of z + e(U) is the form of z plus the sum of the weights
/// over U, also when U contains d: neighbours are looked up without a pass over their coordinates.
class VertexTable {
 public:
  explicit VertexTable(int ambient_dim, int num_values = 0);

  int ambient_dim() const { return dim_; }
  std::size_t size() const { return size_; }

  /// Coordinates of vertex `index`: d of them, then zeros up to a multiple of 4. Invalidated by insertions.
  const std::int32_t* coordinates(std::uint32_t index) const {
    return reinterpret_cast<const std::int32_t*>(record(index) + 1);
  }
  /// The caller's values at vertex `index`, not initialised; kSlackWords more may be read. Invalidated by insertions.
  double* values(std::uint32_t index) {
    return reinterpret_cast<double*>(&records_[index * stride_] + stride_ - num_values_);
  }
  static constexpr int kSlackWords = 7;
  std::uint64_t form(std::uint32_t index) const { return *record(index); }
  /// weights()[j] is the form of e_j, j = 0..d.
  const std::uint64_t* weights() const { return weights_.data(); }
  std::uint64_t form_of(const std::int32_t* z) const;

  /// The index of z, or HashSlots::kNone. form must be form_of(z). kDim: the ambient dimension where it is known at
  /// compile time, else 0.
  template <int kDim = 0>
  std::uint32_t find(const std::int32_t* z, std::uint64_t form) const {
    const int dim = kDim > 0 ? kDim : dim_;
    return slots_.find(mix64(form), [&](std::uint32_t index) {
      if (this->form(index) != form) return false;
      const std::int32_t* known = coordinates(index);
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

  /// Whether vertex `index` is the vertex `from` with `step` added to the coordinates in `moved` (bits; d <= 31).
  template <int kDim = 0>
  bool is_neighbour(std::uint32_t index, std::uint32_t from, std::uint32_t moved, std::int32_t step) const {
    const std::int32_t *known = coordinates(index), *z = coordinates(from);
    const int padded = padded_dim(kDim > 0 ? kDim : dim_);
    std::int32_t difference = 0;
    for (int c = 0; c < padded; ++c)
      difference |= known[c] ^ (z[c] + (-static_cast<std::int32_t>(moved >> c & 1) & step));
    return difference == 0;
  }

  void prefetch(std::uint64_t form) const { slots_.prefetch(mix64(form)); }

  /// The index `find` will most likely return, or kNone: looks at tags alone. Its record is on its way to the cache.
  std::uint32_t guess(std::uint64_t form) const {
    const std::uint32_t index = slots_.guess(mix64(form));
    if (index != HashSlots::kNone) __builtin_prefetch(record(index));
    return index;
  }

  /// Frees the index: find and intern may not be called any more.
  void release_index() { slots_.release(); }
  /// Frees everything: the table is unusable afterwards.
  void release() {
    slots_.release();
    records_.release();
  }

 private:
  std::uint32_t enter(const std::int32_t* z, std::uint64_t form);
  static constexpr int padded_dim(int dim) { return (dim + 3) & ~3; }
  const std::uint64_t* record(std::uint32_t index) const { return &records_[index * stride_]; }

  int dim_;
  std::size_t num_values_, stride_, size_ = 0;
  std::vector<std::uint64_t> weights_;
  // A record is the form, the coordinates and the values, side by side because they are wanted together.
  GrowingArray<std::uint64_t> records_;
  HashSlots slots_;
};

}  // namespace whitney::coxeter
