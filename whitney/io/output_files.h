// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <whitney/io/write_mesh.h>
#include <whitney/topology/mesh.h>

namespace whitney {

/// Refuses before the work begins what can be known then of files that will be written. Empty names stand for no file.
/// Throws FileError when the folder of a file is not there, may not be written into or lies on a full disk, or a folder
/// is in the way; InvalidInput when two of them, or one of them and `input`, are the same file (also by another
/// spelling or a link): devices excepted.
void check_output_files(const std::string& input, const std::vector<std::string>& outputs);

/// The same for a pattern of strata files, "name.vtu", against the other outputs and the input: "name_3.vtu" is one of
/// its files.
void check_strata_pattern(const std::string& input, const std::vector<std::string>& outputs, const std::string& pattern,
                          int intrinsic_dim);

/// Writes every file, even if another fails; returns what went wrong, a line each, empty if nothing did.
std::vector<std::string> write_meshes(const std::vector<std::string>& outputs, const SimplicialMesh& mesh,
                                      const PolygonMesh* polygons, const MeshWriteOptions& options);

struct WrittenStrata {
  std::vector<std::string> files;
  std::vector<std::string> failed;  ///< what went wrong, a line each
};

/// Writes every stratum to a file of its own, "name_3.vtu" for stratum 3 and the pattern "name.vtu"; those of a
/// dimension that the format cannot hold are left out.
WrittenStrata write_strata(const std::string& pattern, const SimplicialMesh& mesh, std::size_t num_strata,
                           const MeshWriteOptions& options);

}  // namespace whitney
