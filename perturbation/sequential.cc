// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/sequential.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include <coxeter/base/error.h>
#include <coxeter/base/keyed_random.h>
#include <coxeter/base/run_watch.h>
#include <coxeter/counts.h>
#include <perturbation/parameters.h>

namespace whitney::perturbation {
namespace {

/// Gives lattice vertices their places, each once.
class Placer {
 public:
  Placer(const coxeter::Triangulation& triangulation, const FootOracle& oracle, double radius, double min_distance,
         const SequentialOptions& options, SequentialResult& result)
      : triangulation_(triangulation),
        oracle_(oracle),
        options_(options),
        result_(result),
        d_(triangulation.ambient_dim()),
        k_(d_ - oracle.intrinsic_dim()),
        radius_(radius),
        min_distance_(min_distance),
        near_(1.5 * triangulation.edge_length()),
        table_(d_) {}

  /// The displacement of the vertex: d numbers, until the next call.
  std::span<const double> displacement(std::span<const std::int32_t> vertex) {
    const std::uint32_t v = place(vertex);
    return {&displacements_[std::size_t{v} * d_], static_cast<std::size_t>(d_)};
  }

 private:
  /// What is needed while a vertex waits for its neighbours.
  struct Waiting {
    std::vector<double> position, point, frame;
    int colour = 0;
    std::vector<std::uint32_t> neighbours;  // by W, see place
  };

  /// The index of the vertex, which has its place afterwards.
  std::uint32_t place(std::span<const std::int32_t> vertex) {
    const std::uint64_t form = table_.form_of(vertex.data());
    if (const std::uint32_t known = table_.find(vertex.data(), form); known != coxeter::HashSlots::kNone) return known;
    const auto d = static_cast<std::size_t>(d_);
    Waiting w;
    w.position.resize(d);
    w.point.resize(d);
    w.frame.resize(d * d);
    triangulation_.cartesian(vertex, w.position);
    FootErrors errors;
    ++result_.oracle_calls;
    bool near = oracle_.foot(w.position, w.point, w.frame, errors);
    if (near) {
      double squared = 0;
      for (std::size_t c = 0; c < d; ++c) squared += (w.position[c] - w.point[c]) * (w.position[c] - w.point[c]);
      near = std::sqrt(squared) < near_;
    }
    if (near) {
      w.colour = colour(vertex);
      place_neighbours(vertex, w);
    }
    // Only now: what has an index has its place.
    const std::uint32_t v = table_.intern(vertex.data(), form);
    displacements_.resize(displacements_.size() + d, 0.0);
    positions_.insert(positions_.end(), w.position.begin(), w.position.end());
    if (near) choose(v, w);
    return v;
  }

  /// The neighbours of z are z + e(U), U a proper subset of {0 .. d} that is not empty, with e_d = -(e_0 + .. +
  /// e_(d-1)); two of them are adjacent when one set contains the other. With W the complement of U the colour of
  /// z + e(U) is that of z minus |W|, mod (d+1): smaller than that of z when |W| <= colour(z). And z + e(U) is z -
  /// e(W).
  void place_neighbours(std::span<const std::int32_t> vertex, Waiting& w) {
    if (k_ == 1) return;
    const std::uint32_t all = (std::uint32_t{1} << (d_ + 1)) - 1;
    w.neighbours.assign(std::size_t{all} + 1, 0);
    coxeter::LatticeVertex other(d_);
    for (std::uint32_t W = 1; W < all; ++W) {
      if (std::popcount(W) > w.colour) continue;
      const int last = W >> d_ & 1;
      for (int c = 0; c < d_; ++c) other[c] = vertex[c] - static_cast<int>(W >> c & 1) + last;
      w.neighbours[W] = place(other);
    }
  }

  /// Appends an orthonormal basis of the normal part of span(tau', T_p M) for every chain of `left` more sets W that
  /// contain `inner` properly.
  void collect(const Waiting& w, std::uint32_t inner, int left) {
    if (left == 0) {
      bases_.insert(bases_.end(), stack_.begin(), stack_.end());
      ++num_spans_;
      return;
    }
    const std::uint32_t rest = ((std::uint32_t{1} << (d_ + 1)) - 1) & ~inner;
    const auto k = static_cast<std::size_t>(k_);
    for (std::uint32_t more = rest; more != 0; more = (more - 1) & rest) {
      const std::uint32_t W = inner | more;
      if (std::popcount(W) > w.colour - (left - 1)) continue;
      const std::size_t at = stack_.size();
      stack_.resize(at + k);
      normal_part(w, &positions_[std::size_t{w.neighbours[W]} * d_], &stack_[at]);
      orthogonalise(at);
      collect(w, W, left - 1);
      stack_.resize(at);
    }
  }

