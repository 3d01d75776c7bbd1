// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include <coxeter/faces/short_output.h>
#include <coxeter/faces/short_simplex.h>

namespace whitney::coxeter::detail {
inline namespace WHITNEY_INSTRUCTION_SET {

/// CofaceEnumeration for d <= 15. From the outside: which elements of the last part wrap to the front, where they are a
/// part of their own; how often each part is cut; the pieces, each a subset of what is left of its part. The ways to
/// cut a part but the last do not depend on the wrap: while all of them fit into a table, they are listed once, those
/// of all parts with as many cuts in a row, so that the innermost loops are long.
class ShortCofaces {
 public:
  /// simplex.dim() <= coface_dim <= simplex.ambient_dim().
  ShortCofaces(const Simplex& simplex, int coface_dim)
      : simplex_(simplex), cuts_(coface_dim - simplex_.dim), out_(simplex, coface_dim + 1) {
    for (int q = 0; q < simplex_.dim; ++q) {
      const int size = simplex_.starts[q + 1] - simplex_.starts[q];
      if (size == 1) continue;
      parts_[num_parts_++] = {simplex_.before[q + 1] ^ simplex_.before[q], simplex_.starts[q], size, 0};
      // The largest is cut innermost.
      for (int i = num_parts_ - 1; i > 2 && parts_[i].size < parts_[i - 1].size; --i)
        std::swap(parts_[i], parts_[i - 1]);
    }
    if (cuts_ > 1) list_ways();
  }

  template <class Visitor>
  bool run(Visitor& visitor) {
    constexpr Way kUncut = {0, 0};
    if (cuts_ == 0) return visit_ways(&kUncut, &kUncut + 1, simplex_.elements, simplex_.lasts, 0, visitor);
    const int k = simplex_.dim, n = simplex_.num_elements, last_begin = simplex_.starts[k];
    const Nibbles last_part = simplex_.before[k + 1] ^ simplex_.before[k];
    const Nibbles others = simplex_.elements & nibbles_below(last_begin), top = nibble_at(n - 1);
    const std::uint32_t num_wraps = std::uint32_t{1} << (n - last_begin - 1);
    for (std::uint32_t chosen = 0; chosen < num_wraps; ++chosen) {
      const Nibbles wraps = choose_members(last_part, chosen), stays = last_part ^ wraps;
      const int shift = std::popcount(chosen), stay_begin = last_begin + shift;
      Nibbles elements = nibbles_up(others, shift) | nibbles_up(list_members(stays), stay_begin);
      Nibbles lasts = simplex_.lasts;
      int cuts = cuts_;
      if (chosen != 0) {
        out_.lower_base(wraps);
        elements |= list_members(wraps);
        lasts = nibbles_up(lasts & ~top, shift) | nibble_at(shift - 1) | top;
        --cuts;
      }
      bool go_on = true;
      if (cuts == 0) {
        go_on = visit_ways(&kUncut, &kUncut + 1, elements, lasts, 0, visitor);
      } else {
        shift_ = shift;
        // What stays comes right before the others if these are listed or the larger ones.
        const bool stays_first = has_ways_ || (num_parts_ > 2 && parts_[num_parts_ - 1].size > n - stay_begin);
        stays_ = stays_first ? 1 : num_parts_;
        end_ = num_parts_ + (stays_first ? 0 : 1);
        parts_[stays_first ? 0 : 1] = {wraps, -shift, shift, 0};
        parts_[stays_] = {stays, last_begin, n - stay_begin, 0};
        parts_[end_ - 1].room_behind = 0;
        for (int i = end_ - 1; i > 0; --i) parts_[i - 1].room_behind = parts_[i].room_behind + parts_[i].size - 1;
        go_on = cut_parts(stays_first ? 0 : 1, cuts, elements, lasts, visitor);
      }
      if (!go_on) return false;
    }
    return true;
  }

 private:
  struct Part {
    Nibbles set;
    int begin;        // its place, without shift_
    int size;         // 0 when nothing wraps
    int room_behind;  // how often the parts behind it can be cut
  };

  /// A set that stands sorted from `begin` on, cut into a piece, the members that are chosen, and the rest.
  struct Cut {
    Cut(Nibbles set, int begin, std::uint32_t chosen) : middle(begin + std::popcount(chosen)) {
      const Nibbles piece = choose_members(set, chosen);
      left = set ^ piece;
      elements = nibbles_up(list_members(piece), begin) | nibbles_up(list_members(left), middle);
    }
    int middle;        // the place at which the rest begins
    Nibbles left;      // the set of the rest
    Nibbles elements;  // of both, at their places
  };

  /// A way to cut one part, where the parts stand if nothing wraps.
  struct Way {
    Nibbles change;  // of the elements: what they are with and without it differs in these bits
    Nibbles lasts;   // at which the pieces but the last end
  };
  static constexpr int kMaxWays = 640, kMaxListedSize = 5, kMaxListedCuts = kMaxShortElements;

  void list_ways() {
    constexpr int kNumWays[kMaxListedSize + 1] = {0, 0, 2, 12, 74, 540};  // ordered partitions, but the one in one part
    int total = 0;
    for (int i = 2; i < num_parts_; ++i)
      total += parts_[i].size > kMaxListedSize ? kMaxWays + 1 : kNumWays[parts_[i].size];
    if (total == 0 || total > kMaxWays) return;
    has_ways_ = true;
    Way* way = ways_;
    for (int cuts = 1; cuts <= cuts_; ++cuts) {
      for (int i = 2; i < num_parts_; ++i) {
        const Part& part = parts_[i];
        way_begins_[cuts][i] = static_cast<std::uint16_t>(way - ways_);
        if (cuts < part.size) {
          const Nibbles places = nibbles_below(part.begin + part.size) & ~nibbles_below(part.begin);
          way = list_ways(part.set, part.begin, part.size, cuts, {simplex_.elements & places, 0}, way);
        }
      }
      way_begins_[cuts][num_parts_] = static_cast<std::uint16_t>(way - ways_);
    }
  }
  /// Lists the ways to cut a set of `size` elements that stands from `begin` on, each joined with `joined`; returns
  /// where the list ends.
  static Way* list_ways(Nibbles set, int begin, int size, int cuts, Way joined, Way* to) {
    const std::uint32_t num_pieces = (std::uint32_t{1} << size) - 1;
    for (std::uint32_t chosen = 1; chosen < num_pieces; ++chosen) {
      const Cut cut(set, begin, chosen);
      const int left = begin + size - cut.middle;
      if (left < cuts) continue;
      const Nibbles piece = cut.elements & nibbles_below(cut.middle);
      const Nibbles lasts = joined.lasts | nibble_at(cut.middle - 1);
      if (cuts == 1)
        *to++ = {joined.change ^ cut.elements, lasts};
      else
        to = list_ways(cut.left, cut.middle, left, cuts - 1, {joined.change ^ piece, lasts}, to);
    }
    return to;
  }

  /// cut_parts for parts whose ways are listed, cuts >= 1.
  template <class Visitor>
  bool cut_listed(int i, int cuts, Nibbles elements, Nibbles lasts, Visitor& visitor) {
    for (int own = 1; own < cuts; ++own) {
      for (int j = i; j < num_parts_ && parts_[j].room_behind >= cuts - own; ++j) {
        const Way* const end = ways_ + way_begins_[own][j + 1];
        for (const Way* way = ways_ + way_begins_[own][j]; way != end; ++way) {
          const Nibbles cut_elements = elements ^ nibbles_up(way->change, shift_);
          if (!cut_listed(j + 1, cuts - own, cut_elements, lasts | nibbles_up(way->lasts, shift_), visitor))
            return false;
        }
      }
    }
    return visit_ways(ways_ + way_begins_[cuts][i], ways_ + way_begins_[cuts][num_parts_], elements, lasts, shift_,
                      visitor);
  }

  /// Visits what each of the ways, moved up by `shift` places, makes of the same elements and lasts. The one call of
  /// the visitor, so that it is compiled into the loop.
  template <class Visitor>
  [[gnu::noinline]] bool visit_ways(const Way* way, const Way* end, Nibbles elements, Nibbles lasts, int shift,
                                    Visitor& visitor) {
    for (; way != end; ++way)
      if (!out_.visit(elements ^ nibbles_up(way->change, shift), lasts | nibbles_up(way->lasts, shift), visitor))
        return false;
    return true;
  }

  /// Cuts the parts from i on, `cuts` times in all.
  template <class Visitor>
  bool cut_parts(int i, int cuts, Nibbles elements, Nibbles lasts, Visitor& visitor) {
    for (; i < end_; ++i) {
      if (i == 2 && has_ways_) return cut_listed(i, cuts, elements, lasts, visitor);
      const Part& part = parts_[i];
      const int most = std::min(cuts, part.size - 1);
      for (int own = std::max(1, cuts - part.room_behind); own <= most; ++own)
        if (!cut_part(i, part.set, part.begin + shift_, part.size, own, cuts - own, elements, lasts, visitor))
          return false;
      if (part.room_behind < cuts) break;
    }
    return true;
  }

  /// Cuts what is left of part i, the set `rest` of `size` elements that stands sorted from `begin` on, `cuts` times,
  /// and the parts behind it `cuts_behind` times.
  template <class Visitor>
  bool cut_part(int i, Nibbles rest, int begin, int size, int cuts, int cuts_behind, Nibbles elements, Nibbles lasts,
                Visitor& visitor) {
    elements &= nibbles_below(begin) | ~nibbles_below(begin + size);
    // Element d, the largest, stays in the last piece.
    const bool holds_d = i == stays_;
    const std::uint32_t num_pieces = (std::uint32_t{1} << (holds_d ? size - 1 : size)) - (holds_d ? 0 : 1);
    if (cuts == 1 && cuts_behind == 0) return cut_once(rest, begin, num_pieces, elements, lasts, visitor);
    for (std::uint32_t chosen = 1; chosen < num_pieces; ++chosen) {
      const Cut cut(rest, begin, chosen);
      if (cut.middle + cuts > begin + size) continue;
      const Nibbles cut_elements = elements | cut.elements, cut_lasts = lasts | nibble_at(cut.middle - 1);
      const bool go_on = cuts == 1 ? cut_parts(i + 1, cuts_behind, cut_elements, cut_lasts, visitor)
                                   : cut_part(i, cut.left, cut.middle, begin + size - cut.middle, cuts - 1, cuts_behind,
                                              cut_elements, cut_lasts, visitor);
      if (!go_on) return false;
    }
    return true;
  }

  template <class Visitor>
  bool cut_once(Nibbles rest, int begin, std::uint32_t num_pieces, Nibbles elements, Nibbles lasts, Visitor& visitor) {
    constexpr std::uint32_t kBlock = 32;
    Way ways[kBlock];
    for (std::uint32_t chosen = 1; chosen < num_pieces;) {
      Way* way = ways;
      for (const std::uint32_t end = std::min(chosen + kBlock, num_pieces); chosen < end; ++chosen) {
        const Cut cut(rest, begin, chosen);
        *way++ = {cut.elements, nibble_at(cut.middle - 1)};
      }
      if (!visit_ways(ways, way, elements, lasts, 0, visitor)) return false;
    }
    return true;
  }

  ShortSimplex simplex_;
  int cuts_;
  // Two free, then the parts but the last with at least 2 elements, one free. What wraps and what stays of the last
  // part take two of the free ones.
  Part parts_[kMaxShortElements / 2 + 3];
  int num_parts_ = 2, end_ = 2, stays_ = 1;
  int shift_ = 0;  // number of elements that wrap
  // The ways to cut the parts but the last: entry [c][i] is where those begin that cut part i c times.
  bool has_ways_ = false;
  std::uint16_t way_begins_[kMaxListedCuts][kMaxShortElements / 2 + 4];
  Way ways_[kMaxWays];
  ShortOutput out_;
};

}  // namespace WHITNEY_INSTRUCTION_SET
}  // namespace whitney::coxeter::detail
