// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/crossing_point.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <whitney/tracing/exact_pivot.h>

namespace whitney {

CrossingPoint::CrossingPoint(int codim) : codim_(codim), columns_(codim + 1), kernel_(codim), weights_(codim + 1) {}

void CrossingPoint::load(std::span<const double* const> columns) {
  columns_.assign(columns.begin(), columns.end());
  if (codim_ == 1) return;
  for (int q = 0; q <= codim_; ++q) kernel_.set_vertex(0, q, columns_[q]);
  kernel_.factor();
}

std::optional<bool> CrossingPoint::quick_hit() const {
  if (codim_ == 1) return (*columns_[0] > 0) != (*columns_[1] > 0);
  if (!kernel_.reliable(0)) return std::nullopt;
  double lowest = std::numeric_limits<double>::infinity();
  for (int q = 0; q <= codim_; ++q) lowest = std::min(lowest, kernel_.weight(0, q));
  if (!(std::abs(lowest) > 2 * kernel_.weight_error(0))) return std::nullopt;
  return lowest > 0;
}

bool CrossingPoint::hit() {
  if (const std::optional<bool> quick = quick_hit()) return *quick;
  ++exact_decisions_;
  return exactly_hit(columns_);
}

int CrossingPoint::leaving(const double* w) {
  if (codim_ == 1) return SignKernel::leaving(*columns_[0], *w);
  kernel_.set_candidate(0, w);
  kernel_.pivot();
  if (kernel_.leaving(0) != BarycentricKernel::kUndecided) return kernel_.leaving(0);
  ++exact_decisions_;
  return exactly_leaving(columns_, w);
}

bool CrossingPoint::below(std::span<const double> component, int position) {
  constexpr double kUnit = std::numeric_limits<double>::epsilon();
  double sum = 0, sizes = 0, error = 4 * kUnit;
  if (codim_ == 1) {
    const double second = SignKernel::second_weight(*columns_[0], *columns_[1]);
    sum = (1 - second) * component[0] + second * component[1];
    sizes = std::abs(component[0]) + std::abs(component[1]);
    // Halves of numbers this small are rounded.
    if (std::abs(*columns_[0]) + std::abs(*columns_[1]) < 1e-290) error = std::numeric_limits<double>::infinity();
  } else {
    for (int q = 0; q <= codim_; ++q) {
      sum += kernel_.weight(0, q) * component[q];
      sizes += std::abs(component[q]);
    }
    // The weights lie in [0, 1], so each product is off by weight_error, and the sum by its roundings.
    error = 2 * kernel_.weight_error(0) + (codim_ + 3) * kUnit;
    if (!kernel_.reliable(0)) error = std::numeric_limits<double>::infinity();
  }
  if (std::abs(sum) > 2 * error * sizes) return sum < 0;  // false for anything that is not a number
  ++exact_decisions_;
  return exactly_below(columns_, component, position);
}

const std::vector<double>& CrossingPoint::weights() {
  if (codim_ == 1) {
    weights_[1] = SignKernel::second_weight(*columns_[0], *columns_[1]);
    weights_[0] = 1 - weights_[1];
  } else if (kernel_.reliable(0)) {
    for (int q = 0; q <= codim_; ++q) weights_[q] = std::max(kernel_.weight(0, q), 0.0);
  } else {
    weights_ = exact_weights(columns_);
  }
  return weights_;
}

}  // namespace whitney
