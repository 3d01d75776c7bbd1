// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <perturbation/hit_walk.h>
#include <whitney/cells/cell_complex.h>

namespace whitney {

/// Whitney's complex, cut out of the d-simplices of a trace.
struct WhitneyComplex {
  /// One 0-cell for every k-face that is hit, at the point where the tangent plane of the first simplex around it (in
  /// the order of the trace) meets it, a positive combination of its vertices; one j-cell for every (k+j)-simplex with
  /// a hit face. Source: BKW20, (25)-(26).
  CellComplex complex;
  /// No point of the complex is further from M (a length): bounded simplex by simplex. With p the best foot of the
  /// simplex and q_i its 0-cells, a point x of the complex in it lies in their hull, and the point of M above the
  /// tangential part of x is within max abs(N^T (q_i - p)) + h(max abs(T^T (q_i - p))) of x, plus the errors of the
  /// foot. Infinite when a simplex has no foot with (C).
  double distance_bound = 0;
  /// M goes on across facets that the region of the trace did not let it cross. The complex then has the n-cells of the
  /// simplices of the trace, and no others.
  bool cut = false;
};

/// whole: the trace is all that M meets, and every simplex certified; otherwise cells that miss a face are left out.
WhitneyComplex whitney_complex(perturbation::PerturbedTriangulation& near, const perturbation::HitWalk& trace,
                               bool whole);

}  // namespace whitney
