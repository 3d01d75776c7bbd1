// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/repair.h>

#include <algorithm>
#include <cmath>

#include <coxeter/base/error.h>
#include <coxeter/base/keyed_random.h>
#include <coxeter/base/run_watch.h>

namespace whitney::perturbation {
namespace {

/// Rounds in which the trace grows are not counted against max_rounds; this ends them all the same.
constexpr int kMostRounds = 1000;

/// The limits are looked at once in so many steps.
constexpr std::size_t kAskEvery = 16;

class Repairer {
 public:
  Repairer(PerturbedTriangulation& near, std::span<const std::uint32_t> starts, const RepairOptions& options)
      : near_(near),
        starts_(starts.begin(), starts.end()),
        options_(options),
        watch_(options.run, "perturb"),
        d_(near.ambient_dim()),
        step_(d_),
        fallback_(near.codim()) {
    if (!(options.max_displacement > 0)) throw InvalidInput("max_displacement must be positive");
    std::erase_if(starts_, [&](std::uint32_t s) { return !near.evaluate(s, 1).is_hit(); });
    near.forget();
  }

  RepairResult run() {
    if (starts_.empty()) return std::move(result_);
    int settled = 0;  // rounds that did not find the trace much larger than the one before did
    for (round_ = 0;; ++round_) {
      bool polish = settled >= options_.sweeps && !is_stuck();
      const double target = settled < 2 ? options_.first_target : options_.target;
      const HitWalk trace = walk(polish, target);
      const bool grew = record(trace);
      // Where a trace ended at exact zeros, the next one goes on; what it finds is swept before it is polished.
      if (grew)
        polish = false;
      else
        ++settled;
      RepairRound& round = result_.rounds.back();
      round.polish = polish;
      result_.all_accepted = trace.complete && failing_.empty();
      if (!trace.complete) return stop(watch_.reason() != StopReason::kNone ? watch_.reason() : trace.stop_reason);
      if (result_.all_accepted || settled > options_.max_rounds || round_ > kMostRounds) return std::move(result_);
      if (polish && static_cast<double>(failing_.size()) > options_.hopeless * static_cast<double>(round.simplices))
        return std::move(result_);
      if (!(polish ? polish_all(trace) : sweep(trace, target))) return stop(watch_.reason());
    }
  }

 private:
  RepairResult stop(StopReason reason) {
    result_.stop_reason = reason;
    result_.complete = false;
    return std::move(result_);
  }

  /// A polish that left as many failing as it found has run into places where every move uncovers others that fail
  /// (exact zeros all around, so that the trace ended there): sweeps get through.
  bool is_stuck() const {
    const std::size_t last = result_.rounds.size();
    return last >= 2 && result_.rounds[last - 1].polish && result_.rounds[last - 2].polish &&
           result_.rounds[last - 1].failing >= result_.rounds[last - 2].failing;
  }

  /// A trace from the starts, with as many feet as what follows needs.
  HitWalk walk(bool polish, double target) {
    HitWalkOptions walk_options;
    walk_options.enough = polish ? options_.accept : target;
    walk_options.with_midpoints = polish;
    walk_options.region = options_.region;
    walk_options.run.max_simplices = options_.run.max_simplices;
    walk_options.run.progress = [this](const Progress& progress) {
      return !watch_.stopped_now(progress.simplices, progress.evaluations);
    };
    keep_starts_hit();
    return walk_hit_facets(near_, starts_, walk_options);
  }

  /// Appends the round of this trace, and collects its failing simplices. Whether it reached much further than the one
  /// before.
  bool record(const HitWalk& trace) {
    RepairRound round;
    round.simplices = trace.simplices.size();
    round.worst_margin = std::numeric_limits<double>::infinity();
    failing_.clear();
    for (const std::uint32_t s : trace.simplices) {
      const double margin = near_.evaluate(s, 0).margin;
      round.worst_margin = std::min(round.worst_margin, margin);
      if (margin < options_.accept || !near_.evaluate(s, 0).is_hit()) failing_.push_back(s);
    }
    round.failing = failing_.size();
    const bool grew = !result_.rounds.empty() &&
                      static_cast<double>(round.simplices) > 1.1 * static_cast<double>(result_.rounds.back().simplices);
    result_.rounds.push_back(round);
    return grew;
  }

  /// False when a limit stopped it.
  bool sweep(const HitWalk& trace, double target) {
    for (const std::uint32_t s : trace.simplices) {
      if (!going()) return false;
      push(s, target);
    }
    return true;
  }

  /// False when a limit stopped it.
  bool polish_all(const HitWalk& trace) {
    reached_.assign(near_.num_simplices(), 0);
    for (const std::uint32_t s : trace.simplices) reached_[s] = 1;
    for (const std::uint32_t s : failing_)
      if (!polish_simplex(s)) return false;
    return true;
  }

