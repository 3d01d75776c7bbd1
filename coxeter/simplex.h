// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <coxeter/lattice_vertex.h>
#include <coxeter/ordered_partition.h>

namespace whitney::coxeter {

class Triangulation;

/// A permutahedral representation: a lattice vertex and an ordered partition of {0 .. d} into parts p_0 .. p_m. It
/// stands for the m-simplex with the vertices
///   v_q = v_0 + e(U_q), U_q the union of the first q parts, q = 0 .. m,
/// where e(U) is the sum of e_j over U and e_d = -(e_0 + .. + e_{d-1}). An m-simplex has m + 1 of them, one per vertex.
/// Source: SoCG 2021, Sect. 2.
struct Representation {
  LatticeVertex vertex;
  OrderedPartition partition;
};

/// A simplex of the Freudenthal triangulation of Z^d, and so of every affine image of it, in canonical form: element d
/// lies in the last part, every part is sorted. Then v_0 < v_1 < .. < v_m in every coordinate (weakly), and
/// v_m - v_0 is a vector of zeros and ones. Equal simplices have equal representations.
class Simplex {
 public:
  /// The empty simplex: ambient dimension -1, dimension -1. It is there to be assigned to.
  Simplex() = default;
  Simplex(const Simplex&) = default;
  Simplex(Simplex&&) = default;
  Simplex& operator=(Simplex&&) = default;
  Simplex& operator=(const Simplex& other) {
    if (owns_memory() | other.owns_memory()) {
      assign_parts(other);
    } else {
      base_.coordinates_.copy_in_place(other.base_.coordinates_);
      partition_.data_.copy_in_place(other.partition_.data_);
      partition_.num_elements_ = other.partition_.num_elements_;
    }
    return *this;
  }
  /// From any of the m + 1 representations. Throws InvalidInput unless the partition has d + 1 elements,
  /// LatticeOverflow when a vertex leaves the range of int32.
  Simplex(LatticeVertex vertex, OrderedPartition partition);
  explicit Simplex(Representation representation);
  /// The simplex with these vertices, in any order. Throws InvalidInput unless they are distinct, of one ambient
  /// dimension, and span a simplex of the triangulation.
  static Simplex from_vertices(std::span<const LatticeVertex> vertices);

  int ambient_dim() const { return partition_.num_elements() - 1; }
  int dim() const { return partition_.num_parts() - 1; }
  int codim() const { return ambient_dim() - dim(); }
  /// v_0, the least vertex.
  const LatticeVertex& base() const { return base_; }
  const OrderedPartition& partition() const { return partition_; }

  /// v_q, 0 <= q <= dim().
  LatticeVertex vertex(int q) const;
  /// v_0 .. v_m.
  std::vector<LatticeVertex> vertices() const;
  /// The representation that starts at v_q, 0 <= q <= dim(); q = 0 is the canonical one.
  Representation cyclic_shift(int q) const;

  /// Whether every vertex of this simplex is one of `other` (a simplex is a face of itself). O(d).
  bool is_face_of(const Simplex& other) const;

  friend bool operator==(const Simplex& a, const Simplex& b) {
    return a.base_ == b.base_ && a.partition_ == b.partition_;
  }
  /// The canonical order: lexicographic by base vertex, then by the array of part indices of the coordinates 0 .. d-1,
  /// then by dimension.
  friend std::strong_ordering operator<=>(const Simplex& a, const Simplex& b);

  /// Depends on the simplex only: the same in every run.
  std::uint64_t hash() const;

 private:
  friend struct detail::SimplexWriter;

  bool owns_memory() const { return base_.coordinates_.owns_memory() | partition_.data_.owns_memory(); }
  [[gnu::noinline]] void assign_parts(const Simplex& other);

  // The values of each begin a cache line: a copy of them is one wide load and one wide store.
  alignas(64) LatticeVertex base_;
  alignas(64) OrderedPartition partition_;
};

/// The mean of the vertices of the simplex in the triangulation; d. Throws InvalidInput when the dimensions differ.
std::vector<double> barycentre(const Simplex& simplex, const Triangulation& triangulation);

}  // namespace whitney::coxeter

template <>
struct std::hash<whitney::coxeter::Simplex> {
  std::size_t operator()(const whitney::coxeter::Simplex& s) const noexcept { return s.hash(); }
};
