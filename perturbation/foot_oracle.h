// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace whitney::perturbation {

/// How far what an oracle returned may be from a point of M and its tangent space.
struct FootErrors {
  double point = 0;  ///< e_p: there is a point p of M within this distance of the one returned (a length)
  double angle = 0;  ///< e_t: the largest angle between T_p M and the space returned is at most this (radians)
};

/// What the perturbation and its certificate ask of a compact C^{1,1} submanifold M of R^d without boundary: points of
/// M near a given point, with their tangent spaces, and two numbers that bound how M bends. It is called concurrently.
class FootOracle {
 public:
  virtual ~FootOracle() = default;
  virtual int ambient_dim() const = 0;
  virtual int intrinsic_dim() const = 0;
  /// A lower bound R of the reach of M (a length, > 0).
  virtual double reach() const = 0;
  /// 1 / curvature_radius bounds the norm of the second fundamental form of M. At least reach().
  virtual double curvature_radius() const = 0;
  /// point (d): the point of M closest to x (d). frame: d x d, row-major, its rows orthonormal up to rounding: n that
  /// span the tangent space there, then k = d - n that span the normal space. A pure function of x. False when there
  /// is none. The certificate rests on `errors`, not on the point being the closest.
  virtual bool foot(std::span<const double> x, std::span<double> point, std::span<double> frame,
                    FootErrors& errors) const = 0;
};

}  // namespace whitney::perturbation
