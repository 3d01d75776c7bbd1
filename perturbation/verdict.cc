// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/verdict.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <coxeter/base/error.h>
#include <coxeter/base/text.h>
#include <perturbation/displacement.h>

namespace whitney::perturbation {
namespace {

/// An upper bound of what the rounding of x(v) + u(v) adds to abs(u(v)), over the vertices in sight: each coordinate is
/// a sum of d + 2 terms, accumulated in order.
double position_rounding(const PerturbedTriangulation& near) {
  const int d = near.ambient_dim();
  const Matrix& linear = near.triangulation().linear();
  const std::vector<double>& offset = near.triangulation().offset();
  double worst = 0;
  for (std::uint32_t v = 0; v < near.num_vertices(); ++v) {
    const auto z = near.lattice_vertex(v);
    double squared = 0;
    for (int c = 0; c < d; ++c) {
      double size = std::abs(offset[c]) + std::abs(near.displacement(v)[c]);
      for (int j = 0; j < d; ++j) size += std::abs(linear(c, j)) * std::abs(static_cast<double>(z[j]));
      squared += size * size;
    }
    worst = std::max(worst, squared);
  }
  return std::sqrt(worst) * (d + 3) * 1.01 * std::numeric_limits<double>::epsilon();
}

/// Barycentre of simplex s of T~.
std::vector<double> centre_of(const PerturbedTriangulation& near, std::uint32_t s) {
  const int d = near.ambient_dim();
  std::vector<double> centre(d, 0.0);
  for (int q = 0; q <= d; ++q)
    for (int c = 0; c < d; ++c) centre[c] += near.position(near.corners(s)[q])[c] / (d + 1);
  return centre;
}

/// One verdict, step by step.
class Certifier {
 public:
  Certifier(PerturbedTriangulation& near, const HitWalk& trace, double embedding_bound)
      : near_(near),
        trace_(trace),
        d_(near.ambient_dim()),
        prover_(near.certificate()),
        corner_(d_ + 1),
        state_(near.num_simplices()),
        in_trace_(near.num_simplices(), 0) {
    report_.basis = {near.oracle().reach_source(), near.oracle().promise(), Components::kOfSeeds};
    report_.simplices = trace.simplices.size();
    report_.complete = trace.complete;
    report_.embedding_bound = embedding_bound;
  }

  CertificateReport run() {
    check_displacements();
    report_.margin_min = std::numeric_limits<double>::infinity();
    for (const std::uint32_t s : trace_.simplices) prove_simplex(s);
    if (report_.not_certified == 0 && trace_.complete)
      for (const std::uint32_t s : trace_.simplices) check_neighbours(s);
    summarise_margins();
    conclude();
    return std::move(report_);
  }

 private:
  struct State {
    std::uint32_t hit_facets = 0;
    bool proven = false;
  };

  /// The embedding. Vertices that were never looked at have u = 0.
  void check_displacements() {
    DisplacementMap displacements(d_);
    for (std::uint32_t v = 0; v < near_.num_vertices(); ++v) {
      const std::span<const double> u(near_.displacement(v), d_);
      if (std::any_of(u.begin(), u.end(), [](double c) { return c != 0; }))
        displacements.set(coxeter::LatticeVertex(near_.lattice_vertex(v)), u);
    }
    const double rounding = position_rounding(near_);
    report_.displacement_max =
        (check_embedding(displacements, report_.embedding_bound).largest_displacement + rounding) *
        (1 + 4 * std::numeric_limits<double>::epsilon());
    report_.embedded = 2 * report_.displacement_max < report_.embedding_bound;
  }

  /// A simplex by itself: proved at one of its feet, and hit.
  void prove_simplex(std::uint32_t s) {
    in_trace_[s] = 1;
    const Evaluation evaluation = near_.evaluate(s, 1.0, true);
    Proof proof;
    bool done = try_foot(s, evaluation.candidate, proof);
    // A margin above 1 whose proof fails is a matter of rounding or of the oracle's errors: another foot may do. It is
    // then the foot of this simplex, for whoever cuts out the complex too: what is hit has been proved for no other.
    const auto num_feet = static_cast<std::uint16_t>(d_ + 2 + d_ * (d_ + 1) / 2);
    for (std::uint16_t candidate = 0; !done && evaluation.margin > 1 && candidate < num_feet; ++candidate) {
      done = try_foot(s, candidate, proof);
      if (!done) continue;
      Evaluation proven = evaluation;
      proven.candidate = candidate;
      proven.hit_facets = proof.hit_facets;
      near_.remember(s, proven);
    }
    const double margin = proof.margins.margin();
    margins_.push_back(margin);
    report_.margin_min = std::min(report_.margin_min, margin);
    if (done)
      state_[s] = {proof.hit_facets, true};
    else
      object(s, evaluation.margin,
             proof.proven()                                ? "a neighbour says it is hit, it says it is not"
             : evaluation.candidate == Evaluation::kNoFoot ? "the oracle has no foot near it"
                                                           : std::string(to_string(proof.outcome)) + " is not proved",
             proof.face);
  }

