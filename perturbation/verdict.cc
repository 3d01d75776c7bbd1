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

CertificateReport certify(PerturbedTriangulation& near, const HitWalk& trace, double embedding_bound) {
  if (!(embedding_bound > 0)) throw InvalidInput("embedding_bound must be positive");
  const int d = near.ambient_dim();
  CertificateReport report;
  report.simplices = trace.simplices.size();
  report.complete = trace.complete;
  report.embedding_bound = embedding_bound;

  // The embedding. Vertices that were never looked at have u = 0.
  DisplacementMap displacements(d);
  for (std::uint32_t v = 0; v < near.num_vertices(); ++v) {
    const std::span<const double> u(near.displacement(v), d);
    if (std::any_of(u.begin(), u.end(), [](double c) { return c != 0; }))
      displacements.set(coxeter::LatticeVertex(near.lattice_vertex(v)), u);
  }
  const double rounding = position_rounding(near);
  report.displacement_max = (check_embedding(displacements, embedding_bound).largest_displacement + rounding) *
                            (1 + 4 * std::numeric_limits<double>::epsilon());
  report.embedded = 2 * report.displacement_max < embedding_bound;

  // Every simplex by itself.
  struct State {
    std::uint32_t hit_facets = 0;
    bool proven = false;
  };
  std::vector<State> state(near.num_simplices());
  std::vector<char> in_trace(near.num_simplices(), 0);
  CertificateProver prover(near.certificate());
  std::vector<const double*> corner(d + 1);
  std::vector<double> margins;
  std::vector<std::pair<float, std::uint32_t>> failing;
  std::optional<std::pair<float, Witness>> worst;
  const auto num_feet = static_cast<std::uint16_t>(d + 2 + d * (d + 1) / 2);
  const auto object = [&](std::uint32_t s, float margin, std::string reason, std::vector<int> face) {
    ++report.not_certified;
    failing.emplace_back(margin, s);
    if (worst && worst->first <= margin) return;
    worst.emplace(margin, Witness{near.simplex(s), centre_of(near, s), std::move(face), margin, std::move(reason)});
  };
  report.margin_min = std::numeric_limits<double>::infinity();
  for (const std::uint32_t s : trace.simplices) {
    in_trace[s] = 1;
    const Evaluation evaluation = near.evaluate(s, 1.0, true);
    Proof proof;
    const auto try_foot = [&](std::uint16_t candidate) {
      FootView foot{};
      if (candidate == Evaluation::kNoFoot || !near.foot(s, candidate, foot)) return false;
      for (int q = 0; q <= d; ++q) corner[q] = near.position(near.corners(s)[q]);
      Proof next = prover.prove(corner.data(), foot);
      if (proof.face.empty() || next.proven()) proof = std::move(next);
      return proof.proven() && proof.num_hit > 0;
    };
    bool done = try_foot(evaluation.candidate);
    // A margin above 1 whose proof fails is a matter of rounding or of the oracle's errors: another foot may do. It is
    // then the foot of this simplex, for whoever cuts out the complex too: what is hit has been proved for no other.
    for (std::uint16_t candidate = 0; !done && evaluation.margin > 1 && candidate < num_feet; ++candidate) {
      done = try_foot(candidate);
      if (!done) continue;
      Evaluation proven = evaluation;
      proven.candidate = candidate;
      proven.hit_facets = proof.hit_facets;
      near.remember(s, proven);
    }
    const double margin = proof.margins.margin();
    margins.push_back(margin);
    report.margin_min = std::min(report.margin_min, margin);
    if (done) {
      state[s] = {proof.hit_facets, true};
    } else {
      object(s, evaluation.margin,
             proof.proven()                                ? "a neighbour says it is hit, it says it is not"
             : evaluation.candidate == Evaluation::kNoFoot ? "the oracle has no foot near it"
                                                           : std::string(to_string(proof.outcome)) + " is not proved",
             proof.face);
    }
  }
  // And with its neighbours.
  if (report.not_certified == 0 && trace.complete) {
    for (const std::uint32_t s : trace.simplices) {
      for (int q = 0; q <= d; ++q) {
        if (!(state[s].hit_facets >> q & 1)) continue;
        const std::uint32_t other = near.neighbour(s, q);
        const int back = q == 0 ? d : q == d ? 0 : q;
        if (other < in_trace.size() && in_trace[other] && (state[other].hit_facets >> back & 1)) continue;
        if (trace.region && !trace.region(near, other)) continue;
        object(s, near.evaluate(s, 0).margin, "its neighbour across a facet that is hit is not certified to be hit",
               {});
        break;
      }
    }
  }
  if (!margins.empty()) {
    const auto middle = margins.begin() + static_cast<std::ptrdiff_t>(margins.size() / 2);
    std::nth_element(margins.begin(), middle, margins.end());
    report.margin_median = *middle;
  }

  if (worst) report.witness = std::move(worst->second);
  if (report.simplices == 0) {
    report.margin_min = 0;
    report.reason = "no simplex meets the manifold";
  } else if (report.not_certified > 0) {
    std::ostringstream text;
    text << report.not_certified << " of " << report.simplices << " simplices of dimension " << d
         << " are not certified; the worst is at " << whitney::text(report.witness->barycentre) << ": "
         << report.witness->reason << ", margin " << report.witness->margin;
    report.reason = text.str();
    std::sort(failing.begin(), failing.end());
    std::vector<std::uint32_t> suspects;
    for (const auto& [margin, s] : failing) suspects.push_back(s);
    report.violation = find_violation(near, suspects);
  } else if (!trace.complete) {
    report.reason = "the trace was cut short by a limit";
  } else if (!report.embedded) {
    std::ostringstream text;
    text << "displacements up to " << report.displacement_max << " are not proved to keep the triangulation embedded: "
         << "twice that must be below " << embedding_bound;
    report.reason = text.str();
  } else {
    report.verdict = Verdict::kCertified;
  }
  if (report.violation) {
    report.verdict = Verdict::kViolated;
    report.reason = describe(*report.violation) + ", near " +
                    whitney::text(std::span<const double>(report.violation->points).first(static_cast<std::size_t>(d)));
  }
  return report;
}

}  // namespace whitney::perturbation
