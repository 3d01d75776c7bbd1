// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/trace_atlas.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <coxeter/base/error.h>
#include <whitney/atlas/glue_charts.h>
#include <whitney/cells/subdivide.h>
#include <whitney/problem/budget.h>
#include <whitney/problem/memory_estimate.h>
#include <whitney/problem/mesh_topology.h>
#include <whitney/problem/trace_piece.h>
#include <whitney/tracing/cut_regularity.h>

namespace whitney {
namespace {

ChartSummary summarize(const Chart& chart, const TracedPiece& piece, const CutRegularity& regularity) {
  ChartSummary out;
  out.name = chart.name;
  out.simplices = piece.traced.num_simplices();
  for (const Stratum& stratum : piece.strata.strata) ++out.strata_per_dim[stratum.dim];
  out.smallest_singular_value = regularity.smallest_singular_value;
  for (const SingularCut& cut : regularity.singular) out.singular_points.push_back(cut.point);
  return out;
}

/// Traces chart by chart, until a limit stops it; the pieces of those that were reached.
std::vector<ChartPiece> trace_charts(const ChartAtlas& atlas, const coxeter::Triangulation& triangulation,
                                     const TraceProblemOptions& options, Budget& budget, Report& report) {
  const double bytes = work_bytes_per_simplex(atlas.ambient_dim(), atlas.codim(), options.mesh);
  std::vector<ChartPiece> pieces;
  for (const Chart& chart : atlas.charts) {
    TracedPiece piece;
    try {
      piece = trace_piece({chart.function, chart.inequalities, to_box(chart.box), chart.seed_points}, triangulation,
                          report.simplices_met, bytes, budget, report);
    } catch (const InvalidInput& error) {
      throw InvalidInput("chart \"" + chart.name + "\": " + error.what());
    }
    const CutRegularity regularity = check_cuts(chart.function, piece.traced, triangulation.edge_length());
    search_interior(chart.function, piece.traced, triangulation.edge_length(), budget, report);
    report.charts.push_back(summarize(chart, piece, regularity));
    pieces.push_back(chart_piece(chart.name,
                                 options.mesh == MeshKind::kBarycentric
                                     ? barycentric_subdivision(piece.complex, &piece.strata)
                                     : pulled_subdivision(piece.complex, &piece.strata),
                                 piece.strata));
    budget.lap(report.seconds, "mesh");
    if (budget.stopped()) break;
  }
  return pieces;
}

std::string mismatch_text(const SeamMismatch& mismatch, double edge_length, const Report& report) {
  std::string text = "the charts do not fit together at edge length " + std::to_string(edge_length) +
                     ", nothing is written: " + mismatch.what();
  for (const ChartSummary& chart : report.charts)
    for (const auto& point : chart.singular_points)
      text += "\n  the boundary of chart \"" + chart.name + "\" is singular at " + point_text(point) +
              ": the charts need other domains (of a projective variety: other weights)";
  return text;
}

}  // namespace

TracedProblem trace_atlas(const Problem& problem, const TraceProblemOptions& options) {
  if (!problem.atlas) throw InvalidInput("trace_atlas: the problem is not made of charts");
  const ChartAtlas& atlas = *problem.atlas;
  const int d = problem.ambient_dim(), k = problem.codim(), n = d - k;
  if (n != 1 && n != 2)
    throw InvalidInput(std::to_string(k) + " equations in " + std::to_string(d) +
                       " variables: only curves and surfaces (dimension 1 and 2) can be glued");
  if (options.mesh == MeshKind::kCells)
    throw InvalidInput("mesh: charts are glued as simplices, not as cells: take pulled");
  const double edge_length =
      edge_length_of(options.edge_length, problem.triangulation.edge_length, to_box(atlas.charts[0].box));
  const coxeter::Triangulation triangulation = make_triangulation(problem.triangulation, d, edge_length);

  Budget budget(options.run);
  TracedProblem result;
  Report& report = result.report;
  report.ambient_dim = d;
  report.intrinsic_dim = n;
  report.edge_length = edge_length;
  report.topology_level = TopologyLevel::kNone;
  result.variables = atlas.embedding_variables.empty() ? atlas.variables : atlas.embedding_variables;
  const std::vector<ChartPiece> pieces = trace_charts(atlas, triangulation, options, budget, report);
  const auto finish = [&](TracedProblem::Outcome outcome, std::string explanation) {
    result.outcome = outcome;
    result.explanation = std::move(explanation);
    report.stop_reason = budget.stop_reason();
    report.left_out = budget.left_out();
    return std::move(result);
  };
  if (report.simplices_met == 0)
    return finish(TracedProblem::Outcome::kNothingFound, "no chart holds a point of the manifold that could be found");

  // Pieces that a limit cut short do not fit together.
  GlueOptions glue;
  glue.embeddings = atlas.embeddings;
  glue.embeddings.resize(std::min(glue.embeddings.size(), pieces.size()));
  glue.embedding_dim = atlas.embedding_dim();
  GluedMesh glued;
  try {
    glued = glue_charts(pieces, budget.stopped() ? std::span<const Seam>() : std::span<const Seam>(atlas.seams), glue);
  } catch (const SeamMismatch& mismatch) {
    return finish(TracedProblem::Outcome::kSeamsDisagree, mismatch_text(mismatch, edge_length, report));
  }
  budget.lap(report.seconds, "glue");
  for (std::size_t s = 0; s < glued.seams.size(); ++s) {
    const SeamReport& seam = glued.seams[s];
    report.seams.push_back({atlas.charts[atlas.seams[s].first_chart].name,
                            atlas.charts[atlas.seams[s].second_chart].name, seam.num_corners, seam.num_arcs,
                            seam.num_loops, seam.worst_distance});
  }
  result.mesh = std::move(glued.mesh);
  if (options.mesh_ready) options.mesh_ready(result);
  budget.lap(report.seconds, "write");
  report_topology(result.mesh, options.topology, budget, report);
  budget.lap(report.seconds, "topology");
  return finish(TracedProblem::Outcome::kTraced, "");
}

}  // namespace whitney
