// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/certificate_proof.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <perturbation/interval.h>
#include <perturbation/small_inverse.h>

namespace whitney::perturbation {
namespace {

/// One simplex at one foot, step by step. Everything but the guesses is in intervals, under the guard of prove().
/// A step that is not proved says so in `proof` and returns false.
class Attempt {
 public:
  /// inverses: see guess_inverses. subfaces: for every k-face, its (k-1)-faces.
  Attempt(const Certificate& certificate, const std::vector<std::uint32_t>& subfaces, const double* const* vertices,
          const FootView& foot, const std::vector<std::vector<double>>& inverses, Proof& proof)
      : certificate_(certificate),
        subfaces_(subfaces),
        vertices_(vertices),
        foot_(foot),
        inverses_(inverses),
        proof_(proof),
        d_(certificate.ambient_dim()),
        n_(certificate.intrinsic_dim()),
        k_(certificate.codim()),
        num_(certificate.simplex_dim() + 1),
        R_(certificate.reach()),
        R_c_(certificate.curvature_radius()) {}

  void run() {
    if (!frame_is_orthonormal()) return;
    enclose_columns();
    if (single_sheet() && faces_are_separated() && hits_are_proved()) proof_.outcome = Proof::Outcome::kProven;
  }

 private:
  bool fail(Proof::Outcome outcome, const std::uint8_t* face, int size) {
    proof_.outcome = outcome;
    proof_.face.assign(face, face + size);
    return false;
  }

  /// turn_: by how much the spans of the rows of the frame may be off, delta included.
  bool frame_is_orthonormal() {
    Interval departure(0);
    for (int a = 0; a < d_; ++a)
      for (int b = 0; b <= a; ++b) {
        Interval sum(a == b ? -1 : 0);
        for (int c = 0; c < d_; ++c) sum += Interval(foot_.frame[a * d_ + c]) * Interval(foot_.frame[b * d_ + c]);
        departure += Interval(a == b ? 1 : 2) * Interval(above(sum)) * Interval(above(sum));
      }
    const double delta = above(sqrt(departure));
    if (!(delta < 1e-3)) {
      proof_.outcome = Proof::Outcome::kFrame;
      return false;
    }
    turn_ = Interval(foot_.errors.angle) + Interval(2.2) * Interval(delta);
    return true;
  }

  /// P_i, Q_i and their uncertainties eta_i; r_i + eta_i and abs(P_i) + eta_i.
  void enclose_columns() {
    P_.resize(static_cast<std::size_t>(num_) * k_);
    Q_.resize(static_cast<std::size_t>(num_) * n_);
    eta_.resize(num_);
    radius_.resize(num_);
    height_.resize(num_);
    std::vector<Interval> away(d_);
    for (int i = 0; i < num_; ++i) {
      Interval squared(0);
      for (int c = 0; c < d_; ++c) {
        away[c] = Interval(vertices_[i][c]) - Interval(foot_.point[c]);
        squared += Interval(above(away[c])) * Interval(above(away[c]));
      }
      eta_[i] = above(Interval(foot_.errors.point) + turn_ * sqrt(squared));
      radius_[i] = Interval(above(sqrt(multiply(0, n_, away, &Q_[i * n_])) + Interval(eta_[i])));
      largest_radius_ = std::max(largest_radius_, radius_[i].sup());
      height_[i] = sqrt(multiply(n_, k_, away, &P_[i * k_])) + Interval(eta_[i]);
    }
  }

  /// product: `count` rows of the frame from `first` on, times `away`. Returns a bound of its squared length.
  Interval multiply(int first, int count, const std::vector<Interval>& away, Interval* product) const {
    Interval squared(0);
    for (int a = 0; a < count; ++a) {
      Interval sum(0);
      for (int c = 0; c < d_; ++c) sum += Interval(foot_.frame[(first + a) * d_ + c]) * away[c];
      product[a] = sum;
      squared += Interval(above(sum)) * Interval(above(sum));
    }
    return squared;
  }

  /// (C)
  bool single_sheet() const {
    if (!(largest_radius_ < R_.inf())) return false;
    const Interval r(largest_radius_);
    const Interval far = R_ + sqrt(R_ * R_ - r * r);
    return std::all_of(height_.begin(), height_.end(), [&](const Interval& h) { return h.sup() < far.inf(); });
  }

  /// Whether e . P_i > abs(e) distance_i for the vertices i of the face.
  bool separates(const double* e, const std::uint8_t* face, int size, const std::vector<double>& distance) const {
    Interval squared(0);
    for (int b = 0; b < k_; ++b) {
      if (!(std::abs(e[b]) < 1e150)) return false;
      squared += Interval(e[b]) * Interval(e[b]);
    }
    const Interval length = sqrt(squared);
    for (int j = 0; j < size; ++j) {
      Interval along(0);
      for (int b = 0; b < k_; ++b) along += Interval(e[b]) * P_[face[j] * k_ + b];
      if (!((along - length * Interval(distance[face[j]])).inf() > 0)) return false;
    }
    return true;
  }

