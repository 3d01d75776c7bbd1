// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <sstream>

#include <coxeter/base/error.h>
#include <whitney/cli/commands.h>
#include <whitney/cli/describe.h>
#include <whitney/cli/session.h>
#include <whitney/io/atomic_file.h>
#include <whitney/io/output_files.h>
#include <whitney/io/read_problem.h>
#include <whitney/io/write_report.h>
#include <whitney/problem/trace_problem.h>

namespace whitney::cli {
namespace {

/// Refuses before the work begins what can be refused then.
void check_outputs(const TraceArguments& arguments, const Problem& problem) {
  std::vector<std::string> files = arguments.outputs;
  files.push_back(arguments.stats);
  check_output_files(arguments.problem, files);
  const int n = problem.ambient_dim() - problem.codim();
  for (const std::string& file : arguments.outputs) check_mesh_format(file, n, arguments.mesh == "cells");
  if (arguments.strata.empty()) return;
  if (problem.atlas) throw InvalidInput("--strata does not go with charts: their seams are no strata");
  check_strata_pattern(arguments.problem, files, arguments.strata, n);
}

std::string describe(const Problem& problem, const TracedProblem& result) {
  const Report& report = result.report;
  const int d = problem.ambient_dim(), k = problem.codim();
  const std::string equations = std::to_string(k) + (k == 1 ? " equation" : " equations");
  std::ostringstream text;
  const double seconds = report.seconds.contains("trace") ? report.seconds.at("trace") : 0;
  if (problem.atlas)
    text << problem.atlas->charts.size() << " charts in R^" << d << ", " << equations << ", edge length "
         << *report.edge_length << ": " << report.simplices_met << " simplices of dimension " << k
         << " meet the zero sets, " << report.oracle_evaluations << " evaluations, " << seconds << " s\n"
         << describe_seams(report);
  else
    text << "R^" << d << ", " << equations << ", edge length " << *report.edge_length << ": " << report.simplices_met
         << " simplices of dimension " << k << " meet the zero set, f evaluated at " << report.oracle_evaluations
         << " lattice vertices, " << seconds << " s\n";
  text << describe_topology(report) << describe_seeds(report) << describe_singular_points(report);
  if (report.boundary) text << describe_boundary(*report.boundary);
  text << describe_singular_charts(report) << describe_stop(report);
  return text.str();
}

/// What to say when there is no mesh.
int report_nothing(const TraceArguments& arguments, const TracedProblem& result) {
  if (!result.report.stopped() && result.outcome == TracedProblem::Outcome::kNothingFound)
    throw InvalidInput(arguments.problem + ": " + result.explanation);
  if (!arguments.stats.empty()) write_file(arguments.stats, to_json(result.report));
  if (result.outcome == TracedProblem::Outcome::kSeamsDisagree) {
    std::cerr << "whitney: " << arguments.problem << ": " << result.explanation << "\n";
    return kNotProved;
  }
  std::cerr << "whitney: " << arguments.problem << ": stopped early (" << to_string(result.report.stop_reason)
            << "), nothing is written" << (result.explanation.empty() ? "" : ": " + result.explanation) << "\n"
            << describe_stop(result.report);
  return kStopped;
}

}  // namespace

int run_trace(const TraceArguments& arguments) {
  const Problem problem = read_problem(arguments.problem);
  check_outputs(arguments, problem);
  const InterruptGuard guard;
  ProgressLine line(arguments.quiet);
  MeshWriteOptions write_options;
  write_options.projection = arguments.projection;
  write_options.color_by = arguments.color_by;
  std::vector<std::string> written, failed;

  TraceProblemOptions options;
  options.edge_length = arguments.edge_length;
  options.mesh = mesh_kind(arguments.mesh);
  options.topology = topology_level(arguments.topology);
  options.always_label_strata = !arguments.strata.empty();
  options.run = run_control(arguments.limits, guard, line);
  options.mesh_ready = [&](const TracedProblem& result) {
    write_options.variables = result.variables;
    failed = write_meshes(arguments.outputs, result.mesh, result.cells ? &*result.cells : nullptr, write_options);
    written = without_failed(arguments.outputs, failed);
    if (arguments.strata.empty()) return;
    const WrittenStrata strata = write_strata(arguments.strata, result.mesh, result.num_strata, write_options);
    written.insert(written.end(), strata.files.begin(), strata.files.end());
    failed.insert(failed.end(), strata.failed.begin(), strata.failed.end());
  };
  const TracedProblem result = with_file(arguments.problem, [&] { return trace_problem(problem, options); });
  line.end();
  if (result.mesh.num_points() == 0) return report_nothing(arguments, result);

  if (!arguments.stats.empty()) {
    write_file(arguments.stats, to_json(result.report));
    written.push_back(arguments.stats);
  }
  if (!arguments.quiet) std::cout << describe(problem, result);
  finish_files(written, failed, arguments.quiet);
  if (result.report.stopped()) return kStopped;
  return result.report.singular() ? kNotProved : kDone;
}

}  // namespace whitney::cli
