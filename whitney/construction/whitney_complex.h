// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include <perturbation/hit_walk.h>
#include <whitney/cells/cell_complex.h>

namespace whitney {

/// Whitney's complex, cut out of the d-simplices of a trace.
struct WhitneyComplex {
  /// One 0-cell for every k-face that is hit, at the point where the tangent plane of the first simplex around it (in
  /// the order of the trace) meets it, a positive combination of its vertices; one j-cell for every (k+j)-simplex with
  /// a hit face. Source: BKW20, (25)-(26).
  CellComplex complex;
  /// No point of the complex is further from M (a length): the largest of the bounds of its d-simplices, each from the
  /// foot that certifies it, or, where that gives none, another of its feet (see distance_bound.h). Empty when some
  /// simplex has no bound.
  std::optional<double> distance_bound;
  /// M goes on across facets that the region of the trace did not let it cross. The complex then has the n-cells of the
  /// simplices of the trace, and no others.
  bool cut = false;
};

/// whole: the trace is all that M meets, and every simplex certified; otherwise cells that miss a face are left out.
/// keep_going is asked every few dozen simplices; when it says false, the complex is that of the simplices so far, as
/// if not whole, and has no distance bound.
WhitneyComplex whitney_complex(perturbation::PerturbedTriangulation& near, const perturbation::HitWalk& trace,
                               bool whole, const std::function<bool()>& keep_going = {});

/// About how many bytes whitney_complex takes for a trace of so many d-simplices, generously: a (k+j)-face of T~ that
/// is hit carries a cell, and T has (m-1)! S(d+1, m) faces with m vertices for d! d-simplices (S: Stirling numbers of
/// the second kind).
std::uint64_t whitney_complex_bytes(int ambient_dim, int codim, std::size_t num_simplices);

}  // namespace whitney