  /// Whether the simplex is proved to be certified and hit at this foot. `proof`: the best so far.
  bool try_foot(std::uint32_t s, std::uint16_t candidate, Proof& proof) {
    FootView foot{};
    if (candidate == Evaluation::kNoFoot || !near_.foot(s, candidate, foot)) return false;
    for (int q = 0; q <= d_; ++q) corner_[q] = near_.position(near_.corners(s)[q]);
    Proof next = prover_.prove(corner_.data(), foot);
    if (proof.face.empty() || next.proven()) proof = std::move(next);
    return proof.proven() && proof.num_hit > 0;
  }

  /// The neighbour across every hit facet is certified, and hit in that facet too.
  void check_neighbours(std::uint32_t s) {
    for (int q = 0; q <= d_; ++q) {
      if (!(state_[s].hit_facets >> q & 1)) continue;
      const std::uint32_t other = near_.neighbour(s, q);
      const int back = q == 0 ? d_ : q == d_ ? 0 : q;
      if (other < in_trace_.size() && in_trace_[other] && (state_[other].hit_facets >> back & 1)) continue;
      if (trace_.region && !trace_.region(near_, other)) continue;
      object(s, near_.evaluate(s, 0).margin, "its neighbour across a facet that is hit is not certified to be hit", {});
      return;
    }
  }

  /// Notes that s stands in the way of the certificate.
  void object(std::uint32_t s, float margin, std::string reason, std::vector<int> face) {
    ++report_.not_certified;
    failing_.emplace_back(margin, s);
    if (worst_ && worst_->first <= margin) return;
    worst_.emplace(margin, Witness{near_.simplex(s), centre_of(near_, s), std::move(face), margin, std::move(reason)});
  }

  void summarise_margins() {
    if (margins_.empty()) {
      report_.margin_min = 0;
      return;
    }
    const auto middle = margins_.begin() + static_cast<std::ptrdiff_t>(margins_.size() / 2);
    std::nth_element(margins_.begin(), middle, margins_.end());
    report_.margin_median = *middle;
  }

  void conclude() {
    if (worst_) report_.witness = std::move(worst_->second);
    std::ostringstream text;
    if (report_.simplices == 0) {
      text << "no simplex meets the manifold";
    } else if (report_.not_certified > 0) {
      text << report_.not_certified << " of " << report_.simplices << " simplices of dimension " << d_
           << " are not certified; the worst is at " << whitney::text(report_.witness->barycentre) << ": "
           << report_.witness->reason << ", margin " << report_.witness->margin;
      std::sort(failing_.begin(), failing_.end());
      std::vector<std::uint32_t> suspects;
      for (const auto& [margin, s] : failing_) suspects.push_back(s);
      report_.violation = find_violation(near_, suspects);
    } else if (!trace_.complete) {
      text << "the trace was cut short by a limit";
    } else if (!report_.embedded) {
      text << "displacements up to " << report_.displacement_max
           << " are not proved to keep the triangulation embedded: twice that must be below "
           << report_.embedding_bound;
    } else {
      report_.verdict = Verdict::kCertified;
    }
    report_.reason = text.str();
    if (!report_.violation) return;
    report_.verdict = Verdict::kViolated;
    report_.reason =
        describe(*report_.violation) + ", near " +
        whitney::text(std::span<const double>(report_.violation->points).first(static_cast<std::size_t>(d_)));
  }

  PerturbedTriangulation& near_;
  const HitWalk& trace_;
  int d_;
  CertificateProver prover_;
  std::vector<const double*> corner_;
  std::vector<State> state_;    // per simplex known to near_ at the start
  std::vector<char> in_trace_;  // likewise
  std::vector<double> margins_;
  std::vector<std::pair<float, std::uint32_t>> failing_;
  std::optional<std::pair<float, Witness>> worst_;
  CertificateReport report_;
};

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::kCertified:
      return "certified";
    case Verdict::kViolated:
      return "violated";
    default:
      return "not certified";
  }
}

const char* to_string(Components components) {
  switch (components) {
    case Components::kOfSeeds:
      return "those of the seeds";
    case Components::kLikelyAll:
      return "likely all";
    case Components::kAll:
      return "all";
  }
  return "unknown";
}

std::string conditions(const VerdictBasis& basis) {
  std::string text;
  if (basis.reach == ReachSource::kCaller) text = "if the reach is at least what the caller says";
  if (basis.reach == ReachSource::kEstimated) text = "if the reach is at least what was estimated";
  if (basis.feet.errors == FootPromise::Errors::kModelled)
    text += std::string(text.empty() ? "if" : " and") + " the errors of the feet are at most what is modelled";
  return text;
}

std::string describe(const CertificateReport& report) {
  std::string text = to_string(report.verdict);
  if (report.verdict == Verdict::kNotCertified) return text;
  VerdictBasis basis = report.basis;
  // That M meets no face is told by distances alone.
  if (report.violation && report.violation->kind == Violation::Kind::kMissesAllFaces)
    basis.reach = ReachSource::kProven;
  if (const std::string rest = conditions(basis); !rest.empty()) text += ", " + rest;
  return text;
}

CertificateReport certify(PerturbedTriangulation& near, const HitWalk& trace, double embedding_bound) {
  if (!(embedding_bound > 0)) throw InvalidInput("embedding_bound must be positive");
  return Certifier(near, trace, embedding_bound).run();
}

}  // namespace whitney::perturbation
