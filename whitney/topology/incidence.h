// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace whitney {

/// Lists of indices, one list per cell, stored one after the other.
struct Incidence {
  std::vector<std::uint32_t> offset{0};  ///< list i is index[offset[i]] .. index[offset[i+1]-1]
  std::vector<std::uint32_t> index;

  std::size_t size() const { return offset.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t i) const {
    return {index.data() + offset[i], index.data() + offset[i + 1]};
  }
};

/// `size` empty lists.
Incidence empty_lists(std::size_t size);

/// The reverse: for each of the `size` indices that occur in the lists, the numbers of the lists it is in, increasing.
/// Facets of the j-cells become the j-cells around every (j-1)-cell.
/// Precondition: all indices are below size.
Incidence transposed(const Incidence& incidence, std::size_t size);

}  // namespace whitney
