// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/implicit_manifold.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <Eigen/Dense>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
/// A Jacobian whose singular values differ by more than this factor has lost its rank.
constexpr double kRankDeficient = 1e-10;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;

std::span<double> span_of(Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }
std::span<const double> const_span_of(const Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

class ImplicitModel : public Submanifold::Model {
 public:
  ImplicitModel(Function f, std::vector<double> seed_points, const ImplicitManifoldOptions& options)
      : f_(std::move(f)), seed_points_(std::move(seed_points)), options_(options) {}

  int ambient_dim() const override { return f_.ambient_dim(); }
  int intrinsic_dim() const override { return f_.ambient_dim() - f_.codim(); }
  /// Newton's method may end at a point that is not the closest, and the error bounds are of first order.
  FootPromise promise() const override { return {FootPromise::Place::kLocal, FootPromise::Errors::kModelled}; }
  std::optional<Bending> bending() const override { return std::nullopt; }
  std::vector<double> seed_points() const override { return seed_points_; }

  bool project(std::span<const double> from, std::span<double> point, std::span<double> frame,
               FootErrors& errors) const override {
    const Eigen::Index d = ambient_dim(), n = intrinsic_dim();
    const Vector x = Eigen::Map<const Vector>(from.data(), d);
    if (!x.allFinite()) return false;
    Vector y = x;
    Place at;
    if (!restore(y, at)) return false;
    for (int iteration = 0;; ++iteration) {
      if (iteration == options_.max_iterations) return false;
      const Vector along = at.tangent * (x - y);
      const double offset = along.norm(), size = std::max(x.norm(), y.norm());
      Matrix hessian = reduced_hessian(x, y, at);
      Eigen::LLT<Matrix> solver(hessian);
      const bool convex = solver.info() == Eigen::Success && solver.rcond() > 1e-12;
      const Vector step = convex ? Vector(solver.solve(along)) : along;
      // What the Newton steps below miss is of second order, of the size of roundings from here on.
      const bool last = convex && (step.norm() <= 1e-8 * (x - y).norm() || offset <= 8 * kEps * size);
      const double before = (y - x).norm();
      Vector next;
      Place there;
      double factor = 1;
      for (int halvings = 0;; ++halvings, factor /= 2) {
        if (halvings == 30) return false;
        next = y + factor * at.tangent.transpose() * step;
        if (restore(next, there) && (last || (next - x).norm() <= before * (1 + 8 * kEps))) break;
      }
      y = next;
      at = there;
      if (last) break;
    }
    std::copy(y.data(), y.data() + d, point.begin());
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index c = 0; c < d; ++c) frame[i * d + c] = at.tangent(i, c);
    for (Eigen::Index i = n; i < d; ++i)
      for (Eigen::Index c = 0; c < d; ++c) frame[i * d + c] = at.normal(i - n, c);
    // Rounding of f as |Df| |y| in units in the last place, plus the residual, both over the least singular value.
    const double noise = options_.roundings * kEps * at.largest * std::max(y.cwiseAbs().maxCoeff(), kTiny);
    errors.point = 2 * (at.residual + noise) / at.least + 4 * kEps * y.norm();
    const double turn = turning(y, at) * errors.point;
    errors.angle = 2 * turn + options_.roundings * kEps * at.largest / at.least;
    return true;
  }

 private:
  static constexpr double kTiny = 1e-290;
  static constexpr double kStep = 1e-5;  ///< of differences, in units of length_scale

  /// A point with what f says there. Equation i and its row of the Jacobian are divided by 2^exponent[i], so that the
  /// largest entry of every row is about 1: the unit in which an equation is written changes nothing, not even a
  /// rounding.
  struct Place {
    Vector value;
    Matrix jacobian;
    Eigen::VectorXi exponent;
    Matrix tangent, normal;         ///< n x d and k x d, orthonormal rows
    double least = 0, largest = 0;  ///< singular values of the Jacobian
    double residual = 0;
  };

  bool look(const Vector& y, Place& place) const {
    const Eigen::Index d = ambient_dim(), k = f_.codim();
    place.value.resize(k);
    place.jacobian.resize(k, d);
    f_.evaluate(const_span_of(y), span_of(place.value));
    f_.jacobian(const_span_of(y), {place.jacobian.data(), static_cast<std::size_t>(k * d)}, options_.length_scale);
    if (!place.value.allFinite() || !place.jacobian.allFinite()) return false;
    place.exponent.resize(k);
    for (Eigen::Index i = 0; i < k; ++i) {
      std::frexp(place.jacobian.row(i).cwiseAbs().maxCoeff(), &place.exponent[i]);
      place.value[i] = std::ldexp(place.value[i], -place.exponent[i]);
    }
    divide_rows(place.jacobian, place.exponent);
    place.residual = place.value.norm();
    return std::isfinite(place.residual);
  }

  static void divide_rows(Matrix& jacobian, const Eigen::VectorXi& exponent) {
    for (Eigen::Index i = 0; i < jacobian.rows(); ++i)
      for (Eigen::Index c = 0; c < jacobian.cols(); ++c) jacobian(i, c) = std::ldexp(jacobian(i, c), -exponent[i]);
  }

  /// Newton steps of least length onto f = 0; fills `place`. False when they do not arrive at a regular point.
  bool restore(Vector& y, Place& place) const {
    const Eigen::Index d = ambient_dim(), k = f_.codim();
    for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
      if (!look(y, place)) return false;
      const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(place.jacobian.transpose());
      const Vector diagonal = qr.matrixR().diagonal().cwiseAbs();
      if (!(diagonal.minCoeff() > kRankDeficient * diagonal.maxCoeff())) return false;
      const Eigen::MatrixXd Q = qr.householderQ();
      // J^T P = Q R: the step of least length is -Q R^-T P^T f.
      const Vector reduced = qr.matrixR().topLeftCorner(k, k).template triangularView<Eigen::Upper>().transpose().solve(
          Vector(qr.colsPermutation().transpose() * place.value));
      const Vector step = Q.leftCols(k) * reduced;
      const double size = std::max(y.norm(), kTiny);
      const bool done = step.norm() <= 4 * kEps * size || (iteration > 2 && step.norm() <= 256 * kEps * size);
      if (done) {
        place.normal = Q.leftCols(k).transpose();
        place.tangent = Q.rightCols(d - k).transpose();
        const Vector singular =
            Eigen::JacobiSVD<Eigen::MatrixXd>(
                qr.matrixR().topLeftCorner(k, k).template triangularView<Eigen::Upper>().toDenseMatrix())
                .singularValues();
        place.largest = singular[0];
        place.least = singular[k - 1];
        return true;
      }
      y -= step;
    }
    return false;
  }

  /// I + sum over i of lambda_i D^2 f_i on the tangent space, with x - y = Df^T lambda + tangential part.
  Matrix reduced_hessian(const Vector& x, const Vector& y, const Place& at) const {
    const Eigen::Index n = intrinsic_dim();
    const Vector lambda = at.jacobian.transpose().colPivHouseholderQr().solve(x - y);
    Matrix hessian = Matrix::Identity(n, n);
    const Matrix change = jacobian_changes(y, at, lambda);
    hessian += (change + change.transpose()) / 2;
    return hessian;
  }

  /// Row a: the derivative of lambda^T Df along tangent a, in coordinates of the tangents.
  Matrix jacobian_changes(const Vector& y, const Place& at, const Vector& lambda) const {
    const Eigen::Index n = intrinsic_dim();
    Matrix changes(n, n);
    for (Eigen::Index a = 0; a < n; ++a)
      changes.row(a) = lambda.transpose() * differentiate(y, at, a) * at.tangent.transpose();
    return changes;
  }

  /// The derivative of Df along tangent `axis`, by central differences. A step over which Df is no longer about the
  /// same is too long for the place, whatever length_scale says.
  Matrix differentiate(const Vector& y, const Place& at, Eigen::Index axis) const {
    const auto size = static_cast<std::size_t>(at.jacobian.size());
    Matrix plus(at.jacobian.rows(), at.jacobian.cols()), minus = plus;
    double step = kStep * options_.length_scale;
    for (int shortened = 0;; ++shortened, step /= 16) {
      const Vector along = step * at.tangent.row(axis).transpose(), forth = y + along, back = y - along;
      f_.jacobian(const_span_of(forth), {plus.data(), size}, options_.length_scale);
      f_.jacobian(const_span_of(back), {minus.data(), size}, options_.length_scale);
      divide_rows(plus, at.exponent);
      divide_rows(minus, at.exponent);
      const double change = (plus - minus).norm();
      if (change <= 0.1 * at.jacobian.norm() || shortened == 20) return (plus - minus) / (2 * step);
    }
  }

  /// About how fast the tangent space turns, per length: |D Df| on the tangent space over the least singular value.
  double turning(const Vector& y, const Place& at) const {
    double squared = 0;
    for (Eigen::Index a = 0; a < intrinsic_dim(); ++a) squared += differentiate(y, at, a).squaredNorm();
    return std::sqrt(squared) / at.least;
  }

  Function f_;
  std::vector<double> seed_points_;
  ImplicitManifoldOptions options_;
};

}  // namespace

Submanifold implicit_manifold(Function f, std::vector<double> seed_points, const ImplicitManifoldOptions& options) {
  if (f.codim() >= f.ambient_dim())
    throw InvalidInput("implicit_manifold: " + std::to_string(f.codim()) + " equations in R^" +
                       std::to_string(f.ambient_dim()) + " leave no manifold of dimension 1 or more");
  if (seed_points.size() % static_cast<std::size_t>(f.ambient_dim()) != 0)
    throw InvalidInput("implicit_manifold: seed_points must be m x d");
  for (const double c : seed_points)
    if (!std::isfinite(c)) throw InvalidInput("implicit_manifold: a seed point is not finite");
  if (!(options.length_scale > 0) || !std::isfinite(options.length_scale) || options.max_iterations < 1 ||
      !(options.roundings > 0))
    throw InvalidInput("implicit_manifold: length_scale, max_iterations and roundings must be positive");
  return Submanifold(std::make_shared<ImplicitModel>(std::move(f), std::move(seed_points), options));
}

}  // namespace whitney
