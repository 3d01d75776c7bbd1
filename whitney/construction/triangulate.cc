// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/triangulate.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <sstream>

#include <coxeter/base/error.h>
#include <coxeter/quality.h>
#include <whitney/construction/place_on_manifold.h>
#include <whitney/construction/whitney_complex.h>
#include <whitney/manifolds/reach_claim.h>

namespace whitney {
namespace {

using perturbation::HitWalk;
using perturbation::HitWalkOptions;
using perturbation::PerturbedTriangulation;

std::string place(std::span<const double> x) {
  std::ostringstream text;
  for (std::size_t c = 0; c < x.size(); ++c) text << (c == 0 ? "(" : ", ") << x[c];
  return text.str() + ")";
}

class Oracle : public perturbation::FootOracle {
 public:
  Oracle(const Submanifold& manifold, const Bending& bending, const std::optional<Box>& box, double edge_length)
      : manifold_(manifold), bending_(bending), box_(box), edge_length_(edge_length) {}

  int ambient_dim() const override { return manifold_.ambient_dim(); }
  int intrinsic_dim() const override { return manifold_.intrinsic_dim(); }
  double reach() const override { return bending_.reach; }
  double curvature_radius() const override { return std::max(bending_.reach, bending_.curvature_radius); }
  perturbation::ReachSource reach_source() const override { return bending_.source; }
  FootPromise promise() const override { return manifold_.promise(); }
  bool foot(std::span<const double> x, std::span<double> point, std::span<double> frame,
            FootErrors& errors) const override {
    if (!manifold_.project(x, point, frame, errors)) return false;
    if (box_) check_inside(x, point);
    return true;
  }

 private:
  /// A foot far from x says nothing about the part of M that is being walked along.
  void check_inside(std::span<const double> x, std::span<const double> point) const {
    const double rounding = 1e-9 * edge_length_;
    bool inside = true;
    double squared = 0;
    for (std::size_t c = 0; c < x.size(); ++c) {
      inside = inside && point[c] >= box_->lower[c] - rounding && point[c] <= box_->upper[c] + rounding;
      squared += (x[c] - point[c]) * (x[c] - point[c]);
    }
    if (!inside && squared <= edge_length_ * edge_length_)
      throw InvalidInput("the manifold leaves the box, at " + place(point) +
                         ": only a closed manifold inside its box can be triangulated; make the box larger");
  }

  const Submanifold& manifold_;
  const Bending& bending_;
  const std::optional<Box>& box_;
  double edge_length_;
};

/// The d-simplices that g >= 0 may meet: no inequality is violated at all vertices.
class DomainRegion {
 public:
  DomainRegion(const Domain& domain, const coxeter::Triangulation& triangulation)
      : domain_(domain), triangulation_(triangulation) {}

  bool operator()(const PerturbedTriangulation& near, std::uint32_t simplex) {
    const std::size_t words = domain_.num_words();
    std::vector<std::uint64_t> all(words, ~std::uint64_t{0});
    for (int q = 0; q <= near.ambient_dim(); ++q) {
      const std::uint32_t v = near.corners(simplex)[q];
      for (; known_ <= v; ++known_) add(near, static_cast<std::uint32_t>(known_));
      for (std::size_t word = 0; word < words; ++word) all[word] &= masks_[v * words + word];
    }
    return std::all_of(all.begin(), all.end(), [](std::uint64_t bits) { return bits == 0; });
  }

 private:
  void add(const PerturbedTriangulation& near, std::uint32_t v) {
    std::vector<double> x(near.ambient_dim());
    triangulation_.cartesian(near.lattice_vertex(v), x);
    const std::vector<double> g = domain_.values(x);
    for (std::size_t j = 0; j < g.size(); ++j)
      if (!std::isfinite(g[j])) throw OracleError(domain_.name(static_cast<int>(j)) + " is not finite at " + place(x));
    masks_.resize(masks_.size() + domain_.num_words());
    domain_.set_mask(x.data(), g.data(), &masks_[masks_.size() - domain_.num_words()]);
  }

