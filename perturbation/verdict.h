// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <perturbation/certificate_proof.h>
#include <perturbation/hit_walk.h>
#include <perturbation/violation.h>

namespace whitney::perturbation {

/// What the check of a trace came to. Every verdict but the last says "proved", and means: proved, provided that what
/// VerdictBasis names holds. Only VerdictBasis::unconditional() makes it a proof without any such words.
enum class Verdict {
  /// T~ is an embedded triangulation, every simplex of the trace is certified in interval arithmetic, and so is its
  /// neighbour across every hit facet: K is homeomorphic to the components of M that the trace meets. When the trace
  /// kept to a region: across every hit facet that does not leave it, and K is homeomorphic to the part of M in the
  /// simplices of the trace.
  kCertified,
  /// Proved that the triangulation is too coarse or badly placed: see the violation.
  kViolated,
  /// Anything else.
  kNotCertified
};

/// "certified", "violated", "not certified".
const char* to_string(Verdict verdict);

/// Which components of M a verdict speaks of.
enum class Components {
  kOfSeeds,    ///< those that the seeds lie on; M may have more
  kLikelyAll,  ///< likewise, but the seeds came from a search: M is not likely to have more, which is not proved
  kAll         ///< all of them: proved, or known from the definition of M
};

/// "those of the seeds", "likely all", "all".
const char* to_string(Components components);

/// What a verdict rests on besides IEEE arithmetic with directed rounding and the positions as stored.
struct VerdictBasis {
  /// Who says that the reach and the curvature radius are what the oracle states.
  ReachSource reach = ReachSource::kCaller;
  /// What the oracle vouches for: of `errors` every verdict makes use; `place` matters only for violations of the kind
  /// kMissesAllFaces, which are not claimed unless it is kGlobal and the errors are proven.
  FootPromise feet;
  /// Which components kCertified is about. certify says kOfSeeds; whoever knows more may say so.
  Components components = Components::kOfSeeds;

  /// The reach follows from the definition of M, and so do the errors of the feet: nothing is taken on trust.
  bool unconditional() const { return reach == ReachSource::kProven && feet.errors == FootPromise::Errors::kProven; }
};

/// What has to hold for the verdict to be one: "if the reach is at least what the caller says and the errors of the
/// feet are at most what is modelled". Empty when the basis is unconditional.
std::string conditions(const VerdictBasis& basis);

/// A simplex that stands in the way of the certificate.
struct Witness {
  coxeter::Simplex simplex;
  std::vector<double> barycentre;  ///< d
  std::vector<int> face;           ///< vertices of the face that fails, positions in the simplex; may be empty
  double margin = 0;               ///< of the simplex, floating point
  std::string reason;              ///< what is not proved
};

struct CertificateReport {
  Verdict verdict = Verdict::kNotCertified;
  VerdictBasis basis;
  std::size_t simplices = 0;                 ///< d-simplices of the trace
  std::size_t not_certified = 0;             ///< those for which no foot gives a proof, or whose neighbour lacks one
  double margin_min = 0, margin_median = 0;  ///< floating point
  double displacement_max = 0;  ///< an upper bound of all abs(u(v)), rounding of the positions included (a length)
  double embedding_bound = 0;   ///< w; 2 displacement_max < w is proved when `embedded`
  bool embedded = false;
  bool complete = false;  ///< the trace was not cut short
  std::optional<Witness> witness;
  std::optional<Violation> violation;
  std::string reason;  ///< one sentence: why the verdict is not "certified"; empty when it is
};

/// The verdict with its conditions: "certified" only when nothing is taken on trust, otherwise "certified, if the reach
/// is ..". The conditions of "violated" likewise; "not certified" has none.
std::string describe(const CertificateReport& report);

/// The verdict on a trace, with every inequality in interval arithmetic. embedding_bound: w of T (see displacement.h).
/// Afterwards near.evaluate names, for every certified simplex, the foot with which it was proved. Steps: the
/// embedding; every simplex by itself; every simplex with its neighbours; the verdict. Throws InvalidInput unless
/// embedding_bound is positive.
CertificateReport certify(PerturbedTriangulation& near, const HitWalk& trace, double embedding_bound);

}  // namespace whitney::perturbation
