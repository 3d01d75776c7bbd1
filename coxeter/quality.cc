// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/quality.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/LU>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <coxeter/triangulation.h>

namespace whitney::coxeter {
namespace {

void check(int ambient_dim, double edge_length) {
  if (ambient_dim < 1 || ambient_dim > 65534)
    throw InvalidInput("ambient_dim must be in 1 .. 65534, is " + std::to_string(ambient_dim));
  if (!std::isfinite(edge_length) || edge_length <= 0)
    throw InvalidInput("edge_length must be finite and positive, is " + std::to_string(edge_length));
}

constexpr double kEps = std::numeric_limits<double>::epsilon();
/// All vectors g of simplex_width, 3^d of them, are tried up to this dimension.
constexpr int kMostEnumerated = 12;
/// What simplex_width takes off where the rounding errors are proved to be smaller.
constexpr double kAllowance = 1e-6;

/// The largest g^T (a I + b J)^-1 g, with (a I + b J)^-1 = (I - b / (a + d b) J) / a and J full of ones.
double largest_symmetric(int d, double a, double b) {
  const double beta = -b / (a + d * b) / a;
  double largest = 0;
  for (int ones = 0; ones <= d; ++ones)
    for (int minus = std::max(0, ones - 1); minus <= ones + 1 && ones + minus <= d; ++minus)
      largest = std::max(largest, (ones + minus) / a + beta * (ones - minus) * (ones - minus));
  return largest;
}

/// A lower bound of the width for a Gram matrix within `error`, entry by entry, of one with this diagonal and these
/// other entries; not positive when there is none. G >= (a - d error) I + b J in the order of quadratic forms, and
/// inverses are in the opposite order.
double symmetric_width_below(int d, double diagonal, double other, double error) {
  const double a = (diagonal - other) - d * error, b = other;
  // The sums below lose few digits, or nothing is claimed.
  if (!(a > 0) || !(a + d * b > 1e-4 * (a + d * std::abs(b)))) return 0;
  const double beta = std::abs(b / (a + d * b) / a);
  return (1 - 1e-12) / std::sqrt(largest_symmetric(d, a, b) + 1e-9 * ((d + 1) / a + beta));
}

/// An approximate inverse X of A with a bound of norm(I - A X)_F, in which the roundings of the product are counted;
/// so A^-1 = X (I - E)^-1, and the norm of A^-T g is at most that of X^T g over 1 - bound.
struct BoundedInverse {
  Eigen::MatrixXd X;
  double bound = 0;

