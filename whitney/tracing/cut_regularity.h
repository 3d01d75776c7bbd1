// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <whitney/tracing/trace.h>

namespace whitney {

/// A point where f = 0 and g_I = 0 and the rows of D(f, g_I) are linearly dependent: there the boundary of f = 0, g >=
/// 0 crosses or touches itself, or two pieces of it are tangent, and a piecewise-linear approximation is one resolution
/// of it among several.
struct SingularCut {
  std::vector<double> point;      ///< d coordinates
  std::vector<int> inequalities;  ///< I, numbers as in Domain
  double singular_value = 0;      ///< what remained of the smallest singular value there: 0 but for rounding
};

/// How far the boundary of a trace is from being singular.
struct CutRegularity {
  /// The smallest singular value of D(f, g_I), rows scaled to length 1, over all stratum points with I not empty, so in
  /// [0, 1]; 1 when there is no boundary.
  double smallest_singular_value = 1;
  std::vector<double> point;          ///< where; empty when there is no boundary
  std::vector<int> inequalities;      ///< I there
  std::vector<SingularCut> singular;  ///< the singular points found, no two closer than an edge length
};

/// Looks for singular points of the boundary of a trace: from the stratum points with the smallest singular values, a
/// Gauss-Newton iteration on f(x) = 0, g_I(x) = 0, sum_r lambda_r grad F_r(x) = 0, |lambda| = 1, F = (f, g_I). These
/// are more equations than unknowns, so a solution is no accident. It is accepted within two edge lengths of the
/// boundary. This is a search in floating point: what it finds is singular (to about 1e-6 of an edge length); it may
/// miss some.
CutRegularity check_cuts(const Function& f, const TraceResult& trace, double edge_length);

}  // namespace whitney
