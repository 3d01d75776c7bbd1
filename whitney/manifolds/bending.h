// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <whitney/manifolds/submanifold.h>

namespace whitney {

struct EstimateBendingOptions {
  std::size_t min_points = 800;   ///< the walk is repeated with shorter steps until it meets this many points
  std::size_t max_points = 4000;  ///< and stops at this many
  std::size_t num_descents = 16;  ///< how many of the worst places are followed downhill
};

struct BendingEstimate {
  Bending bending;  ///< kEstimated
  /// Two points of M where Federer's quotient |q - p|^2 / (2 dist(q - p, T_p M)) is the smallest that was found; d
  /// each. Close together when the reach is a curvature radius.
  std::vector<double> p, q;
  /// A point where M curves most, d, and the unit tangent along which it does.
  std::vector<double> most_curved, direction;
  std::size_t num_points = 0;  ///< points walked to
};

/// Estimates reach and curvature radius of any submanifold: walks over M from its seed points in steps of equal length,
/// takes Federer's quotient for all pairs of points met, and the curvature by differences of feet; then descends from
/// the worst places. The reach is the infimum of the quotient (Federer 1959, Theorem 4.18), so the estimate can only be
/// too large, but for about 1e-6 relative by differences: nothing is proved. Deterministic.
///
/// Throws InvalidInput when no seed point has a foot.
BendingEstimate estimate_bending(const Submanifold& manifold, const EstimateBendingOptions& options = {});

}  // namespace whitney
