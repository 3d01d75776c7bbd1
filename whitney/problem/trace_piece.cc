// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/trace_piece.h>

#include <algorithm>

#include <coxeter/base/error.h>
#include <whitney/tracing/cut_regularity.h>
#include <whitney/tracing/trace.h>

namespace whitney {
namespace {

void count_seeds(const TracedPiece& piece, Report& report) {
  SeedSummary& seeds = report.seeds;
  seeds.searched = seeds.searched || piece.searched;
  seeds.num_starts += piece.found.num_starts;
  for (std::size_t i = 0; i < piece.traced.seeds.size(); ++i) {
    const SeedReport& seed = piece.traced.seeds[i];
    seeds.num_used += seed.outcome == SeedReport::Outcome::kUsed;
    seeds.num_merged += seed.outcome == SeedReport::Outcome::kMerged;
    seeds.num_dropped += seed.outcome == SeedReport::Outcome::kDropped;
    if (seed.outcome == SeedReport::Outcome::kTooSmall) {
      if (seeds.num_too_small++ == 0) seeds.too_small_point = seed.unseen;
      if (seed.finer_edge_length > 0)
        seeds.finer_edge_length = seeds.finer_edge_length > 0
                                      ? std::min(seeds.finer_edge_length, seed.finer_edge_length)
                                      : seed.finer_edge_length;
    }
    if (!piece.searched && seed.outcome == SeedReport::Outcome::kDropped)
      seeds.dropped.push_back("seed point " + std::to_string(i + 1) + " dropped: " + seed.reason);
  }
}

}  // namespace

double edge_length_of(const std::optional<double>& asked, const std::optional<double>& of_problem,
                      const std::optional<Box>& box) {
  if (asked) return *asked;
  if (of_problem) return *of_problem;
  if (!box)
    throw InvalidInput("no edge length: give triangulation.edge_length, --edge-length, or a box to take it from");
  double side = 0;
  for (std::size_t c = 0; c < box->lower.size(); ++c) side = std::max(side, box->upper[c] - box->lower[c]);
  return side / 30;
}

void search_interior(const Function& f, const TraceResult& traced, double edge_length, Budget& budget, Report& report) {
  if (!budget.allows("singular points of the interior", 0)) {
    report.interior_searched = false;
    return;
  }
  const CutRegularity interior = check_interior(f, traced, edge_length);
  report.interior_searched = interior.searched;
  for (const SingularCut& point : interior.singular) report.interior_singular_points.push_back(point.point);
  report.interior_singular_value = std::min(report.interior_singular_value, interior.smallest_singular_value);
}

std::string TracedPiece::why_empty() const {
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

TracedPiece trace_piece(const ZeroSetPiece& zero_set, const coxeter::Triangulation& triangulation,
                        std::size_t found_before, double work_bytes, Budget& budget, Report& report) {
  const int d = zero_set.function.ambient_dim(), k = zero_set.function.codim(), n = d - k;
  TracedPiece piece;
  std::vector<double> seed_points;
  for (const auto& point : zero_set.seed_points) seed_points.insert(seed_points.end(), point.begin(), point.end());
  piece.searched = seed_points.empty();
  if (piece.searched) {
    if (!zero_set.box) throw InvalidInput("give seed_points, or a box in which they can be searched for");
    FindSeedsOptions options;
    options.run = budget.rest(found_before);
    piece.found = find_seeds(zero_set.function, Domain(d, zero_set.inequalities, zero_set.box), options);
    piece.stop_reason = budget.ended(piece.found.stop_reason);
    seed_points = piece.found.points;
  }
  budget.lap(report.seconds, "seeds");

  TraceOptions options;
  options.inequalities = zero_set.inequalities;
  options.box = zero_set.box;
  options.run = budget.rest(found_before, work_bytes);
  piece.traced = trace(zero_set.function, triangulation, seed_points, options);
  const StopReason reason = budget.ended(piece.traced.stop_reason);
  if (piece.stop_reason == StopReason::kNone) piece.stop_reason = reason;
  report.cut_short = report.cut_short || budget.stopped();
  budget.lap(report.seconds, "trace");
  piece.complex = cell_complex(piece.traced);
  piece.strata = strata_of(piece.complex);
  budget.lap(report.seconds, "complex");

  count_seeds(piece, report);
  report.simplices_met += piece.traced.num_simplices();
  for (int j = 0; j <= n; ++j) report.simplices_per_dim[k + j] += piece.complex.set_begin[j][1];
  report.oracle_evaluations += piece.traced.evaluations;
  report.seed_evaluations += piece.traced.seed_evaluations + piece.found.evaluations;
  report.distinct_vertices += piece.traced.num_vertices();
  report.exact_decisions += piece.traced.exact_decisions;
  report.whole_cells = report.whole_cells && piece.traced.whole;
  return piece;
}

}  // namespace whitney
