// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <coxeter/base/growing_array.h>
#include <coxeter/base/hash_mix.h>
#include <coxeter/base/hash_slots.h>

namespace whitney::coxeter {

/// Simplices of one triangulation, each stored once and known by its index (order of first appearance).
///
/// A key is the canonical permutahedral representation: the index of the base vertex in a VertexTable and, for each
/// coordinate 0..d-1, the number of the part it is in (element d is always in the last part). 4 + d bytes for up to 256
/// parts (Index = uint8_t), 4 + 2d beyond (uint16_t). Beside the key a record holds `flag_words` 64-bit words of flags.
/// kDim: the ambient dimension where it is known at compile time, else 0.
template <class Index, int kDim = 0>
class SimplexTable {
 public:
  SimplexTable(int ambient_dim, std::size_t flag_words)
      : words_for_key_(words_for(ambient_dim)), stride_(words_for_key_ + flag_words) {}

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
  std::uint64_t* flags(std::uint32_t index) { return &records_[index * stride_] + key_words(); }
  bool flag(std::uint32_t index, std::size_t bit) { return flags(index)[bit / 64] >> (bit % 64) & 1; }
  void set_flag(std::uint32_t index, std::size_t bit) { flags(index)[bit / 64] |= std::uint64_t{1} << (bit % 64); }

  /// A key to be looked up: key_words() words, laid out as in the table, unused bytes zero.
  std::size_t key_words() const { return kDim > 0 ? words_for(kDim) : words_for_key_; }
  static void set_base(std::uint64_t* key, std::uint32_t base) { std::memcpy(key, &base, sizeof base); }
  static Index* parts_of(std::uint64_t* key) {
    return reinterpret_cast<Index*>(reinterpret_cast<unsigned char*>(key) + 4);
  }

  /// A hash of the whole key.
  std::uint64_t hash_of(const std::uint64_t* key) const {
    std::uint64_t hash = 0;
    for (std::size_t i = 0; i < key_words(); ++i) hash = detail::hash_step(hash, key[i]);
    return hash;
  }

  std::uint32_t find(const std::uint64_t* key, std::uint64_t hash) const {
    return slots_.find(hash, [&](std::uint32_t index) {
      const std::uint64_t* record = &records_[index * stride_];
      std::uint64_t difference = 0;
      for (std::size_t i = 0; i < key_words(); ++i) difference |= record[i] ^ key[i];
      return difference == 0;
    });
  }

  /// The index of the simplex, entered with all flags clear if it is new (then it is size() - 1 afterwards).
  /// hash must be a function of the key.
  std::uint32_t intern(const std::uint64_t* key, std::uint64_t hash) {
    const std::uint32_t found = find(key, hash);
    if (found != HashSlots::kNone) return found;
    const auto index = static_cast<std::uint32_t>(size());
    std::uint64_t* record = records_.extend(stride_ + kSlackWords);
    records_.truncate(records_.size() - kSlackWords);
    std::memcpy(record, key, key_words() * sizeof *key);
    for (std::size_t i = key_words(); i < stride_; ++i) record[i] = 0;
    slots_.insert(hash, index);
    return index;
  }

  void prefetch(std::uint64_t hash) const { slots_.prefetch(hash); }

  /// The index `find` will most likely return, or kNone: looks at tags alone. Its record is on its way to the cache.
  std::uint32_t guess(std::uint64_t hash) const {
    const std::uint32_t index = slots_.guess(hash);
    if (index != HashSlots::kNone) __builtin_prefetch(&records_[index * stride_]);
    return index;
  }

  /// Frees the index: find and intern may not be called any more.
  void release_index() { slots_.release(); }

 private:
  static constexpr std::size_t kSlackWords = 3;

  static constexpr std::size_t words_for(int dim) { return (4 + dim * sizeof(Index) + 7) / 8; }

  std::size_t words_for_key_, stride_;
  GrowingArray<std::uint64_t> records_;
  HashSlots slots_;
};

}  // namespace whitney::coxeter
