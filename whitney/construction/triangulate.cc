// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/triangulate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

#include <coxeter/base/error.h>
#include <coxeter/quality.h>
#include <perturbation/inside.h>
#include <whitney/construction/distance_bound.h>
#include <whitney/construction/phase_watch.h>
#include <whitney/construction/place_on_manifold.h>
#include <whitney/construction/submanifold_oracle.h>
#include <whitney/construction/whitney_complex.h>
#include <whitney/manifolds/reach_claim.h>

namespace whitney {
namespace {

using perturbation::HitWalk;
using perturbation::HitWalkOptions;
using perturbation::PerturbedTriangulation;
using perturbation::Verdict;

std::string place(std::span<const double> x) {
  std::ostringstream text;
  for (std::size_t c = 0; c < x.size(); ++c) text << (c == 0 ? "(" : ", ") << x[c];
  return text.str() + ")";
}

void check(const Submanifold& manifold, const Bending& bending, const coxeter::Triangulation& triangulation,
           std::span<const double> seed_points, const TriangulateOptions& options) {
  const int d = manifold.ambient_dim();
  if (triangulation.ambient_dim() != d)
    throw InvalidInput("triangulation: ambient dimension " + std::to_string(triangulation.ambient_dim()) +
                       ", but the manifold lies in R^" + std::to_string(d));
  if (!(bending.reach > 0) || !std::isfinite(bending.reach) || !std::isfinite(bending.curvature_radius))
    throw InvalidInput("bending: reach must be positive and finite");
  if (bending.curvature_radius != 0 && !(bending.curvature_radius >= bending.reach))
    throw InvalidInput("bending: curvature_radius must be at least reach, or 0 for the same");
  if (seed_points.empty() || seed_points.size() % d != 0)
    throw InvalidInput("seed_points: need at least one point with " + std::to_string(d) + " coordinates");
  for (const double x : seed_points)
    if (!std::isfinite(x)) throw InvalidInput("seed_points: coordinates must be finite");
  if (options.box && (options.box->lower.size() != static_cast<std::size_t>(d) ||
                      options.box->upper.size() != static_cast<std::size_t>(d)))
    throw InvalidInput("box: need " + std::to_string(d) + " lower and upper bounds");
  if (!(options.displacement_fraction > 0) || !(options.displacement_fraction < 1))
    throw InvalidInput("displacement_fraction must be between 0 and 1");
}

/// Compares the claimed reach with the feet of all vertices of the trace.
ReachCheck compare_reach(PerturbedTriangulation& near, const HitWalk& trace) {
  const int d = near.ambient_dim();
  std::vector<char> seen(near.num_vertices(), 0);
  std::vector<double> points, frames;
  std::vector<FootErrors> errors;
  for (const std::uint32_t s : trace.simplices)
    for (int q = 0; q <= d; ++q) {
      const std::uint32_t v = near.corners(s)[q];
      perturbation::FootView foot{};
      if (seen[v] || !near.foot(s, static_cast<std::uint16_t>(q + 1), foot)) continue;
      seen[v] = 1;
      points.insert(points.end(), foot.point, foot.point + d);
      frames.insert(frames.end(), foot.frame, foot.frame + d * d);
      errors.push_back(foot.errors);
    }
  ReachCheck check;
  if (errors.size() < 2) return check;
  const ReachVerdict verdict =
      check_reach(FeetView{d, near.oracle().intrinsic_dim(), points, frames, errors}, near.oracle().reach());
  check.consistent = verdict.consistent();
  check.largest_possible = verdict.largest_possible;
  check.p.assign(&points[verdict.p * d], &points[verdict.p * d] + d);
  check.q.assign(&points[verdict.q * d], &points[verdict.q * d] + d);
  return check;
}

/// What a contradicted reach means: a proof if the feet are proved, otherwise a reason to doubt reach and feet.
std::string describe(const ReachCheck& check, double reach, FootPromise::Errors errors) {
  std::ostringstream text;
  const std::string points = "the points " + place(check.p) + " and " + place(check.q) + " of the manifold ";
  if (errors == FootPromise::Errors::kProven)
    text << "the reach cannot be " << reach << ": " << points << "allow at most " << check.largest_possible;
  else
    text << "the feet found, whose error bounds are modelled and not proved, suggest a reach of at most "
         << check.largest_possible << " in place of " << reach << ": " << points
         << "say so, if they are as exact as the model has it";
  return text.str();
}

/// An upper bound of the edges of the simplices of a trace (a length).
double longest_edge(const PerturbedTriangulation& near, const HitWalk& trace) {
  const int d = near.ambient_dim();
  double squared = 0;
  for (const std::uint32_t s : trace.simplices)
    for (int i = 0; i <= d; ++i)
      for (int j = 0; j < i; ++j) {
        const double *x = near.position(near.corners(s)[i]), *y = near.position(near.corners(s)[j]);
        double sum = 0;
        for (int c = 0; c < d; ++c) sum += (x[c] - y[c]) * (x[c] - y[c]);
        squared = std::max(squared, sum);
      }
  return std::sqrt(squared) * (1 + 1e-12);
}

bool is_displaced(const PerturbedTriangulation& near, std::uint32_t v) {
  return std::any_of(near.displacement(v), near.displacement(v) + near.ambient_dim(), [](double u) { return u != 0; });
}

/// The displacements of the vertices that moved, in lexicographic order.
perturbation::DisplacementMap displacements_of(const PerturbedTriangulation& near) {
  std::vector<std::uint32_t> moved;
  for (std::uint32_t v = 0; v < near.num_vertices(); ++v)
    if (is_displaced(near, v)) moved.push_back(v);
  std::sort(moved.begin(), moved.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto za = near.lattice_vertex(a), zb = near.lattice_vertex(b);
    return std::lexicographical_compare(za.begin(), za.end(), zb.begin(), zb.end());
  });
  const auto d = static_cast<std::size_t>(near.ambient_dim());
  perturbation::DisplacementMap displacements(near.ambient_dim());
  for (const std::uint32_t v : moved)
    displacements.set(coxeter::LatticeVertex(near.lattice_vertex(v)), {near.displacement(v), d});
  return displacements;
}

/// One run of triangulate(), step by step.
class Construction {
 public:
  Construction(const Submanifold& manifold, const Bending& bending, const coxeter::Triangulation& triangulation,
               std::span<const double> seed_points, const TriangulateOptions& options)
      : manifold_(manifold),
        bending_(bending),
        triangulation_(triangulation),
        seed_points_(seed_points),
        options_(options),
        d_(manifold.ambient_dim()),
        oracle_(manifold, bending, options.box, triangulation.edge_length()),
        domain_(d_, options.inequalities, std::nullopt),
        width_(coxeter::simplex_width(triangulation)),
        watch_(options.run) {
    result_.edge_length = triangulation.edge_length();
    result_.ingredients = {bending.source, manifold.promise(),
                           manifold.is_connected()       ? Components::kAll
                           : options.seeds_were_searched ? Components::kOfSearchedSeeds
                                                         : Components::kOfGivenSeeds};
  }

