// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <whitney/cells/strata.h>
#include <whitney/problem/problem.h>
#include <whitney/problem/report.h>
#include <whitney/topology/mesh.h>
#include <whitney/tracing/cut_regularity.h>

namespace whitney {

/// The strata of a traced problem and how regular its boundary is. `mesh` was made with the strata.
BoundarySummary summarize_boundary(const Strata& strata, const SimplicialMesh& mesh, const CutRegularity& regularity,
                                   const Problem& problem);

}  // namespace whitney
