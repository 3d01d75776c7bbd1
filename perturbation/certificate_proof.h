// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <perturbation/certificate.h>

namespace whitney::perturbation {

/// What interval arithmetic proves of one simplex at one foot. The notation is that of certificate.h.
struct Proof {
  enum class Outcome {
    kProven,          ///< (A+), (B), (C) hold with all errors counted: which faces are hit is proved too
    kFrame,           ///< the frame of the foot is not orthonormal enough to say anything
    kSingleSheet,     ///< (C) is not proved: the simplex is too large for the reach, or too far away
    kSeparation,      ///< (A+) is not proved for some (k-1)-face
    kTransversality,  ///< (B) is not proved for some hit k-face
    kUndecided        ///< a k-face is neither proved to be hit nor proved not to be
  };
  Outcome outcome = Outcome::kSingleSheet;
  /// The vertices (positions in the simplex) of the face that failed; empty for kFrame and kSingleSheet.
  std::vector<int> face;
  Margins margins;  ///< floating point, exact up to rounding
  /// Facets that are hit, as in Margins, and the number of hit k-faces; set when proven.
  std::uint32_t hit_facets = 0;
  int num_hit = 0;

  bool proven() const { return outcome == Outcome::kProven; }
};

/// "separation (A+) of a face", and so on.
const char* to_string(Proof::Outcome outcome);

/// Proves the conditions of the certificate with interval arithmetic (CGAL). The positions of the vertices are exact as
/// stored; the foot is off by its errors and by the departure of its frame from an orthonormal one. With the errors
/// e_p, e_t of the foot and the bound delta of norm(F F^T - I) for its frame F, column i is uncertain by
///   eta_i = e_p + (e_t + 2.2 delta) abs(v_i - p),
/// because the tangent rows span a space within 1.1 delta of those of the orthonormal matrix nearest to F, and
/// 2 sin(x / 2) <= x. Everything is then proved for all columns in that range, with r_i + eta_i for r_i and
/// h(r_i + eta_i) + eta_i for h(r_i).
///
/// Directions and inverses are guessed in floating point (by `certificate`) and verified: e . P_i > abs(e) h_i for
/// (A+); the barycentric coordinates of a hit by a preconditioned interval system; (B) by
/// s_min(N^T U) = 1 / sqrt(1 + norm((T^T E)(N^T E)^-1)^2), E the edges of sigma from one vertex.
class CertificateProver {
 public:
  /// Keeps a reference to the certificate, whose evaluations it uses.
  explicit CertificateProver(Certificate& certificate);

  /// vertices and foot as for Certificate::evaluate.
  Proof prove(const double* const* vertices, const FootView& foot);

 private:
  /// Floating-point inverses of the k x k matrices of the P_j - P_0, for the k-faces that floating point takes to be
  /// hit. False, with the reason in `proof`, when one is singular.
  bool guess_inverses(Proof& proof);

  Certificate& certificate_;
  /// For every k-face, its (k-1)-faces: k + 1 numbers each.
  std::vector<std::uint32_t> subfaces_;
  std::vector<std::vector<double>> inverses_;  ///< per k-face: k x k
};

}  // namespace whitney::perturbation
