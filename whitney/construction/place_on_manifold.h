// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include <coxeter/triangulation.h>
#include <perturbation/displacement.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/manifolds/submanifold.h>

namespace whitney {

struct PlacedComplex {
  CellComplex complex;     ///< the same cells, other points
  std::size_t placed = 0;  ///< 0-cells that are now on M, up to the errors of the oracle
  std::size_t kept = 0;    ///< 0-cells that stayed where they were: no convergence inside their simplex
  /// No point of the complex is further from M (a length): the largest of the bounds of its n-cells as the foot of the
  /// mean of their 0-cells sees them, or, where that gives none, the foot of one of the 0-cells (see distance_bound.h).
  /// It rests on the reach. Empty when some cell has no bound.
  std::optional<double> distance_bound;
  bool complete = true;  ///< not stopped; otherwise the further 0-cells stayed where they were, and there is no bound
};

/// Moves every 0-cell inside its k-simplex sigma of T~ to the point M ∩ sigma (there is one when it is certified), by
/// Newton's method: the next x is where sigma meets the tangent plane at the foot of x. A point moves only if its
/// barycentric coordinates in sigma stay positive, so K is embedded and homeomorphic to M as before.
///
/// Why: the 0-cells that a trace leaves lie on tangent planes at different feet, and where two of them are much closer
/// to each other than to M, the simplices between them are steep: for the unit sphere at L = 0.1 up to 72 degrees, with
/// folds under the closest-point projection. On M, the angle of an edge of length e is at most about e / (2 R).
///
/// A few calls of the oracle per 0-cell, one per n-cell. keep_going is asked every few dozen cells; false stops it.
/// Throws InvalidInput when dimensions differ or reach <= 0.
PlacedComplex place_on_manifold(CellComplex complex, const coxeter::Triangulation& triangulation,
                                const perturbation::DisplacementMap& displacements, const Submanifold& manifold,
                                const Bending& bending, const std::function<bool()>& keep_going = {});

}  // namespace whitney
