// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>
#include <whitney/cli/boundary_report.h>
#include <whitney/cli/commands.h>
#include <whitney/cli/report.h>
#include <whitney/cli/session.h>
#include <whitney/cli/trace_piece.h>
#include <whitney/io/atomic_file.h>
#include <whitney/io/read_problem.h>
#include <whitney/io/write_mesh.h>
#include <whitney/io/write_report.h>
#include <whitney/topology/topology.h>
#include <whitney/tracing/cut_regularity.h>
#include <whitney/tracing/orient_by_function.h>

namespace whitney::cli {
int run_trace(const TraceArguments& arguments) {
  Stopwatch watch;
  Statistics statistics;
  const Problem problem = read_problem(arguments.problem);
  if (problem.atlas) return run_trace_charts(problem, arguments);
  if (!problem.function)
    throw InvalidInput(arguments.problem +
                       ": this manifold is given by its closest points, not as a zero set: use `whitney triangulate`");
  const Function& function = *problem.function;
  const int d = problem.ambient_dim(), k = problem.codim(), n = d - k;
  if (n < 1)
    throw InvalidInput(arguments.problem + ": equations: " + std::to_string(k) + " equations in " + std::to_string(d) +
                       " variables leave no manifold of dimension 1 or more");
  check_outputs(arguments.outputs, arguments.stats, n, arguments.mesh == "cells");
  check_outputs({}, arguments.strata, n, false);
  if (!arguments.strata.empty()) check_strata_format(arguments.strata, n);
  const std::optional<Box> box = box_of(problem);
  const double edge_length = edge_length_of(arguments, problem, box);
  const coxeter::Triangulation triangulation = make_triangulation(problem.triangulation, d, edge_length);
  const bool talk = !arguments.quiet;
  const TracedPiece piece = trace_piece({arguments.problem, function, problem.inequalities, box, problem.seed_points},
                                        triangulation, arguments, 0, 0, watch, statistics);
  const TraceResult& traced = piece.traced;
  if (piece.empty()) throw InvalidInput(arguments.problem + ": " + piece.where_to_look());
  const CellComplex& complex = piece.complex;
  const Strata& strata = piece.strata;
  const Strata* const labels = strata.has_boundary() || !arguments.strata.empty() ? &strata : nullptr;
  SimplicialMesh mesh =
      arguments.mesh == "barycentric" ? barycentric_subdivision(complex, labels) : pulled_subdivision(complex, labels);
  mesh = orient_by_function(std::move(mesh), function).mesh;
  const bool polygons = arguments.mesh == "cells";
  PolygonMesh cells;
  if (polygons) cells = polygon_mesh(complex, labels);
  statistics.seconds["mesh"] = watch.lap();

  if (labels != nullptr)
    statistics.boundary =
        boundary_statistics(strata, mesh, check_cuts(function, traced, triangulation.edge_length()), problem);
  const CutRegularity interior = check_interior(function, traced, triangulation.edge_length());
  statistics.interior_singular_value = interior.smallest_singular_value;
  for (const SingularCut& point : interior.singular) statistics.interior_singular_points.push_back(point.point);
  statistics.topology = topology_of(mesh);
  if (polygons) {
    statistics.topology.f_vector.clear();
    for (int j = 0; j <= n; ++j) statistics.topology.f_vector.push_back(complex.num_cells(j));
  }
  statistics.seconds["topology"] = watch.lap();

  MeshWriteOptions write_options;
  write_options.projection = arguments.projection;
  write_options.variables = problem.variables;
  write_options.color_by = arguments.color_by;
  std::string failed = write_outputs(arguments.outputs, mesh, polygons ? &cells : nullptr, write_options);
  std::vector<std::string> written = arguments.outputs;
  if (!arguments.strata.empty()) {
    const auto files =
        write_strata(arguments.strata, mesh, labels != nullptr ? strata.strata.size() : 0, write_options, failed);
    written.insert(written.end(), files.begin(), files.end());
  }
  statistics.seconds["write"] = watch.lap();

  statistics.ambient_dim = d;
  statistics.intrinsic_dim = n;
  statistics.edge_length = edge_length;
  statistics.stop_reason = to_string(traced.stop_reason);
  if (!arguments.stats.empty()) write_file(arguments.stats, to_json(statistics));

  if (talk) {
    std::cout << "R^" << d << ", " << k << (k == 1 ? " equation" : " equations") << ", edge length " << edge_length
              << ": " << traced.num_simplices() << " simplices of dimension " << k
              << " meet the zero set, f evaluated at " << traced.evaluations << " lattice vertices, " << traced.seconds
              << " s\n"
              << describe(statistics.topology, n);
    if (piece.searched)
      std::cout << "seeds: searched for (" << piece.found.num_starts << " starts), " << statistics.num_seeds_used
                << " used; that every component was found is likely, not proved\n";
    for (std::size_t i = 0; !piece.searched && i < traced.seeds.size(); ++i)
      if (traced.seeds[i].outcome == SeedReport::Outcome::kDropped)
        std::cout << "seed point " << i + 1 << " dropped: " << traced.seeds[i].reason << "\n";
    std::cout << too_small_text(statistics);
    for (const auto& point : statistics.interior_singular_points)
      std::cout
          << "the zero set is SINGULAR at " << point_text(point)
          << ": it crosses or touches itself or has a tip there, and the mesh is one resolution of it among several\n";
    if (statistics.boundary) std::cout << describe(*statistics.boundary);
    if (traced.stop_reason == StopReason::kBox)
      std::cout << "the manifold reaches the box and was cut there"
                << (traced.whole ? "" : ", at whole simplices where f has no value outside it") << "\n";
    else if (traced.stop_reason != StopReason::kNone)
      std::cout << "stopped early (" << statistics.stop_reason << "): the mesh is part of the manifold\n";
    for (const std::string& file : written) std::cout << "written: " << file << "\n";
    if (!arguments.stats.empty()) std::cout << "written: " << arguments.stats << "\n";
  }
  if (!failed.empty()) throw FileError(failed);
  if (!statistics.interior_singular_points.empty()) return kSingular;
  if (statistics.boundary && !statistics.boundary->singular_points.empty()) return kSingular;
  if (traced.stop_reason == StopReason::kNone || traced.stop_reason == StopReason::kBox) return kDone;
  return kStopped;
}

}  // namespace whitney::cli
