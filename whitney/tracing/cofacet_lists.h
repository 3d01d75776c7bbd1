// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <coxeter/base/growing_array.h>
#include <coxeter/faces/cofacet_step.h>
#include <coxeter/faces/short_partition.h>
#include <coxeter/simplex.h>
#include <coxeter/tables/vertex_table.h>

// The cofacets of k-simplices, and the simplices behind them: the tracer's own combinatorics, not for others.

namespace whitney {

/// What is known at compile time: the type of part numbers; d and k, or 0; whether ShortPartition fits.
template <class IndexType, bool kShortForm, int kAmbientDim = 0, int kNumEquations = 0>
struct TraceShape {
  using Index = IndexType;
  static constexpr bool kShort = kShortForm;
  static constexpr int kDim = kAmbientDim, kCodim = kNumEquations;
};

/// An int that may be known at compile time.
template <int kKnown>
struct KnownInt {
  int value;
  constexpr operator int() const { return kKnown > 0 ? kKnown : value; }
};

/// How many simplices have their cofacets listed together, and how many are stepped to together.
inline constexpr std::size_t kTraceBatch = 64, kTraceAhead = 32;

/// A k-simplex with its vertices in the table, k + 1 of them; one more on either side may be read.
struct PendingSimplex {
  std::uint32_t id;
  const std::uint32_t* vertices;
};

/// A cofacet of sigma, not yet crossed.
struct CofacetCandidate {
  std::uint64_t form;     // of w
  std::uint32_t vertex;   // w
  std::uint32_t split;    // A, bits over the elements of part q; the long form only
  std::uint32_t special;  // its special half, bits over the coordinates; if d <= kMaxBitsDim
  std::uint32_t flag;     // number of the cofacet
  std::int32_t leaving;   // the vertex of sigma that is not in the simplex behind the cofacet
  std::uint16_t part;     // q
  std::uint8_t slot;      // of sigma in the batch
  bool new_base;          // w is the base vertex of the cofacet
};

/// The simplex behind a cofacet.
struct CofacetCrossing {
  int inserted, removed;  // positions among the vertices of the cofacet, see coxeter::CofacetStep
  std::uint32_t flag;     // number of the cofacet, seen from there
};

/// The linear form of VertexTable at e(U), for every subset U of {0..d-1}, d <= 15, from two small tables.
class SubsetForms {
 public:
  SubsetForms() = default;
  SubsetForms(const std::uint64_t* weights, int dim) {
    for (int c = 0; c < dim; ++c) {
      std::uint64_t* half = c < 8 ? low_ : high_;
      const int bit = 1 << (c & 7);
      for (int u = 0; u < bit; ++u) half[bit | u] = half[u] + weights[c];
    }
  }
  std::uint64_t operator()(std::uint32_t subset) const { return low_[subset & 255] + high_[subset >> 8]; }

 private:
  std::uint64_t low_[256] = {}, high_[128] = {};
};

/// The cofacets of the simplices of one batch, a slot each.
///
/// Notation: sigma = (v_0; parts 0..k) a k-simplex; a cofacet tau arises when part q is split into A before B, which
/// adds the vertex w = v_q + e(A); as e(0) + .. + e(d) = 0, that is v_0 - e(B) when A holds the element d, and then w
/// is the base vertex of tau. A cofacet has a number: the splits of part 0, then those of part 1, ..; within a part, A
/// as a set of bits over the part's elements in increasing order, less 1.
///
/// Two forms of the same steps: ShortPartition where it fits, part lists otherwise.
template <class Shape>
class CofacetLists {
  using Index = typename Shape::Index;
  static constexpr int kDim = Shape::kDim, kCodim = Shape::kCodim;
  static constexpr bool kShort = Shape::kShort;

 public:
  CofacetLists(int ambient_dim, int codim, coxeter::VertexTable& vertices)
      : d_{ambient_dim},
        k_{codim},
        vertices_(vertices),
        partitions_(kShort ? kTraceBatch : 0),
        subset_forms_(vertices.weights(), kShort ? ambient_dim : 0),
        elements_(kTraceBatch * (ambient_dim + 1)),
        starts_(kTraceBatch * (codim + 2)),
        numbers_(kTraceBatch * (codim + 2)),
        form_sums_(std::size_t{2} << (ambient_dim - codim)),
        bit_sums_(std::size_t{2} << (ambient_dim - codim)),
        z_(ambient_dim) {}

