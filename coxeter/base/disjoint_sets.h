// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace whitney {

/// A partition of the numbers 0 .. size - 1 into classes, which are united one pair at a time (union-find). The
/// representative of a class is its least element, so the result does not depend on the order of the calls. Paths are
/// halved on the way: nearly constant time a call, in practice.
class DisjointSets {
 public:
  DisjointSets() = default;
  /// Every number by itself.
  explicit DisjointSets(std::size_t size) { reset(size); }

  void reset(std::size_t size) {
    parent_.resize(size);
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::size_t size() const { return parent_.size(); }

  /// The least element of the class of x < size.
  std::uint32_t find(std::uint32_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }

  /// Makes one class of the classes of a and b. Whether they were two.
  bool unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return false;
    parent_[a < b ? b : a] = a < b ? a : b;
    return true;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace whitney
