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

enum class Verdict {
  /// T~ is an embedded triangulation, every simplex of the trace is certified in interval arithmetic, and so is its
  /// neighbour across every hit facet: K is homeomorphic to the components of M that the trace meets. When the trace
  /// kept
  /// to a region: across every hit facet that does not leave it, and K is homeomorphic to the part of M in the
  /// simplices
  /// of the trace.
  kCertified,
  /// Proved that the triangulation is too coarse or badly placed: see the violation.
  kViolated,
  /// Anything else.
  kNotCertified
};

/// "certified", "violated", "not certified".
const char* to_string(Verdict verdict);

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

/// The verdict on a trace, with every inequality in interval arithmetic. embedding_bound: w of T (see displacement.h).
/// Afterwards near.evaluate names, for every certified simplex, the foot with which it was proved.
/// What the verdict rests on besides: the bounds that the oracle states (reach, curvature, errors of its feet).
CertificateReport certify(PerturbedTriangulation& near, const HitWalk& trace, double embedding_bound);

}  // namespace whitney::perturbation
