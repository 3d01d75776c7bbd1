// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include <whitney/cli/commands.h>
#include <whitney/cli/describe.h>
#include <whitney/cli/session.h>
#include <whitney/io/atomic_file.h>
#include <whitney/io/output_files.h>
#include <whitney/io/read_mesh.h>
#include <whitney/io/write_report.h>
#include <whitney/problem/check_mesh.h>

namespace whitney::cli {

int run_check(const CheckArguments& arguments) {
  check_output_files(arguments.mesh, {arguments.stats});
  const SimplicialMesh mesh = read_mesh(arguments.mesh);
  const InterruptGuard guard;
  ProgressLine line(arguments.quiet);
  const Report report =
      check_mesh(mesh, topology_level(arguments.topology), run_control(arguments.limits, guard, line));
  if (!arguments.stats.empty()) write_file(arguments.stats, to_json(report));
  if (!arguments.quiet)
    std::cout << arguments.mesh << ": " << mesh.num_points() << " points in R^" << mesh.ambient_dim << ", "
              << mesh.num_simplices() << " simplices\n"
              << describe_topology(report) << describe_stop(report);
  if (report.topology.manifold == ManifoldKind::kSingular) return kNotProved;
  return report.stopped() ? kStopped : kDone;
}

}  // namespace whitney::cli
