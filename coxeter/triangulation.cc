// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/triangulation.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include <coxeter/base/eigen_view.h>
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

struct Triangulation::Factors {
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;
};

Triangulation::Triangulation(Matrix linear, std::vector<double> offset, double edge_length)
    : linear_(std::move(linear)),
      offset_(std::move(offset)),
      factors_(new Factors{Eigen::PartialPivLU<Eigen::MatrixXd>(as_eigen(linear_))}),
      edge_length_(edge_length) {}

Triangulation::Triangulation(Matrix linear, std::vector<double> offset)
    : linear_(std::move(linear)), offset_(std::move(offset)) {
  const std::ptrdiff_t d = linear_.rows();
  if (linear_.cols() != d) throw InvalidInput("linear must be a square matrix");
  check_dim(static_cast<int>(d));
  if (std::ssize(offset_) != d) throw InvalidInput("offset must have as many entries as linear has rows");
  if (!all_finite(linear_.entries())) throw InvalidInput("linear must have finite entries");
  if (!all_finite(offset_)) throw InvalidInput("offset must have finite entries");
  const auto matrix = as_eigen(linear_);
  const double scale = matrix.cwiseAbs().maxCoeff();
  if (scale == 0) throw InvalidInput("linear must be regular, is zero");
  // Unscaled, the estimate of the condition overflows for lengths near the ends of the range of double.
  const double rcond = Eigen::PartialPivLU<Eigen::MatrixXd>(matrix / scale).rcond();
  if (!(rcond > double(d) * std::numeric_limits<double>::epsilon()))
    throw InvalidInput("linear must be regular, is numerically singular");
  factors_.reset(new Factors{Eigen::PartialPivLU<Eigen::MatrixXd>(matrix)});
  edge_length_ = longest_edge(matrix);
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

std::vector<double> Triangulation::lattice_coordinates(std::span<const double> x) const {
  if (x.size() != static_cast<std::size_t>(ambient_dim()))
    throw InvalidInput("x must have as many entries as the ambient dimension");
  return as_vector(factors_->lu.solve(as_eigen(x) - as_eigen(offset_)));
}

Triangulation Triangulation::transformed(const Matrix& matrix, std::span<const double> shift) const {
  const std::ptrdiff_t d = ambient_dim();
  if (matrix.rows() != d || matrix.cols() != d) throw InvalidInput("matrix must be d x d, d the ambient dimension");
  if (std::ssize(shift) != d) throw InvalidInput("shift must have as many entries as the ambient dimension");
  const Eigen::MatrixXd product = as_eigen(matrix) * as_eigen(linear_);
  return Triangulation(product, as_vector(as_eigen(matrix) * as_eigen(offset_) + as_eigen(shift)));
}

Triangulation freudenthal(int ambient_dim, double edge_length) {
  check_dim(ambient_dim);
  check_length(edge_length);
  const double spacing = edge_length / std::sqrt(double(ambient_dim));
  Matrix linear(ambient_dim, ambient_dim);
  for (int i = 0; i < ambient_dim; ++i) linear(i, i) = spacing;
  return Triangulation(std::move(linear), std::vector<double>(static_cast<std::size_t>(ambient_dim)), edge_length);
}

Triangulation coxeter_a(int ambient_dim, double edge_length) {
  check_dim(ambient_dim);
  check_length(edge_length);
  const double d = ambient_dim;
  const double m = (ambient_dim + 1) / 2;  // integer quotient
  const double s = edge_length / std::sqrt(m * (d + 1 - m) / (d + 1));
  const double c = (1 - 1 / std::sqrt(d + 1)) / d;
  Matrix linear(ambient_dim, ambient_dim);
  for (int j = 0; j < ambient_dim; ++j)
    for (int i = 0; i < ambient_dim; ++i) linear(i, j) = i == j ? s * (1 - c) : -s * c;
  return Triangulation(std::move(linear), std::vector<double>(static_cast<std::size_t>(ambient_dim)), edge_length);
}

}  // namespace whitney::coxeter
