// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <coxeter/simplex.h>
#include <coxeter/simplex_writer.h>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace whitney::coxeter {
namespace detail {

/// Enumerates the l-cofaces of a k-simplex: every part is cut into an ordered sequence of pieces, l + 1 pieces in all.
/// The pieces of the last part that come after the one with element d wrap to the front, and the base vertex moves with
/// them. Outer loop: how many pieces each part gets. Inner loop: an odometer with one digit per part that is cut, whose
/// states are its ordered partitions; the last part is the slowest digit, since it moves all the others.
class CofaceEnumeration {
 public:
  /// Throws InvalidInput unless simplex.dim() <= coface_dim <= simplex.ambient_dim().
  CofaceEnumeration(const Simplex& simplex, int coface_dim);
  CofaceEnumeration(const CofaceEnumeration&) = delete;

  template <class Visitor>
  bool run(Visitor& visit) {
    do {
      start_composition();
      for (;;) {
        if (!visit_continues(visit, coface_)) return false;
        std::size_t i = 0;
        while (i < active_.size() && !advance(digits_[active_[i]])) ++i;
        if (i == active_.size()) break;
      }
    } while (next_composition());
    return true;
  }

 private:
  struct Digit {
    int part;                // of the simplex
    std::size_t begin;       // of its elements in the simplex
    std::size_t size;        // number of elements, at least 2
    std::size_t pieces;      // at most size
    std::size_t position;    // of its elements in the coface (not for the last part)
    std::size_t index;       // of its first piece in the coface (not for the last part)
    std::uint16_t* labels;   // size: the piece of each element
    std::uint16_t* lengths;  // pieces: the number of elements in each piece
  };

  bool is_last(const Digit& digit) const { return digit.part == num_parts_ - 1; }

  /// The next state of a digit, or its first again; in the latter case the result is false.
  bool advance(Digit& digit) {
    if (digit.size == 2 && !is_last(digit)) {
      std::swap(digit.labels[0], digit.labels[1]);
      std::swap(coface_out_.elements[digit.position], coface_out_.elements[digit.position + 1]);
      return digit.labels[0] == 1;
    }
    return advance_large(digit);
  }

  bool advance_large(Digit& digit);
  void start_composition();
  bool next_composition();
  void distribute(std::size_t first_digit, std::size_t extra);
  void place_middle(std::size_t wrapped_elements, std::size_t wrapped_pieces);
  void write(const Digit& digit);
  void write_last(const Digit& digit);
  void unwrap();

  const Simplex& simplex_;
  int num_parts_;
  std::size_t num_pieces_;  // l + 1
  std::size_t wrapped_elements_ = 0;
  std::size_t wrapped_pieces_ = 0;
  InlineArray<Digit, 8> digits_;            // the parts with at least two elements, in order
  InlineArray<std::uint16_t, 8> active_;    // the digits with at least two pieces
  InlineArray<std::uint16_t, 40> storage_;  // labels and lengths
  Simplex coface_;
  SimplexWriter coface_out_;
};

}  // namespace detail

/// Calls visit(const Simplex& coface) for every coface_dim-dimensional coface of the simplex, each once, in a fixed
/// order; the simplex itself when coface_dim is its dimension. The visitor returns void, or (as bool) whether to go on;
/// the result is false when it stopped. The coface lives in one buffer that the next call overwrites: copy what is to
/// stay. Allocates at most a fixed number of times per call of this function, and never for d <= 16; the work per
/// coface is proportional to the parts that change, and O(d) when the last part is cut anew. Throws InvalidInput unless
/// simplex.dim() <= coface_dim <= simplex.ambient_dim(), LatticeOverflow when a base vertex leaves the range of int32.
template <class Visitor>
bool for_each_coface(const Simplex& simplex, int coface_dim, Visitor&& visit) {
  return detail::CofaceEnumeration(simplex, coface_dim).run(visit);
}

/// for_each_coface one dimension up.
template <class Visitor>
bool for_each_cofacet(const Simplex& simplex, Visitor&& visit) {
  return for_each_coface(simplex, simplex.dim() + 1, visit);
}

}  // namespace whitney::coxeter
