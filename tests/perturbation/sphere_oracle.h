// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/QR>

#include <perturbation/foot_oracle.h>

namespace whitney::perturbation {

/// The unit sphere of dimension n in the first n + 1 coordinates of R^d: what it crosses can be computed by hand.
class SphereOracle : public FootOracle {
 public:
  SphereOracle(int ambient_dim, int intrinsic_dim, double claimed_reach = 1)
      : d_(ambient_dim), n_(intrinsic_dim), reach_(claimed_reach) {}

  int ambient_dim() const override { return d_; }
  int intrinsic_dim() const override { return n_; }
  double reach() const override { return reach_; }
  double curvature_radius() const override { return reach_; }
  FootPromise promise() const override { return {FootPromise::Place::kGlobal, FootPromise::Errors::kProven}; }
  bool foot(std::span<const double> x, std::span<double> point, std::span<double> frame,
            FootErrors& errors) const override {
    double length = 0;
    for (int c = 0; c <= n_; ++c) length += x[c] * x[c];
    length = std::sqrt(length);
    if (!(length > 1e-9)) return false;
    for (int c = 0; c < d_; ++c) point[c] = c <= n_ ? x[c] / length : 0;
    // An orthonormal basis that begins with the radial direction, by a Householder reflection.
    Eigen::VectorXd radial(n_ + 1);
    for (int c = 0; c <= n_; ++c) radial[c] = point[c];
    const Eigen::MatrixXd Q = radial.householderQr().householderQ() * Eigen::MatrixXd::Identity(n_ + 1, n_ + 1);
    std::fill(frame.begin(), frame.end(), 0.0);
    for (int a = 0; a < n_; ++a)
      for (int c = 0; c <= n_; ++c) frame[a * d_ + c] = Q(c, a + 1);
    for (int c = 0; c <= n_; ++c) frame[n_ * d_ + c] = Q(c, 0);
    for (int b = 1; b < d_ - n_; ++b) frame[(n_ + b) * d_ + n_ + b] = 1;
    errors = errors_;
    return true;
  }
  /// What every foot states as its errors, whatever they are.
  void state_errors(FootErrors errors) { errors_ = errors; }

  /// In how many points the sphere crosses the simplex with these vertices (k + 1 columns of length d, k = d - n). The
  /// coordinates from n + 1 on vanish on a line through the simplex, in barycentric coordinates; |x| = 1 is a quadratic
  /// equation there.
  int crossings(const Eigen::MatrixXd& vertices) const {
    const int k = d_ - n_;
    Eigen::MatrixXd A(k, k + 1);  // sum lambda = 1 and the k - 1 further coordinates
    A.row(0).setOnes();
    for (int b = 1; b < k; ++b) A.row(b) = vertices.row(n_ + b);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(k);
    right[0] = 1;
    const Eigen::FullPivHouseholderQR<Eigen::MatrixXd> qr(A);
    const Eigen::VectorXd start = qr.solve(right);
    const Eigen::MatrixXd Q = Eigen::FullPivHouseholderQR<Eigen::MatrixXd>(A.transpose()).matrixQ();
    const Eigen::VectorXd along = Q.col(k);
    const Eigen::VectorXd x = vertices.topRows(n_ + 1) * start, v = vertices.topRows(n_ + 1) * along;
    const double a = v.squaredNorm(), b = x.dot(v), c = x.squaredNorm() - 1, discriminant = b * b - a * c;
    if (discriminant < 0) return 0;
    int count = 0;
    for (const double sign : {-1.0, 1.0})
      count += ((start + (-b + sign * std::sqrt(discriminant)) / a * along).array() >= 0).all();
    return count;
  }

 private:
  int d_, n_;
  double reach_;
  FootErrors errors_{1e-14, 1e-14};
};

}  // namespace whitney::perturbation
