// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/reach_claim.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>
#include <Eigen/SVD>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/// Sines of the angles between the spans of orthonormal rows, tangent (n x d) and normal (k x d), as singular values of
/// their products: small angles keep their digits.
class Angles {
 public:
  Angles(const double* tangent, const double* normal, std::size_t n, std::size_t k, std::size_t d)
      : tangent_(tangent), normal_(normal), n_(n), k_(k), d_(d) {}
  /// At least the largest sine, and that itself if n or k is 1.
  double sine_bound() const {
    double squared = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < k_; ++j) {
        double product = 0;
        for (std::size_t c = 0; c < d_; ++c) product += tangent_[i * d_ + c] * normal_[j * d_ + c];
        squared += product * product;
      }
    }
    return std::sqrt(squared);
  }
  double largest_sine() const {
    if (n_ == 1 || k_ == 1) return sine_bound();
    const auto n = static_cast<Eigen::Index>(n_), k = static_cast<Eigen::Index>(k_), d = static_cast<Eigen::Index>(d_);
    const Eigen::MatrixXd products = Rows(tangent_, n, d) * Rows(normal_, k, d).transpose();
    return Eigen::JacobiSVD<Eigen::MatrixXd>(products).singularValues()[0];
  }

 private:
  const double *tangent_, *normal_;
  std::size_t n_, k_, d_;
};

}  // namespace

ReachVerdict check_reach(const FeetView& feet, double reach, std::size_t max_pairs) {
  if (feet.ambient_dim < 1 || feet.intrinsic_dim < 1 || feet.intrinsic_dim >= feet.ambient_dim)
    throw InvalidInput("check_reach: 1 <= n < d is needed");
  if (!(reach > 0) || !std::isfinite(reach)) throw InvalidInput("check_reach: reach must be positive and finite");
  const std::size_t d = feet.ambient_dim, n = feet.intrinsic_dim, m = feet.points.size() / d;
  if (feet.points.size() != m * d || feet.frames.size() != m * d * d ||
      (!feet.errors.empty() && feet.errors.size() != m))
    throw InvalidInput("check_reach: m points (d), frames (d x d) and errors (or none) are needed");
  double size = 0;
  for (const double c : feet.points) {
    if (!std::isfinite(c)) throw InvalidInput("check_reach: a point is not finite");
    size = std::max(size, std::abs(c));
  }
  const double rounding = 4 * kEps * static_cast<double>(d) * size;
  const double angle_rounding = 16 * kEps * static_cast<double>(d);

  ReachVerdict result;
  result.largest_possible = kInfinity;
  ReachVerdict::Law law = ReachVerdict::Law::kNone;
  const auto bound = [&](double possible, ReachVerdict::Law by, std::size_t p, std::size_t q) {
    if (!(possible < result.largest_possible)) return;
    result.largest_possible = possible;
    result.p = p;
    result.q = q;
    law = by;
  };

  const std::size_t stride = m == 0 ? 1 : (m - 1) * m / std::max<std::size_t>(1, max_pairs) + 1;
  Eigen::VectorXd chord(d);
  for (std::size_t p = 0; p < m; p += stride) {
    const double* origin = &feet.points[p * d];
    const double* normals = &feet.frames[(p * d + n) * d];
    const FootErrors of_p = feet.errors.empty() ? FootErrors{} : feet.errors[p];
    for (std::size_t q = 0; q < m; ++q) {
      if (q == p) continue;
      ++result.num_pairs;
      double squared = 0, normal_squared = 0;
      for (std::size_t c = 0; c < d; ++c) {
        chord[static_cast<Eigen::Index>(c)] = feet.points[q * d + c] - origin[c];
        squared += chord[static_cast<Eigen::Index>(c)] * chord[static_cast<Eigen::Index>(c)];
      }
      for (std::size_t i = 0; i < d - n; ++i) {
        double along = 0;
        for (std::size_t c = 0; c < d; ++c) along += normals[i * d + c] * chord[static_cast<Eigen::Index>(c)];
        normal_squared += along * along;
      }
      const FootErrors of_q = feet.errors.empty() ? FootErrors{} : feet.errors[q];
      const double shift = of_p.point + of_q.point + rounding;
      const double length = std::sqrt(squared), longest = length + shift;
      const double nearest = std::sqrt(normal_squared) - shift - (of_p.angle + angle_rounding) * longest;
      if (nearest > 0) bound(longest * longest / (2 * nearest), ReachVerdict::Law::kDistance, p, q);
      if (q < p && q % stride == 0) continue;  // the angle is symmetric: done already
      if (!(length < reach)) continue;
      const Angles angles(&feet.frames[p * d * d], &feet.frames[(q * d + n) * d], n, d - n, d);
      const auto possible = [&](double sine) {
        const double angle = std::asin(std::min(1.0, sine)) - of_p.angle - of_q.angle - angle_rounding;
        return angle > 0 ? longest / (2 * std::sin(angle / 2)) : kInfinity;
      };
      if (possible(angles.sine_bound()) < result.largest_possible)
        bound(possible(angles.largest_sine()), ReachVerdict::Law::kAngle, p, q);
    }
  }
  if (result.largest_possible < reach) result.law = law;
  return result;
}

}  // namespace whitney
