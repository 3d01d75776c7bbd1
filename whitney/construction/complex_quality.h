// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>

#include <whitney/manifolds/submanifold.h>
#include <whitney/topology/mesh.h>

namespace whitney {

/// How well shaped the simplices of K are, and how well K follows M. Numbers in floating point, not bounds.
struct ComplexQuality {
  /// Smallest altitude / longest edge of an n-simplex (dimensionless, 0 for a degenerate one, at most sqrt(3)/2 for
  /// triangles, 1 for edges): the worst and the median.
  double thickness_min = 0, thickness_median = 0;
  double shortest_edge = 0, longest_edge = 0;  ///< lengths
  /// Largest angle between an n-simplex and the tangent space of M at the foot of its barycentre (radians, 0 .. pi/2):
  /// the worst and the median.
  double angle_max = 0, angle_median = 0;
  /// Distance of the vertices from M (lengths).
  double vertex_distance_max = 0, vertex_distance_median = 0;
  std::size_t feet = 0;          ///< barycentres and vertices that the oracle was asked about
  std::size_t feet_missing = 0;  ///< barycentres and vertices without a foot; they count for nothing above
};

/// The quality of a mesh of n-simplices in R^d near M (n its dimension). One call of the oracle per vertex and simplex;
/// where there are more than max_feet (at least 1) of either, only for every second, third, .. of them.
/// Vertices that no simplex uses are left out. An empty mesh has quality 0.
/// Throws InvalidInput when the dimensions differ.
ComplexQuality complex_quality(const SimplicialMesh& mesh, const Submanifold& manifold,
                               std::size_t max_feet = std::numeric_limits<std::size_t>::max());

/// Smallest altitude / longest edge of simplex s; 0 when it is degenerate, 1 for a point.
double thickness(const SimplicialMesh& mesh, std::size_t s);

/// The largest principal angle (radians) between simplex s and the tangent space spanned by the first n rows of frame
/// (d x d, orthonormal rows); pi/2 when the simplex is degenerate.
double tangent_angle(const SimplicialMesh& mesh, std::size_t s, const double* frame);

}  // namespace whitney
