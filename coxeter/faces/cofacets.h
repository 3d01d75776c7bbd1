// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <coxeter/base/error.h>
#include <coxeter/faces/simplex_writer.h>
#include <coxeter/simplex.h>

namespace whitney::coxeter::detail {

/// Halves of a part travel as bits.
inline constexpr std::size_t kMaxSplitPart = 31;

/// Whether the simplex has cofacets and none of its parts is too large for visit_cofacets().
inline bool can_visit_cofacets(const Simplex& simplex) {
  std::size_t begin = 0, largest = 0;
  for (const std::size_t end : simplex.partition().ends()) {
    largest = std::max(largest, end - begin);
    begin = end;
  }
  return largest > 1 && largest <= kMaxSplitPart;
}

/// Elements i with bit i of `half` set go to a, the others to b. No branch on the bits.
inline void split_part(const std::uint16_t* part, std::size_t size, std::uint32_t half, std::uint16_t* a,
                       std::uint16_t* b) {
  for (std::size_t i = 0; i < size; ++i, half >>= 1) {
    const std::uint32_t in_a = half & 1;
    *(in_a ? a : b) = part[i];
    a += in_a;
    b += 1 - in_a;
  }
}

/// The cofacets of a k-simplex, one after the other in one buffer: part q is split into A before B. When A holds
/// element d, B wraps to the front: the base vertex is v_0 - e(B). Apart from CofaceEnumeration because its tables cost
/// more to set up than the few cofacets there are.
template <class Visitor>
bool visit_cofacets(const Simplex& simplex, Visitor& visit) {
  const int k = simplex.dim();
  const std::uint16_t* const elements = simplex.partition().elements().data();
  const std::uint16_t* const ends = simplex.partition().ends().data();
  const std::size_t n = simplex.partition().elements().size();
  Simplex coface = SimplexWriter::resized(simplex, k + 2);
  const SimplexWriter out(coface);
  std::copy_n(ends, k + 1, out.ends + 1);
  std::size_t begin = 0;
  for (int q = 0; q <= k; ++q) {
    const std::size_t end = ends[q], size = end - begin;
    // A without element d, which is the last of the last part: then it cannot be the whole part.
    const std::uint32_t num_halves = q < k ? (std::uint32_t{1} << size) - 1 : std::uint32_t{1} << (size - 1);
    for (std::uint32_t half = 1; half < num_halves; ++half) {
      const std::size_t middle = begin + static_cast<std::size_t>(std::popcount(half));
      split_part(elements + begin, size, half, out.elements + begin, out.elements + middle);
      out.ends[q] = static_cast<std::uint16_t>(middle);
      if (!visit_continues(visit, coface)) return false;
    }
    if (q == k) break;
    std::copy(elements + begin, elements + end, out.elements + begin);
    out.ends[q] = ends[q];
    begin = end;
  }
  const std::size_t size = n - begin;
  const std::int32_t* const base = simplex.base().data();
  for (std::uint32_t half = 1; half < std::uint32_t{1} << (size - 1); ++half) {
    const auto moved = static_cast<std::size_t>(std::popcount(half));
    split_part(elements + begin, size, half, out.elements, out.elements + moved + begin);
    std::copy_n(elements, begin, out.elements + moved);
    out.ends[0] = static_cast<std::uint16_t>(moved);
    for (int q = 0; q < k; ++q) out.ends[q + 1] = static_cast<std::uint16_t>(ends[q] + moved);
    for (std::size_t i = 0; i + 1 < size; ++i) {
      const std::uint16_t c = elements[begin + i];
      const auto in_half = static_cast<std::int32_t>(half >> i & 1);
      if (in_half != 0 && base[c] == std::numeric_limits<std::int32_t>::min())
        throw LatticeOverflow("the base vertex of a coface leaves the range of int32");
      out.base[c] = base[c] - in_half;
    }
    if (!visit_continues(visit, coface)) return false;
  }
  return true;
}

}  // namespace whitney::coxeter::detail
