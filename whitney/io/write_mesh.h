// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <whitney/topology/mesh.h>

namespace whitney {

struct MeshWriteOptions {
  /// How R^d, d > 3, becomes R^3 where a format wants x y z: "pca" or "i,j,k" (see make_projection). R^1 and R^2 get 0.
  std::string projection = "pca";
  /// Names of the d coordinates, or empty for x1 .. xd. Used by `projection`, `color_by` and in comments.
  std::vector<std::string> variables{};
  /// What colours the vertices (PLY, POV): a point array of one component, or a variable. Empty: the depth of the
  /// projection if d > 3 (so that sheets which cross in the picture differ in colour), else no colours.
  std::string color_by{};
  /// Vertex normals in PLY and OBJ, of oriented surfaces.
  bool normals = true;
};

/// Writes a mesh; the extension of `path` (in any case) is the format:
///
///     .noff  any n and d, polygons     text: the nOFF form; all d coordinates
///     .vtu   n <= 3, polygons          ParaView: x y z as points, all d coordinates, every array
///     .ply   n = 1, 2, polygons        binary: x y z, normals, colours, x1 .. xd if d > 3, arrays
///     .obj   n = 1, 2, polygons        text: x y z, normals
///     .off   n = 2, polygons           text: x y z
///     .stl   n = 2, polygons           binary, in float, corners repeated: what the format is
///     .mesh  n = 1, 2, 3, no polygons  medit's text: x y z
///     .pov   n = 1, 2, polygons        a scene for POV-Ray, camera and lights included
///
/// Numbers are doubles in binary or the shortest text that reads back as the same double, except in STL and POV.
/// Triangles and polygons of each orientable component are turned to agree with the component's first cell; the cells
/// of other components stay as they are. No cell is ever left out: what a format cannot hold is an error. Polygons
/// become fans of triangles in STL and POV.
///
/// The file appears under its name only when complete (AtomicFile). Throws InvalidInput for an unknown extension, a
/// mesh that the format cannot hold (the message names formats that can), or a broken mesh (an index or a size out of
/// range, a coordinate that is not finite); FileError when the system refuses.
void write_mesh(const std::filesystem::path& path, const SimplicialMesh& mesh, const MeshWriteOptions& options = {});
void write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh, const MeshWriteOptions& options = {});

/// Throws the InvalidInput that write_mesh would throw because of the extension, for simplices (or polygons) of
/// dimension `intrinsic_dim`: lets a program complain before hours of work.
void check_mesh_format(const std::filesystem::path& path, int intrinsic_dim, bool polygons = false);

}  // namespace whitney
