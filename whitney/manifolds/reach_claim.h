// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include <whitney/manifolds/submanifold.h>

namespace whitney {

/// Feet on a submanifold of dimension n in R^d, as Submanifold::project returns them.
struct FeetView {
  int ambient_dim = 0, intrinsic_dim = 0;
  std::span<const double> points;      ///< m x d
  std::span<const double> frames;      ///< m x d x d
  std::span<const FootErrors> errors;  ///< m, or empty: exact up to rounding
};

/// What pairs of feet say of a claimed reach. No contradiction proves nothing; a contradiction is a proof, as far as
/// the errors of the feet are honest.
struct ReachVerdict {
  enum class Law {
    kNone,      ///< no pair contradicts the claim
    kDistance,  ///< dist(q, T_p) > |q - p|^2 / (2 reach): Federer 1959, Theorem 4.18
    kAngle  ///< sin(angle(T_p, T_q) / 2) > |q - p| / (2 reach): Boissonnat, Lieutier, Wintraecken 2019, for |q - p| < 2
            ///< reach
  };
  Law law = Law::kNone;
  bool consistent() const { return law == Law::kNone; }
  /// The largest reach that the pairs looked at leave possible, with all errors in its favour; infinite when they say
  /// nothing.
  double largest_possible = 0;
  std::size_t p = 0, q = 0;   ///< the two feet that bound it (indices; law kNone: those that come closest)
  std::size_t num_pairs = 0;  ///< looked at
};

/// Checks a claimed reach. All ordered pairs (p, q), or, when they are more than max_pairs, all q for p in a fixed
/// stride, so that both small and large distances are among them. Angles are compared for the pairs nearer than
/// `reach`. Deterministic; O(d k) per pair.
/// Throws InvalidInput when sizes do not fit, reach is not positive and finite, or a point is not finite.
ReachVerdict check_reach(const FeetView& feet, double reach, std::size_t max_pairs = 4'000'000);

}  // namespace whitney
