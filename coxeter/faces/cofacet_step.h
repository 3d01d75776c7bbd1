// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>

namespace whitney::coxeter {

/// The parts of a simplex as lists, made once for all its cofacets.
///
/// A cofacet arises when part q is split into two non-empty ordered halves A before B. Cofacets have numbers: the
/// splits of part 0, then those of part 1, and so on; within a part with s elements, A as a set of bits over the
/// elements in increasing order, less 1 (2^s - 2 splits). So a set of flags, one per cofacet, belongs to a simplex.
struct PartLists {
  std::uint16_t* elements;  ///< d + 1: all of {0..d}, part after part, increasing inside a part
  std::uint16_t* starts;    ///< k + 2: part q is elements[starts[q]] .. elements[starts[q+1]-1]
  std::uint32_t* numbers;   ///< k + 2: the number of the first cofacet that splits part q

  int size(int q) const { return starts[q + 1] - starts[q]; }
  const std::uint16_t* part(int q) const { return elements + starts[q]; }
};

/// Splits of a part with `size` elements.
inline std::uint32_t num_splits(int size) { return (std::uint32_t{1} << size) - 2; }

/// Up to this ambient dimension sets of coordinates travel as bits.
inline constexpr int kMaxBitsDim = 31;

/// The half of a split whose coordinates do not move up by one with the rest, as bits over the coordinates 0..d-1,
/// given those of the first half A (`first`, element d as bit d) and of the whole part. When A holds element d, the
/// vertex added is w = v_0 - e(B), the new base vertex, and B becomes part 0; otherwise w = v_q + e(A), and A keeps the
/// number q.
inline std::uint32_t special_half(std::uint32_t first, std::uint32_t whole, int d) {
  const std::uint32_t top = std::uint32_t{1} << d;
  return first & top ? whole & ~first : first & ~top;
}

/// Fills the lists from part numbers of the coordinates 0..d-1 (k + 1 parts; element d is in the last one).
template <class Index>
void list_parts(const Index* parts, int d, int k, PartLists lists) {
  std::uint16_t* starts = lists.starts;
  for (int q = 0; q <= k + 1; ++q) starts[q] = 0;
  for (int c = 0; c < d; ++c) ++starts[parts[c] + 1];
  ++starts[k + 1];
  lists.numbers[0] = 0;
  for (int q = 0; q <= k; ++q) {
    lists.numbers[q + 1] = lists.numbers[q] + num_splits(starts[q + 1]);
    starts[q + 1] = static_cast<std::uint16_t>(starts[q + 1] + starts[q]);
  }
  // starts[q] serves as the place of the next element of part q, and is put back afterwards.
  for (int c = 0; c < d; ++c) lists.elements[starts[parts[c]]++] = static_cast<std::uint16_t>(c);
  for (int q = k; q > 0; --q) starts[q] = starts[q - 1];
  starts[0] = 0;
  lists.elements[d] = static_cast<std::uint16_t>(d);
}

/// One step from a k-simplex sigma over a cofacet tau = sigma + w to the k-face sigma' of tau without another vertex.
struct CofacetStep {
  int inserted;          ///< position of w among the vertices of tau in canonical order
  int removed;           ///< position of the vertex that leaves
  std::uint32_t number;  ///< the number of tau as a cofacet of sigma'
};

namespace detail {

template <class Index>
std::uint32_t step_parts(const Index* parts, int d, int k, const std::uint16_t* part, std::uint32_t special,
                         bool new_base, int q, int removed, int merged, int half, Index* out) {
  // First tau in `out`, then sigma'.
  for (int c = 0; c < d; ++c) out[c] = static_cast<Index>(parts[c] + (new_base || parts[c] >= q));
  for (std::uint32_t rest = special; rest != 0; rest &= rest - 1)
    out[part[std::countr_zero(rest)]] = static_cast<Index>(new_base ? 0 : q);
  std::uint32_t split = 0;
  int bit = 0;
  for (int c = 0; c < d; ++c) {
    const int tau = out[c];
    const int result = removed == 0 ? (tau == 0 ? k : tau - 1) : tau - (tau >= removed);
    if (result == merged) split |= std::uint32_t{tau == half} << bit++;
    out[c] = static_cast<Index>(result);
  }
  if (merged == k && half == k + 1) split |= std::uint32_t{1} << bit;
  return split;
}

}  // namespace detail

/// From sigma (part numbers `parts`, lists of them) over the cofacet that splits part q by `split` to the face without
/// vertex `leaving` of sigma (0..k): writes the part numbers of sigma' to `out`, which may not overlap `parts`.
template <class Index>
CofacetStep step_over_cofacet(const Index* parts, const PartLists& lists, int d, int k, int q, std::uint32_t split,
                              int leaving, Index* out) {
  const int size = lists.size(q);
  const bool new_base = q == k && (split >> (size - 1) & 1);
  const int inserted = new_base ? 0 : q + 1;
  const int removed = leaving < inserted ? leaving : leaving + 1;
  // Without its vertex number `removed`, parts removed-1 and removed of tau become one; without the base, part 0 joins
  // the last.
  const int merged = removed == 0 ? k : removed - 1;
  const int half = removed == 0 ? k + 1 : removed - 1;

  const std::uint32_t whole = (std::uint32_t{1} << size) - 1;
  std::uint32_t moved = new_base ? whole & ~split : split;
  if (q == k) moved &= whole >> 1;  // element d has no part number of its own: it is always in the last part
  const std::uint32_t new_split =
      detail::step_parts(parts, d, k, lists.part(q), moved, new_base, q, removed, merged, half, out);

  // Splits of the parts of sigma' before the merged one: those of tau before it.
  const int in_first = std::popcount(split), in_second = size - in_first;
  auto before = [&](int m) {  // splits of the parts 0..m-1 of tau
    if (new_base) return m == 0 ? 0u : num_splits(in_second) + lists.numbers[m - 1];
    if (m <= q) return lists.numbers[m];
    const std::uint32_t first = lists.numbers[q] + num_splits(in_first);
    return m == q + 1 ? first : first + num_splits(in_second) + lists.numbers[m - 1] - lists.numbers[q + 1];
  };
  const std::uint32_t skipped = removed == 0 ? before(k + 1) - before(1) : before(removed - 1);
  return {inserted, removed, skipped + new_split - 1};
}

}  // namespace whitney::coxeter
