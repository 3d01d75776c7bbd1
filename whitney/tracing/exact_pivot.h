// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

namespace whitney {

/// Exact decisions of the tracer, for when rounding errors could change them (see barycentric_kernel.h).
///
/// The target is not 0 but (eps, eps^2, .., eps^k) for an infinitely small eps > 0: B lambda = (1, eps, .., eps^k), so
/// "lambda_r > 0" means that row r of M = B^-1 is lexicographically positive. Every decision below is that of one
/// generic map, so decisions about different simplices never contradict each other, and no vertex is moved. Values are
/// taken as the exact rationals that doubles are; the arithmetic is in integers, fraction-free.
///
/// columns: f(v_0), .., f(v_k), pointers to k finite doubles each.

/// Whether the k-simplex meets the zero set. A simplex whose values are affinely dependent does not.
bool exactly_hit(std::span<const double* const> columns);

/// For a k-simplex that is hit and one more vertex w of a cofacet: the index of the vertex to be replaced by w so that
/// the other hit k-face comes out.
int exactly_leaving(std::span<const double* const> columns, const double* w);

/// For a simplex that is hit and one more component, g(v_0), .., g(v_k): whether its interpolant is below its own
/// target at the point. `position` of the components come before it in the order of the eps (its target is
/// eps^(position+1), and those of the components from `position` on move up by one).
bool exactly_below(std::span<const double* const> columns, std::span<const double> component, int position);

/// The barycentric coordinates at which the interpolant vanishes (eps = 0), correctly rounded up to one unit or so;
/// k + 1 of them, >= 0 for a simplex that is hit.
std::vector<double> exact_weights(std::span<const double* const> columns);

}  // namespace whitney