  void normal_part(const Waiting& w, const double* x, double* y) const {
    for (int b = 0; b < k_; ++b) {
      const double* row = &w.frame[static_cast<std::size_t>(d_ - k_ + b) * d_];
      y[b] = 0;
      for (int c = 0; c < d_; ++c) y[b] += row[c] * (x[c] - w.point[c]);
    }
  }

  /// Makes the vector of k numbers at stack_[at] orthonormal to those before it; 0 when it depends on them up to
  /// rounding, which leaves a smaller span.
  void orthogonalise(std::size_t at) {
    double* y = &stack_[at];
    const double before = norm(y);
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t i = 0; i < at; i += k_) subtract_projection(y, &stack_[i]);
    const double after = norm(y);
    for (int b = 0; b < k_; ++b) y[b] = after > 1e-12 * before ? y[b] / after : 0;
  }

  double norm(const double* y) const {
    double squared = 0;
    for (int b = 0; b < k_; ++b) squared += y[b] * y[b];
    return std::sqrt(squared);
  }

  void subtract_projection(double* y, const double* unit) const {
    double product = 0;
    for (int b = 0; b < k_; ++b) product += y[b] * unit[b];
    for (int b = 0; b < k_; ++b) y[b] -= product * unit[b];
  }

  /// The least distance of the point with normal part y from the spans, or something below `enough` if it is below.
  double distance(const std::vector<double>& y, int size, double enough) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < num_spans_ && least >= enough; ++s) {
      rest_ = y;
      for (int i = 0; i < size; ++i) subtract_projection(rest_.data(), &bases_[(s * size + i) * k_]);
      least = std::min(least, norm(rest_.data()));
    }
    return least;
  }

  void choose(std::uint32_t v, const Waiting& w) {
    const int size = std::min(k_ - 1, w.colour);
    bases_.clear();
    stack_.clear();
    num_spans_ = 0;
    collect(w, 0, size);
    const auto d = static_cast<std::size_t>(d_);
    coxeter::KeyedRandom random(options_.rng_seed, {table_.coordinates(v), d});
    std::vector<double> step(d, 0.0), best(d, 0.0), x(d), y(static_cast<std::size_t>(k_));
    double best_distance = -1;
    for (int candidate = 0; candidate < options_.candidates && best_distance < min_distance_; ++candidate) {
      if (candidate > 0) random.in_ball(radius_ * (1 - 1e-12), step);
      for (std::size_t c = 0; c < d; ++c) x[c] = w.position[c] + step[c];
      normal_part(w, x.data(), y.data());
      const double found = distance(y, size, best_distance);
      if (found <= best_distance) continue;
      best_distance = found;
      best = step;
    }
    ++result_.placed;
    result_.moved += std::any_of(best.begin(), best.end(), [](double c) { return c != 0; });
    result_.below += best_distance < min_distance_;
    result_.least_distance = std::min(result_.least_distance, best_distance / radius_);
    for (std::size_t c = 0; c < d; ++c) {
      displacements_[std::size_t{v} * d + c] = best[c];
      positions_[std::size_t{v} * d + c] += best[c];
    }
  }

  const coxeter::Triangulation& triangulation_;
  const FootOracle& oracle_;
  const SequentialOptions& options_;
  SequentialResult& result_;
  int d_, k_;
  double radius_, min_distance_, near_;

  coxeter::VertexTable table_;                     // the vertices that have their places
  std::vector<double> positions_, displacements_;  // d per vertex
  std::vector<double> bases_, stack_, rest_;       // k per vector; bases_: as many vectors for every span
  std::size_t num_spans_ = 0;
};

}  // namespace

int colour(std::span<const std::int32_t> vertex) {
  const auto colours = static_cast<std::int64_t>(vertex.size()) + 1;
  std::int64_t sum = 0;
  for (const std::int32_t z : vertex) sum += z;
  return static_cast<int>((sum % colours + colours) % colours);
}

namespace {

void check(const PerturbedTriangulation& near, const SequentialOptions& options) {
  const int d = near.ambient_dim(), k = near.codim();
  if (!(options.max_displacement >= 0) || !std::isfinite(options.max_displacement))
    throw InvalidInput("max_displacement must be finite and not negative");
  if (!(options.min_distance >= 0)) throw InvalidInput("min_distance must not be negative");
  if (options.candidates < 1) throw InvalidInput("candidates must be positive");
  if (const double spans = coxeter::num_simplices_in_star(d, k - 1); k > 1 && (spans > kMaxSpans || d > 20))
    throw InvalidInput("the sequential scheme would look at up to " + std::to_string(spans) +
                       " spans for a vertex; in such a codimension use repair");
}

/// The scheme on one set of starts: places for all vertices known, a trace, and again while it meets new ones.
class Scheme {
 public:
  Scheme(PerturbedTriangulation& near, std::span<const std::uint32_t> starts, const SequentialOptions& options,
         double radius, double min_distance)
      : near_(near),
        options_(options),
        d_(near.ambient_dim()),
        placer_(near.triangulation(), near.oracle(), radius, min_distance, options, result_),
        watch_(options.run, "perturb"),
        from_(starts.begin(), starts.end()),
        feet_(from_.size()) {
    for (std::size_t i = 0; i < from_.size(); ++i)
      if (FootView view{}; near.foot(from_[i], 0, view)) feet_[i].assign(view.point, view.point + d_);
  }

