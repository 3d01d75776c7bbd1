// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include <coxeter/faces/facets.h>
#include <coxeter/faces/nibbles.h>
#include <coxeter/faces/short_faces.h>
#include <coxeter/faces/simplex_writer.h>
#include <coxeter/simplex.h>

namespace whitney::coxeter {
namespace detail {

/// Enumerates the k-faces of an l-simplex. Notation:
///   turn     the first vertex of the face is vertex i of the simplex, and the *turned* simplex is the face spanned by
///            the vertices i .. l: parts i .. l-1, and a last one that also holds the parts 0 .. i-1;
///   L        l - i, the dimension of the turned simplex;
///   cut j    the boundary between its parts j-1 and j, 1 <= j <= L: dropping it drops vertex j and merges the parts.
/// So within a turn a face is a choice of k cuts to keep, and the arrays of the face are those of the turned simplex
/// with some neighbouring parts merged in place. Only what changes from one face to the next is rewritten.
class FaceEnumeration {
 public:
  /// Throws InvalidInput unless 0 <= face_dim <= simplex.dim().
  FaceEnumeration(const Simplex& simplex, int face_dim);
  FaceEnumeration(const FaceEnumeration&) = delete;

  template <class Visitor, class = InstructionSet>
  bool run(Visitor& visit) {
    for (;;) {
      const int num_dropped = num_cuts_ - face_dim_;
      if (num_dropped == 0) {
        std::copy_n(ends_, num_cuts_, out_.ends);
        return visit_continues(visit, face_);
      }
      bool go_on = true;
      if (face_dim_ == 0) {  // a vertex: one part
        std::iota(out_.elements, out_.elements + num_elements_, std::uint16_t{0});
        go_on = visit_continues(visit, face_);
      } else if (face_dim_ == 1 && width_ != 0 && kFastNibbles) {
        go_on = visit_edges(visit);
      } else if (drops_cuts(num_dropped)) {
        go_on = drop_cuts(1, num_dropped, 0, 0, visit);
      } else if (width_ == 0) {
        build_tails();
        go_on = keep_cuts(1, face_dim_, 0, visit);
      } else {
        go_on = width_ == kNarrow ? (build_rows<kNarrow>(), keep_cuts_by_rows<kNarrow>(1, face_dim_, 0, visit))
                                  : (build_rows<kWide>(), keep_cuts_by_rows<kWide>(1, face_dim_, 0, visit));
      }
      if (!go_on) return false;
      turn();
    }
  }

 private:
  static constexpr std::size_t kNarrow = 16, kWide = 32;  // elements per row, see rows_

  /// Which of the recursions below to take; they visit the same faces. Dropping has (L+1) / (k+1) nodes per face,
  /// keeping has (L+1) / (L-k+1), and a node of the latter costs about half, with narrow rows a quarter.
  bool drops_cuts(int num_dropped) const {
    return num_dropped == 1 || (width_ == kNarrow ? 4 : 2) * num_dropped < face_dim_;
  }

  /// The edges of a turn, d <= 31: each of the two parts is the list of a set, which costs less than the tables below
  /// when every block is used once.
  template <class Visitor, class = InstructionSet>
  bool visit_edges(Visitor& visit) {
    const int n = static_cast<int>(num_elements_);
    const Nibbles all[2] = {nibbles_below(std::min(n, 16)), nibbles_below(std::max(n - 16, 0))};
    Nibbles set[2] = {0, 0};  // of the elements below 16, and of the others less 16
    auto list = [](Nibbles low, Nibbles high, std::uint16_t* to) {
      widen_nibbles(list_members(low), 0, to);
      widen_nibbles(list_members(high), 16, to + std::popcount(low) / 4);
    };
    for (int cut = 1; cut <= num_cuts_; ++cut) {
      const std::uint16_t end = ends_[cut - 1];
      for (std::size_t i = part_begin(cut - 1); i < end; ++i) set[elements_[i] / 16] |= nibble_at(elements_[i] % 16);
      // What each list writes too much is overwritten by what follows.
      list(set[0], set[1], out_.elements);
      list(all[0] ^ set[0], all[1] ^ set[1], out_.elements + end);
      out_.ends[0] = end;
      out_.ends[1] = static_cast<std::uint16_t>(n);
      if (!visit_continues(visit, face_)) return false;
    }
    return true;
  }

