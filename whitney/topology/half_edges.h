// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <whitney/topology/incidence.h>
#include <whitney/topology/orientation.h>

namespace whitney {

/// A side of a polygon, in the direction in which the polygon runs through it: from a corner to the next one.
struct HalfEdge {
  std::uint32_t low, high;  ///< its ends, low < high
  std::uint32_t slot;       ///< of the corner where it begins: a position in Incidence::index
  bool upward;              ///< runs from low to high
};

/// All half-edges of polygons given by their corners in cyclic order, those of one edge side by side: sorted by low,
/// high, slot. O(number of corners) but for the edges around a point, which are sorted by comparing.
/// Precondition: the corners are below num_points, those of a polygon differ.
std::vector<HalfEdge> sorted_half_edges(const Incidence& polygons, std::size_t num_points);

/// How polygons fit together: see CellOrientation; two polygons agree when they run through their common edge in
/// opposite directions. A sign of -1 asks for the reverse order of the corners.
/// Precondition: as sorted_half_edges.
CellOrientation orient_polygons(const Incidence& polygons, std::size_t num_points);

}  // namespace whitney
