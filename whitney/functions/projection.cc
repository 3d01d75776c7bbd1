// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/projection.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include <Eigen/Eigenvalues>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>

namespace whitney {

namespace {

using ConstPoints = Eigen::Map<const Eigen::MatrixXd>;  // d x m: one column per point

ConstPoints as_matrix(std::span<const double> points, int d) {
  if (d < 1 || points.size() % static_cast<std::size_t>(d) != 0) {
    throw InvalidInput("points: their number of coordinates is not a multiple of the ambient dimension");
  }
  return {points.data(), d, static_cast<Eigen::Index>(points.size()) / d};
}

/// An orthonormal basis of the column space of V that depends on the space only, up to rounding: the projections of a
/// fixed sequence of vectors, orthogonalised. The vectors are in no special position: along coordinate axes a flat
/// torus would fall onto a cylinder, twice.
Eigen::MatrixXd canonical_basis(const Eigen::MatrixXd& V) {
  if (V.cols() == 1) return V;
  Eigen::MatrixXd basis(V.rows(), V.cols());
  Eigen::Index found = 0;
  for (int j = 1; found < V.cols(); ++j) {
    Eigen::VectorXd direction(V.rows());
    for (Eigen::Index i = 0; i < V.rows(); ++i) direction[i] = std::sin(1.0 + 1.7 * j * static_cast<double>(i + 1));
    const double length = direction.norm();
    direction = V * (V.transpose() * direction).eval();
    for (int twice = 0; twice < 2; ++twice) {
      direction -= basis.leftCols(found) * (basis.leftCols(found).transpose() * direction).eval();
    }
    if (direction.norm() > 1e-3 * length) basis.col(found++) = direction.normalized();
  }
  return basis;
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

int variable_index(std::string_view text, int d, std::span<const std::string> variables) {
  const auto named = std::find(variables.begin(), variables.end(), text);
  if (named != variables.end()) return static_cast<int>(named - variables.begin());
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc{} && end == text.data() + text.size() && number >= 1 && number <= std::max(d, 3)) {
    return number - 1;
  }
  throw InvalidInput("projection: \"" + std::string(text) +
                     "\" is neither the name of a variable nor a number from 1 to " + std::to_string(d));
}

}  // namespace

Projection coordinate_projection(int ambient_dim, std::array<int, 3> variables) {
  if (ambient_dim < 1) throw InvalidInput("projection: the ambient dimension must be at least 1");
  Projection result;
  result.A = Matrix(4, ambient_dim);
  result.center.resize(static_cast<std::size_t>(ambient_dim));
  std::vector<bool> used(static_cast<std::size_t>(std::max(ambient_dim, 3)), false);
  for (int row = 0; row < 3; ++row) {
    const int variable = variables[static_cast<std::size_t>(row)];
    if (variable < 0 || variable >= std::max(ambient_dim, 3)) {
      throw InvalidInput("projection: there is no variable number " + std::to_string(variable + 1) + " in R^" +
                         std::to_string(ambient_dim));
    }
    if (used[static_cast<std::size_t>(variable)]) {
      throw InvalidInput("projection: variable number " + std::to_string(variable + 1) + " is named twice");
    }
    used[static_cast<std::size_t>(variable)] = true;
    if (variable < ambient_dim) result.A(row, variable) = 1;
  }
  const auto left_over = std::find(used.begin(), used.begin() + ambient_dim, false) - used.begin();
  if (left_over < ambient_dim) result.A(3, left_over) = 1;
  return result;
}

Projection principal_projection(std::span<const double> points, int ambient_dim) {
  const ConstPoints P = as_matrix(points, ambient_dim);
  if (P.cols() == 0) throw InvalidInput("projection: principal components need at least one point");
  // Scaled first, so that neither huge nor tiny units overflow when squared.
  const Eigen::VectorXd centroid = P.rowwise().sum() / static_cast<double>(P.cols());
  const double size = std::max((P.colwise() - centroid).cwiseAbs().maxCoeff(), 1e-300);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(ambient_dim, ambient_dim);
  Eigen::VectorXd offset(ambient_dim);
  for (Eigen::Index i = 0; i < P.cols(); ++i) {
    offset = (P.col(i) - centroid) / size;
    covariance.selfadjointView<Eigen::Lower>().rankUpdate(offset);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);  // reads the lower half; ascending order
  const Eigen::VectorXd variance = solver.eigenvalues().reverse();
  const Eigen::MatrixXd V = solver.eigenvectors().rowwise().reverse();

  Projection result;
  result.A = Matrix(4, ambient_dim);
  result.center = as_vector(centroid);
  const Eigen::Index rows = std::min(4, ambient_dim);
  for (Eigen::Index first = 0; first < rows;) {
    Eigen::Index last = first + 1;
    while (last < ambient_dim && variance[last - 1] - variance[last] <= 0.01 * variance[0]) ++last;
    const Eigen::MatrixXd basis = canonical_basis(V.middleCols(first, last - first));
    for (Eigen::Index j = first; j < std::min(last, rows); ++j) {
      const auto direction = basis.col(j - first);
      const double largest = direction.cwiseAbs().maxCoeff();
      Eigen::Index entry = 0;
      while (std::abs(direction[entry]) < 0.99 * largest) ++entry;
      for (int i = 0; i < ambient_dim; ++i) result.A(j, i) = direction[entry] < 0 ? -direction[i] : direction[i];
    }
    first = last;
  }
  return result;
}

Projection make_projection(std::string_view text, std::span<const double> points, int ambient_dim,
                           std::span<const std::string> variables) {
  if (!variables.empty() && variables.size() != static_cast<std::size_t>(ambient_dim)) {
    throw InvalidInput("projection: the number of variable names is not the ambient dimension");
  }
  if (trim(text) == "pca") {
    return ambient_dim <= 3 ? coordinate_projection(ambient_dim, {0, 1, 2}) : principal_projection(points, ambient_dim);
  }
  std::array<int, 3> chosen{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto comma = text.find(',');
    if ((comma == std::string_view::npos) != (i == 2)) {
      throw InvalidInput("projection: expected \"pca\" or three variables separated by commas");
    }
    chosen[i] = variable_index(trim(text.substr(0, comma)), ambient_dim, variables);
    if (i < 2) text.remove_prefix(comma + 1);
  }
  return coordinate_projection(ambient_dim, chosen);
}

std::vector<double> project(const Projection& projection, std::span<const double> points) {
  const std::size_t d = projection.center.size();
  if (d < 1 || points.size() % d != 0) {
    throw InvalidInput("points: their number of coordinates is not a multiple of the projection's ambient dimension");
  }
  std::vector<double> result;
  result.reserve(points.size() / d * 4);
  for (std::size_t i = 0; i < points.size(); i += d) {
    for (Eigen::Index row = 0; row < 4; ++row) {
      double sum = 0;
      for (std::size_t k = 0; k < d; ++k) {
        sum += projection.A(row, static_cast<std::ptrdiff_t>(k)) * (points[i + k] - projection.center[k]);
      }
      result.push_back(sum);
    }
  }
  return result;
}

}  // namespace whitney
