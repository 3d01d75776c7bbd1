// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <whitney/tracing/trace.h>

namespace whitney {

/// A point where f = 0 and g_I = 0 and the rows of D(f, g_I) are linearly dependent. With I empty, f = 0 is no
/// submanifold there: it crosses or touches itself, or has a tip. Otherwise the boundary of f = 0, g >= 0 does so, or
/// two pieces of it are tangent. A piecewise-linear approximation is one resolution of it among several.
struct SingularCut {
  std::vector<double> point;      ///< d coordinates
  std::vector<int> inequalities;  ///< I, numbers as in Domain
  double singular_value = 0;      ///< what remained of the smallest singular value there: 0 but for rounding
};

/// How far a trace, or its boundary, is from being singular.
struct CutRegularity {
  /// The smallest singular value found, dimensionless, in [0, 1]; 1 when nothing was looked at. check_cuts: of
  /// D(f, g_I), rows scaled to length 1, over all stratum points with I not empty. check_interior: of Df, rows scaled
  /// by their largest length within an edge length, over the points from which it searched.
  double smallest_singular_value = 1;
  std::vector<double> point;          ///< where; empty when nothing was looked at
  std::vector<int> inequalities;      ///< I there
  std::vector<SingularCut> singular;  ///< the singular points found, no two closer than an edge length
  bool searched = true;               ///< false: no search was made, because the equations are too many (d + k > 64)
};

/// Looks for singular points of the boundary of a trace: from the stratum points with the smallest singular values, a
/// Gauss-Newton iteration on f(x) = 0, g_I(x) = 0, sum_r lambda_r grad F_r(x) = 0, |lambda| = 1, F = (f, g_I). These
/// are more equations than unknowns, so a solution is no accident. It is accepted within two edge lengths of the
/// boundary. This is a search in floating point: what it finds is singular (to about 1e-6 of an edge length); it may
/// miss some.
CutRegularity check_cuts(const Function& f, const TraceResult& trace, double edge_length);

/// The same for the interior of the trace, I empty, by the same iteration: a search, it may miss some. Singular sets
/// of positive dimension are listed by 16 points at most.
///
/// Df is not asked for at every point traced. In a simplex the differences of f along its edges are a k x k matrix,
/// whose determinant is about |det| of Df on the simplex; its largest value among the simplices of a small block of the
/// lattice is small where Df is. The search starts in the blocks where that is least, and in those where it is least
/// against the blocks around: one start for 2000 simplices, 40 at least, 200 at most. Multiplying components of f by
/// powers of two changes nothing. A point found counts when it is within 3 edge lengths of a point of the trace (the
/// tip of a cusp may be cut off) and in the domain.
CutRegularity check_interior(const Function& f, const TraceResult& trace, double edge_length);

}  // namespace whitney
