// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Not installed: what Eigen's matrices look like depends on the flags of whoever compiles. Sources of ours that compute
// with Eigen see the matrices and vectors of the interfaces through these.

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <coxeter/base/matrix.h>

namespace whitney {

inline Eigen::Map<const Eigen::MatrixXd> as_eigen(const Matrix& M) { return {M.data(), M.rows(), M.cols()}; }

inline Eigen::Map<const Eigen::VectorXd> as_eigen(std::span<const double> x) {
  return {x.data(), static_cast<Eigen::Index>(x.size())};
}

/// The entries of a vector of Eigen's that lie side by side.
template <class Vector>
std::span<const double> as_span(const Vector& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}

/// A copy of a vector, or of the value of an expression that is one.
template <class Expression>
std::vector<double> as_vector(const Eigen::DenseBase<Expression>& x) {
  std::vector<double> result(static_cast<std::size_t>(x.size()));
  Eigen::Map<Eigen::VectorXd>(result.data(), x.size()) = x.derived();
  return result;
}

}  // namespace whitney
