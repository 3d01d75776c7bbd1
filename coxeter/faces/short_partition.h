// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

#include <coxeter/faces/byte_register.h>

namespace whitney::coxeter {

inline constexpr int kMaxShortDim = 15;    // d
inline constexpr int kMaxShortExcess = 5;  // n

/// An ordered partition of {0..d} into k + 1 parts, element d in the last one, as one register of part numbers: for
/// d <= 15 and n = d - k <= 5. Everything about its cofacets comes from a few instructions on that register, without a
/// branch, and the flags of all cofacets fit one 64-bit word.
///
/// A cofacet arises when part q, of s elements, is split into two non-empty ordered halves A before B. Its number is
///   2^(E+1) - 2 + (A as bits over the elements of the part, in increasing order) - 1,
/// E = (elements in the parts before q) - q. Numbers of different parts do not meet: with e = s - 1 they begin at
/// 2^(E+1) - 2 and are 2^(e+1) - 2 many, so they end at or before 2^(E+e+1) - 2; and all are below 2^(n+1) - 2.
///
/// kDim, kCodim: d and k where they are known at compile time, else 0.
template <int kDim = 0, int kCodim = 0>
class ShortPartition {
 public:
  /// A split of part q.
  struct Split {
    int part;               // q
    std::uint32_t special;  // B if A holds element d, else A: the half that does not hold it, as bits
    bool new_base;  // A holds element d: the vertex added, v_0 - e(B), is the base vertex; else it is v_q + e(A)
  };

  ShortPartition() = default;
  /// parts: the part numbers of 0..d-1; 16 bytes may be read.
  ShortPartition(const std::uint8_t* parts, int dim, int codim) : dim_(dim), codim_(codim) {
    const Bytes own = load_bytes(parts) & bytes_of_mask(below_d());
    parts_ = own | (bytes_of_mask(1u << d()) & splat_byte(k())) | ~bytes_of_mask(all());
  }

  /// Of all cofacets of the partition, the numbers, as bits; afterwards split() may be called.
  std::uint64_t cofacets() {
    // Elements that are not the least of their part, n of them, sorted by part: the i-th has `level` i, and the part it
    // is in begins at level E.
    const int n = d() - k();
    std::uint32_t rest = not_first();
    std::uint8_t parts[16];
    std::memcpy(parts, &parts_, sizeof parts);
    for (int i = 0; i < n; ++i, rest &= rest - 1) level_part_[i] = parts[std::countr_zero(rest) & 15];
    for (int i = n - 1; i > 0; --i)
      for (int j = 0; j < i; ++j) {
        const int a = level_part_[j], b = level_part_[j + 1];
        level_part_[j] = a < b ? a : b;
        level_part_[j + 1] = a < b ? b : a;
      }
    std::uint64_t numbers = 0;
    int run = 0;
    for (int i = 0; i < n; ++i) {
      run = i > 0 && level_part_[i] == level_part_[i - 1] ? run + 1 : 1;
      level_begin_[i] = i + 1 - run;
      numbers |= ((std::uint64_t{1} << ((2u << run) - 2)) - 1) << ((2u << level_begin_[i]) - 2);
    }
    return numbers;
  }

  /// The split that makes the cofacet with this number.
  Split split(int number) const {
    const int level = std::bit_width(static_cast<unsigned>(number + 2)) - 2;
    const int q = level_part_[level];
    const std::uint32_t whole = part(q);
    const std::uint32_t first = spread_bits(number + 3 - (2u << level_begin_[level]), whole);
    const bool new_base = first >> d() & 1;
    return {q, new_base ? whole & ~first : first, new_base};
  }

  /// A step from sigma over its cofacet tau to the facet of tau without vertex `leaving` of sigma (0..k).
  struct Step {
    Bytes parts;   ///< of the new simplex; zeros from element d on
    int inserted;  ///< position of the added vertex among the vertices of tau in canonical order
    int removed;   ///< position of the vertex that leaves
    int number;    ///< of tau as a cofacet of the new simplex
  };
  Step step(const Split& split, int leaving) const {
    const int inserted = split.new_base ? 0 : split.part + 1;
    const int removed = leaving + (leaving >= inserted);
    // Parts of tau: those from the split one on move up, the special half takes the place that becomes free.
    const Bytes place = splat_byte(split.new_base ? 0 : split.part);
    const Bytes special = bytes_of_mask(split.special);
    Bytes tau = parts_ - reinterpret_cast<Bytes>(parts_ >= place);  // a true comparison is -1
    tau = (tau & ~special) | (place & special);
    // Without vertex r, parts r-1 and r of tau become one; without the base (r = 0), part 0 joins the last: it becomes
    // 255, and the minimum makes that k.
    const Bytes parts = min_bytes(tau + reinterpret_cast<Bytes>(tau >= splat_byte(removed)), splat_byte(k()));
    const int merged = removed == 0 ? k() : removed - 1;
    const int half = removed == 0 ? k() + 1 : removed - 1;
    const std::uint32_t whole = mask_of_bytes(parts == splat_byte(merged)) & all();
    const std::uint32_t first = mask_of_bytes(tau == splat_byte(half)) & all();
    const int before = std::popcount(mask_of_bytes(parts < splat_byte(merged)) & all()) - merged;
    return {parts & bytes_of_mask(below_d()), inserted, removed,
            static_cast<int>((2u << before) - 3 + gather_bits(first, whole))};
  }

 private:
  int d() const { return kDim > 0 ? kDim : dim_; }
  int k() const { return kCodim > 0 ? kCodim : codim_; }
  std::uint32_t below_d() const { return (1u << d()) - 1; }
  std::uint32_t all() const { return (2u << d()) - 1; }
  std::uint32_t part(int q) const { return mask_of_bytes(parts_ == splat_byte(q)); }

  std::uint32_t not_first() const {
    const Bytes from_one = parts_ + 1;  // so that the zeros shifted in match nothing
    Bytes found{};
    [&]<int... kShifts>(std::integer_sequence<int, kShifts...>) {
      ((kShifts < d() ? (found |= reinterpret_cast<Bytes>(from_one == shift_bytes<kShifts + 1>(from_one)), 0) : 0),
       ...);
    }
    (std::make_integer_sequence<int, kMaxShortDim>{});
    return mask_of_bytes(reinterpret_cast<ByteMask>(found)) & all();
  }

  int dim_, codim_;
  Bytes parts_;  // 255 beyond element d
  int level_part_[kMaxShortExcess], level_begin_[kMaxShortExcess];
};

}  // namespace whitney::coxeter
