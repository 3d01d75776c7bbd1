// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <whitney/problem/problem.h>
#include <whitney/problem/trace_problem.h>

namespace whitney {

/// Traces every chart of problem.atlas, a curve or surface each, and glues them along the seams. Stopped by a limit,
/// the pieces lie side by side, not glued. mesh.point_data and cell_data "chart" as in glue_charts.h.
///
/// Throws InvalidInput when the charts leave other dimensions than 1 and 2, for MeshKind::kCells, and as trace_problem
/// does; std::bad_alloc when memory gives out.
TracedProblem trace_atlas(const Problem& problem, const TraceProblemOptions& options = {});

}  // namespace whitney
