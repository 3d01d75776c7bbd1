// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>

#include <coxeter/base/inline_array.h>

namespace whitney::coxeter {

/// A point of Z^d, d from 0 to 65534; up to d = 16 it owns no memory. Ordered lexicographically.
class LatticeVertex {
 public:
  LatticeVertex() = default;
  /// The origin of Z^d.
  explicit LatticeVertex(int ambient_dim) : coordinates_(static_cast<std::size_t>(ambient_dim), std::int32_t{0}) {}
  /// The point with the given coordinates: LatticeVertex{1, 2} lies in Z^2.
  LatticeVertex(std::initializer_list<std::int32_t> coordinates) : coordinates_(coordinates) {}
  explicit LatticeVertex(std::span<const std::int32_t> coordinates)
      : coordinates_(coordinates.data(), coordinates.data() + coordinates.size()) {}

  int ambient_dim() const { return static_cast<int>(coordinates_.size()); }
  std::int32_t operator[](int i) const { return coordinates_.data()[i]; }
  std::int32_t& operator[](int i) { return coordinates_.data()[i]; }
  std::int32_t* data() { return coordinates_.data(); }
  const std::int32_t* data() const { return coordinates_.data(); }
  const std::int32_t* begin() const { return coordinates_.data(); }
  const std::int32_t* end() const { return coordinates_.data() + coordinates_.size(); }
  operator std::span<const std::int32_t>() const { return {coordinates_.data(), coordinates_.size()}; }

  friend bool operator==(const LatticeVertex& a, const LatticeVertex& b) { return a.coordinates_ == b.coordinates_; }
  friend std::strong_ordering operator<=>(const LatticeVertex& a, const LatticeVertex& b) {
    return std::lexicographical_compare_three_way(a.begin(), a.end(), b.begin(), b.end());
  }

  /// Depends on the coordinates only: the same in every run.
  std::uint64_t hash() const;

 private:
  friend class Simplex;

  InlineArray<std::int32_t, 16> coordinates_;
};

}  // namespace whitney::coxeter

template <>
struct std::hash<whitney::coxeter::LatticeVertex> {
  std::size_t operator()(const whitney::coxeter::LatticeVertex& v) const noexcept { return v.hash(); }
};