  /// Drops `todo` of the cuts from `first` on; `dropped` were dropped before it. `start`: where the block begins that
  /// cut `first` ends.
  template <class Visitor>
  bool drop_cuts(int first, int todo, int dropped, std::size_t start, Visitor& visit) {
    const int last = num_cuts_ - todo + 1;
    // End of the block before cut j is at ends_[j - 1]; `dropped` cuts before it are missing in the face.
    std::uint16_t* out_end = out_.ends + (first - 1 - dropped);
    if (todo == 1) std::copy_n(ends_ + first, num_cuts_ - first, out_end);
    for (int cut = first; cut <= last; ++cut) {
      const std::size_t middle = ends_[cut - 1], end = ends_[cut];
      if (cut > first) *out_end++ = static_cast<std::uint16_t>(start);  // cut - 1 is kept again
      absorb(start, middle, end);
      const bool go_on =
          todo == 1 ? visit_continues(visit, face_) : drop_cuts(cut + 1, todo - 1, dropped + 1, start, visit);
      if (!go_on) return false;
      release(start, middle, end, cut == first && start != part_begin(cut - 1));
      start = middle;
    }
    return true;
  }

  /// Where part q of the turned simplex begins.
  std::size_t part_begin(int q) const { return q == 0 ? 0 : ends_[q - 1]; }

  /// Keeps `todo` of the cuts from `first` on; `kept` were kept before it, the last of them `first` - 1.
  template <class Visitor>
  bool keep_cuts(int first, int todo, int kept, Visitor& visit) {
    const int last = num_cuts_ - todo + 1;
    const std::size_t start = part_begin(first - 1);
    // The block before the cut grows part by part; deeper levels write what follows.
    std::size_t filled = start;
    for (int cut = first; cut <= last; ++cut) {
      const std::size_t end = ends_[cut - 1];
      for (; filled < end; ++filled) insert(out_.elements + start, filled - start, elements_[filled]);
      out_.ends[kept] = static_cast<std::uint16_t>(end);
      if (todo == 1) {
        std::copy_n(tails_.data() + tail_begin_[static_cast<std::size_t>(cut)], num_elements_ - end,
                    out_.elements + end);
        if (!visit_continues(visit, face_)) return false;
      } else if (!keep_cuts(cut + 1, todo - 1, kept + 1, visit)) {
        return false;
      }
    }
    return true;
  }

  /// The same in at most kWidth elements: every block is copied from a table, at its full width, since a copy of fixed
  /// size is a few instructions. What it writes too much is overwritten by the copies that follow.
  template <std::size_t kWidth, class Visitor>
  bool keep_cuts_by_rows(int first, int todo, int kept, Visitor& visit) {
    const int last = num_cuts_ - todo + 1;
    std::uint16_t* const block = out_.elements + part_begin(first - 1);
    for (int cut = first; cut <= last; ++cut) {
      const std::uint16_t end = ends_[cut - 1];
      std::copy_n(row(first - 1, cut), kWidth, block);
      if (todo > 1) {
        kept_ends_[kept] = end;
        if (!keep_cuts_by_rows<kWidth>(cut + 1, todo - 1, kept + 1, visit)) return false;
      } else {
        std::copy_n(row(cut, num_cuts_ + 1), kWidth, out_.elements + end);
        std::copy_n(kept_ends_, kWidth, out_.ends);
        out_.ends[kept] = end;
        out_.ends[kept + 1] = static_cast<std::uint16_t>(num_elements_);
        if (!visit_continues(visit, face_)) return false;
      }
    }
    return true;
  }

  /// Where the union of the parts first .. end - 1 of the turned simplex is kept, sorted.
  std::uint16_t* row(int first, int end) {
    return rows_.data() + static_cast<std::size_t>((first + turn_) * row_stride_ + end + turn_) * width_;
  }

  /// Merges [start, middle) of the face with the part of the turned simplex that stands at [middle, end).
  void absorb(std::size_t start, std::size_t middle, std::size_t end) {
    for (; middle < end; ++middle) insert(out_.elements + start, middle - start, elements_[middle]);
  }

