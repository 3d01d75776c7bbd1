// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include <coxeter/base/growing_array.h>

namespace whitney::coxeter {

/// Mixes all bits of x into all bits of the result (the finaliser of splitmix64, a bijection).
inline std::uint64_t mix64(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Open addressing with linear probing and a load of at most 1/2: maps the hash of a key to the index of its record in
/// an append-only store. Keys stay in that store; a slot holds 32 bits of the hash and the index. The position of a
/// slot comes from those same 32 bits, so growing never touches the keys.
class HashSlots {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  HashSlots() { slots_.resize(std::size_t{1} << bits_, Slot{0, kNone}); }

  /// The index whose key is equal, by `equal(index)`, among those with this hash; or kNone.
  template <class Equal>
  std::uint32_t find(std::uint64_t hash, Equal&& equal) const {
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = tag >> (32 - bits_);; i = (i + 1) & mask) {
      const Slot& slot = slots_[i];
      if (slot.index == kNone) return kNone;
      if (slot.tag == tag && equal(slot.index)) return slot.index;
    }
  }

  /// The first index with this hash, its key not compared; or kNone.
  std::uint32_t guess(std::uint64_t hash) const {
    return find(hash, [](std::uint32_t) { return true; });
  }

  /// Enters an index whose key is known to be absent.
  void insert(std::uint64_t hash, std::uint32_t index) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    place({static_cast<std::uint32_t>(hash >> 32), index});
    ++count_;
  }

  void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[(hash >> 32) >> (32 - bits_)]); }

  void release() { slots_.release(); }

 private:
  struct Slot {
    std::uint32_t tag, index;
  };

  void place(Slot slot) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = slot.tag >> (32 - bits_);
    while (slots_[i].index != kNone) i = (i + 1) & mask;
    slots_[i] = slot;
  }

  void grow() {
    GrowingArray<Slot> old;
    old.swap(slots_);
    ++bits_;
    slots_.reserve(std::size_t{1} << bits_);
    slots_.resize(std::size_t{1} << bits_, Slot{0, kNone});
    for (const Slot& slot : old)
      if (slot.index != kNone) place(slot);
  }

  int bits_ = 10;
  std::size_t count_ = 0;
  GrowingArray<Slot> slots_;
};

}  // namespace whitney::coxeter
