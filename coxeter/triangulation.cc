// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/triangulation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <coxeter/base/error.h>

namespace whitney::coxeter {
namespace {

constexpr int kExhaustiveDim = 20;            // 2^20 edges are milliseconds
constexpr double kSymmetryTolerance = 1e-12;  // relative, for a Gram matrix with equal entries

void check_dim(int ambient_dim) {
  if (ambient_dim < 1 || ambient_dim >= std::numeric_limits<std::uint16_t>::max())
    throw InvalidInput("ambient_dim must be in 1 .. 65534, is " + std::to_string(ambient_dim));
}

void check_length(double edge_length) {
  if (!std::isfinite(edge_length) || edge_length <= 0)
    throw InvalidInput("edge_length must be finite and positive, is " + std::to_string(edge_length));
}

/// Longest sum of a subset of the columns from `first` on, added to `sum`. Depth first, so that every sum is rounded at
/// most d times.
double longest_sum(const Eigen::MatrixXd& linear, Eigen::Index first, const Eigen::VectorXd& sum) {
  double best = sum.norm();
  for (Eigen::Index j = first; j < linear.cols(); ++j)
    best = std::max(best, longest_sum(linear, j + 1, sum + linear.col(j)));
  return best;
}

double longest_edge(const Eigen::MatrixXd& linear) {
  const Eigen::Index d = linear.cols();
  // Rotated and scaled copies of Z^d and of the Coxeter lattice have a Gram matrix a on and b off the diagonal, and
  // then |Lambda e(U)|^2 = m a + m (m - 1) b with m = |U|.
  const Eigen::MatrixXd unit = linear / linear.cwiseAbs().maxCoeff();
  const Eigen::MatrixXd gram = unit.transpose() * unit;
  const double a = gram.diagonal().mean();
  const double b = d > 1 ? (gram.sum() - gram.trace()) / (double(d) * double(d - 1)) : 0;
  Eigen::MatrixXd symmetric = Eigen::MatrixXd::Constant(d, d, b);
  symmetric.diagonal().setConstant(a);
  if ((gram - symmetric).cwiseAbs().maxCoeff() <= kSymmetryTolerance * a) {
    double best = 0;
    for (Eigen::Index m = 1; m <= d; ++m) best = std::max(best, double(m) * (a + double(m - 1) * b));
    return linear.cwiseAbs().maxCoeff() * std::sqrt(best);
  }
  if (d <= kExhaustiveDim) return longest_sum(linear, 0, Eigen::VectorXd::Zero(d));
  return linear.colwise().norm().sum();
}

}  // namespace

Triangulation::Triangulation(Eigen::MatrixXd linear, Eigen::VectorXd offset, double edge_length)
    : linear_(std::move(linear)), offset_(std::move(offset)), lu_(linear_), edge_length_(edge_length) {}

Triangulation::Triangulation(Eigen::MatrixXd linear, Eigen::VectorXd offset)
    : linear_(std::move(linear)), offset_(std::move(offset)) {
  const Eigen::Index d = linear_.rows();
  if (linear_.cols() != d) throw InvalidInput("linear must be a square matrix");
  check_dim(static_cast<int>(d));
  if (offset_.size() != d) throw InvalidInput("offset must have as many entries as linear has rows");
  if (!linear_.allFinite()) throw InvalidInput("linear must have finite entries");
  if (!offset_.allFinite()) throw InvalidInput("offset must have finite entries");
  const double scale = linear_.cwiseAbs().maxCoeff();
  if (scale == 0) throw InvalidInput("linear must be regular, is zero");
  // Unscaled, the estimate of the condition overflows for lengths near the ends of the range of double.
  const double rcond = Eigen::PartialPivLU<Eigen::MatrixXd>(linear_ / scale).rcond();
  if (!(rcond > double(d) * std::numeric_limits<double>::epsilon()))
    throw InvalidInput("linear must be regular, is numerically singular");
  lu_.compute(linear_);
  edge_length_ = longest_edge(linear_);
}

void Triangulation::cartesian(std::span<const std::int32_t> z, std::span<double> x) const {
  const std::size_t d = static_cast<std::size_t>(ambient_dim());
  if (z.size() != d || x.size() != d) throw InvalidInput("z and x must have as many entries as the ambient dimension");
  std::copy_n(offset_.data(), d, x.data());
  const double* column = linear_.data();
  for (std::size_t j = 0; j < d; ++j, column += d) {
    const double factor = z[j];
    for (std::size_t i = 0; i < d; ++i) x[i] += factor * column[i];
  }
}

Eigen::VectorXd Triangulation::lattice_coordinates(std::span<const double> x) const {
  if (x.size() != static_cast<std::size_t>(ambient_dim()))
    throw InvalidInput("x must have as many entries as the ambient dimension");
  return lu_.solve(Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())) - offset_);
}

Triangulation Triangulation::transformed(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& shift) const {
  const Eigen::Index d = ambient_dim();
  if (matrix.rows() != d || matrix.cols() != d) throw InvalidInput("matrix must be d x d, d the ambient dimension");
  if (shift.size() != d) throw InvalidInput("shift must have as many entries as the ambient dimension");
  return Triangulation(matrix * linear_, matrix * offset_ + shift);
}

Triangulation freudenthal(int ambient_dim, double edge_length) {
  check_dim(ambient_dim);
  check_length(edge_length);
  const double spacing = edge_length / std::sqrt(double(ambient_dim));
  return Triangulation(Eigen::MatrixXd::Identity(ambient_dim, ambient_dim) * spacing,
                       Eigen::VectorXd::Zero(ambient_dim), edge_length);
}

Triangulation coxeter_a(int ambient_dim, double edge_length) {
  check_dim(ambient_dim);
  check_length(edge_length);
  const double d = ambient_dim;
  const double m = (ambient_dim + 1) / 2;  // integer quotient
  const double s = edge_length / std::sqrt(m * (d + 1 - m) / (d + 1));
  const double c = (1 - 1 / std::sqrt(d + 1)) / d;
  Eigen::MatrixXd linear = Eigen::MatrixXd::Constant(ambient_dim, ambient_dim, -s * c);
  linear.diagonal().setConstant(s * (1 - c));
  return Triangulation(std::move(linear), Eigen::VectorXd::Zero(ambient_dim), edge_length);
}

}  // namespace whitney::coxeter
