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

}  // namespace whitney
