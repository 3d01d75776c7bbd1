// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <whitney/io/formats/mesh_view.h>

namespace whitney::io {

/// Turns the cells (reverses their corners) so that each orientable component agrees with its first cell, and says
/// whether that worked everywhere. Two cells agree at an edge when they run through it in opposite directions; edges
/// with more than two cells ask nothing. Components that are not orientable stay as they were. O(number of corners).
bool orient_cells(MeshView& mesh);

/// Unit vertex normals (num_points x 3) by way of an OpenMesh half-edge mesh, for an oriented surface. Nothing if
/// OpenMesh refuses a face, as it does where a surface is not a manifold.
std::optional<std::vector<double>> vertex_normals(const MeshView& mesh);

/// A normal for every corner of every cell (num_corners x 3), also for one-sided surfaces: each vertex has one line of
/// normals, and each corner takes the direction on its own cell's side. For shading, where the sign is of no
/// importance.
std::vector<double> corner_normals(const MeshView& mesh);

/// A normal of a cell in R^3, its length twice the area (Newell's sum; not the plane's where corners are not coplanar).
std::array<double, 3> area_vector(const MeshView& mesh, std::size_t cell);

}  // namespace whitney::io
