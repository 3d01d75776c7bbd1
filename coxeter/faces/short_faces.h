// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <coxeter/faces/short_output.h>
#include <coxeter/faces/short_simplex.h>

namespace whitney::coxeter::detail {
inline namespace WHITNEY_INSTRUCTION_SET {

/// FaceEnumeration for d <= 15: a block of merged parts is the list of a set, so there are no large tables to set up,
/// and nothing to undo. The first vertex of the face is vertex i of the simplex; a block goes from one vertex that is
/// kept to the next, and the last one, the tail, from the last vertex on and around to vertex i. A partition is the
/// union of the shares of its blocks.
class ShortFaces {
 public:
  /// 0 <= face_dim <= simplex.dim().
  ShortFaces(const Simplex& simplex, int face_dim)
      : simplex_(simplex),
        face_dim_(face_dim),
        top_(nibble_at(simplex_.num_elements - 1)),
        out_(simplex, face_dim + 1) {}

  template <class Visitor>
  bool run(Visitor& visitor) {
    for (first_ = 0; first_ + face_dim_ <= simplex_.dim; ++first_) {
      if (first_ > 0) out_.raise_base(simplex_.before[first_]);
      if (!run_turn(visitor)) return false;
    }
    return true;
  }

 private:
  /// The faces whose first vertex is first_.
  template <class Visitor>
  bool run_turn(Visitor& visitor) {
    const int dim = simplex_.dim, num_dropped = dim - first_ - face_dim_;
    if (face_dim_ == 0) return out_.visit_once(list_members(simplex_.before[dim + 1]), top_, visitor);
    around_ = simplex_.before[dim + 1] ^ simplex_.before[first_];
    for (int v = 0; v < kMaxShortElements; ++v) shifts_[v] = 4 * (simplex_.starts[v] - simplex_.starts[first_]);
    if (kKeepFactor * num_dropped >= face_dim_ && num_dropped > 1) {
      if (face_dim_ == 1) return visit_all(NibblePair{}, pairs_, make_edges(), visitor);
      make_pairs();
      return keep_vertices(first_ + 1, 0, first_, NibblePair{}, visitor);
    }
    const int shift = 4 * simplex_.starts[first_];
    const Nibbles elements = (simplex_.elements >> shift & below(dim)) | tail(dim);
    const Nibbles lasts = (simplex_.lasts & ~top_) >> shift | top_;
    return num_dropped == 0 ? out_.visit_once(elements, lasts, visitor)
                            : drop_vertices(first_ + 1, num_dropped, first_, elements, lasts, visitor);
  }

  static constexpr int kKeepFactor = 2;

  /// The places before vertex v, and the last of them.
  Nibbles below(int v) const { return (Nibbles{1} << shifts_[v]) - 1; }
  Nibbles last_below(int v) const { return Nibbles{15} << (shifts_[v] - 4); }
  /// The elements between two vertices, and those from the last vertex around to the first, at their places.
  Nibbles block(int v, int end) const { return list_members(simplex_.before[end] ^ simplex_.before[v]) << shifts_[v]; }
  Nibbles tail(int v) const { return list_members(around_ ^ simplex_.before[v]) << shifts_[v]; }
  /// The shares of the same when this is the part number q of the face, and the last one.
  NibblePair share(int v, int end, int q) const {
    return out_.partition(block(v, end), static_cast<Nibbles>((shifts_[end] >> 2) - 1) << (4 * q));
  }
  NibblePair tail_share(int v) const {
    return out_.partition(tail(v), static_cast<Nibbles>(simplex_.num_elements - 1) << (4 * face_dim_));
  }

  /// The partitions of all edges in pairs_, and where they end.
  const NibblePair* make_edges() {
    NibblePair* edge = pairs_;
    for (int v = first_ + 1; v <= simplex_.dim; ++v) *edge++ = share(first_, v, 0) | tail_share(v);
    return edge;
  }

  /// The shares of the last two parts, for each vertex before the former one after the other.
  void make_pairs() {
    NibblePair tails[kMaxShortElements];
    const int dim = simplex_.dim, least = first_ + face_dim_ - 1;
    for (int v = least + 1; v <= dim; ++v) tails[v] = tail_share(v);
    int num = 0;
    for (int v = least; v < dim; ++v) {
      pair_begins_[v] = num;
      for (int end = v + 1; end <= dim; ++end) pairs_[num++] = share(v, end, face_dim_ - 1) | tails[end];
    }
    pair_begins_[dim] = num;
  }

  /// Keeps all vertices but `kept`, from v on. `begin`: the last one kept.
  template <class Visitor>
  bool keep_vertices(int v, int kept, int begin, NibblePair shares, Visitor& visitor) {
    const int todo = face_dim_ - kept, last = simplex_.dim + 1 - todo;
    for (; v <= last; ++v) {
      const NibblePair more = shares | share(begin, v, kept);
      const bool go_on = todo == 2 ? visit_all(more, pairs_ + pair_begins_[v], pairs_ + pair_begins_[v + 1], visitor)
                                   : keep_vertices(v + 1, kept + 1, v, more, visitor);
      if (!go_on) return false;
    }
    return true;
  }

  template <class Visitor>
  [[gnu::noinline]] bool visit_all(NibblePair shares, const NibblePair* pair, const NibblePair* end, Visitor& visitor) {
    for (; pair != end; ++pair)
      if (!out_.visit(shares | *pair, visitor)) return false;
    return true;
  }

  /// Drops `todo` of the vertices from v on. `begin`: the last one before v that is kept.
  template <class Visitor>
  bool drop_vertices(int v, int todo, int begin, Nibbles elements, Nibbles lasts, Visitor& visitor) {
    const int dim = simplex_.dim;
    for (; v + todo <= dim + 1; begin = v++) {
      const Nibbles merged = v < dim ? (elements & (below(begin) | ~below(v + 1))) | block(begin, v + 1)
                                     : (elements & below(begin)) | tail(begin);
      const Nibbles fewer_lasts = lasts & ~last_below(v);
      const bool go_on = todo == 1 ? out_.visit(merged, fewer_lasts, visitor)
                                   : drop_vertices(v + 1, todo - 1, begin, merged, fewer_lasts, visitor);
      if (!go_on) return false;
    }
    return true;
  }

  ShortSimplex simplex_;
  int face_dim_;
  Nibbles top_;  // the last place of all, at which the tail ends
  int first_ = 0;
  Nibbles around_;  // the set of all elements, less those before the first vertex
  int shifts_[kMaxShortElements];
  int pair_begins_[kMaxShortElements + 1];
  NibblePair pairs_[kMaxShortElements * (kMaxShortElements - 1) / 2];
  ShortOutput out_;
};

}  // namespace WHITNEY_INSTRUCTION_SET
}  // namespace whitney::coxeter::detail