  TriangulateResult run() {
    project_seeds();
    find_displacements();
    result_.seconds_perturb = watch_.seconds();
    // Everything from here on depends on the displacements alone, not on how they were found.
    PerturbedTriangulation near(triangulation_, oracle_);
    near.displace(result_.displacements);
    const HitWalk trace = walk(near);
    certify(near, trace);
    result_.seconds_certify = watch_.seconds() - result_.seconds_perturb;
    count_vertices(near, trace);
    if (!trace.simplices.empty()) cut_out(near, trace);
    result_.oracle_evaluations += near.oracle_calls();
    result_.stop_reason = watch_.stop_reason();
    result_.seconds_complex = watch_.seconds() - result_.seconds_perturb - result_.seconds_certify;
    return std::move(result_);
  }

 private:
  /// Each set of simplices numbers its vertices in its own way.
  perturbation::Region make_region() const {
    if (domain_.empty()) return {};
    return [region = std::make_shared<DomainRegion>(domain_, triangulation_)](
               const PerturbedTriangulation& near, std::uint32_t s) { return (*region)(near, s); };
  }

  std::function<bool()> keep_going(const char* phase, const PerturbedTriangulation& near) {
    return [this, phase, &near] {
      // Memory for the complex must be left.
      return watch_.keep_going(phase, near.num_simplices(), near.oracle_calls(),
                               whitney_complex_bytes(d_, near.codim(), near.num_simplices()));
    };
  }

  void project_seeds() {
    std::vector<double> point(d_), frame(static_cast<std::size_t>(d_) * d_);
    for (std::size_t i = 0; i < seed_points_.size() / d_; ++i) {
      FootErrors errors;
      if (!manifold_.project(seed_points_.subspan(i * d_, d_), point, frame, errors)) {
        ++result_.seeds_dropped;
        continue;
      }
      feet_.insert(feet_.end(), point.begin(), point.end());
      feet_errors_.push_back(errors.point);
      seed_of_foot_.push_back(i);
    }
  }