  /// A start that moves have taken off the manifold would end the trace at once: the nearest hit simplex replaces it.
  /// One that was never hit has been searched around already.
  void keep_starts_hit() {
    for (std::uint32_t& s : starts_) {
      if (near_.evaluate(s, 1).is_hit()) continue;
      std::vector<double> centre(d_, 0.0);
      for (int q = 0; q <= d_; ++q)
        for (int c = 0; c < d_; ++c) centre[c] += near_.position(near_.corners(s)[q])[c] / (d_ + 1);
      s = find_start(near_, centre);
    }
  }

  bool going() { return ++count_ % kAskEvery != 0 || !watch_.stopped_now(near_.num_simplices(), near_.oracle_calls()); }

  /// Random numbers of this round for the simplex s.
  coxeter::KeyedRandom random_of(std::uint32_t s) {
    const auto z = near_.lattice_vertex(near_.base(s));
    key_.assign(z.begin(), z.end());
    for (int c = 0; c < d_; ++c) key_.push_back(near_.part(s, c));
    key_.push_back(round_);
    return {options_.rng_seed, key_};
  }

  /// Moves v by step, and back into the ball of radius rho about its lattice position.
  void move(std::uint32_t v, std::span<const double> step) {
    moved_.assign(near_.displacement(v), near_.displacement(v) + d_);
    double length = 0;
    for (int c = 0; c < d_; ++c) {
      moved_[c] += step[c];
      length += moved_[c] * moved_[c];
    }
    length = std::sqrt(length);
    if (length > options_.max_displacement)
      for (double& c : moved_) c *= options_.max_displacement / length * (1 - 1e-12);
    near_.set_displacement(v, moved_);
  }

  /// Pushes all (k-1)-faces of s, as its best foot sees them, to the target.
  void push(std::uint32_t s, double target) {
    const Evaluation& evaluation = near_.evaluate(s, target);
    if (evaluation.margin >= target) return;
    Margins margins;
    if (!near_.evaluate_at(s, evaluation.candidate, margins, target) || !margins.single_sheet) return;
    random_of(s).in_ball(1, fallback_);
    steps_.assign((d_ + 1) * static_cast<std::size_t>(d_), 0.0);
    near_.certificate().for_each_push(target, fallback_, [&](const Certificate::Push& push) {
      for (int j = 0; j < near_.codim(); ++j)
        for (int c = 0; c < d_; ++c) steps_[push.face[j] * d_ + c] += push.steps[j] * push.direction[c];
    });
    for (int q = 0; q <= d_; ++q) {
      const std::span<const double> step(&steps_[static_cast<std::size_t>(q) * d_], d_);
      if (std::any_of(step.begin(), step.end(), [](double c) { return c != 0; })) move(near_.corners(s)[q], step);
    }
  }

  double penalty(const Evaluation& evaluation) const {
    return evaluation.margin < options_.accept ? 1 + options_.accept - evaluation.margin : 0;
  }

  /// The visited simplices around the vertices that are about to move.
  void collect_before(std::span<const std::uint32_t> moving) {
    before_.clear();
    for (const std::uint32_t v : moving)
      for (const std::uint32_t s : near_.star(v))
        if (is_reached(s) && mark(s)) before_.push_back(s);
    for (const std::uint32_t s : before_) marks_[s] = 0;
  }

  bool is_reached(std::uint32_t s) const { return s < reached_.size() && reached_[s]; }
  bool mark(std::uint32_t s) {
    if (marks_.size() <= s) marks_.resize(near_.num_simplices() + 1, 0);
    if (marks_[s]) return false;
    marks_[s] = 1;
    return true;
  }

  bool has_corner_among(std::uint32_t s, int except, std::span<const std::uint32_t> moving) const {
    const std::uint32_t* corner = near_.corners(s);
    for (int i = 0; i <= d_; ++i)
      if (i != except && std::find(moving.begin(), moving.end(), corner[i]) != moving.end()) return true;
    return false;
  }

  /// The penalty after the move, over the simplices around the moved vertices that are hit now: those hit before that
  /// still are, and what a walk across hit facets inside the stars reaches from them. Stops when it exceeds `limit`.
  double penalty_after(std::span<const std::uint32_t> moving, double limit) {
    after_.clear();
    double sum = 0;
    const auto visit = [&](std::uint32_t s) {
      if (!mark(s)) return;
      after_.push_back(s);
      sum += penalty(near_.evaluate(s, options_.accept, true));
    };
    for (const std::uint32_t s : before_) {
      if (sum > limit) break;
      if (near_.evaluate(s, options_.accept, true).is_hit()) visit(s);
    }
    for (std::size_t next = 0; next < after_.size() && sum <= limit; ++next) {
      const std::uint32_t s = after_[next];
      const std::uint32_t hit = near_.evaluate(s, 0).hit_facets;
      for (int q = 0; q <= d_; ++q)
        if ((hit >> q & 1) && has_corner_among(s, q, moving)) visit(near_.neighbour(s, q));
    }
    for (const std::uint32_t s : after_) marks_[s] = 0;
    return sum;
  }

