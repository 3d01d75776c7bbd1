// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <new>

#include <CLI/CLI.hpp>

#include <whitney/cli/commands.h>

#ifdef __SANITIZE_ADDRESS__
// libcln, behind GiNaC, leaks 26 bytes when a program starts.
extern "C" const char* __lsan_default_suppressions() { return "leak:libcln"; }
#endif

namespace {

using namespace whitney::cli;

void add_topology_option(CLI::App& command, std::string& topology) {
  command
      .add_option("--topology", topology,
                  "of the mesh: none, euler (counts, components, orientability), full (also links and homology)")
      ->check(CLI::IsMember({"none", "euler", "full"}))
      ->capture_default_str();
}

void add_limits(CLI::App& command, LimitArguments& limits) {
  command
      .add_option("--time-limit", limits.time_limit,
                  "stop the search after so many seconds, write what was found, and leave out what comes after")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--memory-limit", limits.memory_limit,
                  "bytes, or 500M, 2G: stop the search, and leave out parts, that would need more (default: what the "
                  "machine has free)")
      ->transform(CLI::AsSizeValue(false));
}

CLI::App* add_trace(CLI::App& app, TraceArguments& trace) {
  CLI::App* trace_command = app.add_subcommand(
      "trace", "Trace the zero set of equations: a piecewise-linear manifold, its topology and a mesh of it");
  trace_command
      ->add_option("PROBLEM", trace.problem,
                   "problem file (JSON): equations and inequalities, charts, or a projective variety; see README")
      ->required();
  trace_command
      ->add_option("-o,--output", trace.outputs,
                   "mesh file, format by extension: .off .ply .obj .stl .vtu .mesh .noff .pov; repeatable")
      ->take_all()
      ->expected(1);
  trace_command->add_option("--stats", trace.stats, "write counts, topology and timings to this JSON file");
  trace_command->add_option("--strata", trace.strata,
                            "write each stratum of a manifold with boundary to a file of its own: NAME.vtu gives "
                            "NAME_0.vtu, NAME_1.vtu, .. (numbers as in the statistics)");
  trace_command
      ->add_option("--edge-length", trace.edge_length,
                   "longest edge of the ambient simplices, a length; overrides the problem file (default there: "
                   "longest side of the box / 30)")
      ->check(CLI::PositiveNumber);
  trace_command
      ->add_option("--mesh", trace.mesh,
                   "what is written: pulled (simplices, no new vertices), barycentric, or cells (the polygons, n <= 2)")
      ->check(CLI::IsMember({"pulled", "barycentric", "cells"}))
      ->capture_default_str();
  add_topology_option(*trace_command, trace.topology);
  trace_command->add_option("--max-simplices", trace.limits.max_simplices, "stop after so many simplices")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_limits(*trace_command, trace.limits);
  trace_command
      ->add_option("--project", trace.projection,
                   "how R^d, d > 3, becomes R^3: pca, or three variables i,j,k (numbers from 1, or names)")
      ->capture_default_str();
  trace_command->add_option("--color-by", trace.color_by, "variable that colours the vertices (.ply, .pov)");
  trace_command->add_flag("-q,--quiet", trace.quiet, "print nothing but errors");
  return trace_command;
}

