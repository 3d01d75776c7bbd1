// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <whitney/manifolds/submanifold.h>

namespace whitney::closed_form {

// Submanifolds whose foot, tangent space, reach and curvature are formulas. The bending of each is exact, not only a
// bound (Bending::Source::kProven; the derivation stands with each).
//
// All reaches here come from Federer (Curvature measures, 1959, Theorem 4.18):
//   reach(M) = inf over p != q in M of |q - p|^2 / (2 dist(q - p, T_p M)),
// whose limit q -> p along v is 1 / |II(v,v)|; so the reach is never more than the curvature radius.
//
// Errors of a foot are the rounding of its formula times a generous constant and the conditioning: the distance of x
// over its distance from the medial axis. x on the medial axis (up to 1e-12 of its size), or not finite: no foot.
// No heap allocation in project.

/// The sphere |(x_1 .. x_(n+1))| = radius, other coordinates 0, in R^d. 1 <= n < d, radius > 0; n = 1 is the circle.
/// Reach and curvature radius: radius (|q - p|^2 / 2 = radius (radius - p.q / radius) is radius times the distance).
/// Throws InvalidInput outside these ranges, as all functions here.
Submanifold sphere(int intrinsic_dim, int ambient_dim, double radius = 1);

/// The torus with tube radius r around the circle of radius R in the plane z = 0 of R^3, 0 < r < R.
/// Its medial axis is the circle and the z-axis, at distances r and R - r: reach min(r, R - r). The principal
/// curvatures are 1/r and cos v / (R + r cos v), of which the largest are 1/r and 1/(R - r): the same radius.
Submanifold torus_of_revolution(double R = 2, double r = 1);

/// |(x_1,x_2)| = r1, |(x_3,x_4)| = r2, other coordinates 0, in R^d, d >= 4. Reach and curvature radius of a product are
/// the smaller ones of its factors: min(r1, r2).
Submanifold flat_torus(int ambient_dim = 4, double r1 = 1, double r2 = 1);

}  // namespace whitney::closed_form
