// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include <whitney/topology/mesh.h>

namespace whitney {

/// Reads a simplicial complex; the extension of `path` (in any case) is the format:
///
///     .off .noff  text, with the prefixes of Geomview (COFF, NOFF, ...) but 4OFF and binary
///     .ply        text and binary; vertices of our own files come back with all d coordinates
///     .obj        v, f, l; everything else is skipped
///     .stl        text and binary; corners with equal coordinates become one point
///     .mesh       medit's text: the cells of the highest dimension found
///     .vtu        as write_mesh writes it (appended base64, not compressed); all d coordinates
///
/// A polygon with more than three corners gets a new point, the mean of its corners, and becomes the triangles from
/// there to its edges: the same surface, whatever the polygon's shape. In nOFF, cells of one size are simplices of any
/// dimension, unless the file ends with our mark `# polygons`. Arrays other than coordinates are not read.
///
/// The result is pure: cells of several dimensions in one file are an error. Points that no cell uses are kept.
/// Throws FileError naming the file, the line (of binary parts: the element) and the reason: a file that cannot be
/// read, is cut short, has an index out of range, a cell that names a point twice, a coordinate that is not finite, or
/// no cells. Memory is never taken on the word of a header. Throws InvalidInput for an unknown extension.
SimplicialMesh read_mesh(const std::filesystem::path& path);

}  // namespace whitney