  SequentialResult run() {
    for (;;) {
      if (!place_vertices()) return stop(watch_.reason());
      keep_starts_hit();
      HitWalkOptions walk_options;
      walk_options.enough = options_.accept;
      walk_options.region = options_.region;
      walk_options.run.max_simplices = options_.run.max_simplices;
      walk_options.run.progress = [this](const Progress& progress) {
        return !watch_.stopped_now(progress.simplices, progress.evaluations);
      };
      const HitWalk trace = walk_hit_facets(near_, from_, walk_options);
      record(trace);
      const bool settled = near_.num_vertices() == done_;
      result_.complete = trace.complete && settled;
      result_.all_accepted = result_.complete && result_.rounds.back().failing == 0 && result_.rounds.back().hit > 0;
      if (!trace.complete) return stop(watch_.reason() != StopReason::kNone ? watch_.reason() : trace.stop_reason);
      if (settled || static_cast<int>(result_.rounds.size()) >= options_.max_rounds) return std::move(result_);
    }
  }

 private:
  SequentialResult stop(StopReason reason) {
    result_.stop_reason = reason;
    result_.complete = false;
    return std::move(result_);
  }

  /// All vertices known so far go to their places. False when a limit stopped it.
  bool place_vertices() {
    for (; done_ < near_.num_vertices(); ++done_) {
      if (done_ % 64 == 63 && watch_.stopped_now(near_.num_simplices(), result_.oracle_calls)) return false;
      const auto z = near_.lattice_vertex(done_);
      vertex_.assign(z.begin(), z.end());
      const auto u = placer_.displacement(vertex_);
      if (!std::equal(u.begin(), u.end(), near_.displacement(done_))) near_.set_displacement(done_, u);
    }
    return true;
  }

  /// A start that the manifold left when its vertices moved is replaced by the nearest simplex that it meets now.
  void keep_starts_hit() {
    for (std::size_t i = 0; i < from_.size(); ++i)
      if (!feet_[i].empty() && !near_.evaluate(from_[i], options_.accept, true).is_hit())
        if (const std::uint32_t other = find_start(near_, feet_[i]); other < near_.num_simplices()) from_[i] = other;
  }

  void record(const HitWalk& trace) {
    SequentialRound round;
    round.vertices = done_;
    round.simplices = trace.simplices.size();
    round.worst_margin = std::numeric_limits<double>::infinity();
    result_.worst_separation = result_.worst_transversality = round.worst_margin;
    for (const std::uint32_t s : trace.simplices) {
      const Evaluation& evaluation = near_.evaluate(s, 0);
      round.worst_margin = std::min(round.worst_margin, double{evaluation.margin});
      result_.worst_separation = std::min(result_.worst_separation, double{evaluation.separation});
      result_.worst_transversality = std::min(result_.worst_transversality, double{evaluation.transversality});
      round.failing += evaluation.margin < options_.accept;
      round.hit += evaluation.is_hit();
    }
    result_.rounds.push_back(round);
  }

  PerturbedTriangulation& near_;
  const SequentialOptions& options_;
  int d_;
  SequentialResult result_;
  Placer placer_;
  RunWatch watch_;
  std::vector<std::uint32_t> from_;
  std::vector<std::vector<double>> feet_;  // points of M near the starts, where there are any
  std::uint32_t done_ = 0;                 // vertices in their places
  std::vector<std::int32_t> vertex_;
};

}  // namespace

SequentialResult sequential(PerturbedTriangulation& near, std::span<const std::uint32_t> starts,
                            const SequentialOptions& options) {
  check(near, options);
  const int d = near.ambient_dim(), k = near.codim();
  const WhitneyParameters paper = whitney_parameters(d, d - k, Variant::kCorrected);
  const double radius = options.max_displacement > 0
                            ? options.max_displacement
                            : std::pow(10, paper.log10_max_displacement) * near.triangulation().edge_length();
  const double part = options.min_distance > 0 ? options.min_distance : std::pow(10, paper.log10_slab);
  return Scheme(near, starts, options, radius, part * radius).run();
}

}  // namespace whitney::perturbation
