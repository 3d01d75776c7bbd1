// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <numbers>
#include <sstream>
#include <unistd.h>
#include <utility>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>
#include <whitney/cli/commands.h>
#include <whitney/cli/report.h>
#include <whitney/cli/session.h>
#include <whitney/construction/ambient_mesh.h>
#include <whitney/construction/complex_quality.h>
#include <whitney/construction/inside_mesh.h>
#include <whitney/construction/scale_search.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/io/atomic_file.h>
#include <whitney/io/read_problem.h>
#include <whitney/io/write_mesh.h>
#include <whitney/io/write_report.h>
#include <whitney/manifolds/bending.h>
#include <whitney/topology/orientation.h>
#include <whitney/topology/topology.h>

namespace whitney::cli {
namespace {

using perturbation::Verdict;

std::vector<double> seeds_of(Problem& problem, const std::string& file) {
  if (problem.seed_points.empty() && !problem.submanifold) {
    const std::optional<Box> box = box_of(problem);
    if (!box) throw InvalidInput(file + ": give seed_points, or a box in which they can be searched for");
    const FoundSeeds found = find_seeds(*problem.function, Domain(problem.ambient_dim(), problem.inequalities, box));
    const auto d = static_cast<std::size_t>(problem.ambient_dim());
    for (std::size_t at = 0; at + d <= found.points.size(); at += d)
      problem.seed_points.emplace_back(&found.points[at], &found.points[at] + d);
    if (problem.seed_points.empty()) throw InvalidInput(file + ": no point of the manifold was found in the box");
  }
  std::vector<double> seeds;
  for (const auto& point : problem.seed_points) seeds.insert(seeds.end(), point.begin(), point.end());
  return seeds;
}

/// The reach of a zero set that came without one. A zero set that crosses itself or has a corner would send the search
/// for a scale to ever smaller edge lengths, so it is named here.
Bending estimated(const Submanifold& manifold, const std::optional<Box>& box, const std::string& file) {
  const BendingEstimate estimate = estimate_bending(manifold);
  const auto d = static_cast<std::size_t>(manifold.ambient_dim());
  double side = 0;
  for (std::size_t c = 0; box && c < d; ++c) side = std::max(side, box->upper[c] - box->lower[c]);
  if (estimate.bending.reach > 1e-5 * side) return estimate.bending;
  std::ostringstream text;
  text << file << ": the reach seems to be " << estimate.bending.reach << " or less, from the points";
  for (const std::vector<double>& x : {estimate.p, estimate.q}) {
    text << " (";
    for (std::size_t c = 0; c < d; ++c) text << (c == 0 ? "" : ", ") << x[c];
    text << ")";
  }
  text << ": the set crosses itself or is singular there, so it is no submanifold; if it is one, give its reach";
  throw InvalidInput(text.str());
}

CertificateStatistics certificate_statistics(const TriangulateResult& result, const Bending& bending) {
  const perturbation::CertificateReport& report = result.certificate;
  CertificateStatistics out;
  out.verdict = to_string(report.verdict);
  out.margin_min = report.margin_min;
  out.margin_median = report.margin_median;
  out.displacement_max = report.displacement_max / result.edge_length;
  out.rounds = result.rounds.size();
  out.vertices_near = result.vertices_near;
  out.vertices_moved = result.vertices_moved;
  out.reach = bending.reach;
  out.curvature_radius = bending.curvature_radius;
  out.reach_source = to_string(bending.source);
  out.edge_length_over_reach = result.edge_length / bending.reach;
  if (report.verdict == Verdict::kCertified && !result.cut) out.hausdorff_bound = result.hausdorff_bound;
  out.cut = result.cut;
  out.reason = report.reason;
  if (report.witness) out.witness = report.witness->barycentre;
  return out;
}

/// What a person wants to know first.
std::string describe_verdict(const TriangulateResult& result, const Bending& bending) {
  const perturbation::CertificateReport& report = result.certificate;
  std::ostringstream text;
  text.precision(4);
  text << to_string(report.verdict) << (result.cut ? " away from the boundary: " : ": ");
  if (report.verdict == Verdict::kCertified) {
    text << "the complex is homeomorphic to "
         << (result.cut ? "the part of the manifold in its simplices, which end just beyond the inequalities"
                        : "the manifold")
         << ", given its reach " << bending.reach << " (" << to_string(bending.source) << ")";
    if (bending.source == Bending::Source::kEstimated) text << ": an estimate, so this is no proof";
    text << "\n  margins: worst " << report.margin_min << ", median " << report.margin_median;
    if (result.hausdorff_bound) text << "; Hausdorff distance at most " << *result.hausdorff_bound;
    text << "\n";
  } else {
    text << report.reason << "\n";
    text << "  margins: worst " << report.margin_min << ", median " << report.margin_median
         << "; above 1 is certified\n";
    if (result.reach_check.consistent)
      text << "  next: --edge-length " << result.edge_length / 2 << ", or --auto-refine\n";
  }
  text << "  edge length / reach " << result.edge_length / bending.reach << ", " << report.simplices
       << " simplices of R^" << result.complex.ambient_dim << " meet the manifold, " << result.vertices_moved << " of "
       << result.vertices_near << " vertices moved, by at most " << report.displacement_max / result.edge_length
       << " edge lengths\n";
  return text.str();
}

std::string describe_quality(const ComplexQuality& quality) {
  const double degrees = 180 / std::numbers::pi;
  std::ostringstream text;
  text.precision(3);
  text << "quality: thickness worst " << quality.thickness_min << ", median " << quality.thickness_median
       << "; angle with the tangent spaces worst " << quality.angle_max * degrees << ", median "
       << quality.angle_median * degrees << " degrees; edges " << quality.shortest_edge << " to "
       << quality.longest_edge << "\n";
  return text.str();
}

/// Refuses --ambient and --inside before the work begins.
void check_solid_outputs(const TriangulateArguments& arguments, int d, int n) {
  for (const auto& [file, option] : {std::pair{arguments.ambient, "--ambient"}, {arguments.inside, "--inside"}}) {
    if (file.empty()) continue;
    if (d < 2 || d > 4)
      throw InvalidInput(std::string(option) + ": made for 2 <= d <= 4, the manifold lies in R^" + std::to_string(d));
    check_outputs({file}, "", d, false);
  }
  if (!arguments.inside.empty() && n != d - 1)
    throw InvalidInput("--inside: a manifold of dimension " + std::to_string(n) + " in R^" + std::to_string(d) +
                       " has no inside");
}

/// Writes them; returns what went wrong, a line each.
std::string write_solids(const TriangulateArguments& arguments, const TriangulateResult& result,
                         const coxeter::Triangulation& triangulation, const MeshWriteOptions& options) {
  std::string failed;
  const auto write = [&](const std::string& file, auto make) {
    if (file.empty()) return;
    try {
      write_mesh(file, make(result.complex, triangulation, result.displacements).mesh, options);
    } catch (const std::exception& error) {
      const std::string what = error.what();
      failed += (failed.empty() ? "" : "\n") + (what.starts_with(file) ? what : file + ": " + what);
    }
  };
  write(arguments.ambient, ambient_mesh);
  write(arguments.inside, inside_mesh);
  return failed;
}

}  // namespace

int run_triangulate(const TriangulateArguments& arguments) {
  Stopwatch watch;
  Statistics statistics;
  Problem problem = read_problem(arguments.problem);
  if (problem.atlas) {
    throw InvalidInput(arguments.problem +
                       ": charts have no closest points, which Whitney's construction needs: use `whitney trace`");
  }
  const int d = problem.ambient_dim(), k = problem.codim(), n = d - k;
  if (n < 1) throw InvalidInput(arguments.problem + ": no manifold of dimension 1 or more");
  const bool polygons = arguments.mesh == "cells";
  check_outputs(arguments.outputs, arguments.stats, n, polygons);
  check_solid_outputs(arguments, d, n);
  const bool talk = !arguments.quiet, live = talk && isatty(STDERR_FILENO);

  std::vector<double> seeds = seeds_of(problem, arguments.problem);
  const Submanifold manifold = submanifold_of(problem);
  if (seeds.empty()) seeds = manifold.seed_points();
  std::optional<Bending> bending = manifold.bending();
  if (!bending) bending = estimated(manifold, box_of(problem), arguments.problem);
  statistics.seconds["seeds"] = watch.lap();

  InterruptGuard guard;
  ScaleSearchOptions options;
  options.triangulate.scheme = arguments.scheme == "none"         ? TriangulateOptions::Scheme::kNone
                               : arguments.scheme == "sequential" ? TriangulateOptions::Scheme::kSequential
                                                                  : TriangulateOptions::Scheme::kRepair;
  options.triangulate.rng_seed = problem.triangulation.rng_seed;
  options.triangulate.max_rounds = arguments.max_rounds;
  options.triangulate.inequalities = problem.inequalities;
  options.triangulate.box = box_of(problem);
  options.triangulate.run.max_simplices = arguments.max_simplices;
  options.triangulate.run.time_limit = arguments.time_limit;
  double reported = 0;
  options.triangulate.run.progress = [&](const Progress& progress) {
    if (live && (progress.seconds > reported + 0.5 || progress.seconds < reported)) {
      reported = progress.seconds;
      std::fprintf(stderr, "\r%s: %zu simplices, %.0f s ", progress.phase, progress.simplices, progress.seconds);
    }
    return !guard.interrupted();
  };
  options.first_edge_length = arguments.edge_length ? arguments.edge_length : problem.triangulation.edge_length;
  if (options.first_edge_length && arguments.auto_refine) options.factor = 0.5;
  if (options.first_edge_length && !arguments.auto_refine) options.max_attempts = 1;
  const auto triangulation_of = [&](double L) { return make_triangulation(problem.triangulation, d, L); };
  ScaleSearchResult search;
  try {
    search = search_scale(manifold, *bending, triangulation_of, seeds, options);
  } catch (const InvalidInput& error) {
    throw InvalidInput(arguments.problem + ": " + error.what());
  }
  const TriangulateResult& result = search.result;
  if (live && reported > 0) std::fprintf(stderr, "\n");
  statistics.seconds["perturb"] = result.seconds_perturb;
  statistics.seconds["certify"] = result.seconds_certify;
  statistics.seconds["complex"] = result.seconds_complex;
  watch.lap();
  if (result.certificate.simplices == 0)
    throw InvalidInput(
        arguments.problem + ": no simplex near the " + std::to_string(seeds.size() / d) +
        " seed points meets the manifold (" + std::to_string(result.seeds_dropped) +
        " of them have no closest point on it)" +
        (problem.inequalities ? "; seeds outside the inequalities do not count: give seed_points inside" : ""));

  SimplicialMesh mesh =
      arguments.mesh == "pulled" ? pulled_subdivision(result.complex) : barycentric_subdivision(result.complex);
  mesh = orient(std::move(mesh)).mesh;
  PolygonMesh cells;
  if (polygons) cells = polygon_mesh(result.complex);
  statistics.seconds["mesh"] = watch.lap();
  statistics.topology = topology_of(mesh);
  if (polygons) {
    statistics.topology.f_vector.clear();
    for (int j = 0; j <= n; ++j) statistics.topology.f_vector.push_back(result.complex.num_cells(j));
  }
  statistics.seconds["topology"] = watch.lap();
  constexpr std::size_t kMaxFeet = 100'000;  // of each kind: enough to judge, and a slow oracle has an end
  statistics.quality = complex_quality(mesh, manifold, kMaxFeet);
  statistics.seconds["quality"] = watch.lap();

  MeshWriteOptions write_options;
  write_options.projection = arguments.projection;
  write_options.variables = problem.variables;
  write_options.color_by = arguments.color_by;
  std::string failed = write_outputs(arguments.outputs, mesh, polygons ? &cells : nullptr, write_options);
  write_options.color_by.clear();
  const std::string solids =
      write_solids(arguments, result, make_triangulation(problem.triangulation, d, search.attempts.back().edge_length),
                   write_options);
  if (!failed.empty() && !solids.empty()) failed += "\n";
  failed += solids;
  statistics.seconds["write"] = watch.lap();

  statistics.ambient_dim = d;
  statistics.intrinsic_dim = n;
  statistics.edge_length = search.attempts.back().edge_length;
  statistics.num_seeds_used = result.seeds_used;
  statistics.num_seeds_merged = result.seeds_merged;
  statistics.num_seeds_dropped = result.seeds_dropped;
  for (int j = 0; j <= n; ++j) statistics.simplices_per_dim[k + j] = result.complex.num_cells(j);
  statistics.oracle_evaluations = result.oracle_evaluations;
  statistics.distinct_vertices = result.vertices_near;
  statistics.stop_reason = to_string(result.stop_reason);
  statistics.certificate = certificate_statistics(result, *bending);
  if (!arguments.stats.empty()) write_file(arguments.stats, to_json(statistics));

  if (talk) {
    for (std::size_t i = 0; i + 1 < search.attempts.size(); ++i)
      std::cout << "edge length " << search.attempts[i].edge_length << ": " << to_string(search.attempts[i].verdict)
                << " (" << search.attempts[i].not_certified << " of " << search.attempts[i].simplices
                << " simplices), refined\n";
    std::cout << "R^" << d << ", edge length " << result.edge_length << ", "
              << result.seconds_perturb + result.seconds_certify + result.seconds_complex << " s\n"
              << describe_verdict(result, *bending) << describe(statistics.topology, n)
              << describe_quality(*statistics.quality);
    if (result.stop_reason != StopReason::kNone) std::cout << "stopped early (" << statistics.stop_reason << ")\n";
    for (const std::string& file : arguments.outputs) std::cout << "written: " << file << "\n";
    for (const std::string& file : {arguments.ambient, arguments.inside})
      if (!file.empty() && solids.find(file) == std::string::npos) std::cout << "written: " << file << "\n";
    if (!arguments.stats.empty()) std::cout << "written: " << arguments.stats << "\n";
  }
  if (!failed.empty()) throw FileError(failed);
  if (result.stop_reason != StopReason::kNone) return kStopped;
  return result.certificate.verdict == Verdict::kCertified ? kDone : kNotCertified;
}

}  // namespace whitney::cli
