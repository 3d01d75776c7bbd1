// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <coxeter/growing_array.h>
#include <coxeter/hash_slots.h>

namespace whitney::coxeter {

/// Simplices of one triangulation, each stored once and known by its index (order of first appearance).
///
/// A key is the canonical permutahedral representation: the index of the base vertex in a VertexTable and, for each
/// coordinate 0..d-1, the number of the part it is in (element d is always in the last part). 4 + d bytes for up to 256
/// parts (Index = uint8_t), 4 + 2d beyond (uint16_t). Beside the key a record holds `flag_words` 64-bit words of flags.
template <class Index>
class SimplexTable {
 public:
  SimplexTable(int ambient_dim, std::size_t flag_words)
      : dim_(ambient_dim), key_words_((4 + ambient_dim * sizeof(Index) + 7) / 8), stride_(key_words_ + flag_words) {}

  std::size_t size() const { return records_.size() / stride_; }

  std::uint32_t base(std::uint32_t index) const {
    std::uint32_t base;
    std::memcpy(&base, &records_[index * stride_], sizeof base);
    return base;
  }
  /// Part numbers of coordinates 0..d-1, and at least 16 more bytes that may be read. Invalidated by insertions.
  const Index* parts(std::uint32_t index) const {
    return reinterpret_cast<const Index*>(reinterpret_cast<const unsigned char*>(&records_[index * stride_]) + 4);
  }
  std::uint64_t* flags(std::uint32_t index) { return &records_[index * stride_] + key_words_; }
  bool flag(std::uint32_t index, std::size_t bit) { return flags(index)[bit / 64] >> (bit % 64) & 1; }
  void set_flag(std::uint32_t index, std::size_t bit) { flags(index)[bit / 64] |= std::uint64_t{1} << (bit % 64); }

  /// A key to be looked up: key_words() words, laid out as in the table, unused bytes zero.
  std::size_t key_words() const { return key_words_; }
  static void set_base(std::uint64_t* key, std::uint32_t base) { std::memcpy(key, &base, sizeof base); }
  static Index* parts_of(std::uint64_t* key) {
    return reinterpret_cast<Index*>(reinterpret_cast<unsigned char*>(key) + 4);
  }

  std::uint32_t find(const std::uint64_t* key, std::uint64_t hash) const {
    return slots_.find(hash, [&](std::uint32_t index) {
      const std::uint64_t* record = &records_[index * stride_];
      for (std::size_t i = 0; i < key_words_; ++i)
        if (record[i] != key[i]) return false;
      return true;
    });
  }

  /// The index of the simplex, entered with all flags clear if it is new (then it is size() - 1 afterwards).
  /// hash must be a function of the key.
  std::uint32_t intern(const std::uint64_t* key, std::uint64_t hash) {
    const std::uint32_t found = find(key, hash);
    if (found != HashSlots::kNone) return found;
    const auto index = static_cast<std::uint32_t>(size());
    std::uint64_t* record = records_.extend(stride_ + kSlackWords);
    records_.resize(records_.size() - kSlackWords, 0);
    std::memcpy(record, key, key_words_ * sizeof *key);
    for (std::size_t i = key_words_; i < stride_; ++i) record[i] = 0;
    slots_.insert(hash, index);
    return index;
  }

  void prefetch(std::uint64_t hash) const { slots_.prefetch(hash); }

  /// Frees the index: find and intern may not be called any more.
  void release_index() { slots_.release(); }

 private:
  static constexpr std::size_t kSlackWords = 3;

  int dim_;
  std::size_t key_words_, stride_;
  GrowingArray<std::uint64_t> records_;
  HashSlots slots_;
};

}  // namespace whitney::coxeter
