// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <coxeter/base/inline_array.h>

namespace whitney::coxeter {

namespace detail {
struct SimplexWriter;
}

/// One index per element or part; up to 20 entries in place.
using IndexArray = InlineArray<std::uint16_t, 20>;

/// An ordered partition of {0 .. n-1} into parts that are not empty, n at most 65535. Every part is sorted, so equal
/// partitions have equal arrays. Up to n + number of parts = 36 it owns no memory.
class OrderedPartition {
 public:
  /// The partition of the empty set.
  OrderedPartition() = default;
  /// From the parts, in order; their elements in any order. Throws InvalidInput unless the parts are not empty and
  /// every one of 0 .. n-1 occurs exactly once.
  static OrderedPartition from_parts(const std::vector<std::vector<int>>& parts);
  /// The partition in which element i lies in part part_indices[i]. Throws InvalidInput unless the indices are exactly
  /// 0 .. m for some m.
  static OrderedPartition from_part_indices(std::span<const std::uint16_t> part_indices);

  int num_elements() const { return num_elements_; }
  int num_parts() const { return static_cast<int>(data_.size()) - num_elements_; }
  /// All elements, part after part.
  std::span<const std::uint16_t> elements() const { return {data_.data(), num_elements_}; }
  /// ends()[q] is the number of elements in the parts 0 .. q.
  std::span<const std::uint16_t> ends() const { return {data_.data() + num_elements_, data_.size() - num_elements_}; }
  /// The elements of part q, increasing.
  std::span<const std::uint16_t> part(int q) const {
    const std::size_t begin = q == 0 ? 0 : ends()[static_cast<std::size_t>(q) - 1];
    return elements().subspan(begin, ends()[static_cast<std::size_t>(q)] - begin);
  }
  /// Entry i is the number of the part that holds element i.
  IndexArray part_indices() const;

  friend bool operator==(const OrderedPartition& a, const OrderedPartition& b) {
    return a.num_elements_ == b.num_elements_ && a.data_ == b.data_;
  }

 private:
  friend class Simplex;
  friend struct detail::SimplexWriter;

  // Elements and ends in one array: one allocation, or none, per partition.
  InlineArray<std::uint16_t, 36> data_;
  std::uint16_t num_elements_ = 0;
};

}  // namespace whitney::coxeter
