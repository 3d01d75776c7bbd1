// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/cli/trace_piece.h>

#include <unistd.h>
#include <algorithm>
#include <cstdio>

#include <coxeter/base/error.h>
#include <whitney/cli/boundary_report.h>

namespace whitney::cli {

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

std::string TracedPiece::where_to_look() const {
  std::string text;
  if (searched && found.points.empty()) {
    text = "no point of the manifold was found in the box (" + std::to_string(found.num_starts) + " Newton iterations";
    if (found.num_singular > 0)
      text +=
          ", " + std::to_string(found.num_singular) +
          " of them to points where the rows of the Jacobian are linearly dependent: 0 is not a regular value there";
    return text + ")";
  }
  text = "no simplex meets the zero set";
  if (!traced.seeds.empty()) text += "; the first seed point was dropped because " + traced.seeds.front().reason;
  return text;
}

std::string too_small_text(const Statistics& statistics) {
  if (statistics.num_seeds_too_small == 0) return "";
  const bool one = statistics.num_seeds_too_small == 1;
  std::string text = std::to_string(statistics.num_seeds_too_small) + (one ? " seed lies" : " seeds lie") +
                     " on parts too small for this edge length, e.g. at " + point_text(statistics.too_small_point);
  char finer[32];
  std::snprintf(finer, sizeof finer, "%.3g", statistics.too_small_edge_length);
  if (statistics.too_small_edge_length > 0) text += ": try L <= " + std::string(finer);
  return text + "\n";
}

TracedPiece trace_piece(const PieceProblem& problem, const coxeter::Triangulation& triangulation,
                        const TraceArguments& arguments, std::size_t found_before, double seconds_before,
                        Stopwatch& watch, Statistics& statistics) {
  const int d = problem.function.ambient_dim(), k = problem.function.codim(), n = d - k;
  const bool live = !arguments.quiet && isatty(STDERR_FILENO);
  TracedPiece piece;
  std::vector<double> seed_points;
  for (const auto& point : problem.seed_points) seed_points.insert(seed_points.end(), point.begin(), point.end());
  piece.searched = seed_points.empty();
  if (piece.searched) {
    if (!problem.box)
      throw InvalidInput(problem.where + ": give seed_points, or a box in which they can be searched for");
    piece.found = find_seeds(problem.function, Domain(d, problem.inequalities, problem.box));
    seed_points = piece.found.points;
  }
  statistics.seconds["seeds"] += watch.lap();

  TraceOptions options;
  options.inequalities = problem.inequalities;
  options.box = problem.box;
  options.run.max_simplices = arguments.max_simplices - std::min(arguments.max_simplices, found_before);
  options.run.time_limit = arguments.time_limit - seconds_before;
  double reported = 0;
  {
    const InterruptGuard interrupt;
    options.run.progress = [&](const Progress& progress) {
      if (live && progress.seconds > reported + 0.5) {
        reported = progress.seconds;
        std::fprintf(stderr, "\r%zu simplices, %zu evaluations, %.0f s ", found_before + progress.simplices,
                     progress.evaluations, seconds_before + progress.seconds);
      }
      return !interrupt.interrupted();
    };
    piece.traced = trace(problem.function, triangulation, seed_points, options);
  }
  if (live && reported > 0) std::fprintf(stderr, "\n");
  statistics.seconds["trace"] += watch.lap();
  piece.complex = cell_complex(piece.traced);
  piece.strata = strata_of(piece.complex);
  statistics.seconds["complex"] += watch.lap();

  for (const SeedReport& seed : piece.traced.seeds) {
    statistics.num_seeds_used += seed.outcome == SeedReport::Outcome::kUsed;
    statistics.num_seeds_merged += seed.outcome == SeedReport::Outcome::kMerged;
    statistics.num_seeds_dropped += seed.outcome == SeedReport::Outcome::kDropped;
    if (seed.outcome != SeedReport::Outcome::kTooSmall) continue;
    if (statistics.num_seeds_too_small++ == 0) statistics.too_small_point = seed.unseen;
    double& finer = statistics.too_small_edge_length;
    if (seed.finer_edge_length > 0)
      finer = finer > 0 ? std::min(finer, seed.finer_edge_length) : seed.finer_edge_length;
  }
  for (int j = 0; j <= n; ++j) statistics.simplices_per_dim[k + j] += piece.complex.set_begin[j][1];
  statistics.oracle_evaluations += piece.traced.evaluations;
  statistics.seed_evaluations += piece.traced.seed_evaluations + piece.found.evaluations;
  statistics.distinct_vertices += piece.traced.num_vertices();
  statistics.exact_decisions += piece.traced.exact_decisions;
  return piece;
}

}  // namespace whitney::cli