CLI::App* add_triangulate(CLI::App& app, TriangulateArguments& triangulate) {
  CLI::App* triangulate_command = app.add_subcommand(
      "triangulate",
      "Whitney's construction: an embedded complex with a proof that it is homeomorphic to the manifold");
  triangulate_command
      ->add_option("PROBLEM", triangulate.problem,
                   "problem file (JSON): a named manifold, a parametrization or equations; see README")
      ->required();
  triangulate_command
      ->add_option("-o,--output", triangulate.outputs,
                   "mesh file, format by extension: .off .ply .obj .stl .vtu .mesh .noff .pov; repeatable")
      ->take_all()
      ->expected(1);
  triangulate_command->add_option("--stats", triangulate.stats,
                                  "write the certificate, counts, topology and timings to this JSON file");
  triangulate_command->add_option("--ambient", triangulate.ambient,
                                  "write the subdivided ambient simplices around the manifold, d <= 4 (.vtu, .mesh, "
                                  ".noff); the complex is part of it");
  triangulate_command->add_option("--inside", triangulate.inside,
                                  "write the inside of a closed hypersurface as simplices of dimension d <= 4 (.vtu, "
                                  ".mesh, .noff); the complex is its boundary");
  triangulate_command
      ->add_option("--edge-length", triangulate.edge_length,
                   "longest edge of the ambient simplices, a length; overrides the problem file (default there: "
                   "searched for, from the reach downwards)")
      ->check(CLI::PositiveNumber);
  triangulate_command->add_flag("--auto-refine", triangulate.auto_refine,
                                "halve the edge length until the result is certified (at most 8 attempts)");
  triangulate_command
      ->add_option(
          "--scheme", triangulate.scheme,
          "how the vertices of the triangulation are displaced: repair, sequential (BKW20's own; needs smaller "
          "edge lengths), none")
      ->check(CLI::IsMember({"repair", "sequential", "none"}))
      ->capture_default_str();
  triangulate_command->add_option("--max-rounds", triangulate.max_rounds, "rounds of the repair")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  triangulate_command
      ->add_option("--mesh", triangulate.mesh,
                   "what is written: barycentric (K), pulled (no new vertices), or cells (the polygons, n <= 2)")
      ->check(CLI::IsMember({"pulled", "barycentric", "cells"}))
      ->capture_default_str();
  add_topology_option(*triangulate_command, triangulate.topology);
  triangulate_command->add_option("--max-simplices", triangulate.limits.max_simplices, "stop after so many d-simplices")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_limits(*triangulate_command, triangulate.limits);
  triangulate_command
      ->add_option("--project", triangulate.projection,
                   "how R^d, d > 3, becomes R^3: pca, or three variables i,j,k (numbers from 1, or names)")
      ->capture_default_str();
  triangulate_command->add_option("--color-by", triangulate.color_by,
                                  "variable that colours the vertices (.ply, .pov)");
  triangulate_command->add_flag("-q,--quiet", triangulate.quiet, "print nothing but errors");
  return triangulate_command;
}

CLI::App* add_check(CLI::App& app, CheckArguments& check) {
  CLI::App* check_command =
      app.add_subcommand("check", "Topology of a mesh file: is it a manifold, Euler characteristic, homology");
  check_command->add_option("MESH", check.mesh, "mesh file: .off .noff .ply .obj .stl .mesh .vtu")->required();
  check_command->add_option("--stats", check.stats, "write the results to this JSON file");
  add_topology_option(*check_command, check.topology);
  add_limits(*check_command, check.limits);
  check_command->add_flag("-q,--quiet", check.quiet, "print nothing but errors");
  return check_command;
}

CLI::App* add_parameters(CLI::App& app, ParametersArguments& parameters) {
  CLI::App* parameters_command = app.add_subcommand(
      "parameters", "The constants of Boissonnat, Kachanovich and Wintraecken, as printed and corrected, in log10");
  parameters_command->add_option("--ambient", parameters.ambient_dim, "dimension d of the ambient space")->required();
  parameters_command->add_option("--intrinsic", parameters.intrinsic_dim, "dimension n of the manifold, 1 <= n < d")
      ->required();
  parameters_command->add_option("--stats", parameters.stats, "write the constants to this JSON file");
  return parameters_command;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Triangulates smooth submanifolds of R^d of any dimension and codimension.\n"
      "\n"
      "Exit status: 0 done (and certified, where that was asked for); 1 bad input, named with file, key and\n"
      "reason, or a file that could not be written; 2 stopped by a limit or a signal, what was found is written\n"
      "and what was left out is named; 3 done, but not certified, violated or singular, or the mesh checked is\n"
      "not a manifold: mesh and witness are written. No file is ever left half written.",
      "whitney"};
  app.set_version_flag("--version", std::string("whitney ") + WHITNEY_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  app.get_formatter()->column_width(34);

  TraceArguments trace;
  TriangulateArguments triangulate;
  CheckArguments check;
  ParametersArguments parameters;
  const CLI::App* const trace_command = add_trace(app, trace);
  const CLI::App* const triangulate_command = add_triangulate(app, triangulate);
  add_check(app, check);
  const CLI::App* const parameters_command = add_parameters(app, parameters);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kBadInput;
  }
  try {
    if (trace_command->parsed()) return run_trace(trace);
    if (triangulate_command->parsed()) return run_triangulate(triangulate);
    if (parameters_command->parsed()) return run_parameters(parameters);
    return run_check(check);
  } catch (const std::bad_alloc&) {
    std::cerr << "whitney: stopped early (memory_limit), out of memory: nothing more is written; a larger edge length "
                 "or a smaller --max-simplices helps\n";
    return kStopped;
  } catch (const std::exception& error) {
    std::cerr << "whitney: " << error.what() << "\n";
  }
  return kBadInput;
}