  /// The hit simplices nearest to the feet of the seeds, each once. `counts[i]`: foot i is inside the inequalities.
  std::vector<std::uint32_t> find_starts(PerturbedTriangulation& near, std::vector<char>& counts) const {
    const perturbation::Region region = make_region();
    std::vector<std::uint32_t> starts;
    counts.assign(feet_errors_.size(), 0);
    for (std::size_t i = 0; i < feet_errors_.size(); ++i) {
      const std::uint32_t s = perturbation::find_start(near, std::span(feet_).subspan(i * d_, d_));
      if (region && !region(near, s)) continue;
      counts[i] = 1;
      if (std::find(starts.begin(), starts.end(), s) == starts.end()) starts.push_back(s);
    }
    return starts;
  }

  template <class SchemeOptions>
  SchemeOptions scheme_options(const PerturbedTriangulation& near) {
    SchemeOptions scheme;
    scheme.max_displacement = options_.displacement_fraction * width_ / 2;
    scheme.rng_seed = options_.rng_seed;
    scheme.max_rounds = options_.max_rounds;
    scheme.run.max_simplices = options_.run.max_simplices;
    scheme.region = make_region();
    scheme.run.progress = [go = keep_going("perturb", near)](const Progress&) { return go(); };
    return scheme;
  }

  void find_displacements() {
    PerturbedTriangulation near(triangulation_, oracle_);
    std::vector<char> counts;
    const std::vector<std::uint32_t> starts = find_starts(near, counts);
    if (options_.scheme == TriangulateOptions::Scheme::kRepair && !starts.empty()) {
      result_.rounds = perturbation::repair(near, starts, scheme_options<perturbation::RepairOptions>(near)).rounds;
    } else if (options_.scheme == TriangulateOptions::Scheme::kSequential && !starts.empty()) {
      auto scheme = scheme_options<perturbation::SequentialOptions>(near);
      scheme.min_distance = 1;
      for (const auto& round : perturbation::sequential(near, starts, scheme).rounds)
        result_.rounds.push_back({round.simplices, round.failing, round.worst_margin, false});
    }
    if (watch_.stopped()) result_.left_out.emplace_back("further displacements");
    if (watch_.stop_reason() == StopReason::kMemoryLimit) most_simplices_ = near.num_simplices() / 2;
    result_.displacements = displacements_of(near);
    result_.oracle_evaluations += near.oracle_calls();
  }

  HitWalk walk(PerturbedTriangulation& near) {
    const std::vector<std::uint32_t> starts = find_starts(near, seed_counts_);
    HitWalkOptions walk_options;
    walk_options.run.max_simplices = std::min(options_.run.max_simplices, most_simplices_);
    walk_options.region = make_region();
    // What was found by then is wanted even when the search was stopped, but not at any price.
    const double deadline = 1.25 * watch_.seconds() + 1;
    if (watch_.stopped())
      walk_options.run.progress = [this, deadline](const Progress&) { return watch_.seconds() < deadline; };
    else
      walk_options.run.progress = [go = keep_going("certify", near)](const Progress&) { return go(); };
    HitWalk trace = perturbation::walk_hit_facets(near, starts, walk_options);
    if (!trace.complete) {
      watch_.stop(StopReason::kMaxSimplices);
      result_.left_out.emplace_back("simplices that the walk had not come to");
    }
    result_.seeds_used = starts.size();
    result_.seeds_merged = feet_errors_.size() - starts.size();
    return trace;
  }

  void certify(PerturbedTriangulation& near, const HitWalk& trace) {
    result_.certificate = perturbation::certify(near, trace, width_);
    if (options_.check_reach) result_.reach_check = compare_reach(near, trace);
    if (!result_.reach_check.consistent)
      object(describe(result_.reach_check, bending_.reach, result_.ingredients.feet.errors));
    find_seeds_outside(near, trace);
    if (!result_.seeds_outside.empty()) {
      const std::size_t num = result_.seeds_outside.size() / d_;
      object(std::to_string(num) + (num == 1 ? " seed point is" : " seed points are") +
             " not proved to lie in the certified simplices, after projection, so the complex may be one of another "
             "component, e.g. " +
             place(std::span(result_.seeds_outside).first(d_)));
    }
  }