  /// Undoes absorb. `merged`: whether [start, middle) held several parts of the turned simplex.
  void release(std::size_t start, std::size_t middle, std::size_t end, bool merged) {
    std::uint16_t* const e = out_.elements;
    if (!merged) {
      for (std::size_t i = start; i < end; ++i) e[i] = elements_[i];
      return;
    }
    std::size_t to = start, next = middle;
    for (std::size_t from = start; from < end; ++from) {
      // No branch on the values: they are random. The read behind the last element finds the ends.
      const std::uint16_t element = e[from];
      const bool leaves = (next < end) & (element == elements_[next]);
      e[to] = element;
      to += !leaves;
      next += leaves;
    }
    std::copy(elements_ + middle, elements_ + end, e + middle);
  }

  /// Inserts an element into the sorted range a[0 .. size).
  static void insert(std::uint16_t* a, std::size_t size, std::uint16_t element) {
    // Neither way branches on the values.
    if (size <= 8) {
      for (std::size_t i = 0; i < size; ++i) {
        const std::uint16_t other = a[i];
        a[i] = std::min(other, element);
        element = std::max(other, element);
      }
      a[size] = element;
      return;
    }
    std::uint16_t smaller = 0;
    for (std::size_t i = 0; i < size; ++i) smaller = static_cast<std::uint16_t>(smaller + (a[i] < element));
    std::copy_backward(a + smaller, a + size, a + size + 1);
    a[smaller] = element;
  }

  void build_tails();
  template <std::size_t kWidth>
  void build_rows();
  void turn();

  int face_dim_;
  int num_cuts_;                           // L
  std::size_t num_elements_;               // d + 1
  const std::uint16_t* elements_;          // of the turned simplex, d + 1
  const std::uint16_t* ends_;              // of the turned simplex, L + 1
  InlineArray<std::uint16_t, 36> turned_;  // their storage after the first turn
  std::size_t width_;                      // of the rows in rows_; 0 when they are not used
  IndexArray scratch_;
  // What follows cut j, sorted, stands in tails_ from tail_begin_[j] on; only while cuts are kept.
  InlineArray<std::uint16_t, 80> tails_;
  InlineArray<std::uint32_t, 20> tail_begin_;
  Simplex face_;  // the only one there is; its elements are those of the turned simplex between two visits of a turn
  SimplexWriter out_;

  // The table of keep_cuts_by_rows.
  int row_stride_;
  std::uint16_t* empty_row_ = nullptr;
  int turn_ = 0;
  InlineArray<std::uint16_t, 1> rows_;
  std::uint16_t kept_ends_[kWide] = {};
};

}  // namespace detail

inline namespace WHITNEY_INSTRUCTION_SET {

/// Calls visit(const Simplex& face) for every face_dim-dimensional face of the simplex, each once, in a fixed order;
/// the simplex itself when face_dim is its dimension. The visitor returns void, or (as bool) whether to go on; the
/// result is false when it stopped. The face lives in one buffer that the next call overwrites: copy what is to stay.
/// Allocates at most a fixed number of times per call, nothing per face; the work per face is proportional to the parts
/// that change. Throws InvalidInput unless 0 <= face_dim <= simplex.dim().
template <class Visitor>
bool for_each_face(const Simplex& simplex, int face_dim, Visitor&& visit) {
  if (detail::is_short(simplex) && face_dim >= 0 && face_dim <= simplex.dim())
    return detail::ShortFaces(simplex, face_dim).run(visit);
  if (face_dim >= 0 && face_dim == simplex.dim() - 1) return detail::visit_facets(simplex, visit);
  return detail::FaceEnumeration(simplex, face_dim).run(visit);
}

/// for_each_face one dimension down. Facet i in the order of visits leaves out vertex 1, 2, .., m and last 0.
template <class Visitor>
bool for_each_facet(const Simplex& simplex, Visitor&& visit) {
  return for_each_face(simplex, simplex.dim() - 1, visit);
}

}  // namespace WHITNEY_INSTRUCTION_SET
}  // namespace whitney::coxeter
