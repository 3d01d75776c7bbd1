// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <whitney/cells/strata.h>
#include <whitney/io/read_problem.h>
#include <whitney/io/write_mesh.h>
#include <whitney/io/write_report.h>
#include <whitney/tracing/cut_regularity.h>

namespace whitney::cli {

/// What the statistics say about the boundary. `mesh` was made with the strata.
BoundaryStatistics boundary_statistics(const Strata& strata, const SimplicialMesh& mesh,
                                       const CutRegularity& regularity, const Problem& problem);

/// The same in a few lines of text, each ending in a newline.
std::string describe(const BoundaryStatistics& boundary);

/// "(1, 0.5)", six digits.
std::string point_text(const std::vector<double>& point);

/// Throws InvalidInput when the format of the pattern can hold strata of no dimension up to n.
void check_strata_format(const std::string& pattern, int intrinsic_dim);

/// Writes every stratum to a file of its own, "name_3.vtu" for stratum 3 and the pattern "name.vtu"; those of a
/// dimension that the format cannot hold are left out. Returns the names; appends what went wrong to `failed`, a line
/// each.
std::vector<std::string> write_strata(const std::string& pattern, const SimplicialMesh& mesh, std::size_t num_strata,
                                      const MeshWriteOptions& options, std::string& failed);

}  // namespace whitney::cli
