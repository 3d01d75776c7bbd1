// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/matrix_manifolds.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

constexpr int kMaxSize = 8;
constexpr double kEps = std::numeric_limits<double>::epsilon();
/// Closer to the medial axis than this, relative to the size of x, there is no foot.
constexpr double kMedial = 1e-12;
/// Times the size of the matrix: the backward error of Eigen's decompositions in units of rounding, generously.
constexpr double kRoundings = 64;
/// The closest point is known (Eckart and Young, Fan and Hoffman), and the decompositions are backward stable.
constexpr FootPromise kPromise{FootPromise::Place::kGlobal, FootPromise::Errors::kProven};

using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxSize, kMaxSize>;

void require(bool condition, const std::string& message) {
  if (!condition) throw InvalidInput(message);
}

/// The coordinates of the matrix (a b^T + b a^T) / 2, times `factor`.
void dyad_coordinates(const double* a, const double* b, int q, double factor, double* coordinates) {
  double sum = 0;
  for (int k = 1; k < q; ++k) {
    sum += a[k - 1] * b[k - 1];
    *coordinates++ = factor * (sum - k * a[k] * b[k]) / std::sqrt(static_cast<double>(k) * (k + 1));
  }
  for (int i = 0; i < q; ++i)
    for (int j = i + 1; j < q; ++j) *coordinates++ = factor * std::sqrt(0.5) * (a[i] * b[j] + a[j] * b[i]);
}

template <class AnyMatrix>
void coordinates_of(const AnyMatrix& A, int q, double* coordinates) {
  double sum = 0;
  for (int k = 1; k < q; ++k) {
    sum += A(k - 1, k - 1);
    *coordinates++ = (sum - k * A(k, k)) / std::sqrt(static_cast<double>(k) * (k + 1));
  }
  for (int i = 0; i < q; ++i)
    for (int j = i + 1; j < q; ++j) *coordinates++ = std::sqrt(2.0) * A(i, j);
}

template <class AnyMatrix>
void fill_matrix(const double* coordinates, int q, double trace, AnyMatrix& A) {
  A.setZero(q, q);
  A.diagonal().setConstant(trace / q);
  for (int k = 1; k < q; ++k) {
    const double c = *coordinates++ / std::sqrt(static_cast<double>(k) * (k + 1));
    for (int i = 0; i < k; ++i) A(i, i) += c;
    A(k, k) -= k * c;
  }
  for (int i = 0; i < q; ++i)
    for (int j = i + 1; j < q; ++j) A(i, j) = A(j, i) = std::sqrt(0.5) * *coordinates++;
}

class Grassmann : public Submanifold::Model {
 public:
  Grassmann(int p, int q) : p_(p), q_(q) {}
  int ambient_dim() const override { return q_ * (q_ + 1) / 2 - 1; }
  int intrinsic_dim() const override { return p_ * (q_ - p_); }
  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
               FootErrors& errors) const override {
    const int d = ambient_dim();
    SmallMatrix A;
    fill_matrix(x.data(), q_, p_, A);
    const double size = std::max(1.0, A.norm());
    if (!std::isfinite(size)) return false;
    const Eigen::SelfAdjointEigenSolver<SmallMatrix> solver(A);
    if (solver.info() != Eigen::Success) return false;
    // Ascending: the last p eigenvectors span the image of the projector.
    const double gap = solver.eigenvalues()[q_ - p_] - solver.eigenvalues()[q_ - p_ - 1];
    if (!(gap > kMedial * size)) return false;
    const SmallMatrix& V = solver.eigenvectors();
    const auto column = [&](int i) { return V.data() + static_cast<std::ptrdiff_t>(i) * q_; };
    const SmallMatrix P = V.rightCols(p_) * V.rightCols(p_).transpose();
    coordinates_of(P, q_, point.data());

    double* row = frame.data();
    for (int i = q_ - p_; i < q_; ++i)
      for (int j = 0; j < q_ - p_; ++j, row += d) dyad_coordinates(column(i), column(j), q_, std::sqrt(2.0), row);
    for (const auto& [first, last] : {std::pair{0, q_ - p_}, std::pair{q_ - p_, q_}})
      for (int i = first; i < last; ++i)
        for (int j = i + 1; j < last; ++j, row += d) dyad_coordinates(column(i), column(j), q_, std::sqrt(2.0), row);
    // What is left of the trace-free matrices: those diagonal in the eigenvectors.
    std::array<double, kMaxSize*(kMaxSize + 1) / 2> one;
    std::fill_n(row, (q_ - 1) * d, 0.0);
    for (int i = 0; i < q_; ++i) {
      dyad_coordinates(column(i), column(i), q_, 1, one.data());
      for (int k = std::max(1, i); k < q_; ++k) {
        const double factor = (k > i ? 1 : -k) / std::sqrt(static_cast<double>(k) * (k + 1));
        for (int c = 0; c < d; ++c) row[(k - 1) * d + c] += factor * one[c];
      }
    }
    const double relative = kRoundings * q_ * kEps * (1 + size / gap);
    errors = {relative, relative};
    return true;
  }
  FootPromise promise() const override { return kPromise; }
  std::optional<Bending> bending() const override {
    // The double nearest to sqrt(1/2) is above it.
    const double reach = std::nextafter(std::sqrt(0.5), 0.0);
    return Bending{reach, reach, Bending::Source::kProven};
  }
  bool is_connected() const override { return true; }
  std::vector<double> seed_points() const override {
    Matrix A(q_, q_);
    for (int i = 0; i < p_; ++i) A(i, i) = 1;
    return symmetric_coordinates(A);
  }

 private:
  int p_, q_;
};

