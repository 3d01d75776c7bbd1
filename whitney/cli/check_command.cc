// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include <whitney/cli/commands.h>
#include <whitney/cli/report.h>
#include <whitney/io/atomic_file.h>
#include <whitney/io/read_mesh.h>
#include <whitney/io/write_report.h>

namespace whitney::cli {

int run_check(const CheckArguments& arguments) {
  const SimplicialMesh mesh = read_mesh(arguments.mesh);
  Statistics statistics;
  statistics.ambient_dim = mesh.ambient_dim;
  statistics.intrinsic_dim = mesh.dim;
  statistics.topology = topology_of(mesh);
  if (!arguments.stats.empty()) write_file(arguments.stats, to_json(statistics));
  if (!arguments.quiet)
    std::cout << arguments.mesh << ": " << mesh.num_points() << " points in R^" << mesh.ambient_dim << ", "
              << mesh.num_simplices() << " simplices\n"
              << describe(statistics.topology, mesh.dim);
  return statistics.topology.is_manifold() ? kDone : kNotAManifold;
}

}  // namespace whitney::cli
