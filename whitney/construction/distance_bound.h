// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include <perturbation/certificate.h>
#include <whitney/manifolds/submanifold.h>

namespace whitney {

// How far K and M are from each other, proved from feet, the reach R and the curvature radius R_c >= R of M. There is a
// bound or there is none: never an infinite one. Source: Federer 1959, Theorem 4.8; perturbation/README.md, "Distance".

/// A bound of the distance from M of every point of a convex hull (a length).
///
/// points: m x d, the hull is theirs; foot: a point p of M with its frame (d x d, tangent rows first). With q_i the
/// points, eta the errors of the foot as seen from the farthest of them, rho = max |T^T (q_i - p)| + eta and
/// nu = max |N^T (q_i - p)| + eta: if rho < R, M is near p the graph of a function over the ball of radius R in the
/// tangent plane, which leaves the plane by at most h(rho) = R_c - sqrt(R_c^2 - rho^2) over the ball of radius rho. So
/// the point of M above the tangential part of x is within nu + h(rho) of x. Empty when rho >= R: over such a distance
/// M need not be a graph, however little it is curved.
std::optional<double> distance_from_manifold(std::span<const double> points, int ambient_dim, int intrinsic_dim,
                                             const perturbation::FootView& foot, const Bending& bending);

/// A bound of the Hausdorff distance between K and the components of M that it is homeomorphic to (a length).
///
/// distance_bound: delta, no point of K is further from M. longest_edge: ell, of the d-simplices of T~ that M meets.
/// K and M must be homeomorphic simplex by simplex: a point x of K goes to a point g(x) of M in the same closed
/// d-simplex. Then every point of M is within delta of K, if (delta + ell) / 2 < R:
/// the segment from x to g(x) is no longer than ell, so each of its points z has min(delta + |z - x|, |z - g(x)|) <=
/// (delta + ell) / 2 < R as a bound of its distance from M, and the closest-point projection pi is defined and
/// continuous there. pi along the segments is a homotopy from pi: K -> M to g. g is a homeomorphism of closed
/// n-manifolds, so pi has degree one modulo 2 on every component and is onto: y in M is pi(x) for some x in K, and
/// |x - y| <= delta. Without that condition the segments may cross the medial axis, and nothing is said: empty.
std::optional<double> hausdorff_bound(double distance_bound, double longest_edge, double reach);

}  // namespace whitney
