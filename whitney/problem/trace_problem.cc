// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/trace_problem.h>

#include <algorithm>
#include <new>
#include <string>
#include <utility>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>
#include <whitney/problem/boundary_summary.h>
#include <whitney/problem/budget.h>
#include <whitney/problem/memory_estimate.h>
#include <whitney/problem/mesh_topology.h>
#include <whitney/problem/trace_atlas.h>
#include <whitney/problem/trace_piece.h>
#include <whitney/tracing/cut_regularity.h>
#include <whitney/tracing/orient_by_function.h>

namespace whitney {
namespace {

/// Seeds, trace, complex and mesh.
struct Traced {
  TracedProblem result;
  TracedPiece piece;
  bool labelled = false;
};

Traced trace_and_mesh(const Problem& problem, const TraceProblemOptions& options,
                      const coxeter::Triangulation& triangulation, Budget& budget) {
  const Function& function = *problem.function;
  const double bytes = work_bytes_per_simplex(function.ambient_dim(), function.codim(), options.mesh);
  Traced out;
  out.piece = trace_piece({function, problem.inequalities, problem.bounding_box(), problem.seed_points}, triangulation,
                          0, bytes, budget, out.result.report);
  if (out.piece.empty()) return out;
  const CellComplex& complex = out.piece.complex;
  const Strata& strata = out.piece.strata;
  out.labelled = strata.has_boundary() || options.always_label_strata;
  if (!budget.fits("mesh", mesh_bytes(complex, options.mesh))) return out;
  const Strata* const labels = out.labelled ? &strata : nullptr;
  SimplicialMesh mesh = options.mesh == MeshKind::kBarycentric ? barycentric_subdivision(complex, labels)
                                                               : pulled_subdivision(complex, labels);
  out.result.mesh = orient_by_function(std::move(mesh), function).mesh;
  if (options.mesh == MeshKind::kCells) out.result.cells = polygon_mesh(complex, labels);
  out.result.num_strata = labels != nullptr ? strata.strata.size() : 0;
  budget.lap(out.result.report.seconds, "mesh");
  return out;
}

/// The same; where memory is not enough in spite of all estimates, with half as many simplices, and so on.
Traced trace_what_fits(const Problem& problem, const TraceProblemOptions& options,
                       const coxeter::Triangulation& triangulation, Budget& budget) {
  for (;;) {
    try {
      return trace_and_mesh(problem, options, triangulation, budget);
    } catch (const std::bad_alloc&) {
      if (!budget.halve()) throw;
    }
  }
}

void check_zero_set(const Problem& problem) {
  if (!problem.function)
    throw InvalidInput("this manifold is given by its closest points, not as a zero set: use `whitney triangulate`");
  const int d = problem.ambient_dim(), k = problem.codim();
  if (d - k < 1)
    throw InvalidInput("equations: " + std::to_string(k) + " equations in " + std::to_string(d) +
                       " variables leave no manifold of dimension 1 or more");
}

}  // namespace

TracedProblem trace_problem(const Problem& problem, const TraceProblemOptions& options) {
  if (problem.atlas) return trace_atlas(problem, options);
  check_zero_set(problem);
  const Function& function = *problem.function;
  const int d = problem.ambient_dim(), n = d - problem.codim();
  if (options.mesh == MeshKind::kCells && n > 2)
    throw InvalidInput("mesh: cells are polygons; a manifold of dimension " + std::to_string(n) + " has others");
  const double edge_length =
      edge_length_of(options.edge_length, problem.triangulation.edge_length, problem.bounding_box());
  const coxeter::Triangulation triangulation = make_triangulation(problem.triangulation, d, edge_length);

  Budget budget(options.run);
  Traced traced = trace_what_fits(problem, options, triangulation, budget);
  TracedProblem& result = traced.result;
  Report& report = result.report;
  report.ambient_dim = d;
  report.intrinsic_dim = n;
  report.edge_length = edge_length;
  report.topology_level = TopologyLevel::kNone;
  result.variables = problem.variables;
  if (traced.piece.empty()) {
    result.outcome = TracedProblem::Outcome::kNothingFound;
    result.explanation = traced.piece.why_empty();
  } else if (result.mesh.num_points() > 0) {
    if (options.mesh_ready) options.mesh_ready(result);
    budget.lap(report.seconds, "write");
    if (traced.labelled && budget.allows("strata and singular points of the boundary", face_bytes(result.mesh)))
      report.boundary =
          summarize_boundary(traced.piece.strata, result.mesh,
                             check_cuts(function, traced.piece.traced, triangulation.edge_length()), problem);
    search_interior(function, traced.piece.traced, triangulation.edge_length(), budget, report);
    report_topology(result.mesh, options.topology, budget, report);
    if (options.mesh == MeshKind::kCells) count_cells(traced.piece.complex, report);
    budget.lap(report.seconds, "topology");
  }
  report.stop_reason = budget.stop_reason();
  report.left_out = budget.left_out();
  return std::move(traced.result);
}

}  // namespace whitney
