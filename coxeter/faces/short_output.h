// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include <coxeter/base/error.h>
#include <coxeter/faces/nibbles.h>
#include <coxeter/faces/simplex_writer.h>
#include <coxeter/simplex.h>

namespace whitney::coxeter::detail {
inline namespace WHITNEY_INSTRUCTION_SET {

/// A simplex with d <= 15 that is rewritten as a whole, from words, for a visitor.
class ShortOutput {
 public:
  /// Starts with the base vertex of `original`, which has to stay.
  ShortOutput(const Simplex& original, int num_parts)
      : simplex_(SimplexWriter::resized(original, num_parts)),
        original_(original),
        elements_(SimplexWriter(simplex_).elements),
        ends_shift_(2 * (original.ambient_dim() + 1)),
        ends_rest_(32 - ends_shift_) {
    for (int i = 0; i < 2 * kMaxShortElements; ++i) increments_[i] = i > original.ambient_dim();
  }
  ShortOutput(const ShortOutput&) = delete;

  /// Makes the base vertex that of `original` plus 1 in the coordinates of a set, which may not hold d.
  void raise_base(Nibbles set) {
    const std::uint32_t bits = bits_of_set(set);
    write_base(bits, 1);
  }
  /// The same with minus 1. Throws LatticeOverflow when a coordinate becomes too small.
  void lower_base(Nibbles set) {
    const std::uint32_t bits = bits_of_set(set);
    for (std::uint32_t rest = bits; rest != 0; rest &= rest - 1)
      if (original_.base()[std::countr_zero(rest)] == std::numeric_limits<std::int32_t>::min())
        throw LatticeOverflow("the base vertex of a coface leaves the range of int32");
    write_base(bits, -1);
  }

  /// A partition as NibblePair: the elements, part after part, then the ends of the parts less 1. This is the share of
  /// some elements at their places and of ends that are the first ones.
  NibblePair partition(Nibbles elements, Nibbles ends) const {
    return NibblePair{elements | ends << ends_shift_ << ends_shift_, ends >> ends_rest_ >> ends_rest_};
  }

  /// Writes the partition and visits.
  template <class Visitor>
  bool visit(NibblePair partition, Visitor& visitor) {
    widen_nibbles(partition, increments_, elements_);
    if (SimplexWriter::owns_memory(simplex_)) __builtin_unreachable();  // so that copies need not ask
    return visit_continues(visitor, static_cast<const Simplex&>(simplex_));
  }
  /// The same; `lasts` is the set of the places at which a part ends.
  template <class Visitor>
  bool visit(Nibbles elements, Nibbles lasts, Visitor& visitor) {
    return visit(partition(elements, list_members(lasts)), visitor);
  }
  /// The same, where it is rare: so that the visitor is compiled into few places.
  template <class Visitor>
  [[gnu::noinline]] bool visit_once(Nibbles elements, Nibbles lasts, Visitor& visitor) {
    return visit(elements, lasts, visitor);
  }

 private:
  using Coordinates = std::int32_t __attribute__((vector_size(64)));

  void write_base(std::uint32_t bits, int step) {
    const Coordinates bit{1,      1 << 1, 1 << 2,  1 << 3,  1 << 4,  1 << 5,  1 << 6,  1 << 7,
                          1 << 8, 1 << 9, 1 << 10, 1 << 11, 1 << 12, 1 << 13, 1 << 14, 1 << 15};
    Coordinates base;
    std::memcpy(&base, original_.base().data(), sizeof base);
    base += ((bit & static_cast<std::int32_t>(bits)) != 0) & step;  // a true comparison is -1
    std::memcpy(SimplexWriter(simplex_).base, &base, sizeof base);
  }

  Simplex simplex_;
  const Simplex& original_;
  std::uint16_t* elements_;
  int ends_shift_, ends_rest_;                                   // halves of the shifts, which may be by 64
  alignas(64) std::uint16_t increments_[2 * kMaxShortElements];  // the last place of a part plus 1 is its end
};

}  // namespace WHITNEY_INSTRUCTION_SET
}  // namespace whitney::coxeter::detail
