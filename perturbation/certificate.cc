// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/certificate.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <coxeter/base/error.h>
#include <perturbation/small_inverse.h>

namespace whitney::perturbation {
namespace {

/// An upper bound (within 3 % for matrices with up to 8 rows or columns) of the squared spectral norm of the rows x
/// cols matrix G: exact when one of them is 1 or 2, else norm(A^16)_F^(1/16) for the smaller Gram matrix A.
double squared_norm(const double* G, int rows, int cols, double* gram, double* power) {
  const int m = std::min(rows, cols);
  for (int a = 0; a < m; ++a)
    for (int b = 0; b <= a; ++b) {
      double sum = 0;
      if (rows <= cols)
        for (int c = 0; c < cols; ++c) sum += G[a * cols + c] * G[b * cols + c];
      else
        for (int r = 0; r < rows; ++r) sum += G[r * cols + a] * G[r * cols + b];
      gram[a * m + b] = gram[b * m + a] = sum;
    }
  if (m == 1) return gram[0];
  if (m == 2) return (gram[0] + gram[3]) / 2 + std::hypot((gram[0] - gram[3]) / 2, gram[1]);
  double log_scale = 0;  // A^(2^s) = gram * exp(log_scale)
  for (int s = 0;; ++s) {
    double largest = 0;
    for (int i = 0; i < m * m; ++i) largest = std::max(largest, std::abs(gram[i]));
    if (!(largest > 0)) return 0;
    for (int i = 0; i < m * m; ++i) gram[i] /= largest;
    log_scale += std::log(largest);
    if (s == 4) break;
    for (int a = 0; a < m; ++a)
      for (int b = 0; b < m; ++b) {
        double sum = 0;
        for (int c = 0; c < m; ++c) sum += gram[a * m + c] * gram[c * m + b];
        power[a * m + b] = sum;
      }
    std::swap_ranges(gram, gram + m * m, power);
    log_scale *= 2;
  }
  double sum = 0;
  for (int i = 0; i < m * m; ++i) sum += gram[i] * gram[i];
  return std::exp((log_scale + 0.5 * std::log(sum)) / 16);
}

}  // namespace

Certificate::Certificate(int ambient_dim, int intrinsic_dim, double reach, double curvature_radius, int simplex_dim)
    : d_(ambient_dim),
      n_(intrinsic_dim),
      k_(d_ - n_),
      m_(simplex_dim < 0 ? d_ : simplex_dim),
      reach_(reach),
      curvature_radius_(curvature_radius) {
  if (n_ < 1 || k_ < 1 || d_ > 31) throw InvalidInput("need 1 <= intrinsic_dim < ambient_dim <= 31");
  if (m_ < k_ || m_ > d_) throw InvalidInput("simplex_dim must be from the codimension to the ambient dimension");
  if (!(reach > 0) || !(curvature_radius >= reach) || !std::isfinite(curvature_radius))
    throw InvalidInput("need 0 < reach <= curvature_radius, both finite");
  low_faces_ = VertexSubsets(m_, k_ - 1);
  faces_ = VertexSubsets(m_, k_);
  const std::size_t vertices = m_ + 1, k = k_;
  P_.resize(vertices * k);
  Q_.resize(vertices * n_);
  weight_.resize(vertices);
  scaled_.resize(vertices * k);
  separation_.resize(low_faces_.num());
  nearest_.resize(low_faces_.num() * k);
  low_lambda_.resize(low_faces_.num() * k);
  hit_.resize(faces_.num());
  lambda_.resize(faces_.num() * (k + 1));
  matrix_.resize(2 * k * k);
  slope_.resize(2 * n_ * k);
  const std::size_t m = std::min(n_, k_);
  gram_.resize(m * m);
  power_.resize(m * m);
  steps_.resize(k);
  direction_.resize(d_);
  corner_.resize(k);
}

Margins Certificate::evaluate(const double* const* vertices, const FootView& foot, double enough, double useless) {
  foot_ = foot;
  Margins margins;
  double radius = 0;
  for (int i = 0; i <= m_; ++i) {
    const double* v = vertices[i];
    double length = 0;
    for (int a = 0; a < n_; ++a) {
      const double* row = foot.frame + a * d_;
      double sum = 0;
      for (int c = 0; c < d_; ++c) sum += row[c] * (v[c] - foot.point[c]);
      Q_[i * n_ + a] = sum;
      length += sum * sum;
    }
    weight_[i] = length;
    radius = std::max(radius, length);
    for (int b = 0; b < k_; ++b) {
      const double* row = foot.frame + (n_ + b) * d_;
      double sum = 0;
      for (int c = 0; c < d_; ++c) sum += row[c] * (v[c] - foot.point[c]);
      P_[i * k_ + b] = sum;
    }
  }
  radius = std::sqrt(radius);
  if (!(radius < reach_)) return margins;
  const double far = reach_ + std::sqrt(reach_ * reach_ - radius * radius);
  for (int i = 0; i <= m_; ++i) {
    double height = 0;
    for (int b = 0; b < k_; ++b) height += P_[i * k_ + b] * P_[i * k_ + b];
    if (!(height < far * far)) return margins;
  }
  margins.single_sheet = true;

  // h_i may be anything from h(r_i) up. The floor keeps P_i / h_i in range; it costs nothing, since h(r) is what the
  // other vertices have.
  const auto leave = [&](double squared) {
    return squared / (curvature_radius_ + std::sqrt(curvature_radius_ * curvature_radius_ - squared));
  };
  const double floor = 1e-3 * leave(radius * radius);
  for (int i = 0; i <= m_; ++i) {
    weight_[i] = std::max(leave(weight_[i]), floor);
    const double inverse = 1 / weight_[i];
    for (int b = 0; b < k_; ++b) scaled_[i * k_ + b] = P_[i * k_ + b] * inverse;
  }
  double least = std::numeric_limits<double>::infinity();
  if (useless >= 0) {
    margins.separation = measure(worst_, enough);
    if (margins.separation <= useless) return margins;
  }
  for (std::size_t f = 0; f < low_faces_.num(); ++f) {
    const double separation = measure(f, enough);
    if (separation >= least) continue;
    least = separation;
    worst_ = f;
    if (least > useless) continue;
    margins.separation = least;
    return margins;
  }
  margins.separation = least;
  margins.transversality = radius > 0 ? curvature_radius_ / radius : std::numeric_limits<double>::infinity();
  find_hits(margins);
  return margins;
}

/// The separation of (k-1)-face f.
double Certificate::measure(std::size_t f, double enough) {
  const std::uint8_t* face = low_faces_[f];
  for (int j = 0; j < k_; ++j) corner_[j] = &scaled_[face[j] * k_];
  return separation_[f] = min_norm_(corner_.data(), k_, k_, enough, &low_lambda_[f * k_], &nearest_[f * k_]);
}

void Certificate::find_hits(Margins& margins) {
  const double over_radius = margins.transversality;  // R_c / r
  double steepest = -1;                               // the largest squared tangent of the angle between sigma and N
  const std::uint32_t all = (std::uint32_t{2} << m_) - 1;
  double *M = matrix_.data(), *X = M + k_ * k_;
  double *E = slope_.data(), *G = E + n_ * k_;
  for (std::size_t f = 0; f < faces_.num(); ++f) {
    const std::uint8_t* face = faces_[f];
    hit_[f] = 0;
    bool apart = false;
    for (int b = 0; b < k_ && !apart; ++b) {
      bool above = true, below = true;
      for (int j = 0; j <= k_; ++j) {
        const double value = P_[face[j] * k_ + b];
        above = above && value > 0;
        below = below && value < 0;
      }
      apart = above || below;
    }
    if (apart) continue;
    const double* origin = &P_[face[0] * k_];
    for (int b = 0; b < k_; ++b)
      for (int j = 0; j < k_; ++j) M[b * k_ + j] = P_[face[j + 1] * k_ + b] - origin[b];
    if (!invert(M, X, k_)) continue;
    double* lambda = &lambda_[f * (k_ + 1)];
    double first = 1;
    bool inside = true;
    for (int j = 0; j < k_; ++j) {
      double sum = 0;
      for (int b = 0; b < k_; ++b) sum -= X[j * k_ + b] * origin[b];
      lambda[j + 1] = sum;
      first -= sum;
      inside = inside && sum >= 0;
    }
    lambda[0] = first;
    if (!inside || first < 0) continue;
    hit_[f] = 1;
    ++margins.num_hit;
    std::uint32_t members = 0;
    for (int j = 0; j <= k_; ++j) members |= std::uint32_t{1} << face[j];
    margins.hit_facets |= all & ~members;
    // G = (T^T E)(N^T E)^-1 maps the normal part of a direction of sigma to its tangent part.
    const double* tangent_origin = &Q_[face[0] * n_];
    for (int a = 0; a < n_; ++a)
      for (int j = 0; j < k_; ++j) E[a * k_ + j] = Q_[face[j + 1] * n_ + a] - tangent_origin[a];
    for (int a = 0; a < n_; ++a)
      for (int b = 0; b < k_; ++b) {
        double sum = 0;
        for (int j = 0; j < k_; ++j) sum += E[a * k_ + j] * X[j * k_ + b];
        G[a * k_ + b] = sum;
      }
    steepest = std::max(steepest, squared_norm(G, n_, k_, gram_.data(), power_.data()));
  }
  margins.transversality =
      margins.num_hit > 0 ? over_radius / std::sqrt(1 + steepest) : std::numeric_limits<double>::infinity();
}

bool Certificate::make_push(std::size_t f, double target, std::span<const double> fallback) {
  const double separation = separation_[f];
  if (separation >= target) return false;
  const std::uint8_t* face = low_faces_[f];
  const double* lambda = &low_lambda_[f * k_];
  const double* x = &nearest_[f * k_];
  const bool touching = separation < 1e-9 * target;
  if (touching) x = fallback.data();
  double length = 0, sum = 0;
  for (int b = 0; b < k_; ++b) length += x[b] * x[b];
  length = std::sqrt(length);
  for (int j = 0; j < k_; ++j) {
    steps_[j] = lambda[j] / weight_[face[j]];
    sum += steps_[j] * steps_[j];
  }
  if (!(length > 0) || !(sum > 0)) return false;
  for (int j = 0; j < k_; ++j) steps_[j] *= (target - separation) / sum;
  std::fill(direction_.begin(), direction_.end(), 0.0);
  for (int b = 0; b < k_; ++b)
    for (int c = 0; c < d_; ++c) direction_[c] += x[b] / length * foot_.frame[(n_ + b) * d_ + c];
  return true;
}

}  // namespace whitney::perturbation
