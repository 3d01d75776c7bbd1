// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <perturbation/perturbed_triangulation.h>

namespace whitney::perturbation {

// Where a point known up to an error lies in T~: which simplices of a verdict hold the foot of a seed, for one.

/// Barycentric coordinates of all points in a ball, in a d-simplex.
struct BarycentricBounds {
  std::vector<double> coordinates;  ///< d + 1, of the centre, in floating point
  double slack = 0;                 ///< proved: no point of the ball has a coordinate that differs by more from these

  /// Every point of the ball lies in the interior of the simplex.
  bool inside() const;
};

/// Of the ball of radius `error` about `point` (d), in the simplex with these vertices (d + 1 pointers to d numbers).
/// An infinite slack when nothing can be proved: the simplex is flat, or numbers are out of range.
BarycentricBounds barycentric_bounds(const double* const* vertices, int ambient_dim, const double* point, double error);

/// Whether interval arithmetic proves that every point within `error` of `point` (d) lies in the interior of the
/// d-simplex with these vertices.
bool proved_inside(const double* const* vertices, int ambient_dim, const double* point, double error);

/// d-simplices of T~ whose union is proved to hold every point within `error` (a length, >= 0) of `point` (d); provided
/// that T~ is embedded, see CertificateReport::embedded. One when the ball is inside a simplex; those around a face
/// when the ball touches it. Empty when nothing can be proved with `max_simplices`.
///
/// Why: S holds, with every simplex, its neighbours across the facets that the ball is not proved to stay clear of. So
/// the ball, which is connected, does not meet the boundary of the union of S; and it is proved to hold a point of one
/// simplex of S.
std::vector<std::uint32_t> proved_cover(PerturbedTriangulation& near, std::span<const double> point, double error,
                                        std::size_t max_simplices = 200);

/// For every one of m points (m x d), known up to errors (m lengths): whether it is proved to lie in the union of the
/// given d-simplices. For the simplices of a trace that is certified and the feet of the seeds: whether the component
/// of M that the foot lies on is one of those the verdict speaks of.
std::vector<bool> proved_in_union(PerturbedTriangulation& near, std::span<const std::uint32_t> simplices,
                                  std::span<const double> points, std::span<const double> errors);

}  // namespace whitney::perturbation
