// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <whitney/manifolds/submanifold.h>

namespace whitney {

/// An immersion phi of a manifold of parameters U into R^d whose image M is a compact submanifold without boundary.
/// U is R^n, or anything that can be moved about on: what names a parameter u are `parameter_size` >= n numbers.
/// Pure functions of their arguments, called concurrently.
class Parametrization {
 public:
  virtual ~Parametrization() = default;
  virtual int ambient_dim() const = 0;
  virtual int intrinsic_dim() const = 0;
  virtual int parameter_size() const { return intrinsic_dim(); }
  /// x (d) = phi(u).
  virtual void evaluate(std::span<const double> u, std::span<double> x) const = 0;
  /// jacobian: d x n, row-major, the derivative of phi(moved(u, t)) by t at t = 0; of rank n everywhere on U.
  virtual void derivative(std::span<const double> u, std::span<double> jacobian) const = 0;
  /// moved = u + t where U is R^n; elsewhere a chart around u (t: n), of second order smooth.
  virtual void move(std::span<const double> u, std::span<const double> t, std::span<double> moved) const;
  /// Relative error of `derivative`, in units of its norm.
  virtual double derivative_precision() const { return 1e-14; }
  /// A step in t along axis i over which phi changes by about a radian's worth, for derivatives by differences.
  virtual double scale(int axis) const = 0;
  /// m x parameter_size: parameters whose images cover M, about `spacing` (a length in R^d) apart; spacing infinite: a
  /// few dozen. All of M, but no finer than about max_samples allows.
  virtual std::vector<double> samples(double spacing, std::size_t max_samples) const = 0;
};

/// The submanifold phi(U). The foot is the global one: M is sampled once; the samples near enough to hold the foot,
/// taken together where they touch, each start a Newton iteration, and the nearest point wins (ties: the first).
///
/// Known to be the closest point as far as the sampling tells: its covering radius is measured (at most a fifth of the
/// smallest curvature radius seen, where 200 000 samples suffice), not proved.
///
/// Errors: the foot is phi(u), so on M up to the rounding of phi, assumed to be at most 64 units of the largest
/// coordinate of M; the tangent space is off by the rounding of the derivative over its smallest singular value. phi
/// must be evaluated that well. bending(): estimate_bending, made when first asked for (kEstimated).
/// Throws InvalidInput on impossible dimensions (1 <= n < d), when phi is not finite at a sample, or its derivative
/// there is not of rank n.
Submanifold parametric_manifold(std::shared_ptr<const Parametrization> phi);

/// The image of phi: R^n -> R^d, given by callables; derivative may be empty: central differences then. domain: n x
/// (lower, upper), where samples are taken: the image of the domain must be all of M. Parameters outside occur.
Submanifold parametric_manifold(
    int ambient_dim, std::vector<std::array<double, 2>> domain,
    std::function<void(std::span<const double> u, std::span<double> x)> map,
    std::function<void(std::span<const double> u, std::span<double> jacobian)> derivative = {});

/// The same from expressions in the named parameters (see expression.h), with exact derivatives.
Submanifold parametric_manifold(std::span<const std::string> parameters, std::vector<std::array<double, 2>> domain,
                                std::span<const std::string> map);

}  // namespace whitney