  /// (A+)
  bool faces_are_separated() {
    std::vector<double> weight(num_);
    for (int i = 0; i < num_; ++i) {
      const Interval squared = radius_[i] * radius_[i];
      weight[i] = above(squared / (R_c_ + sqrt(R_c_ * R_c_ - squared)) + Interval(eta_[i]));
    }
    const VertexSubsets& low = certificate_.low_faces();
    for (std::size_t f = 0; f < low.num(); ++f)
      if (!separates(certificate_.separating_direction(f), low[f], low.size, weight))
        return fail(Proof::Outcome::kSeparation, low[f], low.size);
    return true;
  }

  /// Which k-faces are hit, and (B) for those.
  bool hits_are_proved() {
    normal_edges_.resize(static_cast<std::size_t>(k_) * k_);
    tangent_edges_.resize(static_cast<std::size_t>(n_) * k_);
    slope_.resize(tangent_edges_.size());
    coordinates_.resize(k_);
    const std::uint32_t all = (std::uint32_t{2} << (num_ - 1)) - 1;
    const VertexSubsets& high = certificate_.hit_candidates();
    for (std::size_t f = 0; f < high.num(); ++f) {
      const std::uint8_t* face = high[f];
      if (!certificate_.face_is_hit(f)) {
        if (!is_missed(f, face)) return fail(Proof::Outcome::kUndecided, face, k_ + 1);
        continue;
      }
      double right_norm = 0;
      if (!is_hit(inverses_[f].data(), face, right_norm)) return fail(Proof::Outcome::kUndecided, face, k_ + 1);
      if (!is_transversal(inverses_[f].data(), face, right_norm))
        return fail(Proof::Outcome::kTransversality, face, k_ + 1);
      std::uint32_t members = 0;
      for (int j = 0; j <= k_; ++j) members |= std::uint32_t{1} << face[j];
      proof_.hit_facets |= all & ~members;
      ++proof_.num_hit;
    }
    return true;
  }

  /// The direction that separates the closest of its (k-1)-faces separates a k-face as a whole.
  bool is_missed(std::size_t f, const std::uint8_t* face) const {
    const std::uint32_t* sub = &subfaces_[f * (k_ + 1)];
    const std::uint32_t* closest = std::min_element(sub, sub + k_ + 1, [&](std::uint32_t a, std::uint32_t b) {
      return certificate_.separation(a) < certificate_.separation(b);
    });
    const auto apart = [&](std::uint32_t low) {
      return separates(certificate_.separating_direction(low), face, k_ + 1, eta_);
    };
    return apart(*closest) || std::any_of(sub, sub + k_ + 1, apart);
  }

  /// With M the k x k matrix of the columns P_j - P_0, b = C (-P_0): the barycentric coordinates M^-1 (-P_0) of the
  /// origin are b + error, abs(error) <= norm(b) left / (1 - left), where C M = I - residual, norm_inf(residual) <=
  /// left. right_norm: M C = I - residual with norm_F(residual) <= right_norm.
  bool is_hit(const double* C, const std::uint8_t* face, double& right_norm) {
    for (int b = 0; b < k_; ++b)
      for (int j = 0; j < k_; ++j)
        normal_edges_[b * k_ + j] =
            P_[face[j + 1] * k_ + b] + ball(eta_[face[j + 1]]) - P_[face[0] * k_ + b] - ball(eta_[face[0]]);
    double left = 0;
    Interval right(0);
    for (int a = 0; a < k_; ++a) {
      Interval row(0);
      for (int j = 0; j < k_; ++j) {
        Interval sum(a == j ? 1 : 0), other(a == j ? 1 : 0);
        for (int b = 0; b < k_; ++b) {
          sum -= Interval(C[a * k_ + b]) * normal_edges_[b * k_ + j];
          other -= normal_edges_[a * k_ + b] * Interval(C[b * k_ + j]);
        }
        row += Interval(above(sum));
        right += Interval(above(other)) * Interval(above(other));
      }
      left = std::max(left, row.sup());
    }
    right_norm = above(sqrt(right));
    if (!(left < 1) || !(right_norm < 1)) return false;
    double largest = 0;
    for (int j = 0; j < k_; ++j) {
      Interval sum(0);
      for (int b = 0; b < k_; ++b) sum -= Interval(C[j * k_ + b]) * (P_[face[0] * k_ + b] + ball(eta_[face[0]]));
      coordinates_[j] = sum;
      largest = std::max(largest, above(sum));
    }
    const double error = above(Interval(largest) * Interval(left) / (Interval(1) - Interval(left)));
    Interval first(1);
    bool inside = true;
    for (int j = 0; j < k_; ++j) {
      const Interval coordinate = coordinates_[j] + ball(error);
      inside = inside && coordinate.inf() > 0;
      first -= coordinate;
    }
    return inside && first.inf() > 0;
  }