/// V(p, q) for p < q, SO(q) for p = q.
class OrthonormalColumns : public Submanifold::Model {
 public:
  OrthonormalColumns(int p, int q) : p_(p), q_(q) {}
  int ambient_dim() const override { return p_ * q_; }
  int intrinsic_dim() const override { return p_ * q_ - p_ * (p_ + 1) / 2; }
  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
               FootErrors& errors) const override {
    const int d = ambient_dim();
    const SmallMatrix A = Eigen::Map<const Eigen::MatrixXd>(x.data(), q_, p_);
    const double size = std::max(1.0, A.norm());
    if (!std::isfinite(size)) return false;
    const Eigen::JacobiSVD<SmallMatrix> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
    SmallMatrix U = svd.matrixU();
    double gap = svd.singularValues()[p_ - 1];
    if (p_ == q_) {
      if (U.determinant() * svd.matrixV().determinant() < 0) {
        U.col(p_ - 1) *= -1;
        gap = -gap;
      }
      gap += svd.singularValues()[p_ - 2];
    }
    if (!(gap > kMedial * size)) return false;
    const SmallMatrix X = U * svd.matrixV().transpose();
    Eigen::Map<Eigen::MatrixXd>(point.data(), q_, p_) = X;

    // Rows of `columns`: the columns of X, then q - p that complete them.
    std::array<double, kMaxSize * kMaxSize> columns;
    std::copy_n(X.data(), q_ * p_, columns.begin());
    if (!complete_frame({columns.data(), static_cast<std::size_t>(q_ * q_)}, q_, p_)) return false;
    std::fill(frame.begin(), frame.end(), 0.0);
    double* row = frame.data();
    const auto add = [&](int column, int of, double factor) {
      for (int c = 0; c < q_; ++c) row[column * q_ + c] += factor * columns[of * q_ + c];
    };
    const double half = std::sqrt(0.5);
    for (int i = 0; i < p_; ++i)
      for (int j = i + 1; j < p_; ++j, row += d) add(i, j, half), add(j, i, -half);
    for (int i = p_; i < q_; ++i)
      for (int j = 0; j < p_; ++j, row += d) add(j, i, 1);
    for (int i = 0; i < p_; ++i)
      for (int j = i; j < p_; ++j, row += d) {
        if (i == j) {
          add(i, i, 1);
        } else {
          add(i, j, half), add(j, i, half);
        }
      }
    const double relative = kRoundings * q_ * kEps * (1 + size / gap);
    errors = {relative * std::sqrt(static_cast<double>(p_)), relative};
    return true;
  }
  FootPromise promise() const override { return kPromise; }
  std::optional<Bending> bending() const override {
    // The double nearest to sqrt(2) is above it.
    const double reach = p_ == q_ ? std::nextafter(std::sqrt(2.0), 0.0) : 1;
    return Bending{reach, reach, Bending::Source::kProven};
  }
  bool is_connected() const override { return true; }
  std::vector<double> seed_points() const override {
    std::vector<double> seed(p_ * q_, 0.0);
    for (int i = 0; i < p_; ++i) seed[i * q_ + i] = 1;
    return seed;
  }

 private:
  int p_, q_;
};

std::string sizes(int p, int q) { return "not " + std::to_string(p) + " and " + std::to_string(q); }

}  // namespace

Submanifold grassmann(int p, int q) {
  require(1 <= p && p < q && q <= kMaxSize, "grassmann: 1 <= p < q <= 8 is needed, " + sizes(p, q));
  return Submanifold(std::make_shared<Grassmann>(p, q));
}

Submanifold projective_plane_projectors() { return grassmann(1, 3); }

Submanifold stiefel(int p, int q) {
  require(1 <= p && p < q && q <= kMaxSize,
          "stiefel: 1 <= p < q <= 8 is needed, " + sizes(p, q) + " (p = q: special_orthogonal)");
  return Submanifold(std::make_shared<OrthonormalColumns>(p, q));
}

Submanifold special_orthogonal(int q) {
  require(2 <= q && q <= kMaxSize, "special_orthogonal: 2 <= q <= 8 is needed, not " + std::to_string(q));
  return Submanifold(std::make_shared<OrthonormalColumns>(q, q));
}

Submanifold so3_matrices() { return special_orthogonal(3); }

std::vector<double> symmetric_coordinates(const Matrix& A) {
  require(A.rows() == A.cols() && A.rows() >= 2, "symmetric_coordinates: a q x q matrix with q >= 2 is needed");
  const int q = static_cast<int>(A.rows());
  std::vector<double> coordinates(q * (q + 1) / 2 - 1);
  coordinates_of(A, q, coordinates.data());
  return coordinates;
}

Matrix symmetric_matrix(std::span<const double> coordinates, int q, double trace) {
  require(q >= 2 && coordinates.size() == static_cast<std::size_t>(q * (q + 1) / 2 - 1),
          "symmetric_matrix: q(q+1)/2 - 1 coordinates are needed");
  Eigen::MatrixXd A;
  fill_matrix(coordinates.data(), q, trace, A);
  return A;
}

}  // namespace whitney
