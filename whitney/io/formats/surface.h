// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <whitney/io/formats/mesh_view.h>
#include <whitney/topology/incidence.h>

namespace whitney::io {

/// The corners of the cells, a list per cell.
Incidence cells_of(const MeshView& mesh);

/// Turns the cells (reverses their corners) so that each orientable component agrees with its first cell, and says
/// whether that worked everywhere. Two cells agree at an edge when they run through it in opposite directions; edges
/// with more than two cells ask nothing. Components that are not orientable stay as they were. O(number of corners).
bool orient_cells(MeshView& mesh);

/// Unit vertex normals (num_points x 3) of an oriented surface: the mean of the unit normals of the cells around a
/// point, as OpenMesh's update_normals() takes it; 0 where there is none. Nothing (so that a file has no normals) where
/// a surface is not a manifold in a way that leaves no side at a point to speak of: not oriented, a half-edge in two
/// cells, or a further cell at a point that a closed fan surrounds. Open fans that meet in a point have normals.
std::optional<std::vector<double>> vertex_normals(const MeshView& mesh);

/// A normal for every corner of every cell (num_corners x 3), also for one-sided surfaces: each vertex has one line of
/// normals, and each corner takes the direction on its own cell's side. For shading, where the sign is of no
/// importance.
std::vector<double> corner_normals(const MeshView& mesh);

/// A normal of a cell in R^3, its length twice the area (Newell's sum; not the plane's where corners are not coplanar).
std::array<double, 3> area_vector(const MeshView& mesh, std::size_t cell);

}  // namespace whitney::io