  /// Appends the cofacets not yet crossed of a simplex, with the form of the vertex each adds; its parts and flags.
  void list(const PendingSimplex& simplex, const Index* parts, const std::uint64_t* flags, std::size_t slot,
            coxeter::GrowingArray<CofacetCandidate>& candidates) {
    if constexpr (kShort)
      list_short(simplex, parts, *flags, slot, candidates);
    else
      list_long(simplex, parts, flags, slot, candidates);
  }

  /// Finds or enters the vertex w of a candidate, w = v_q + e(A), or v_0 - e(B) if that is below v_0; `vertex` is a
  /// guess.
  void find_vertex(const PendingSimplex& sigma, CofacetCandidate& candidate) {
    const std::uint32_t from = sigma.vertices[candidate.new_base ? 0 : candidate.part];
    const std::int32_t step = candidate.new_base ? -1 : 1;
    const bool bits_fit = d_ <= coxeter::kMaxBitsDim;
    if (bits_fit && candidate.vertex != coxeter::HashSlots::kNone &&
        vertices_.template is_neighbour<kDim>(candidate.vertex, from, candidate.special, step))
      return;
    const std::int32_t* z = vertices_.coordinates(from);
    if (bits_fit) {
      for (int c = 0; c < d_; ++c) z_[c] = z[c] + step * static_cast<std::int32_t>(candidate.special >> c & 1);
    } else {
      std::copy_n(z, int{d_}, z_.begin());
      const coxeter::PartLists lists = part_lists(candidate.slot);
      const std::uint16_t* part = lists.part(candidate.part);
      std::uint32_t half = candidate.split;
      if (candidate.new_base) half = ~half & ((std::uint32_t{1} << lists.size(candidate.part)) - 1);
      for (; half != 0; half &= half - 1) z_[part[std::countr_zero(half)]] += step;
    }
    candidate.vertex = vertices_.template intern<kDim>(z_.data(), candidate.form);
  }

  /// From sigma over the cofacet to its other k-face that is hit, the one without vertex `leaving` of sigma. Writes its
  /// part numbers.
  CofacetCrossing cross(const Index* parts, const CofacetCandidate& candidate, Index* out) const {
    if constexpr (kShort) {
      const auto over =
          partitions_[candidate.slot].step({candidate.part, candidate.special, candidate.new_base}, candidate.leaving);
      std::memcpy(out, &over.parts, sizeof over.parts);
      return {over.inserted, over.removed, static_cast<std::uint32_t>(over.number)};
    } else {
      const coxeter::CofacetStep over = coxeter::step_over_cofacet(
          parts, part_lists(candidate.slot), d_, k_, candidate.part, candidate.split, candidate.leaving, out);
      return {over.inserted, over.removed, over.number};
    }
  }

  /// The cofacet that has this number.
  coxeter::Simplex cofacet(const Index* parts, coxeter::LatticeVertex base, std::uint32_t number) {
    int q = 0;
    bool new_base = false;
    std::vector<char> special(d_, 0);  // the half that takes the number q, or goes before the base
    if constexpr (kShort) {
      coxeter::ShortPartition<kDim, kCodim> partition(parts, d_, k_);
      partition.cofacets();
      const auto split = partition.split(static_cast<int>(number));
      q = split.part;
      new_base = split.new_base;
      for (int c = 0; c < d_; ++c) special[c] = split.special >> c & 1;
    } else {
      const coxeter::PartLists lists = part_lists(0);
      coxeter::list_parts(parts, d_, k_, lists);
      while (q < k_ && lists.numbers[q + 1] <= number) ++q;
      const std::uint32_t split = number - lists.numbers[q] + 1;
      const int size = lists.size(q);
      new_base = q == k_ && (split >> (size - 1) & 1);
      for (int i = 0; i < size; ++i)
        if (lists.part(q)[i] < d_) special[lists.part(q)[i]] = (split >> i & 1) != new_base;
    }
    std::vector<std::uint16_t> of_cofacet(d_ + 1);
    for (int c = 0; c < d_; ++c) {
      of_cofacet[c] =
          static_cast<std::uint16_t>(special[c] ? (new_base ? 0 : q) : parts[c] + (new_base || parts[c] >= q));
      if (new_base && special[c]) --base[c];
    }
    of_cofacet[d_] = static_cast<std::uint16_t>(k_ + 1);
    return {std::move(base), coxeter::OrderedPartition::from_part_indices(of_cofacet)};
  }

