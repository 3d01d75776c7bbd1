// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace whitney::coxeter::detail {

/// One step of a hash over a sequence: every bit of `value` reaches the upper half of the product, and the shift brings
/// it back down.
inline std::uint64_t hash_step(std::uint64_t state, std::uint64_t value) {
  state = (state ^ value) * 0x9e3779b97f4a7c15u;
  return state ^ (state >> 32);
}

}  // namespace whitney::coxeter::detail