  /// Something stands in the way of "certified"; a violation is more than that.
  void object(const std::string& reason) {
    if (result_.certificate.verdict == Verdict::kViolated) return;
    result_.certificate.verdict = Verdict::kNotCertified;
    result_.certificate.reason = reason;
  }

  void find_seeds_outside(PerturbedTriangulation& near, const HitWalk& trace) {
    // Without every simplex certified there is nothing that a seed could be proved to lie in.
    if (trace.simplices.empty() || result_.certificate.verdict != Verdict::kCertified) return;
    const std::vector<bool> proved = perturbation::proved_in_union(near, trace.simplices, feet_, feet_errors_);
    for (std::size_t i = 0; i < proved.size(); ++i) {
      if (proved[i] || !seed_counts_[i]) continue;
      const std::span<const double> seed = seed_points_.subspan(seed_of_foot_[i] * d_, d_);
      result_.seeds_outside.insert(result_.seeds_outside.end(), seed.begin(), seed.end());
    }
  }

  void count_vertices(const PerturbedTriangulation& near, const HitWalk& trace) {
    std::vector<char> is_near(near.num_vertices(), 0);
    for (const std::uint32_t s : trace.simplices)
      for (int q = 0; q <= d_; ++q) {
        const std::uint32_t v = near.corners(s)[q];
        if (is_near[v]) continue;
        is_near[v] = 1;
        ++result_.vertices_near;
        result_.vertices_moved += is_displaced(near, v);
      }
  }

  /// K, its 0-cells on M if wanted, and the distance bound.
  void cut_out(PerturbedTriangulation& near, const HitWalk& trace) {
    if (!watch_.fits(whitney_complex_bytes(d_, near.codim(), trace.simplices.size()))) {
      result_.left_out.emplace_back("complex");
      return;
    }
    const bool stopped_before = watch_.stopped();
    const bool whole = trace.complete && result_.certificate.not_certified == 0;
    const auto go_on = [&](const char* phase) -> std::function<bool()> {
      if (stopped_before) return {};
      return keep_going(phase, near);
    };
    WhitneyComplex cut = whitney_complex(near, trace, whole, go_on("complex"));
    result_.complex = std::move(cut.complex);
    result_.cut = cut.cut;
    if (!stopped_before && watch_.stopped()) {
      result_.left_out.emplace_back("part of the complex");
      return;
    }
    if (!whole || result_.cut) return;
    std::optional<double> distance = cut.distance_bound;
    if (options_.place_on_manifold) {
      PlacedComplex placed = place_on_manifold(std::move(result_.complex), triangulation_, result_.displacements,
                                               manifold_, bending_, go_on("place"));
      result_.complex = std::move(placed.complex);
      distance = placed.distance_bound;
      if (!placed.complete) result_.left_out.emplace_back("places of 0-cells on the manifold");
    }
    if (distance && result_.certificate.verdict == Verdict::kCertified)
      result_.hausdorff_bound = hausdorff_bound(*distance, longest_edge(near, trace), bending_.reach);
  }

  const Submanifold& manifold_;
  const Bending& bending_;
  const coxeter::Triangulation& triangulation_;
  std::span<const double> seed_points_;
  const TriangulateOptions& options_;
  int d_;
  SubmanifoldOracle oracle_;
  Domain domain_;
  double width_;
  PhaseWatch watch_;

  // Feet of the seeds that have one: points m x d, error bounds, and which seeds they belong to.
  std::vector<double> feet_, feet_errors_;
  std::vector<std::size_t> seed_of_foot_;
  std::vector<char> seed_counts_;
  /// What the walk may find where memory was short before.
  std::size_t most_simplices_ = std::numeric_limits<std::size_t>::max();
  TriangulateResult result_;
};

}  // namespace

const char* to_string(Components components) {
  switch (components) {
    case Components::kOfGivenSeeds:
      return "seeds_given";
    case Components::kOfSearchedSeeds:
      return "seeds_searched";
    default:
      return "connected_by_definition";
  }
}

TriangulateResult triangulate(const Submanifold& manifold, const Bending& bending,
                              const coxeter::Triangulation& triangulation, std::span<const double> seed_points,
                              const TriangulateOptions& options) {
  check(manifold, bending, triangulation, seed_points, options);
  return Construction(manifold, bending, triangulation, seed_points, options).run();
}

}  // namespace whitney
