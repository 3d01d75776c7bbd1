// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <coxeter/faces/cofacets.h>
#include <coxeter/faces/short_cofaces.h>
#include <coxeter/faces/simplex_writer.h>
#include <coxeter/simplex.h>

namespace whitney::coxeter {
namespace detail {

/// Enumerates the l-cofaces of a k-simplex: every part is cut into an ordered sequence of pieces, l + 1 pieces in all.
/// The pieces of the last part that come after the one with element d wrap to the front, and the base vertex moves with
/// them. Three loops, from the outside:
///   composition  how many pieces each part gets;
///   wrap         which elements of the last part wrap, and into how many pieces: this moves all other elements;
///   odometer     one digit for each part, for the elements that wrap and for those that stay, if they are cut; its
///                states are the ordered partitions of those elements. A step rewrites only the digits that change.
class CofaceEnumeration {
 public:
  /// Throws InvalidInput unless simplex.dim() <= coface_dim <= simplex.ambient_dim().
  CofaceEnumeration(const Simplex& simplex, int coface_dim);
  CofaceEnumeration(const CofaceEnumeration&) = delete;

  template <class Visitor>
  bool run(Visitor& visit) {
    do {
      start_composition();
      do {
        for (;;) {
          if (!visit_continues(visit, coface_)) return false;
          std::size_t i = 0;
          while (i < digits_.size() && !advance(digits_[i])) ++i;
          if (i == digits_.size()) break;
        }
      } while (next_wrap());
    } while (next_composition());
    return true;
  }

 private:
  struct Part {
    std::size_t index, begin, size;  // in the simplex
    std::size_t pieces;
  };
  struct Digit {
    const std::uint16_t* from;  // the elements, increasing
    std::size_t size;
    std::size_t free;        // the elements that move: all, or all but d, which stays in the last piece
    std::size_t pieces;      // from 2 to size
    std::uint16_t* out;      // the elements in the coface, piece after piece
    std::uint16_t* ends;     // the ends of its pieces in the coface
    std::uint16_t* labels;   // the piece of each element; not used when every piece has one
    std::uint16_t* lengths;  // the number of elements of each piece
  };

  /// The next state of a digit, or its first again; in the latter case the result is false.
  static bool advance(Digit& digit) {
    if (digit.pieces < digit.size) return advance_uneven(digit);
    if (digit.free == 2) {
      std::swap(digit.out[0], digit.out[1]);
      return digit.out[0] > digit.out[1];
    }
    return std::next_permutation(digit.out, digit.out + digit.free);
  }

  static bool advance_uneven(Digit& digit);
  void start_composition();
  bool next_composition();
  void distribute(std::size_t first_part, std::size_t extra);
  bool next_wrap();
  void apply_wrap(bool others_move);
  void place_others();
  void place_last();
  void unwrap();
  void add_digit(const std::uint16_t* from, std::size_t size, bool pinned, std::size_t pieces, std::uint16_t* out,
                 std::uint16_t* ends, std::uint16_t* storage);

  const Simplex& simplex_;
  std::size_t num_pieces_;            // l + 1
  InlineArray<Part, 8> parts_;        // those with at least two elements, in order, and always the last part
  InlineArray<Digit, 8> digits_;      // what is cut: parts but the last, then what wraps, then what stays
  std::size_t num_other_digits_ = 0;  // those of parts but the last
  std::size_t wrapped_ = 0;           // number of elements that wrap
  std::size_t wrapped_pieces_ = 0;
  InlineArray<std::uint16_t, 60> storage_;  // 2 size values per part for labels and lengths, then what follows
  std::uint16_t* mask_;                     // of the last part without d: 1 for the elements that wrap
  std::uint16_t* last_;                     // of the last part: the elements that wrap, then those that stay
  Simplex coface_;
  SimplexWriter out_;
};

}  // namespace detail

inline namespace WHITNEY_INSTRUCTION_SET {

/// Calls visit(const Simplex& coface) for every coface_dim-dimensional coface of the simplex, each once, in a fixed
/// order; the simplex itself when coface_dim is its dimension. The visitor returns void, or (as bool) whether to go on;
/// the result is false when it stopped. The coface lives in one buffer that the next call overwrites: copy what is to
/// stay. Allocates at most a fixed number of times per call, nothing per coface; the work per coface is proportional to
/// the parts that change, and O(d) when other elements of the last part come before v_0. Throws InvalidInput unless
/// simplex.dim() <= coface_dim <= simplex.ambient_dim(), LatticeOverflow when a base vertex leaves the range of int32.
template <class Visitor>
bool for_each_coface(const Simplex& simplex, int coface_dim, Visitor&& visit) {
  if (detail::is_short(simplex) && coface_dim >= simplex.dim() && coface_dim <= simplex.ambient_dim())
    return detail::ShortCofaces(simplex, coface_dim).run(visit);
  if (coface_dim == simplex.dim() + 1 && detail::can_visit_cofacets(simplex))
    return detail::visit_cofacets(simplex, visit);
  return detail::CofaceEnumeration(simplex, coface_dim).run(visit);
}

/// for_each_coface one dimension up.
template <class Visitor>
bool for_each_cofacet(const Simplex& simplex, Visitor&& visit) {
  return for_each_coface(simplex, simplex.dim() + 1, visit);
}

}  // namespace WHITNEY_INSTRUCTION_SET
}  // namespace whitney::coxeter
