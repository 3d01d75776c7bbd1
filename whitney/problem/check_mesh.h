// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <coxeter/base/run_control.h>
#include <whitney/problem/report.h>
#include <whitney/topology/mesh.h>

namespace whitney {

/// The topology of a mesh as a report; parts that the limits do not allow are left out. Throws InvalidInput as
/// topology_of does.
Report check_mesh(const SimplicialMesh& mesh, TopologyLevel level = TopologyLevel::kFull, const RunControl& run = {});

}  // namespace whitney
