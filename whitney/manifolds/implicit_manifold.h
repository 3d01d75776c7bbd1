// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <whitney/functions/function.h>
#include <whitney/manifolds/submanifold.h>

namespace whitney {

struct ImplicitManifoldOptions {
  /// About the size of the features of f (a length): steps of differences, where f or its second derivatives need them.
  /// Steps for second derivatives that are far too long for f are shortened.
  double length_scale = 1;
  int max_iterations = 50;  ///< of each of the two Newton iterations
  /// Rounding errors of f, in units of the rounding of abs(Df) abs(x), assumed and not checked.
  double roundings = 64;
};

/// The submanifold f = 0 for f: R^d -> R^k, k < d, 0 a regular value.
///
/// Foot: Newton's method takes x to f = 0, then Newton's method for the Lagrangian of |y - x|^2 / 2 goes on along M
/// until x - y is normal. This is a *local* foot, the one that descent from there leads to: for x closer to M than its
/// reach it is the closest point, further away it need not be. No foot where the Jacobian is rank deficient, the
/// iteration does not arrive, or the point reached is no strict local minimum.
///
/// Errors: residual of f and roundings over the least singular value of Df (the bound of a Newton step, doubled; not a
/// verified one), and for the tangent space its change over that distance as well as the rounding of Df.
///
/// Units: equations are scaled by powers of two at every point, so that f and diag(2^a, 2^b, ..) f give the same bytes,
/// as long as nothing of f or Df overflows or becomes subnormal.
///
/// bending(): empty; a zero set says nothing of its reach. Use with_bending, or estimate_bending (which is an
/// estimate). seed_points: m x d, points on M or near it. Throws InvalidInput when k >= d or sizes do not fit, or a
/// number is not finite.
Submanifold implicit_manifold(Function f, std::vector<double> seed_points, const ImplicitManifoldOptions& options = {});

}  // namespace whitney
