// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/triangulate_problem.h>

#include <algorithm>
#include <new>
#include <sstream>
#include <utility>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>
#include <whitney/construction/ambient_mesh.h>
#include <whitney/construction/complex_quality.h>
#include <whitney/construction/inside_mesh.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/manifolds/bending.h>
#include <whitney/problem/budget.h>
#include <whitney/problem/memory_estimate.h>
#include <whitney/problem/mesh_topology.h>
#include <whitney/topology/orientation.h>

namespace whitney {
namespace {

using perturbation::Verdict;

void check(const Problem& problem, const TriangulateProblemOptions& options) {
  if (problem.atlas)
    throw InvalidInput("charts have no closest points, which Whitney's construction needs: use `whitney trace`");
  const int d = problem.ambient_dim(), n = d - problem.codim();
  if (n < 1) throw InvalidInput("no manifold of dimension 1 or more");
  if (options.mesh == MeshKind::kCells && n > 2)
    throw InvalidInput("mesh: cells are polygons; a manifold of dimension " + std::to_string(n) + " has others");
  for (const auto& [asked, name] : {std::pair{options.ambient, "ambient"}, {options.inside, "inside"}})
    if (asked && (d < 2 || d > 4))
      throw InvalidInput("--" + std::string(name) + ": made for 2 <= d <= 4, the manifold lies in R^" +
                         std::to_string(d));
  if (options.inside && n != d - 1)
    throw InvalidInput("--inside: a manifold of dimension " + std::to_string(n) + " in R^" + std::to_string(d) +
                       " has no inside");
}

/// The problem with seed points, found in the box where it has none.
Problem with_seeds(Problem problem, Budget& budget, Report& report) {
  if (!problem.seed_points.empty() || problem.submanifold) return problem;
  const std::optional<Box> box = problem.bounding_box();
  if (!box) throw InvalidInput("give seed_points, or a box in which they can be searched for");
  FindSeedsOptions options;
  options.run = budget.rest();
  const FoundSeeds found =
      find_seeds(*problem.function, Domain(problem.ambient_dim(), problem.inequalities, box), options);
  budget.ended(found.stop_reason);
  report.seeds.searched = true;
  report.seeds.num_starts = found.num_starts;
  report.seed_evaluations = found.evaluations;
  const auto d = static_cast<std::size_t>(problem.ambient_dim());
  for (std::size_t at = 0; at + d <= found.points.size(); at += d)
    problem.seed_points.emplace_back(&found.points[at], &found.points[at] + d);
  return problem;
}

/// Why a zero set that came without a reach is no submanifold; empty when it may be one. One that crosses itself or has
/// a corner would send the search for a scale to ever smaller edge lengths.
std::string why_singular(const BendingEstimate& estimate, const std::optional<Box>& box) {
  double side = 0;
  for (std::size_t c = 0; box && c < box->lower.size(); ++c) side = std::max(side, box->upper[c] - box->lower[c]);
  if (estimate.bending.reach > 1e-5 * side) return "";
  std::ostringstream text;
  text << "the reach seems to be " << estimate.bending.reach << " or less, from the points " << point_text(estimate.p)
       << " " << point_text(estimate.q)
       << ": the set crosses itself or is singular there, so it is no submanifold; if it is one, give its reach";
  return text.str();
}

ScaleSearchOptions search_options(const Problem& problem, const TriangulateProblemOptions& options,
                                  bool seeds_were_searched, Budget& budget) {
  ScaleSearchOptions search;
  TriangulateOptions& one = search.triangulate;
  one.scheme = options.scheme;
  one.rng_seed = problem.triangulation.rng_seed;
  one.max_rounds = options.max_rounds;
  one.inequalities = problem.inequalities;
  one.box = problem.bounding_box();
  one.seeds_were_searched = seeds_were_searched;
  one.run = budget.rest(0, work_bytes_per_top_simplex(problem.ambient_dim(), problem.codim(), options.mesh));
  search.first_edge_length = options.edge_length ? options.edge_length : problem.triangulation.edge_length;
  if (search.first_edge_length && options.auto_refine) search.factor = 0.5;
  if (search.first_edge_length && !options.auto_refine) search.max_attempts = 1;
  return search;
}

const char* name_of(Components components) {
  switch (components) {
    case Components::kOfGivenSeeds:
      return "seeds_given";
    case Components::kOfSearchedSeeds:
      return "seeds_searched";
    case Components::kAll:
      return "connected_by_definition";
  }
  return "unknown";
}

CertificateSummary summarize(const TriangulateResult& result, const Bending& bending) {
  const perturbation::CertificateReport& report = result.certificate;
  CertificateSummary out;
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
  out.feet_source = to_string(result.ingredients.feet.errors);
  out.feet_place = to_string(result.ingredients.feet.place);
  out.components = name_of(result.ingredients.components);
  out.edge_length_over_reach = result.edge_length / bending.reach;
  if (report.verdict == Verdict::kCertified && !result.cut) out.hausdorff_bound = result.hausdorff_bound;
  out.cut = result.cut;
  out.reason = report.reason;
  if (report.witness) out.witness = report.witness->barycentre;
  out.reach_contradicted = !result.reach_check.consistent;
  return out;
}

void summarize(const ScaleSearchResult& search, const Bending& bending, const Problem& problem, Report& report) {
  const TriangulateResult& result = search.result;
  const int k = problem.codim(), n = problem.ambient_dim() - k;
  report.edge_length = search.attempts.back().edge_length;
  report.seeds.num_used = result.seeds_used;
  report.seeds.num_merged = result.seeds_merged;
  report.seeds.num_dropped = result.seeds_dropped;
  for (int j = 0; j <= n; ++j) report.simplices_per_dim[k + j] = result.complex.num_cells(j);
  report.simplices_met = result.certificate.simplices;
  report.oracle_evaluations = result.oracle_evaluations;
  report.distinct_vertices = result.vertices_near;
  report.certificate = summarize(result, bending);
  report.seconds["perturb"] = result.seconds_perturb;
  report.seconds["certify"] = result.seconds_certify;
  report.seconds["complex"] = result.seconds_complex;
}

void add_solids(const TriangulateProblemOptions& options, const TriangulateResult& result,
                const coxeter::Triangulation& triangulation, Budget& budget, TriangulatedProblem& out) {
  const int d = result.complex.ambient_dim, n = result.complex.intrinsic_dim;
  double per_simplex = 1;
  for (int i = 2; i <= d + 1; ++i) per_simplex *= i;
  const double corners = per_simplex * (d + 1) * static_cast<double>(result.complex.num_cells(n));
  const auto add = [&](bool asked, const char* name, auto make, std::optional<SimplicialMesh>& solid) {
    if (!asked || !budget.allows(name, static_cast<std::uint64_t>(16 * corners))) return;
    try {
      solid = make(result.complex, triangulation, result.displacements).mesh;
    } catch (const Error& error) {
      out.no_solids.push_back(std::string(name) + ": " + error.what());
    }
  };
  add(options.ambient, "ambient mesh", ambient_mesh, out.ambient);
  add(options.inside, "inside mesh", inside_mesh, out.inside);
}

/// The search for a scale; where memory gives out in spite of all estimates, with half as many simplices, and so on.
ScaleSearchResult search_what_fits(const Submanifold& manifold, const Bending& bending, const Problem& problem,
                                   std::span<const double> seeds, const TriangulateProblemOptions& options,
                                   bool seeds_were_searched, Budget& budget) {
  const auto triangulation_of = [&](double L) {
    return make_triangulation(problem.triangulation, problem.ambient_dim(), L);
  };
  for (;;) {
    try {
      return search_scale(manifold, bending, triangulation_of, seeds,
                          search_options(problem, options, seeds_were_searched, budget));
    } catch (const std::bad_alloc&) {
      if (!budget.halve()) throw;
    }
  }
}

std::string why_empty(const Problem& problem, const TriangulateResult& result, std::size_t num_seeds) {
  return "no simplex near the " + std::to_string(num_seeds) + " seed points meets the manifold (" +
         std::to_string(result.seeds_dropped) + " of them have no closest point on it)" +
         (problem.inequalities ? "; seeds outside the inequalities do not count: give seed_points inside" : "");
}

/// Mesh, and what comes after it.
void add_meshes(const TriangulateResult& result, const Submanifold& manifold, const Problem& problem,
                const TriangulateProblemOptions& options, Budget& budget, TriangulatedProblem& out) {
  Report& report = out.report;
  if (!budget.fits("mesh", mesh_bytes(result.complex, options.mesh))) return;
  out.mesh = orient(options.mesh == MeshKind::kBarycentric ? barycentric_subdivision(result.complex)
                                                           : pulled_subdivision(result.complex))
                 .mesh;
  if (options.mesh == MeshKind::kCells) out.cells = polygon_mesh(result.complex);
  budget.lap(report.seconds, "mesh");
  if (options.ambient || options.inside) {
    add_solids(options, result, make_triangulation(problem.triangulation, problem.ambient_dim(), *report.edge_length),
               budget, out);
    budget.lap(report.seconds, "solids");
  }
  if (options.mesh_ready) options.mesh_ready(out);
  budget.lap(report.seconds, "write");
  report_topology(out.mesh, options.topology, budget, report);
  if (options.mesh == MeshKind::kCells) count_cells(result.complex, report);
  budget.lap(report.seconds, "topology");
  constexpr std::size_t kMaxFeet = 100'000;  // of each kind: enough to judge, and a slow oracle has an end
  if (budget.allows("quality", 16 * kMaxFeet)) report.quality = complex_quality(out.mesh, manifold, kMaxFeet);
  budget.lap(report.seconds, "quality");
}

}  // namespace

TriangulatedProblem triangulate_problem(const Problem& asked, const TriangulateProblemOptions& options) {
  using Outcome = TriangulatedProblem::Outcome;
  check(asked, options);
  Budget budget(options.run);
  TriangulatedProblem out;
  Report& report = out.report;
  report.ambient_dim = asked.ambient_dim();
  report.intrinsic_dim = asked.ambient_dim() - asked.codim();
  report.topology_level = TopologyLevel::kNone;
  out.variables = asked.variables;
  const auto finish = [&](Outcome outcome, std::string explanation) {
    out.outcome = outcome;
    out.explanation = std::move(explanation);
    report.stop_reason = budget.stop_reason();
    report.left_out = budget.left_out();
    return std::move(out);
  };

  const Problem problem = with_seeds(asked, budget, report);
  if (problem.seed_points.empty() && !problem.submanifold)
    return finish(Outcome::kNothingFound, "no point of the manifold was found in the box");
  const Submanifold manifold = submanifold_of(problem);
  std::vector<double> seeds;
  for (const auto& point : problem.seed_points) seeds.insert(seeds.end(), point.begin(), point.end());
  if (seeds.empty()) seeds = manifold.seed_points();
  std::optional<Bending> bending = manifold.bending();
  if (!bending) {
    const BendingEstimate estimate = estimate_bending(manifold);
    const std::string singular = why_singular(estimate, problem.bounding_box());
    if (!singular.empty()) return finish(Outcome::kNoSubmanifold, singular);
    bending = estimate.bending;
  }
  budget.lap(report.seconds, "seeds");

  ScaleSearchResult search =
      search_what_fits(manifold, *bending, problem, seeds, options, report.seeds.searched, budget);
  const StopReason ended = budget.ended(search.result.stop_reason);
  for (const std::string& what : search.result.left_out) budget.leave_out(what, ended);
  report.cut_short = budget.stopped();
  std::map<std::string, double> inside_search;
  budget.lap(inside_search, "");
  out.attempts = search.attempts;
  if (search.result.certificate.simplices == 0)
    return finish(Outcome::kNothingFound,
                  why_empty(problem, search.result, seeds.size() / static_cast<std::size_t>(report.ambient_dim)));
  summarize(search, *bending, problem, report);
  add_meshes(search.result, manifold, problem, options, budget, out);
  return finish(Outcome::kTriangulated, "");
}

}  // namespace whitney