  /// (B)
  bool is_transversal(const double* C, const std::uint8_t* face, double right_norm) {
    for (int a = 0; a < n_; ++a)
      for (int j = 0; j < k_; ++j)
        tangent_edges_[a * k_ + j] =
            Q_[face[j + 1] * n_ + a] + ball(eta_[face[j + 1]]) - Q_[face[0] * n_ + a] - ball(eta_[face[0]]);
    for (int a = 0; a < n_; ++a)
      for (int b = 0; b < k_; ++b) {
        Interval sum(0);
        for (int j = 0; j < k_; ++j) sum += tangent_edges_[a * k_ + j] * Interval(C[j * k_ + b]);
        slope_[a * k_ + b] = sum;
      }
    const double slope_norm = norm_above(slope_, n_, k_);
    if (!std::isfinite(slope_norm)) return false;
    const Interval steepest = Interval(slope_norm) / (Interval(1) - Interval(right_norm));
    const Interval sine = Interval(1) / sqrt(Interval(1) + Interval(above(steepest)) * Interval(above(steepest)));
    return (sine * (R_c_ / Interval(largest_radius_))).inf() > 1;
  }

  const Certificate& certificate_;
  const std::vector<std::uint32_t>& subfaces_;
  const double* const* vertices_;
  const FootView& foot_;
  const std::vector<std::vector<double>>& inverses_;
  Proof& proof_;
  int d_, n_, k_, num_;
  Interval R_, R_c_, turn_;
  std::vector<Interval> P_, Q_, radius_, height_;  // num x k, num x n, num, num
  std::vector<double> eta_;
  double largest_radius_ = 0;
  std::vector<Interval> normal_edges_, tangent_edges_, slope_, coordinates_;  // of the k-face looked at
};

}  // namespace

const char* to_string(Proof::Outcome outcome) {
  switch (outcome) {
    case Proof::Outcome::kProven:
      return "proven";
    case Proof::Outcome::kFrame:
      return "the frame of the oracle is not orthonormal";
    case Proof::Outcome::kSingleSheet:
      return "single sheet (C)";
    case Proof::Outcome::kSeparation:
      return "separation (A+)";
    case Proof::Outcome::kTransversality:
      return "transversality (B)";
    default:
      return "hit or not, undecided";
  }
}

CertificateProver::CertificateProver(Certificate& certificate) : certificate_(certificate) {
  const VertexSubsets& low = certificate.low_faces();
  const VertexSubsets& high = certificate.hit_candidates();
  std::map<std::vector<std::uint8_t>, std::uint32_t> number;
  for (std::size_t f = 0; f < low.num(); ++f) number[{low[f], low[f] + low.size}] = static_cast<std::uint32_t>(f);
  for (std::size_t f = 0; f < high.num(); ++f)
    for (int omitted = 0; omitted < high.size; ++omitted) {
      std::vector<std::uint8_t> sub(high[f], high[f] + high.size);
      sub.erase(sub.begin() + omitted);
      subfaces_.push_back(number.at(sub));
    }
}

bool CertificateProver::guess_inverses(Proof& proof) {
  const int k = certificate_.codim();
  const VertexSubsets& high = certificate_.hit_candidates();
  inverses_.resize(high.num());
  std::vector<double> matrix(static_cast<std::size_t>(k) * k);
  for (std::size_t f = 0; f < high.num(); ++f) {
    if (!certificate_.face_is_hit(f)) continue;
    for (int b = 0; b < k; ++b)
      for (int j = 0; j < k; ++j)
        matrix[b * k + j] = certificate_.normal_part(high[f][j + 1])[b] - certificate_.normal_part(high[f][0])[b];
    std::vector<double>& inverse = inverses_[f];
    inverse.resize(matrix.size());
    if (invert(matrix.data(), inverse.data(), k) &&
        std::all_of(inverse.begin(), inverse.end(), [](double x) { return std::abs(x) < 1e150; }))
      continue;
    proof.outcome = Proof::Outcome::kUndecided;
    proof.face.assign(high[f], high[f] + high.size);
    return false;
  }
  return true;
}

Proof CertificateProver::prove(const double* const* vertices, const FootView& foot) {
  Proof proof;
  proof.margins = certificate_.evaluate(vertices, foot);
  if (!proof.margins.single_sheet || !std::isfinite(foot.errors.point) || !std::isfinite(foot.errors.angle))
    return proof;
  // Everything that floating point guesses comes before the rounding mode changes.
  if (!guess_inverses(proof)) return proof;
  const Rounding rounding;
  Attempt(certificate_, subfaces_, vertices, foot, inverses_, proof).run();
  return proof;
}

}  // namespace whitney::perturbation
