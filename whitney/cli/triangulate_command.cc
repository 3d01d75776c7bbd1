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
#include <whitney/problem/triangulate_problem.h>

namespace whitney::cli {
namespace {

/// Refuses before the work begins what can be refused then.
void check_outputs(const TriangulateArguments& arguments, const Problem& problem) {
  std::vector<std::string> files = arguments.outputs;
  files.insert(files.end(), {arguments.stats, arguments.ambient, arguments.inside});
  check_output_files(arguments.problem, files);
  if (problem.atlas) return;  // refused for another reason
  const int d = problem.ambient_dim(), n = d - problem.codim();
  for (const std::string& file : arguments.outputs) check_mesh_format(file, n, arguments.mesh == "cells");
  for (const std::string& file : {arguments.ambient, arguments.inside})
    if (!file.empty() && d >= 2 && d <= 4) check_mesh_format(file, d, false);
}

std::string describe(const TriangulatedProblem& result) {
  const Report& report = result.report;
  std::ostringstream text;
  for (std::size_t i = 0; i + 1 < result.attempts.size(); ++i)
    text << "edge length " << result.attempts[i].edge_length << ": " << to_string(result.attempts[i].verdict) << " ("
         << result.attempts[i].not_certified << " of " << result.attempts[i].simplices << " simplices), refined\n";
  text << "R^" << report.ambient_dim << ", edge length " << *report.edge_length << ", "
       << report.seconds.at("perturb") + report.seconds.at("certify") + report.seconds.at("complex") << " s\n"
       << describe_certificate(report) << describe_topology(report);
  if (report.quality) text << describe_quality(*report.quality);
  text << describe_stop(report);
  return text.str();
}

/// What to say when there is no mesh.
int report_nothing(const TriangulateArguments& arguments, const TriangulatedProblem& result) {
  if (!result.report.stopped()) throw InvalidInput(arguments.problem + ": " + result.explanation);
  if (!arguments.stats.empty()) write_file(arguments.stats, to_json(result.report));
  std::cerr << "whitney: " << arguments.problem << ": stopped early (" << to_string(result.report.stop_reason)
            << "), nothing is written" << (result.explanation.empty() ? "" : ": " + result.explanation) << "\n"
            << describe_stop(result.report);
  return kStopped;
}

}  // namespace

int run_triangulate(const TriangulateArguments& arguments) {
  using Scheme = TriangulateOptions::Scheme;
  const Problem problem = read_problem(arguments.problem);
  check_outputs(arguments, problem);
  const InterruptGuard guard;
  ProgressLine line(arguments.quiet);
  MeshWriteOptions write_options;
  write_options.projection = arguments.projection;
  std::vector<std::string> written, failed;

  TriangulateProblemOptions options;
  options.edge_length = arguments.edge_length;
  options.auto_refine = arguments.auto_refine;
  options.scheme = arguments.scheme == "none"         ? Scheme::kNone
                   : arguments.scheme == "sequential" ? Scheme::kSequential
                                                      : Scheme::kRepair;
  options.max_rounds = arguments.max_rounds;
  options.mesh = mesh_kind(arguments.mesh);
  options.topology = topology_level(arguments.topology);
  options.ambient = !arguments.ambient.empty();
  options.inside = !arguments.inside.empty();
  options.run = run_control(arguments.limits, guard, line);
  options.mesh_ready = [&](const TriangulatedProblem& result) {
    write_options.variables = result.variables;
    write_options.color_by = arguments.color_by;
    failed = write_meshes(arguments.outputs, result.mesh, result.cells ? &*result.cells : nullptr, write_options);
    write_options.color_by.clear();
    std::vector<std::string> files = arguments.outputs;
    for (const auto& [file, solid] :
         {std::pair{&arguments.ambient, &result.ambient}, {&arguments.inside, &result.inside}}) {
      if (!*solid) continue;
      files.push_back(*file);
      for (std::string& line_of_it : write_meshes({*file}, **solid, nullptr, write_options))
        failed.push_back(std::move(line_of_it));
    }
    failed.insert(failed.end(), result.no_solids.begin(), result.no_solids.end());
    written = without_failed(files, failed);
  };
  const TriangulatedProblem result =
      with_file(arguments.problem, [&] { return triangulate_problem(problem, options); });
  line.end();
  const bool nothing = result.outcome != TriangulatedProblem::Outcome::kTriangulated;
  if (nothing || (result.mesh.num_points() == 0 && result.report.stopped())) return report_nothing(arguments, result);

  if (!arguments.stats.empty()) {
    write_file(arguments.stats, to_json(result.report));
    written.push_back(arguments.stats);
  }
  if (!arguments.quiet) std::cout << describe(result);
  finish_files(written, failed, arguments.quiet);
  if (result.report.stopped()) return kStopped;
  return result.report.certificate->verdict == "certified" ? kDone : kNotProved;
}

}  // namespace whitney::cli
