// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/ordered_partition.h>

#include <algorithm>
#include <limits>

#include <coxeter/base/error.h>

namespace whitney::coxeter {

constexpr std::size_t kMaxElements = std::numeric_limits<std::uint16_t>::max();

OrderedPartition OrderedPartition::from_parts(const std::vector<std::vector<int>>& parts) {
  std::size_t n = 0;
  for (const auto& part : parts) n += part.size();
  if (n > kMaxElements) throw InvalidInput("parts must have at most 65535 elements together");
  constexpr std::uint16_t kUnset = std::numeric_limits<std::uint16_t>::max();
  IndexArray part_indices(n, kUnset);
  for (std::size_t q = 0; q < parts.size(); ++q) {
    if (parts[q].empty()) throw InvalidInput("parts must not be empty");
    for (const int element : parts[q]) {
      if (element < 0 || static_cast<std::size_t>(element) >= n)
        throw InvalidInput("parts must partition {0 .. n-1}; an element is out of range");
      auto& index = part_indices[static_cast<std::size_t>(element)];
      if (index != kUnset) throw InvalidInput("parts must partition {0 .. n-1}; an element occurs twice");
      index = static_cast<std::uint16_t>(q);
    }
  }
  return from_part_indices({part_indices.data(), n});
}

OrderedPartition OrderedPartition::from_part_indices(std::span<const std::uint16_t> part_indices) {
  const std::size_t n = part_indices.size();
  if (n > kMaxElements) throw InvalidInput("part_indices must have at most 65535 entries");
  OrderedPartition result;
  if (n == 0) return result;
  const std::size_t num_parts = *std::ranges::max_element(part_indices) + std::size_t{1};
  if (num_parts > n) throw InvalidInput("part_indices must take every value up to the largest");
  result.num_elements_ = static_cast<std::uint16_t>(n);
  result.data_ = InlineArray<std::uint16_t, 36>(n + num_parts, std::uint16_t{0});
  std::uint16_t* elements = result.data_.data();
  std::uint16_t* ends = elements + n;
  for (const auto q : part_indices) ++ends[q];
  std::uint16_t total = 0;
  for (std::size_t q = 0; q < num_parts; ++q) {
    if (ends[q] == 0) throw InvalidInput("part_indices must take every value up to the largest");
    const std::uint16_t size = ends[q];
    ends[q] = total;
    total = static_cast<std::uint16_t>(total + size);
  }
  // Counting sort; it turns the begins of the parts into their ends.
  for (std::size_t i = 0; i < n; ++i) elements[ends[part_indices[i]]++] = static_cast<std::uint16_t>(i);
  return result;
}

IndexArray OrderedPartition::part_indices() const {
  IndexArray result(num_elements_);
  const auto all = elements();
  std::uint16_t q = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == ends()[q]) ++q;
    result[all[i]] = q;
  }
  return result;
}

}  // namespace whitney::coxeter
