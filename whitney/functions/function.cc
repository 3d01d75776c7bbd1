// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/function.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

class CallableModel : public Function::Model {
 public:
  CallableModel(int ambient_dim, int codim, std::function<void(std::span<const double>, std::span<double>)> f)
      : ambient_dim_(ambient_dim), codim_(codim), f_(std::move(f)) {}

  int ambient_dim() const override { return ambient_dim_; }
  int codim() const override { return codim_; }
  void evaluate(std::span<const double> points, std::span<double> values) const override {
    const std::size_t d = ambient_dim_, k = codim_;
    for (std::size_t i = 0; i < points.size() / d; ++i) f_(points.subspan(i * d, d), values.subspan(i * k, k));
  }

 private:
  int ambient_dim_, codim_;
  std::function<void(std::span<const double>, std::span<double>)> f_;
};

}  // namespace

void Function::Model::jacobian(std::span<const double> point, std::span<double> jacobian, double length_scale) const {
  const std::size_t d = ambient_dim(), k = codim();
  const double relative_step = std::cbrt(std::numeric_limits<double>::epsilon());
  // The 2 d neighbours of the point go out as one batch.
  std::vector<double> points(2 * d * d), values(2 * d * k);
  for (std::size_t i = 0; i < 2 * d; ++i) {
    std::copy(point.begin(), point.end(), points.begin() + i * d);
    const double step = relative_step * std::max(std::abs(point[i / 2]), length_scale);
    points[i * d + i / 2] += i % 2 == 0 ? step : -step;
  }
  evaluate(points, values);
  for (std::size_t j = 0; j < d; ++j) {
    // The step that was taken, after rounding, not the one that was meant.
    const double width = points[2 * j * d + j] - points[(2 * j + 1) * d + j];
    for (std::size_t i = 0; i < k; ++i) {
      jacobian[i * d + j] = (values[2 * j * k + i] - values[(2 * j + 1) * k + i]) / width;
    }
  }
}

void Function::evaluate(std::span<const double> points, std::span<double> values) const {
  const std::size_t d = ambient_dim(), k = codim();
  // One point is common, and a division is slow.
  if (points.size() == d && values.size() == k) return model_->evaluate(points, values);
  if (points.size() % d != 0) {
    throw InvalidInput("points: " + std::to_string(points.size()) +
                       " coordinates are not a multiple of d = " + std::to_string(d));
  }
  if (values.size() != points.size() / d * k) {
    throw InvalidInput("values: room for " + std::to_string(values.size()) + " numbers, but " +
                       std::to_string(points.size() / d) + " points with k = " + std::to_string(k) + " give " +
                       std::to_string(points.size() / d * k));
  }
  model_->evaluate(points, values);
}

void Function::jacobian(std::span<const double> point, std::span<double> jacobian, double length_scale) const {
  const std::size_t d = ambient_dim(), k = codim();
  if (point.size() != d) {
    throw InvalidInput("point: " + std::to_string(point.size()) + " coordinates instead of d = " + std::to_string(d));
  }
  if (jacobian.size() != k * d) {
    throw InvalidInput("jacobian: room for " + std::to_string(jacobian.size()) +
                       " numbers instead of k d = " + std::to_string(k * d));
  }
  if (!(length_scale > 0) || !std::isfinite(length_scale)) {
    throw InvalidInput("length_scale must be positive and finite, not " + std::to_string(length_scale));
  }
  model_->jacobian(point, jacobian, length_scale);
}

Function make_function(int ambient_dim, int codim, std::function<void(std::span<const double>, std::span<double>)> f) {
  if (ambient_dim < 1) throw InvalidInput("ambient_dim must be at least 1, not " + std::to_string(ambient_dim));
  if (codim < 1) throw InvalidInput("codim must be at least 1, not " + std::to_string(codim));
  if (!f) throw InvalidInput("f is an empty std::function");
  return Function(std::make_shared<CallableModel>(ambient_dim, codim, std::move(f)));
}

}  // namespace whitney
