// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>

#include <coxeter/faces/nibbles.h>
#include <coxeter/simplex.h>

namespace whitney::coxeter::detail {
inline namespace WHITNEY_INSTRUCTION_SET {

/// Whether the classes below take this simplex, and are worth it on this processor.
inline bool is_short(const Simplex& simplex) {
  return kFastNibbles && std::endian::native == std::endian::little && simplex.ambient_dim() >= 0 &&
         simplex.ambient_dim() < kMaxShortElements;
}

/// The ordered partition of a simplex with d <= 15 in words. Vertex q stands before part q.
struct ShortSimplex {
  explicit ShortSimplex(const Simplex& simplex)
      : num_elements(simplex.ambient_dim() + 1), dim(simplex.dim()), elements(0), lasts(0) {
    // Two loops in a row: one in the other would branch on the sizes of the parts, which are random.
    const std::uint16_t* const all = simplex.partition().elements().data();
    const std::uint16_t* const ends = simplex.partition().ends().data();
    Nibbles first[kMaxShortElements + 1];  // entry i: the set of the first i elements
    first[0] = 0;
    for (int i = 0; i < num_elements; ++i) {
      first[i + 1] = first[i] | nibble_at(all[i]);
      elements |= nibbles_up(all[i], i);
    }
    starts[0] = 0;
    before[0] = 0;
    for (int q = 0; q <= dim; ++q) {
      starts[q + 1] = ends[q];
      before[q + 1] = first[ends[q]];
      lasts |= nibble_at(ends[q] - 1);
    }
  }

  int num_elements, dim;
  Nibbles elements;                        ///< part after part
  Nibbles lasts;                           ///< the set of the places at which a part ends
  int starts[kMaxShortElements + 1] = {};  ///< the place of vertex q; entry dim + 1 is num_elements
  Nibbles before[kMaxShortElements + 1];   ///< the set of the elements before vertex q
};

}  // namespace WHITNEY_INSTRUCTION_SET
}  // namespace whitney::coxeter::detail
