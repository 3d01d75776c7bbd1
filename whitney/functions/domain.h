// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <whitney/functions/function.h>

namespace whitney {

/// An axis-parallel box in R^d.
struct Box {
  std::vector<double> lower, upper;  ///< d numbers each (lengths), lower[i] < upper[i]
};

/// The part of R^d where inequalities g_j(x) >= 0 hold. Numbers j: first those of the caller's function; then, when
/// there is a box, x_c - lower_c as m + 2c and upper_c - x_c as m + 2c + 1. The sides of the box are inequalities like
/// any other, but what they cut off is no boundary that the caller asked for: `is_box_side` tells them apart.
///
/// A Mask has bit j set where g_j < 0: num_words() words, bit j of word j / 64.
class Domain {
 public:
  /// All of R^d.
  Domain() = default;
  /// Throws InvalidInput when the function, or the box, is not one of R^d, or the box is empty or has bounds that are
  /// not numbers (they may be infinite).
  Domain(int ambient_dim, std::optional<Function> inequalities, std::optional<Box> box);

  int num_inequalities() const { return num_given_ + (box_ ? 2 * ambient_dim_ : 0); }
  /// m: how many of them are the caller's, numbers 0..m-1.
  int num_given() const { return num_given_; }
  bool empty() const { return num_inequalities() == 0; }
  bool is_box_side(int j) const { return j >= num_given_; }
  const std::optional<Function>& given() const { return given_; }
  const std::optional<Box>& box() const { return box_; }

  /// g_j at a point for a side of the box.
  double box_value(int j, const double* x) const {
    const int side = j - num_given_, c = side / 2;
    return side % 2 == 0 ? x[c] - box_->lower[c] : box_->upper[c] - x[c];
  }
  /// Sets the mask of a point: x, d coordinates; given, the m values of the caller's inequalities there.
  void set_mask(const double* x, const double* given, std::uint64_t* mask) const;
  std::size_t num_words() const { return (std::size_t(num_inequalities()) + 63) / 64; }

  /// Whether every inequality holds at the point, up to slack[j] >= 0 where given (num_inequalities() of them or none).
  /// Not where one of them is not a number.
  bool contains(std::span<const double> x, std::span<const double> slack = {}) const;
  /// All of g at a point: num_inequalities() values.
  std::vector<double> values(std::span<const double> x) const;
  /// The derivative of g_j at a point, d numbers; length_scale as for Function::jacobian.
  std::vector<double> gradient(int j, std::span<const double> x, double length_scale) const;
  /// The map (f, g_I) for some of the inequalities: its zero set holds the strata on which they vanish.
  Function with_equations(const Function& f, std::vector<int> inequalities) const;
  /// "inequality 1", from 0 as in a problem file, or "box: lower side of coordinate 2", from 1.
  std::string name(int j) const;

 private:
  int ambient_dim_ = 0, num_given_ = 0;
  std::optional<Function> given_;
  std::optional<Box> box_;
};

}  // namespace whitney
