// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

#include <coxeter/base/hash_slots.h>

namespace whitney::coxeter {

/// A stream of random numbers that is a function of its keys alone, so that what is drawn for a vertex depends neither
/// on the order in which vertices are asked for nor on the number of threads.
class KeyedRandom {
 public:
  /// The stream of a lattice vertex, or of anything else that is a list of integers.
  KeyedRandom(std::uint64_t seed, std::span<const std::int32_t> vertex) : state_(mix64(seed + kStep)) {
    for (const std::int32_t z : vertex) state_ = mix64(state_ ^ static_cast<std::uint32_t>(z));
  }

  std::uint64_t bits() { return mix64(state_ += kStep); }
  /// Uniform in (0, 1].
  double uniform() { return static_cast<double>((bits() >> 11) + 1) * 0x1p-53; }
  /// Uniform in 0 .. n-1.
  int below(int n) { return static_cast<int>((bits() >> 32) * static_cast<std::uint64_t>(n) >> 32); }
  double normal() { return std::sqrt(-2 * std::log(uniform())) * std::cos(2 * std::numbers::pi * uniform()); }
  /// Uniform in the ball of this radius about 0; x: any number of coordinates.
  void in_ball(double radius, std::span<double> x) {
    double length = 0;
    for (double& c : x) {
      c = normal();
      length += c * c;
    }
    if (!(length > 0)) return;
    const double scale = radius * std::pow(uniform(), 1.0 / static_cast<double>(x.size())) / std::sqrt(length);
    for (double& c : x) c *= scale;
  }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15u;
  std::uint64_t state_;
};

}  // namespace whitney::coxeter
