// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/lattice_vertex.h>

#include <coxeter/base/hash_mix.h>

namespace whitney::coxeter {

std::uint64_t LatticeVertex::hash() const {
  std::uint64_t state = coordinates_.size();
  for (const std::int32_t c : *this) state = detail::hash_step(state, static_cast<std::uint32_t>(c));
  return detail::hash_step(state, 0);
}

}  // namespace whitney::coxeter
