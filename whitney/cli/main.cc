// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <new>

#include <CLI/CLI.hpp>

#include <whitney/cli/commands.h>

#ifdef __SANITIZE_ADDRESS__
// libcln, behind GiNaC, leaks 26 bytes when a program starts.
extern "C" const char* __lsan_default_suppressions() { return "leak:libcln"; }
#endif

int main(int argc, char** argv) {
  using namespace whitney::cli;
  CLI::App app{
      "Triangulates smooth submanifolds of R^d of any dimension and codimension.\n"
      "\n"
      "Exit status: 0 done; 1 bad input, named with file, key and reason; 2 stopped by a limit, what was\n"
      "found is written; 3 the mesh checked is not a manifold, or the triangulation is not certified (it is\n"
      "written, with what stands in the way). No file is ever left half written.",
      "whitney"};
  app.set_version_flag("--version", std::string("whitney ") + WHITNEY_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  app.get_formatter()->column_width(34);

  TraceArguments trace;
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
  trace_command->add_option("--max-simplices", trace.max_simplices, "stop after so many simplices")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  trace_command->add_option("--time-limit", trace.time_limit, "stop tracing after so many seconds")
      ->check(CLI::NonNegativeNumber);
  trace_command
      ->add_option("--project", trace.projection,
                   "how R^d, d > 3, becomes R^3: pca, or three variables i,j,k (numbers from 1, or names)")
      ->capture_default_str();
  trace_command->add_option("--color-by", trace.color_by, "variable that colours the vertices (.ply, .pov)");
  trace_command->add_flag("-q,--quiet", trace.quiet, "print nothing but errors");

  TriangulateArguments triangulate;
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
  triangulate_command->add_option("--max-simplices", triangulate.max_simplices, "stop after so many d-simplices")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  triangulate_command
      ->add_option("--time-limit", triangulate.time_limit, "stop displacing vertices after so many seconds")
      ->check(CLI::NonNegativeNumber);
  triangulate_command
      ->add_option("--project", triangulate.projection,
                   "how R^d, d > 3, becomes R^3: pca, or three variables i,j,k (numbers from 1, or names)")
      ->capture_default_str();
  triangulate_command->add_option("--color-by", triangulate.color_by,
                                  "variable that colours the vertices (.ply, .pov)");
  triangulate_command->add_flag("-q,--quiet", triangulate.quiet, "print nothing but errors");

  CheckArguments check;
  CLI::App* check_command =
      app.add_subcommand("check", "Topology of a mesh file: is it a manifold, Euler characteristic, homology");
  check_command->add_option("MESH", check.mesh, "mesh file: .off .noff .ply .obj .stl .mesh .vtu")->required();
  check_command->add_option("--stats", check.stats, "write the results to this JSON file");
  check_command->add_flag("-q,--quiet", check.quiet, "print nothing but errors");

  ParametersArguments parameters;
  CLI::App* parameters_command = app.add_subcommand(
      "parameters", "The constants of Boissonnat, Kachanovich and Wintraecken, as printed and corrected, in log10");
  parameters_command->add_option("--ambient", parameters.ambient_dim, "dimension d of the ambient space")->required();
  parameters_command->add_option("--intrinsic", parameters.intrinsic_dim, "dimension n of the manifold, 1 <= n < d")
      ->required();
  parameters_command->add_option("--stats", parameters.stats, "write the constants to this JSON file");

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
    std::cerr << "whitney: out of memory; a larger --edge-length or --max-simplices helps\n";
  } catch (const std::exception& error) {
    std::cerr << "whitney: " << error.what() << "\n";
  }
  return kBadInput;
}