  explicit BoundedInverse(const Eigen::MatrixXd& A) : X(A.inverse()) {
    const auto d = A.rows();
    const Eigen::MatrixXd residual = Eigen::MatrixXd::Identity(d, d) - A * X;
    const Eigen::MatrixXd sizes = Eigen::MatrixXd::Identity(d, d) + A.cwiseAbs() * X.cwiseAbs();
    const double roundings = 1.01 * static_cast<double>(d + 2) * kEps;
    bound = (residual.cwiseAbs() + roundings * sizes).norm() * (1 + 1e-12);
  }
  bool useful() const { return bound < 1 && X.allFinite(); }
};

/// By all g; 0 when the inverse is not known well enough.
double enumerated_width_below(const Eigen::MatrixXd& linear) {
  const auto d = static_cast<int>(linear.rows());
  const BoundedInverse inverse(linear);
  if (!inverse.useful()) return 0;
  const Eigen::MatrixXd gradients = inverse.X.transpose();
  double largest = 0;  // squared length of X^T g
  Eigen::VectorXi g = Eigen::VectorXi::Constant(d, -1);
  for (;;) {
    if (std::abs(g.sum()) <= 1) largest = std::max(largest, (gradients * g.cast<double>()).squaredNorm());
    int i = 0;
    while (i < d && g[i] == 1) g[i++] = -1;
    if (i == d) break;
    ++g[i];
  }
  // (d + 2) eps: the roundings of X^T g, each g at most sqrt(d) long.
  const double longest =
      std::sqrt(largest) + 1.01 * (d + 2) * kEps * std::sqrt(static_cast<double>(d)) * gradients.norm();
  const double proven = (1 - 1e-12) * (1 - inverse.bound) / longest;
  return std::min(proven, (1 - kAllowance) / std::sqrt(largest));
}

/// By norm(X^T g) <= norm(X)_F norm(g), for dimensions with too many g.
double width_below_by_norm(const Eigen::MatrixXd& linear) {
  const BoundedInverse inverse(linear);
  if (!inverse.useful()) return 0;
  return (1 - 1e-12) * (1 - inverse.bound) / (std::sqrt(static_cast<double>(linear.rows())) * inverse.X.norm());
}

}  // namespace

Quality coxeter_a_quality(int ambient_dim, double edge_length) {
  check(ambient_dim, edge_length);
  const double d = ambient_dim;
  const double half = (ambient_dim + 1) / 2;  // integer quotient
  const double s = edge_length / std::sqrt(half * (d + 1 - half) / (d + 1));
  Quality q{};
  q.ambient_dim = ambient_dim;
  q.longest_edge = edge_length;
  q.shortest_edge = s * std::sqrt(d / (d + 1));
  q.smallest_altitude = s / std::sqrt(2.0);
  q.thickness = q.smallest_altitude / edge_length;
  q.width = q.smallest_altitude / std::sqrt(half);
  q.circumradius = s * std::sqrt(d * (d + 2) / (12 * (d + 1)));
  q.inradius = q.smallest_altitude / (d + 1);
  // sqrt(R^2 + g) - R without cancellation, g = 2 s^2 / (d + 1).
  const double g = 2 * s * s / (d + 1);
  q.protection = g / (std::sqrt(q.circumradius * q.circumradius + g) + q.circumradius);
  return q;
}

Quality freudenthal_quality(int ambient_dim, double edge_length) {
  check(ambient_dim, edge_length);
  const double d = ambient_dim;
  const double spacing = edge_length / std::sqrt(d);
  Quality q{};
  q.ambient_dim = ambient_dim;
  q.longest_edge = edge_length;
  q.shortest_edge = spacing;
  q.smallest_altitude = ambient_dim == 1 ? spacing : spacing / std::sqrt(2.0);
  q.thickness = q.smallest_altitude / edge_length;
  q.width = spacing / std::sqrt(d);
  q.circumradius = edge_length / 2;
  q.inradius = spacing / (2 + std::sqrt(2.0) * (d - 1));
  q.protection = ambient_dim == 1 ? edge_length : 0;
  return q;
}

double simplex_width(const Triangulation& triangulation) {
  const int d = triangulation.ambient_dim();
  const Eigen::MatrixXd linear = as_eigen(triangulation.linear());
  const Eigen::MatrixXd gram = linear.transpose() * linear;
  const double diagonal = gram(0, 0), other = d > 1 ? gram(0, 1) : 0;
  double departure = 0;
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) departure = std::max(departure, std::abs(gram(i, j) - (i == j ? diagonal : other)));
  const bool symmetric = departure <= 1e-12 * diagonal;
  if (!symmetric && d > kMostEnumerated)
    throw InvalidInput("simplex_width: ambient dimension " + std::to_string(d) +
                       " is above 12, and the triangulation is not similar to a Coxeter or Freudenthal one");
  double bound = 0;
  if (symmetric) {
    // (d + 8) eps diagonal: the roundings of gram, by the inequality of Cauchy and Schwarz.
    const double proven = symmetric_width_below(d, diagonal, other, departure + (d + 8) * kEps * diagonal);
    const double usual = (1 - kAllowance) / std::sqrt(largest_symmetric(d, diagonal - other, other));
    if (proven >= usual) return usual;
    bound = std::max(0.0, proven);
  }
  const double other_bound = d <= kMostEnumerated ? enumerated_width_below(linear) : width_below_by_norm(linear);
  return std::max(bound, other_bound);
}

}  // namespace whitney::coxeter
