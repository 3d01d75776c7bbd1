// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>
#include <whitney/cell_complex.h>
#include <whitney/cli/boundary_report.h>
#include <whitney/cli/commands.h>
#include <whitney/cli/report.h>
#include <whitney/cli/session.h>
#include <whitney/cut_regularity.h>
#include <whitney/find_seeds.h>
#include <whitney/io/atomic_file.h>
#include <whitney/io/problem.h>
#include <whitney/io/statistics.h>
#include <whitney/io/write_mesh.h>
#include <whitney/orient_by_function.h>
#include <whitney/strata.h>
#include <whitney/subdivide.h>
#include <whitney/topology.h>
#include <whitney/trace.h>

#include <algorithm>
#include <cstdio>
#include <iostream>

#include <coxeter/error.h>

namespace whitney::cli {
namespace {

double edge_length_of(const TraceArguments& arguments, const Problem& problem, const std::optional<Box>& box) {
  if (arguments.edge_length) return *arguments.edge_length;
  if (problem.triangulation.edge_length) return *problem.triangulation.edge_length;
  if (!box)
    throw InvalidInput(arguments.problem +
                       ": no edge length: give triangulation.edge_length, --edge-length, or a box to take it from");
  double side = 0;
  for (std::size_t c = 0; c < box->lower.size(); ++c) side = std::max(side, box->upper[c] - box->lower[c]);
  return side / 30;
}

std::string where_to_look(const TraceResult& traced, const FoundSeeds* search) {
  std::string text;
  if (search != nullptr && search->points.empty()) {
    text =
        "no point of the manifold was found in the box (" + std::to_string(search->num_starts) + " Newton iterations";
    if (search->num_singular > 0)
      text +=
          ", " + std::to_string(search->num_singular) +
          " of them to points where the rows of the Jacobian are linearly dependent: 0 is not a regular value there";
    return text + ")";
  }
  text = "no simplex meets the zero set";
  if (!traced.seeds.empty()) text += "; the first seed point was dropped because " + traced.seeds.front().reason;
  return text;
}

}  // namespace

int run_trace(const TraceArguments& arguments) {
  Stopwatch watch;
  Statistics statistics;
  const Problem problem = read_problem(arguments.problem);
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
  const std::optional<Box> box = box_of(problem);
  const double edge_length = edge_length_of(arguments, problem, box);
  const coxeter::Triangulation triangulation = make_triangulation(problem.triangulation, d, edge_length);
  const bool talk = !arguments.quiet;
  const bool live = talk && isatty(STDERR_FILENO);

  std::vector<double> seed_points;
  for (const auto& point : problem.seed_points) seed_points.insert(seed_points.end(), point.begin(), point.end());
  FoundSeeds found;
  const bool searched = seed_points.empty();
  if (searched) {
    if (!box) throw InvalidInput(arguments.problem + ": give seed_points, or a box in which they can be searched for");
    found = find_seeds(function, Domain(d, problem.inequalities, box));
    seed_points = found.points;
  }
  statistics.seconds["seeds"] = watch.lap();

  TraceOptions options;
  options.inequalities = problem.inequalities;
  options.box = box;
  options.max_simplices = arguments.max_simplices;
  options.time_limit = arguments.time_limit;
  double reported = 0;
  std::optional<InterruptGuard> guard(std::in_place);
  const InterruptGuard& interrupt = *guard;
  options.progress = [&](const TraceProgress& progress) {
    if (live && progress.seconds > reported + 0.5) {
      reported = progress.seconds;
      std::fprintf(stderr, "\r%zu simplices, %zu evaluations, %.0f s ", progress.simplices, progress.evaluations,
                   progress.seconds);
    }
    return !interrupt.interrupted();
  };
  const TraceResult traced = trace(function, triangulation, seed_points, options);
  guard.reset();
  if (live && reported > 0) std::fprintf(stderr, "\n");
  statistics.seconds["trace"] = watch.lap();
  if (traced.num_simplices() == 0)
    throw InvalidInput(arguments.problem + ": " + where_to_look(traced, searched ? &found : nullptr));

  const CellComplex complex = cell_complex(traced);
  statistics.seconds["complex"] = watch.lap();

  const Strata strata = strata_of(complex);
  const Strata* const labels = strata.has_boundary() || !arguments.strata.empty() ? &strata : nullptr;
  SimplicialMesh mesh =
      arguments.mesh == "barycentric" ? barycentric_subdivision(complex, labels) : pulled_subdivision(complex, labels);
  mesh = orient_by_function(std::move(mesh), function).mesh;
  const bool polygons = arguments.mesh == "cells";
  PolygonMesh cells;
  if (polygons) cells = polygon_mesh(complex);
  statistics.seconds["mesh"] = watch.lap();

  if (labels != nullptr)
    statistics.boundary =
        boundary_statistics(strata, mesh, check_cuts(function, traced, triangulation.edge_length()), problem);
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
  for (const SeedReport& seed : traced.seeds) {
    statistics.num_seeds_used += seed.outcome == SeedReport::Outcome::kUsed;
    statistics.num_seeds_merged += seed.outcome == SeedReport::Outcome::kMerged;
    statistics.num_seeds_dropped += seed.outcome == SeedReport::Outcome::kDropped;
  }
  for (int j = 0; j <= n; ++j) statistics.simplices_per_dim[k + j] = complex.set_begin[j][1];
  statistics.oracle_evaluations = traced.evaluations;
  statistics.seed_evaluations = traced.seed_evaluations + found.evaluations;
  statistics.distinct_vertices = traced.num_vertices();
  statistics.exact_decisions = traced.exact_decisions;
  statistics.stop_reason = to_string(traced.stop_reason);
  if (!arguments.stats.empty()) write_file(arguments.stats, to_json(statistics));

  if (talk) {
    std::cout << "R^" << d << ", " << k << (k == 1 ? " equation" : " equations") << ", edge length " << edge_length
              << ": " << traced.num_simplices() << " simplices of dimension " << k
              << " meet the zero set, f evaluated at " << traced.evaluations << " lattice vertices, " << traced.seconds
              << " s\n"
              << describe(statistics.topology, n);
    if (searched)
      std::cout << "seeds: searched for (" << found.num_starts << " starts), " << statistics.num_seeds_used
                << " used; that every component was found is likely, not proved\n";
    for (std::size_t i = 0; !searched && i < traced.seeds.size(); ++i)
      if (traced.seeds[i].outcome == SeedReport::Outcome::kDropped)
        std::cout << "seed point " << i + 1 << " dropped: " << traced.seeds[i].reason << "\n";
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
  if (statistics.boundary && !statistics.boundary->singular_points.empty()) return kSingular;
  if (traced.stop_reason == StopReason::kNone || traced.stop_reason == StopReason::kBox) return kDone;
  return kStopped;
}

}  // namespace whitney::cli
