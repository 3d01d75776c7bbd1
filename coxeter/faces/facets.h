// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <coxeter/faces/simplex_writer.h>
#include <coxeter/simplex.h>

namespace whitney::coxeter::detail {

/// Merges the sorted ranges [i, i_end) and [j, j_end) of a; a[i_end] and a[j_end] may be read. No branch on the values.
inline void merge_parts(const std::uint16_t* a, std::size_t i, std::size_t i_end, std::size_t j, std::size_t j_end,
                        std::uint16_t* to) {
  while ((i < i_end) | (j < j_end)) {
    const bool left = (j == j_end) | ((i < i_end) & (a[i] < a[j]));
    *to++ = a[left ? i : j];
    i += left;
    j += !left;
  }
}

/// The facets of an m-simplex, m >= 1, one after the other in one buffer: without vertex 1, 2, .., m, then without 0.
/// Apart from FaceEnumeration because its tables cost more to set up than the few facets there are.
template <class Visitor>
bool visit_facets(const Simplex& simplex, Visitor& visit) {
  const int m = simplex.dim();
  const std::uint16_t* const elements = simplex.partition().elements().data();
  const std::uint16_t* const ends = simplex.partition().ends().data();  // right behind the elements
  const std::size_t n = simplex.partition().elements().size();
  Simplex facet = SimplexWriter::resized(simplex, m);
  const SimplexWriter out(facet);
  std::copy_n(ends + 1, m, out.ends);
  for (int j = 1; j <= m; ++j) {
    const std::size_t begin = j == 1 ? 0 : ends[j - 2], end = ends[j];
    merge_parts(elements, begin, ends[j - 1], ends[j - 1], end, out.elements + begin);
    if (!visit_continues(visit, facet)) return false;
    std::copy(elements + begin, elements + end, out.elements + begin);
    if (j < m) out.ends[j - 1] = ends[j - 1];
  }
  // Part 0 moves to the last part, and the base vertex along it.
  const std::size_t moved = ends[0], last = ends[m - 1];
  for (std::size_t i = 0; i < moved; ++i) ++out.base[elements[i]];
  std::copy(elements + moved, elements + last, out.elements);
  merge_parts(elements, 0, moved, last, n, out.elements + (last - moved));
  for (int q = 0; q < m - 1; ++q) out.ends[q] = static_cast<std::uint16_t>(ends[q + 1] - moved);
  out.ends[m - 1] = static_cast<std::uint16_t>(n);
  return visit_continues(visit, facet);
}

}  // namespace whitney::coxeter::detail
