// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/tables/lattice_order.h>

#include <algorithm>
#include <numeric>

namespace whitney::coxeter {

std::vector<std::uint32_t> lexicographic_order(std::span<const std::int32_t> coordinates, int dim) {
  const std::size_t count = dim > 0 ? coordinates.size() / dim : 0;
  std::vector<std::uint32_t> order(count), sorted(count), begin;
  std::iota(order.begin(), order.end(), 0);
  // Least significant coordinate first; every pass is stable.
  for (int c = dim - 1; c >= 0; --c) {
    std::int32_t lowest = count ? coordinates[c] : 0, highest = lowest;
    for (std::size_t i = 0; i < count; ++i) {
      lowest = std::min(lowest, coordinates[i * dim + c]);
      highest = std::max(highest, coordinates[i * dim + c]);
    }
    const std::uint64_t range = std::uint64_t(std::int64_t{highest} - lowest);
    constexpr int kDigitBits = 16;
    for (int shift = 0; shift == 0 || range >> shift != 0; shift += kDigitBits) {
      const std::size_t mask = (std::size_t{1} << kDigitBits) - 1;
      auto digit = [&](std::uint32_t row) {
        return (std::uint64_t(std::int64_t{coordinates[std::size_t{row} * dim + c]} - lowest) >> shift) & mask;
      };
      begin.assign(std::min<std::uint64_t>(range >> shift, mask) + 2, 0);
      for (std::uint32_t row : order) ++begin[digit(row) + 1];
      for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
      for (std::uint32_t row : order) sorted[begin[digit(row)]++] = row;
      order.swap(sorted);
    }
  }
  return order;
}

}  // namespace whitney::coxeter
