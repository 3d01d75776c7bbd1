// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace whitney::perturbation {

/// How far what an oracle returned may be from a point of M and its tangent space.
struct FootErrors {
  double point = 0;  ///< e_p: there is a point p of M within this distance of the one returned (a length)
  double angle = 0;  ///< e_t: the largest angle between T_p M and the space returned is at most this (radians)
};

/// What an oracle vouches for, of all its feet. Each enum goes from the least to the most that can be said, so that of
/// several oracles together the least holds.
struct FootPromise {
  /// Which point of M the foot of x is.
  enum class Place {
    kUnknown,  ///< any
    kLocal,    ///< what a search for the closest point ended at: nothing excludes that another point is closer
    kGlobal    ///< proved: no point of M is closer to x, but for e_p
  };
  /// What FootErrors rest on.
  enum class Errors {
    kModelled,  ///< a model of the errors (a Newton residual, roundings in proportion): it may be wrong
    kProven     ///< an analysis of the formulas that give the foot: they hold
  };
  Place place = Place::kUnknown;
  Errors errors = Errors::kModelled;

  friend bool operator==(const FootPromise&, const FootPromise&) = default;
};

/// What holds of feet that rest on both.
FootPromise weaker(const FootPromise& a, const FootPromise& b);

/// "unknown", "local", "global".
const char* to_string(FootPromise::Place place);
/// "modelled", "proven".
const char* to_string(FootPromise::Errors errors);

/// Who says how much M bends; from the most to the least trustworthy.
enum class ReachSource {
  kProven,    ///< follows from the definition of the manifold (closed forms)
  kCaller,    ///< supplied by the user, who vouches for it
  kEstimated  ///< estimated from samples: nothing that rests on it is proved
};

/// "proven", "caller", "estimated".
const char* to_string(ReachSource source);

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
  /// Who says so, of both.
  virtual ReachSource reach_source() const { return ReachSource::kCaller; }
  /// What holds of every foot.
  virtual FootPromise promise() const { return {}; }
  /// point (d): a point of M near x (d), the closest one as far as promise() says so. frame: d x d, row-major, its rows
  /// orthonormal up to rounding: n that span the tangent space there, then k = d - n that span the normal space. A pure
  /// function of x. False when there is none. The certificate rests on `errors`, not on the point being the closest.
  virtual bool foot(std::span<const double> x, std::span<double> point, std::span<double> frame,
                    FootErrors& errors) const = 0;
};

}  // namespace whitney::perturbation
