// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/check_mesh.h>

#include <whitney/problem/budget.h>
#include <whitney/problem/mesh_topology.h>

namespace whitney {

Report check_mesh(const SimplicialMesh& mesh, TopologyLevel level, const RunControl& run) {
  Budget budget(run);
  Report report;
  report.ambient_dim = mesh.ambient_dim;
  report.intrinsic_dim = mesh.dim;
  report_topology(mesh, level, budget, report);
  budget.lap(report.seconds, "topology");
  report.stop_reason = budget.stop_reason();
  report.left_out = budget.left_out();
  return report;
}

}  // namespace whitney