  const Domain& domain_;
  const coxeter::Triangulation& triangulation_;
  std::vector<std::uint64_t> masks_;
  std::size_t known_ = 0;
};

class Watch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

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

}  // namespace

TriangulateResult triangulate(const Submanifold& manifold, const Bending& bending,
                              const coxeter::Triangulation& triangulation, std::span<const double> seed_points,
                              const TriangulateOptions& options) {
  check(manifold, bending, triangulation, seed_points, options);
  const int d = manifold.ambient_dim();
  const Oracle oracle(manifold, bending, options.box, triangulation.edge_length());
  const Domain domain(d, options.inequalities, std::nullopt);
  // Each set of simplices numbers its vertices in its own way.
  const auto make_region = [&]() -> perturbation::Region {
    if (domain.empty()) return {};
    return [region = std::make_shared<DomainRegion>(domain, triangulation)](
               const PerturbedTriangulation& near, std::uint32_t s) { return (*region)(near, s); };
  };
  const double width = coxeter::simplex_width(triangulation);
  const Watch watch;
  TriangulateResult result;
  result.edge_length = triangulation.edge_length();
  const char* phase = "perturb";
  const PerturbedTriangulation* working = nullptr;
  const auto stopped = [&] { return result.stop_reason != StopReason::kNone; };
  const auto not_cancelled = [&] {
    if (!stopped() && options.run.progress &&
        !options.run.progress({phase, working->num_simplices(), working->oracle_calls(), watch.seconds()}))
      result.stop_reason = StopReason::kCancelled;
    return !stopped();
  };
  const auto keep_going = [&] {
    if (!stopped() && watch.seconds() > options.run.time_limit) result.stop_reason = StopReason::kTimeLimit;
    return not_cancelled();
  };

  // Feet of the seeds, then the hit simplices nearest to them.
  std::vector<double> feet;
  for (std::size_t i = 0; i < seed_points.size() / d; ++i) {
    std::vector<double> point(d), frame(static_cast<std::size_t>(d) * d);
    FootErrors errors;
    if (manifold.project(seed_points.subspan(i * d, d), point, frame, errors))
      feet.insert(feet.end(), point.begin(), point.end());
    else
      ++result.seeds_dropped;
  }
  const auto find_starts = [&](PerturbedTriangulation& near) {
    const perturbation::Region region = make_region();
    std::vector<std::uint32_t> starts;
    for (std::size_t i = 0; i < feet.size() / d; ++i) {
      const std::uint32_t s = perturbation::find_start(near, std::span<const double>(feet).subspan(i * d, d));
      if (region && !region(near, s)) continue;
      if (std::find(starts.begin(), starts.end(), s) == starts.end()) starts.push_back(s);
    }
    return starts;
  };

  // Displacements.
  perturbation::DisplacementMap displacements(d);
  {
    PerturbedTriangulation near(triangulation, oracle);
    working = &near;
    const std::vector<std::uint32_t> starts = find_starts(near);
    if (options.scheme == TriangulateOptions::Scheme::kRepair && !starts.empty()) {
      perturbation::RepairOptions repair_options;
      repair_options.max_displacement = options.displacement_fraction * width / 2;
      repair_options.rng_seed = options.rng_seed;
      repair_options.max_rounds = options.max_rounds;
      repair_options.run.max_simplices = options.run.max_simplices;
      repair_options.region = make_region();
      repair_options.run.progress = [&](const Progress&) { return keep_going(); };
      result.rounds = perturbation::repair(near, starts, repair_options).rounds;
    } else if (options.scheme == TriangulateOptions::Scheme::kSequential && !starts.empty()) {
      perturbation::SequentialOptions sequential_options;
      sequential_options.max_displacement = options.displacement_fraction * width / 2;
      sequential_options.min_distance = 1;
      sequential_options.rng_seed = options.rng_seed;
      sequential_options.max_rounds = options.max_rounds;
      sequential_options.run.max_simplices = options.run.max_simplices;
      sequential_options.region = make_region();
      sequential_options.run.progress = [&](const Progress&) { return keep_going(); };
      for (const auto& round : perturbation::sequential(near, starts, sequential_options).rounds)
        result.rounds.push_back({round.simplices, round.failing, round.worst_margin, false});
    }
    std::vector<std::uint32_t> moved;
    for (std::uint32_t v = 0; v < near.num_vertices(); ++v)
      if (std::any_of(near.displacement(v), near.displacement(v) + d, [](double u) { return u != 0; }))
        moved.push_back(v);
    std::sort(moved.begin(), moved.end(), [&](std::uint32_t a, std::uint32_t b) {
      const auto za = near.lattice_vertex(a), zb = near.lattice_vertex(b);
      return std::lexicographical_compare(za.begin(), za.end(), zb.begin(), zb.end());
    });
    for (const std::uint32_t v : moved)
      displacements.set(coxeter::LatticeVertex(near.lattice_vertex(v)), {near.displacement(v), std::size_t(d)});
    result.oracle_evaluations += near.oracle_calls();
  }
  result.seconds_perturb = watch.seconds();

  // Everything from here on depends on the displacements alone, not on how they were found.
  phase = "certify";
  PerturbedTriangulation near(triangulation, oracle);
  working = &near;
  near.displace(displacements);
  const std::vector<std::uint32_t> starts = find_starts(near);
  HitWalkOptions trace_options;
  trace_options.run.max_simplices = options.run.max_simplices;
  trace_options.region = make_region();
  // What was found by then is wanted even when the search was stopped, but not at any price.
  const bool stopped_before = stopped();
  const double deadline = 1.25 * watch.seconds() + 1;
  trace_options.run.progress = [&](const Progress&) { return stopped_before ? watch.seconds() < deadline : not_cancelled(); };
  const HitWalk trace = perturbation::walk_hit_facets(near, starts, trace_options);
  if (!trace.complete && !stopped()) result.stop_reason = StopReason::kMaxSimplices;
  result.certificate = perturbation::certify(near, trace, width);
  if (options.check_reach) result.reach_check = compare_reach(near, trace);
  if (!result.reach_check.consistent && result.certificate.verdict != perturbation::Verdict::kViolated) {
    std::ostringstream text;
    text << "the reach cannot be " << bending.reach << ": the points " << place(result.reach_check.p) << " and "
         << place(result.reach_check.q) << " of the manifold allow at most " << result.reach_check.largest_possible;
    result.certificate.verdict = perturbation::Verdict::kNotCertified;
    result.certificate.reason = text.str();
  }
  result.seconds_certify = watch.seconds() - result.seconds_perturb;

  const bool whole = trace.complete && result.certificate.not_certified == 0;
  if (!trace.simplices.empty()) {
    WhitneyComplex cut = whitney_complex(near, trace, whole);
    result.complex = std::move(cut.complex);
    result.cut = cut.cut;
    if (whole && options.place_on_manifold && !result.cut) {
      PlacedComplex placed =
          place_on_manifold(std::move(result.complex), triangulation, displacements, manifold, bending);
      result.complex = std::move(placed.complex);
      result.hausdorff_bound = placed.distance_bound;
    } else if (whole && !result.cut) {
      result.hausdorff_bound = cut.distance_bound;
    }
  }
  std::vector<char> is_near(near.num_vertices(), 0);
  for (const std::uint32_t s : trace.simplices)
    for (int q = 0; q <= d; ++q) {
      const std::uint32_t v = near.corners(s)[q];
      if (is_near[v]) continue;
      is_near[v] = 1;
      ++result.vertices_near;
      result.vertices_moved +=
          std::any_of(near.displacement(v), near.displacement(v) + d, [](double u) { return u != 0; });
    }
  result.seeds_used = starts.size();
  result.seeds_merged = feet.size() / d - starts.size();
  result.oracle_evaluations += near.oracle_calls();
  result.displacements = std::move(displacements);
  result.seconds_complex = watch.seconds() - result.seconds_perturb - result.seconds_certify;
  return result;
}

}  // namespace whitney
