// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include <coxeter/base/error.h>
#include <whitney/atlas/glue_charts.h>
#include <whitney/cells/subdivide.h>
#include <whitney/cli/boundary_report.h>
#include <whitney/cli/report.h>
#include <whitney/cli/trace_piece.h>
#include <whitney/io/atomic_file.h>
#include <whitney/io/write_mesh.h>
#include <whitney/tracing/cut_regularity.h>

namespace whitney::cli {
namespace {

ChartStatistics statistics_of(const Chart& chart, const TracedPiece& piece, const CutRegularity& regularity) {
  ChartStatistics out;
  out.name = chart.name;
  out.simplices = piece.traced.num_simplices();
  for (const Stratum& stratum : piece.strata.strata) ++out.strata_per_dim[stratum.dim];
  out.smallest_singular_value = regularity.smallest_singular_value;
  for (const SingularCut& cut : regularity.singular) out.singular_points.push_back(cut.point);
  return out;
}

}  // namespace

int run_trace_charts(const Problem& problem, const TraceArguments& arguments) {
  const ChartAtlas& atlas = *problem.atlas;
  const int d = problem.ambient_dim(), k = problem.codim(), n = d - k;
  if (n != 1 && n != 2)
    throw InvalidInput(arguments.problem + ": " + std::to_string(k) + " equations in " + std::to_string(d) +
                       " variables: only curves and surfaces (dimension 1 and 2) can be glued");
  if (arguments.mesh == "cells") throw InvalidInput("--mesh cells: charts are glued as simplices; take pulled");
  if (!arguments.strata.empty()) throw InvalidInput("--strata does not go with charts: their seams are no strata");
  check_outputs(arguments.outputs, arguments.stats, n, false);
  const double edge_length = edge_length_of(arguments, problem, to_box(atlas.charts[0].box));
  const coxeter::Triangulation triangulation = make_triangulation(problem.triangulation, d, edge_length);

  Stopwatch watch;
  Statistics statistics;
  std::vector<ChartPiece> pieces;
  StopReason stop = StopReason::kNone;
  std::size_t found = 0;
  double seconds = 0;
  bool singular = false, searched = false;
  for (const Chart& chart : atlas.charts) {
    const TracedPiece piece = trace_piece({arguments.problem + ": chart \"" + chart.name + "\"", chart.function,
                                           chart.inequalities, to_box(chart.box), chart.seed_points},
                                          triangulation, arguments, found, seconds, watch, statistics);
    found += piece.traced.num_simplices();
    seconds += piece.traced.seconds;
    searched = searched || piece.searched;
    if (piece.traced.stop_reason != StopReason::kNone && stop != StopReason::kMaxSimplices)
      stop = piece.traced.stop_reason;
    const CutRegularity regularity = check_cuts(chart.function, piece.traced, edge_length);
    const CutRegularity interior = check_interior(chart.function, piece.traced, edge_length);
    for (const SingularCut& point : interior.singular) statistics.interior_singular_points.push_back(point.point);
    statistics.interior_singular_value = std::min(statistics.interior_singular_value, interior.smallest_singular_value);
    singular = singular || !regularity.singular.empty() || !interior.singular.empty();
    statistics.charts.push_back(statistics_of(chart, piece, regularity));
    pieces.push_back(chart_piece(chart.name,
                                 arguments.mesh == "barycentric" ? barycentric_subdivision(piece.complex, &piece.strata)
                                                                 : pulled_subdivision(piece.complex, &piece.strata),
                                 piece.strata));
    statistics.seconds["mesh"] += watch.lap();
    if (stop != StopReason::kNone && stop != StopReason::kBox) break;
  }
  if (found == 0)
    throw InvalidInput(arguments.problem + ": no chart holds a point of the manifold that could be found");

  // Pieces that a limit cut short do not fit together: they are written side by side.
  const bool stopped = stop != StopReason::kNone && stop != StopReason::kBox;
  GlueOptions options;
  options.embeddings = atlas.embeddings;
  options.embeddings.resize(std::min(options.embeddings.size(), pieces.size()));
  options.embedding_dim = atlas.embedding_dim();
  GluedMesh glued;
  try {
    glued = glue_charts(pieces, stopped ? std::span<const Seam>() : std::span<const Seam>(atlas.seams), options);
  } catch (const SeamMismatch& mismatch) {
    std::string text = arguments.problem + ": the charts do not fit together at edge length " +
                       std::to_string(edge_length) + ", nothing is written: " + mismatch.what();
    for (const ChartStatistics& chart : statistics.charts)
      for (const auto& point : chart.singular_points)
        text += "\n  the boundary of chart \"" + chart.name + "\" is singular at " + point_text(point) +
                ": the charts need other domains (of a projective variety: other weights)";
    std::cerr << "whitney: " << text << "\n";
    return kSingular;
  }
  statistics.seconds["glue"] = watch.lap();
  statistics.topology = topology_of(glued.mesh);
  statistics.seconds["topology"] = watch.lap();
  for (std::size_t s = 0; s < glued.seams.size(); ++s) {
    const SeamReport& seam = glued.seams[s];
    statistics.seams.push_back({atlas.charts[atlas.seams[s].first_chart].name,
                                atlas.charts[atlas.seams[s].second_chart].name, seam.num_corners, seam.num_arcs,
                                seam.num_loops, seam.worst_distance});
  }

  MeshWriteOptions write_options;
  write_options.projection = arguments.projection;
  write_options.variables = atlas.embedding_variables.empty() ? atlas.variables : atlas.embedding_variables;
  write_options.color_by = arguments.color_by;
  const std::string failed = write_outputs(arguments.outputs, glued.mesh, nullptr, write_options);
  statistics.seconds["write"] = watch.lap();
  statistics.ambient_dim = d;
  statistics.intrinsic_dim = n;
  statistics.edge_length = edge_length;
  statistics.stop_reason = to_string(stop);
  if (!arguments.stats.empty()) write_file(arguments.stats, to_json(statistics));

  if (!arguments.quiet) {
    std::cout << atlas.charts.size() << " charts in R^" << d << ", " << k << (k == 1 ? " equation" : " equations")
              << ", edge length " << edge_length << ": " << found << " simplices of dimension " << k
              << " meet the zero sets, " << statistics.oracle_evaluations << " evaluations, " << seconds << " s\n";
    for (const SeamStatistics& seam : statistics.seams)
      std::cout << "  seam of " << seam.first << " and " << seam.second << ": " << seam.corners << " corners, "
                << seam.arcs << " arcs, " << seam.loops << " loops, at most " << seam.worst_distance << " apart\n";
    std::cout << describe(statistics.topology, n);
    if (searched) std::cout << "seeds were searched for: that every component was found is likely, not proved\n";
    for (const ChartStatistics& chart : statistics.charts)
      for (const auto& point : chart.singular_points)
        std::cout << "the boundary of chart " << chart.name << " is SINGULAR at " << point_text(point)
                  << ": what was glued there is one resolution of it among several\n";
    std::cout << too_small_text(statistics);
    for (const auto& point : statistics.interior_singular_points)
      std::cout << "the zero set of a chart is SINGULAR at " << point_text(point) << ", in the chart's coordinates\n";
    if (stopped) std::cout << "stopped early (" << statistics.stop_reason << "): the pieces are not glued\n";
    if (stop == StopReason::kBox) std::cout << "the manifold reaches the box of a chart and was cut there\n";
    for (const std::string& file : arguments.outputs) std::cout << "written: " << file << "\n";
    if (!arguments.stats.empty()) std::cout << "written: " << arguments.stats << "\n";
  }
  if (!failed.empty()) throw FileError(failed);
  if (stopped) return kStopped;
  return singular ? kSingular : kDone;
}

}  // namespace whitney::cli