  struct Saved {
    std::vector<double> displacement;
    std::uint64_t version;
  };

  /// One trial: moves the vertices by steps (d numbers each) and keeps that if the penalty falls.
  bool trial(std::span<const std::uint32_t> moving, std::span<const double> steps) {
    collect_before(moving);
    double before = 0;
    remembered_.clear();
    for (const std::uint32_t s : before_) {
      remembered_.push_back(near_.evaluate(s, options_.accept, true));
      before += penalty(remembered_.back());
    }
    if (before == 0) return false;
    saved_.clear();
    for (std::size_t i = 0; i < moving.size(); ++i) {
      const double* u = near_.displacement(moving[i]);
      saved_.push_back({{u, u + d_}, near_.version(moving[i])});
      move(moving[i], steps.subspan(i * d_, d_));
    }
    if (penalty_after(moving, before * (1 - 1e-6)) < before * (1 - 1e-6)) {
      for (const std::uint32_t s : before_) reached_[s] = 0;
      reached_.resize(std::max(reached_.size(), near_.num_simplices()), 0);
      for (const std::uint32_t s : after_) reached_[s] = 1;
      return true;
    }
    for (std::size_t i = 0; i < moving.size(); ++i) near_.restore(moving[i], saved_[i].displacement, saved_[i].version);
    for (std::size_t i = 0; i < before_.size(); ++i) near_.remember(before_[i], remembered_[i]);
    return false;
  }

  /// Trials until s is accepted or given up. False when a limit stopped it.
  bool polish_simplex(std::uint32_t s) {
    coxeter::KeyedRandom random = random_of(s);
    for (int attempt = 0; attempt < options_.trials; ++attempt) {
      if (!is_reached(s)) return true;
      if (!going()) return false;
      const Evaluation evaluation = near_.evaluate(s, options_.accept, true);
      if (evaluation.margin >= options_.accept) return true;
      Margins margins;
      moving_.clear();
      trial_steps_.clear();
      const std::uint32_t* corner = near_.corners(s);
      if (near_.evaluate_at(s, evaluation.candidate, margins, options_.target) && margins.single_sheet &&
          margins.separation < options_.accept && attempt % 4 != 3) {
        // The worst face: pushed (by more, then by less than needed), or all of it or one vertex at random.
        random.in_ball(1, fallback_);
        double worst = options_.target;
        std::vector<double> steps;
        near_.certificate().for_each_push(options_.target, fallback_, [&](const Certificate::Push& push) {
          const auto f = static_cast<std::size_t>(push.face - near_.certificate().low_faces()[0]) / near_.codim();
          if (near_.certificate().separation(f) >= worst) return;
          worst = near_.certificate().separation(f);
          moving_.clear();
          trial_steps_.clear();
          for (int j = 0; j < near_.codim(); ++j) {
            moving_.push_back(corner[push.face[j]]);
            for (int c = 0; c < d_; ++c) trial_steps_.push_back(push.steps[j] * push.direction[c]);
          }
        });
        if (attempt < 4) {
          const double factor = attempt == 0 ? 1 : attempt == 1 ? 2 : 0.5;
          for (double& c : trial_steps_) c *= factor;
        } else {
          if (random.below(2) == 0 && !moving_.empty())
            moving_ = {moving_[random.below(static_cast<int>(moving_.size()))]};
          random_steps(random);
        }
      } else {
        moving_ = {corner[random.below(d_ + 1)]};
        random_steps(random);
      }
      if (!moving_.empty()) trial(moving_, trial_steps_);
    }
    return true;
  }

  void random_steps(coxeter::KeyedRandom& random) {
    const double size = options_.max_displacement * std::pow(10.0, 0.3 - 2 * random.uniform());
    trial_steps_.clear();
    for (std::size_t i = 0; i < moving_.size(); ++i) {
      random.in_ball(size, step_);
      trial_steps_.insert(trial_steps_.end(), step_.begin(), step_.end());
    }
  }

  PerturbedTriangulation& near_;
  std::vector<std::uint32_t> starts_;
  const RepairOptions& options_;
  RepairResult result_;
  RunWatch watch_;
  int d_, round_ = 0;
  std::size_t count_ = 0;
  std::vector<double> step_, fallback_, moved_, steps_, trial_steps_;
  std::vector<std::uint32_t> failing_, before_, after_, moving_;
  std::vector<std::int32_t> key_;
  std::vector<char> reached_, marks_;
  std::vector<Evaluation> remembered_;
  std::vector<Saved> saved_;
};

}  // namespace

RepairResult repair(PerturbedTriangulation& near, std::span<const std::uint32_t> starts, const RepairOptions& options) {
  return Repairer(near, starts, options).run();
}

}  // namespace whitney::perturbation
