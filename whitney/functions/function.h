// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <utility>

namespace whitney {

/// A map f: R^d -> R^k: equations, whose zero set is an isomanifold of dimension n = d - k, or k inequalities f >= 0
/// (then k may exceed d).
///
/// A value: cheap to copy, immutable, safe to call from several threads. Evaluation is by batches, because a tracer
/// asks for many points at a time and an interpreter or a SIMD kernel wants them so. The value at a point does not
/// depend on the batch it came in (the tracer's determinism rests on that).
class Function {
 public:
  /// The interface behind a Function. Derive from it to supply a batch kernel or exact derivatives.
  class Model {
   public:
    virtual ~Model() = default;
    virtual int ambient_dim() const = 0;
    virtual int codim() const = 0;
    /// points: m x d, one point after the other; values: m x k, likewise.
    virtual void evaluate(std::span<const double> points, std::span<double> values) const = 0;
    /// jacobian: k x d, row-major. The default takes central differences with steps eps^(1/3) max(|x_i|, length_scale).
    virtual void jacobian(std::span<const double> point, std::span<double> jacobian, double length_scale) const;
  };

  explicit Function(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

  int ambient_dim() const { return model_->ambient_dim(); }
  int codim() const { return model_->codim(); }

  /// values = f(points); points m x d, values m x k, one after the other.
  /// Throws InvalidInput when the sizes do not fit. Values that are not finite are passed on: whoever asked knows what
  /// to say about them.
  void evaluate(std::span<const double> points, std::span<double> values) const;

  /// The Jacobian matrix Df(point), k x d, row-major. length_scale (a length, > 0) is used only where derivatives are
  /// taken by differences: about the size of the features of f near the point.
  void jacobian(std::span<const double> point, std::span<double> jacobian, double length_scale = 1) const;

 private:
  std::shared_ptr<const Model> model_;
};

/// The Function of any callable `f(std::span<const double> x, std::span<double> values)`, d >= 1, k >= 1, which is
/// called concurrently and must be a pure function of x. Derivatives are taken by differences. Throws InvalidInput on
/// impossible dimensions.
Function make_function(int ambient_dim, int codim, std::function<void(std::span<const double>, std::span<double>)> f);

}  // namespace whitney