 private:
  coxeter::PartLists part_lists(std::size_t slot) const {
    return {const_cast<std::uint16_t*>(&elements_[slot * (d_ + 1)]),
            const_cast<std::uint16_t*>(&starts_[slot * (k_ + 2)]),
            const_cast<std::uint32_t*>(&numbers_[slot * (k_ + 2)])};
  }
  void list_short(const PendingSimplex& simplex, const Index* parts, std::uint64_t flags, std::size_t slot,
                  coxeter::GrowingArray<CofacetCandidate>& candidates) {
    auto& partition = partitions_[slot];
    partition = {parts, d_, k_};
    std::uint64_t rest = partition.cofacets() & ~flags;
    const std::size_t size = candidates.size();
    CofacetCandidate* candidate = candidates.extend(64);
    CofacetCandidate* const begin = candidate;
    for (; rest != 0; rest &= rest - 1, ++candidate) {
      const int number = std::countr_zero(rest);
      const auto split = partition.split(number);
      const std::uint64_t sum = subset_forms_(split.special);
      const std::uint64_t form =
          vertices_.form(simplex.vertices[split.new_base ? 0 : split.part]) + (split.new_base ? 0 - sum : sum);
      vertices_.prefetch(form);
      *candidate = {form,
                    0,
                    0,
                    split.special,
                    static_cast<std::uint32_t>(number),
                    0,
                    static_cast<std::uint16_t>(split.part),
                    static_cast<std::uint8_t>(slot),
                    split.new_base};
    }
    candidates.truncate(size + (candidate - begin));
  }

  void list_long(const PendingSimplex& simplex, const Index* parts, const std::uint64_t* flags, std::size_t slot,
                 coxeter::GrowingArray<CofacetCandidate>& candidates) {
    const coxeter::PartLists lists = part_lists(slot);
    coxeter::list_parts(parts, d_, k_, lists);
    const std::uint64_t* weights = vertices_.weights();
    for (int q = 0; q <= k_; ++q) {
      const int size = lists.size(q);
      if (size < 2) continue;
      const std::uint16_t* part = lists.part(q);
      const std::uint32_t whole = (std::uint32_t{1} << size) - 1;
      const bool bits_fit = d_ <= coxeter::kMaxBitsDim;
      // Sums over all subsets of the part, each from a smaller one.
      form_sums_[0] = vertices_.form(simplex.vertices[q]);
      bit_sums_[0] = 0;
      for (std::uint32_t split = 1; split <= whole; ++split) {
        const std::uint32_t rest = split & (split - 1);
        const std::uint16_t element = part[std::countr_zero(split)];
        form_sums_[split] = form_sums_[rest] + weights[element];
        if (bits_fit) bit_sums_[split] = bit_sums_[rest] | std::uint32_t{1} << element;
      }
      std::uint32_t flag = lists.numbers[q];
      for (std::uint32_t split = 1; split < whole; ++split, ++flag) {
        if (flags[flag / 64] >> (flag % 64) & 1) continue;
        vertices_.prefetch(form_sums_[split]);
        candidates.push_back({form_sums_[split], 0, split,
                              bits_fit ? coxeter::special_half(bit_sums_[split], bit_sums_[whole], d_) : 0, flag, 0,
                              static_cast<std::uint16_t>(q), static_cast<std::uint8_t>(slot),
                              q == k_ && (split >> (size - 1) & 1)});
      }
    }
  }

  const KnownInt<kDim> d_;
  const KnownInt<kCodim> k_;
  coxeter::VertexTable& vertices_;
  std::vector<coxeter::ShortPartition<kDim, kCodim>> partitions_;
  SubsetForms subset_forms_;
  std::vector<std::uint16_t> elements_, starts_;
  std::vector<std::uint32_t> numbers_;
  std::vector<std::uint64_t> form_sums_;  // over the subsets of one part
  std::vector<std::uint32_t> bit_sums_;
  std::vector<std::int32_t> z_;
};

}  // namespace whitney
