// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <perturbation/foot_oracle.h>
#include <perturbation/min_norm_point.h>
#include <perturbation/vertex_subsets.h>

namespace whitney::perturbation {

// Notation, here and in the files that include this one:
//   d, n, k = d - n   ambient dimension, intrinsic dimension, codimension
//   R, R_c            lower bounds of the reach and of the radius of curvature of M, R <= R_c
//   tau, v_i          a d-simplex of T~ and its vertices, i = 0 .. d
//   p, T, N           a foot: a point of M near tau, bases of the tangent and of the normal space there
//   P_i, Q_i          N^T (v_i - p), k numbers, and T^T (v_i - p), n numbers
//   r_i, r            abs(Q_i) and the largest of them
//   h(s)              R_c - sqrt(R_c^2 - s^2): the most that M leaves its tangent plane over a ball of radius s < R_c
//   sigma, phi        a k-face and a (k-1)-face of tau
//   hit               a face is hit when 0 lies in the convex hull of its P_i, that is, when it meets the plane p + T

/// What one foot says about one d-simplex. Floating point: a guide, not a proof (see certificate_proof.h).
struct Margins {
  /// (A+): the least distance of 0 from hull{P_i / h_i : v_i in phi} over the (k-1)-faces phi; a lower bound of it
  /// where it is above what was enough for the caller.
  double separation = 0;
  /// (B): the least of s_min(N^T U) R_c / r over the hit k-faces sigma, U an orthonormal basis of the directions of
  /// sigma; infinite when none is hit.
  double transversality = 0;
  /// (C): r < R and abs(P_i) < R + sqrt(R^2 - r^2) for all i. When it fails, nothing else is set.
  bool single_sheet = false;
  /// Bit q: a k-face that does not contain v_q is hit, so the facet opposite to v_q is.
  std::uint32_t hit_facets = 0;
  /// The number of hit k-faces.
  int num_hit = 0;

  bool is_hit() const { return num_hit > 0; }
  /// Certified when above 1. 0 when (C) fails.
  double margin() const { return !single_sheet ? 0 : separation < transversality ? separation : transversality; }
};

/// A foot as it is handed over: point d, frame d x d (rows: n tangent vectors, k normal vectors).
struct FootView {
  const double* point;
  const double* frame;
  FootErrors errors;
};

/// Evaluates the conditions of the certificate on one simplex after the other: a d-simplex tau, or a face of it of
/// dimension at least k, for which the same argument says how M meets it. Keeps scratch memory; one object per thread.
/// The conditions and the theorem: perturbation/README.md.
class Certificate {
 public:
  /// simplex_dim: the dimension m of the simplices, k <= m <= d; d when negative. Throws InvalidInput unless
  /// 1 <= intrinsic_dim < ambient_dim <= 31 and 0 < reach <= curvature_radius are finite.
  Certificate(int ambient_dim, int intrinsic_dim, double reach, double curvature_radius, int simplex_dim = -1);

  int ambient_dim() const { return d_; }
  int intrinsic_dim() const { return n_; }
  int codim() const { return k_; }
  int simplex_dim() const { return m_; }
  double reach() const { return reach_; }
  double curvature_radius() const { return curvature_radius_; }
  const VertexSubsets& low_faces() const { return low_faces_; }   ///< the (k-1)-faces
  const VertexSubsets& hit_candidates() const { return faces_; }  ///< the k-faces

  /// The margins of the simplex with the given vertices (m + 1 pointers to d numbers) at one foot.
  /// Distances in (A+) are exact (up to rounding) below `enough`, and known to be at least that otherwise. As soon as
  /// one turns out to be at most `useless` the work stops: then the separation is that, and nothing else is set.
  Margins evaluate(const double* const* vertices, const FootView& foot,
                   double enough = std::numeric_limits<double>::infinity(), double useless = -1);

  /// A (k-1)-face that is too close to the plane, and in which direction its vertices leave it.
  struct Push {
    const std::uint8_t* face;  ///< k vertices of tau
    /// k steps (lengths): moving v_face[j] by steps[j] times `direction`, for all j, brings the separation of the face
    /// to the target, to first order.
    const double* steps;
    const double* direction;  ///< d: a unit vector of the normal space
  };
  /// Calls visit(const Push&) for every (k-1)-face whose separation is below target, for the arguments of the last
  /// call of evaluate, whose `enough` was at least target. When the face touches the plane, `fallback` (k numbers)
  /// gives the direction.
  template <class Visitor>
  void for_each_push(double target, std::span<const double> fallback, Visitor visit) {
    for (std::size_t f = 0; f < low_faces_.num(); ++f)
      if (make_push(f, target, fallback)) visit(Push{low_faces_[f], steps_.data(), direction_.data()});
  }

  /// Of the last call of evaluate, for whoever verifies it.
  const double* normal_part(int i) const { return &P_[i * k_]; }                         ///< P_i
  const double* tangent_part(int i) const { return &Q_[i * n_]; }                        ///< Q_i
  bool face_is_hit(std::size_t f) const { return hit_[f]; }                              ///< k-face f
  const double* hit_coordinates(std::size_t f) const { return &lambda_[f * (k_ + 1)]; }  ///< if hit: k + 1 numbers
  /// For (k-1)-face f: a direction e (k) with e . P_i > abs(e) h_i for its vertices, if its separation is above 1.
  const double* separating_direction(std::size_t f) const { return &nearest_[f * k_]; }
  double separation(std::size_t f) const { return separation_[f]; }

 private:
  double measure(std::size_t f, double enough);
  void find_hits(Margins& margins);
  bool make_push(std::size_t f, double target, std::span<const double> fallback);

  int d_, n_, k_, m_;
  double reach_, curvature_radius_;
  VertexSubsets low_faces_, faces_;
  MinNormPoint min_norm_;
  FootView foot_{};
  std::vector<double> P_, Q_, weight_, scaled_;  // (m+1) x k, (m+1) x n, m+1, (m+1) x k
  std::size_t worst_ = 0;  // the (k-1)-face of the least separation seen last: where the next foot is likely to fail
  std::vector<double> separation_, nearest_, low_lambda_;  // per (k-1)-face: 1, k, k
  std::vector<char> hit_;                                  // per k-face
  std::vector<double> lambda_;                             // per k-face: k+1
  std::vector<double> matrix_, slope_, gram_, power_;      // scratch of find_hits
  std::vector<double> steps_, direction_;
  std::vector<const double*> corner_;
};

}  // namespace whitney::perturbation
