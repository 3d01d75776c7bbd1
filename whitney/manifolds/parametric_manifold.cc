// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/parametric_manifold.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <boost/container/small_vector.hpp>

#include <coxeter/base/error.h>
#include <whitney/functions/expression.h>
#include <whitney/manifolds/bending.h>
#include <whitney/manifolds/kd_tree.h>

namespace whitney {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr int kMaxIntrinsicDim = 8;
constexpr std::size_t kMaxSamples = 200000;

using Buffer = boost::container::small_vector<double, 64>;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxIntrinsicDim, kMaxIntrinsicDim>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxIntrinsicDim, 1>;
using Jacobian = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

std::span<double> span_of(Buffer& buffer) { return {buffer.data(), buffer.size()}; }
std::span<const double> const_span_of(const Buffer& buffer) { return {buffer.data(), buffer.size()}; }

double squared_distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t c = 0; c < a.size(); ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

/// D^2 phi at u by differences: calls use(i, j, second derivative along axes j <= i). The error, about 1e-8 relative,
/// slows Newton's method down to that factor per step and does not move its fixed points.
template <class Use>
void second_derivatives(const Parametrization& phi, std::span<const double> u, std::span<const double> phi_u,
                        const Use& use) {
  constexpr double kStep = 1e-4;  // balances kStep^2 against eps / kStep^2
  const std::size_t n = phi.intrinsic_dim(), d = phi_u.size();
  Buffer t(n, 0.0), moved(u.size()), plus(d), minus(d), pure(n * d), second(d);
  // plus + minus - 2 phi(u), for steps along axes i and j (both, when they differ).
  const auto difference = [&](std::size_t i, std::size_t j, double* result) {
    std::fill(t.begin(), t.end(), 0.0);
    t[i] = kStep * phi.scale(static_cast<int>(i));
    t[j] = kStep * phi.scale(static_cast<int>(j));
    phi.move(u, const_span_of(t), span_of(moved));
    phi.evaluate(const_span_of(moved), span_of(plus));
    for (double& component : t) component = -component;
    phi.move(u, const_span_of(t), span_of(moved));
    phi.evaluate(const_span_of(moved), span_of(minus));
    for (std::size_t c = 0; c < d; ++c) result[c] = (plus[c] - phi_u[c]) + (minus[c] - phi_u[c]);
  };
  for (std::size_t i = 0; i < n; ++i) difference(i, i, &pure[i * d]);
  for (std::size_t i = 0; i < n; ++i) {
    const double h = kStep * phi.scale(static_cast<int>(i));
    for (std::size_t j = 0; j < i; ++j) {
      const double l = kStep * phi.scale(static_cast<int>(j));
      difference(i, j, second.data());
      for (std::size_t c = 0; c < d; ++c) second[c] = (second[c] - pure[i * d + c] - pure[j * d + c]) / (2 * h * l);
      use(static_cast<int>(i), static_cast<int>(j), const_span_of(second));
    }
    for (std::size_t c = 0; c < d; ++c) second[c] = pure[i * d + c] / (h * h);
    use(static_cast<int>(i), static_cast<int>(i), const_span_of(second));
  }
}

class ParametricModel : public Submanifold::Model, public std::enable_shared_from_this<ParametricModel> {
 public:
  explicit ParametricModel(std::shared_ptr<const Parametrization> phi) : phi_(std::move(phi)) {
    if (!phi_) throw InvalidInput("parametric_manifold: no parametrization");
    const int n = phi_->intrinsic_dim(), d = phi_->ambient_dim();
    if (n < 1 || n >= d || n > kMaxIntrinsicDim)
      throw InvalidInput("parametric_manifold: 1 <= n < d and n <= 8 is needed, not n = " + std::to_string(n) +
                         ", d = " + std::to_string(d));
    sample();
    link();
  }

  int ambient_dim() const override { return phi_->ambient_dim(); }
  int intrinsic_dim() const override { return phi_->intrinsic_dim(); }

  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
               FootErrors& errors) const override {
    for (const double c : x)
      if (!std::isfinite(c)) return false;
    const std::size_t m = phi_->parameter_size();
    const KdTree::Neighbor first = tree_->nearest(x);
    if (first.index == tree_->size() || !std::isfinite(first.squared_distance)) return false;
    Buffer best(m), u(m);
    double best_squared = std::numeric_limits<double>::infinity();
    const bool found = descend(first.index, x, best, best_squared);
    // The sample next to the foot is in this ball; on each sheet of M there, the nearest sample starts a search.
    thread_local std::vector<KdTree::Neighbor> near;
    const double distance = std::sqrt(found ? std::min(best_squared, first.squared_distance) : first.squared_distance);
    tree_->within(x, distance + covering_radius_, near);
    for (const KdTree::Neighbor& candidate : near) {
      if (candidate.index == first.index || !is_locally_nearest(candidate, x)) continue;
      double squared = std::numeric_limits<double>::infinity();
      if (!descend(candidate.index, x, u, squared)) continue;
      if (std::abs(squared - best_squared) <= 1e-12 * (squared + best_squared) && !same_point(u, best)) return false;
      if (squared < best_squared) {
        best_squared = squared;
        best = u;
      }
    }
    if (!std::isfinite(best_squared)) return false;
    phi_->evaluate(const_span_of(best), point);
    return frame_at(const_span_of(best), frame, errors);
  }

  /// A closer point may have been missed, and the error bounds are of first order.
  FootPromise promise() const override { return {FootPromise::Place::kLocal, FootPromise::Errors::kModelled}; }
  std::optional<Bending> bending() const override {
    std::call_once(bending_once_, [&] { bending_ = estimate_bending(Submanifold(shared_from_this())).bending; });
    return bending_;
  }
  /// The image of a box.
  bool is_connected() const override { return true; }
  std::vector<double> seed_points() const override {
    const auto point = tree_->point(0);
    return {point.begin(), point.end()};
  }

 private:
  std::span<const double> parameter(std::size_t sample) const {
    const std::size_t m = phi_->parameter_size();
    return {&parameters_[sample * m], m};
  }

  /// Images of parameters, checked.
  std::vector<double> images(const std::vector<double>& parameters) const {
    const std::size_t m = phi_->parameter_size(), d = ambient_dim();
    std::vector<double> points(parameters.size() / m * d);
    for (std::size_t i = 0; i < parameters.size() / m; ++i) {
      phi_->evaluate({&parameters[i * m], m}, {&points[i * d], d});
      for (std::size_t c = 0; c < d; ++c)
        if (!std::isfinite(points[i * d + c]))
          throw InvalidInput("parametric_manifold: the map is not finite at a sample");
    }
    return points;
  }

  /// A bound (not more than sqrt(n) times it) of the norm of the second fundamental form at a sample.
  double curvature(std::size_t sample, Buffer& frame) const {
    const int n = intrinsic_dim(), d = ambient_dim();
    frame.resize(static_cast<std::size_t>(d) * d);
    FootErrors errors;
    if (!frame_at(parameter(sample), span_of(frame), errors))
      throw InvalidInput("parametric_manifold: the derivative of the map is not of rank n at a sample");
    Buffer J(static_cast<std::size_t>(d) * n);
    phi_->derivative(parameter(sample), span_of(J));
    const Jacobian jacobian(J.data(), d, n), rows(frame.data(), d, d);
    // In an orthonormal basis of the tangent space, t = C s.
    const Eigen::MatrixXd C = (rows.topRows(n) * jacobian).inverse();
    std::vector<Eigen::MatrixXd> form(d - n, Eigen::MatrixXd::Zero(n, n));
    second_derivatives(*phi_, parameter(sample), tree_->point(sample), [&](int i, int j, std::span<const double> S) {
      const Eigen::VectorXd normal = rows.bottomRows(d - n) * Eigen::Map<const Eigen::VectorXd>(S.data(), d);
      for (int a = 0; a < d - n; ++a) form[a](i, j) = form[a](j, i) = normal[a];
    });
    double squared = 0;
    for (const Eigen::MatrixXd& f : form) squared += (C.transpose() * f * C).squaredNorm();
    return std::sqrt(squared);
  }

  void sample() {
    const std::size_t d = ambient_dim();
    const std::vector<double> coarse = images(phi_->samples(std::numeric_limits<double>::infinity(), kMaxSamples));
    double spacing = 0;
    for (std::size_t c = 0; c < d; ++c) {
      double low = coarse[c], high = coarse[c];
      for (std::size_t i = c; i < coarse.size(); i += d) {
        low = std::min(low, coarse[i]);
        high = std::max(high, coarse[i]);
      }
      spacing = std::max(spacing, (high - low) / 4);
    }
    if (!(spacing > 0)) throw InvalidInput("parametric_manifold: the map is constant on its samples");
    Buffer frame;
    for (;;) {
      parameters_ = phi_->samples(spacing, kMaxSamples / 2);
      tree_.emplace(images(parameters_), static_cast<int>(d));
      covering_radius_ = 0;
      const std::vector<double> probes = images(phi_->samples(0.37 * spacing, kMaxSamples));
      for (std::size_t i = 0; i < probes.size(); i += d)
        covering_radius_ = std::max(covering_radius_, tree_->nearest({&probes[i], d}).squared_distance);
      covering_radius_ = 1.2 * std::sqrt(covering_radius_);
      largest_curvature_ = 0;
      for (std::size_t i = 0; i < tree_->size(); ++i)
        largest_curvature_ = std::max(largest_curvature_, curvature(i, frame));
      const double wanted = 0.2 / largest_curvature_;
      if (covering_radius_ <= wanted || tree_->size() > kMaxSamples / 4) break;
      spacing *= std::clamp(0.95 * wanted / covering_radius_, 0.3, 0.8);
    }
    size_ = 0;
    for (std::size_t i = 0; i < tree_->size(); ++i)
      for (const double c : tree_->point(i)) size_ = std::max(size_, std::abs(c));
  }

  /// Which samples are neighbours on M, not only in R^d: near, and not further off the tangent space than M bends.
  void link() {
    const std::size_t n = intrinsic_dim(), d = ambient_dim();
    Buffer frame(d * d);
    std::vector<KdTree::Neighbor> near;
    first_neighbor_ = {0};
    FootErrors errors;
    for (std::size_t i = 0; i < tree_->size(); ++i) {
      frame_at(parameter(i), span_of(frame), errors);
      tree_->within(tree_->point(i), 2.5 * covering_radius_, near);
      for (const KdTree::Neighbor& other : near) {
        double squared = 0;
        for (std::size_t row = n; row < d; ++row) {
          double along = 0;
          for (std::size_t c = 0; c < d; ++c)
            along += frame[row * d + c] * (tree_->point(other.index)[c] - tree_->point(i)[c]);
          squared += along * along;
        }
        if (other.index != i && std::sqrt(squared) <= largest_curvature_ * other.squared_distance)
          neighbors_.push_back(other.index);
      }
      first_neighbor_.push_back(neighbors_.size());
    }
  }

  bool is_locally_nearest(const KdTree::Neighbor& sample, std::span<const double> x) const {
    for (std::size_t i = first_neighbor_[sample.index]; i < first_neighbor_[sample.index + 1]; ++i) {
      const double squared = squared_distance(tree_->point(neighbors_[i]), x);
      if (squared < sample.squared_distance || (squared == sample.squared_distance && neighbors_[i] < sample.index))
        return false;
    }
    return true;
  }

  bool same_point(const Buffer& u, const Buffer& v) const {
    const std::size_t d = ambient_dim();
    Buffer a(d), b(d);
    phi_->evaluate(const_span_of(u), span_of(a));
    phi_->evaluate(const_span_of(v), span_of(b));
    return squared_distance(const_span_of(a), const_span_of(b)) <= covering_radius_ * covering_radius_ * 1e-6;
  }

  /// Newton's method for the closest point, from a sample: u, and its squared distance from x. False when it does not
  /// arrive at a strict local minimum.
  bool descend(std::size_t sample, std::span<const double> x, Buffer& u, double& squared) const {
    const int n = intrinsic_dim();
    const std::size_t d = ambient_dim(), m = phi_->parameter_size();
    u.assign(parameter(sample).begin(), parameter(sample).end());
    Buffer y(tree_->point(sample).begin(), tree_->point(sample).end()), J(d * n), moved(m), y_moved(d), step(n);
    squared = squared_distance(const_span_of(y), x);
    for (int iteration = 0; iteration < 40; ++iteration) {
      phi_->derivative(const_span_of(u), span_of(J));
      SmallVector gradient = SmallVector::Zero(n);
      SmallMatrix gram = SmallMatrix::Zero(n, n);
      for (std::size_t c = 0; c < d; ++c) {
        for (int i = 0; i < n; ++i) {
          gradient[i] += J[c * n + i] * (y[c] - x[c]);
          for (int j = 0; j <= i; ++j) gram(i, j) += J[c * n + i] * J[c * n + j];
        }
      }
      SmallMatrix hessian = gram;
      second_derivatives(*phi_, const_span_of(u), const_span_of(y), [&](int i, int j, std::span<const double> S) {
        double along = 0;
        for (std::size_t c = 0; c < d; ++c) along += S[c] * (y[c] - x[c]);
        hessian(i, j) += along;
      });
      Eigen::LLT<SmallMatrix> solver(hessian);
      const bool convex = solver.info() == Eigen::Success;
      if (!convex) solver.compute(gram);
      if (solver.info() != Eigen::Success) return false;
      SmallVector t = solver.solve(-gradient);
      double length = std::sqrt(std::max(0.0, t.dot(gram.selfadjointView<Eigen::Lower>() * t)));
      // From here the next step would be of the size of roundings; later where the minimum is shallow (next to the
      // medial axis), because there the differences in the Hessian weigh more.
      const bool sharp = t.dot(hessian.selfadjointView<Eigen::Lower>() * t) > 0.1 * length * length;
      // So near, distances differ by roundings only, and cannot say whether a step is good.
      const bool close = convex && length <= 1e-4 * covering_radius_;
      const bool last = convex && length <= (sharp ? 1e-7 : 1e-11) * covering_radius_;
      double moved_squared = 0;
      for (int halvings = 0;; ++halvings) {
        if (halvings == 30) return false;
        std::copy(t.data(), t.data() + n, step.begin());
        phi_->move(const_span_of(u), const_span_of(step), span_of(moved));
        phi_->evaluate(const_span_of(moved), span_of(y_moved));
        moved_squared = squared_distance(const_span_of(y_moved), x);
        if (close || moved_squared <= squared) break;
        t *= 0.5;
      }
      u = moved;
      y = y_moved;
      squared = moved_squared;
      if (last) return std::isfinite(squared);
    }
    return false;
  }

  bool frame_at(std::span<const double> u, std::span<double> frame, FootErrors& errors) const {
    const int n = intrinsic_dim();
    const std::size_t d = ambient_dim();
    Buffer J(d * n);
    phi_->derivative(u, span_of(J));
    SmallMatrix gram = SmallMatrix::Zero(n, n);
    for (std::size_t c = 0; c < d; ++c) {
      for (int i = 0; i < n; ++i) {
        frame[i * d + c] = J[c * n + i];
        for (int j = 0; j <= i; ++j) gram(i, j) += J[c * n + i] * J[c * n + j];
      }
    }
    double low = gram(0, 0), high = low;
    if (n == 2) {
      const double mean = (gram(0, 0) + gram(1, 1)) / 2, half = std::hypot((gram(0, 0) - gram(1, 1)) / 2, gram(1, 0));
      high = mean + half;
      low = (gram(0, 0) * gram(1, 1) - gram(1, 0) * gram(1, 0)) / high;
    } else if (n > 2) {
      const Eigen::SelfAdjointEigenSolver<SmallMatrix> solver(gram, Eigen::EigenvaluesOnly);
      low = solver.eigenvalues()[0];
      high = solver.eigenvalues()[n - 1];
    }
    if (!(low > 1e-20 * high)) return false;
    errors.point = 64 * kEps * size_;
    errors.angle = phi_->derivative_precision() * (1 + 2 * std::sqrt(static_cast<double>(n) * high / low));
    return complete_frame(frame, ambient_dim(), n);
  }

  std::shared_ptr<const Parametrization> phi_;
  std::vector<double> parameters_;  ///< of the samples
  std::optional<KdTree> tree_;      ///< their images
  double covering_radius_ = 0;      ///< every point of M is this close to a sample, as far as measured
  double largest_curvature_ = 0;    ///< at the samples
  double size_ = 0;                 ///< largest coordinate of a sample
  std::vector<std::size_t> first_neighbor_, neighbors_;
  mutable std::once_flag bending_once_;
  mutable std::optional<Bending> bending_;
};

/// R^n with a box to take samples from.
class BoxParametrization : public Parametrization {
 public:
  BoxParametrization(int ambient_dim, std::vector<std::array<double, 2>> domain)
      : ambient_dim_(ambient_dim), domain_(std::move(domain)) {
    if (domain_.empty() || domain_.size() > kMaxIntrinsicDim)
      throw InvalidInput("parametric_manifold: 1 <= n <= 8 parameters are needed");
    for (const auto& [low, high] : domain_)
      if (!(low < high) || !std::isfinite(high - low))
        throw InvalidInput("parametric_manifold: a side of the domain is empty or not finite");
  }
  int ambient_dim() const override { return ambient_dim_; }
  int intrinsic_dim() const override { return static_cast<int>(domain_.size()); }
  double scale(int axis) const override { return (domain_[axis][1] - domain_[axis][0]) / (2 * std::numbers::pi); }
  std::vector<double> samples(double spacing, std::size_t max_samples) const override {
    const std::size_t n = domain_.size();
    std::vector<std::size_t> counts(n, n <= 2 ? 9 : 5);
    if (std::isfinite(spacing)) {
      const std::vector<double> lengths = side_lengths();
      double product = 1;
      for (const double length : lengths) product *= std::max(4.0, length / spacing);
      const double shrink =
          std::min(1.0, std::pow(static_cast<double>(max_samples) / product, 1.0 / static_cast<double>(n)));
      for (std::size_t i = 0; i < n; ++i)
        counts[i] = static_cast<std::size_t>(std::ceil(std::max(4.0, lengths[i] / spacing) * shrink));
    }
    return grid(counts);
  }

 private:
  /// The centres of the cells of a regular subdivision.
  std::vector<double> grid(const std::vector<std::size_t>& counts) const {
    const std::size_t n = domain_.size();
    std::vector<std::size_t> cell(n, 0);
    std::vector<double> parameters;
    for (std::size_t i = 0; i < n;) {
      for (std::size_t j = 0; j < n; ++j)
        parameters.push_back(domain_[j][0] + (domain_[j][1] - domain_[j][0]) * (static_cast<double>(cell[j]) + 0.5) /
                                                 static_cast<double>(counts[j]));
      for (i = 0; i < n && ++cell[i] == counts[i]; ++i) cell[i] = 0;
    }
    return parameters;
  }
  /// How long the image of a line along each axis can be.
  std::vector<double> side_lengths() const {
    const std::size_t n = domain_.size(), d = ambient_dim_;
    std::vector<double> lengths(n, 0.0), J(d * n);
    const std::vector<double> parameters = grid(std::vector<std::size_t>(n, n <= 2 ? 9 : 5));
    for (std::size_t p = 0; p < parameters.size(); p += n) {
      derivative({&parameters[p], n}, J);
      for (std::size_t i = 0; i < n; ++i) {
        double squared = 0;
        for (std::size_t c = 0; c < d; ++c) squared += J[c * n + i] * J[c * n + i];
        lengths[i] = std::max(lengths[i], std::sqrt(squared) * (domain_[i][1] - domain_[i][0]));
      }
    }
    return lengths;
  }

  int ambient_dim_;
  std::vector<std::array<double, 2>> domain_;
};

class CallableParametrization : public BoxParametrization {
 public:
  using Map = std::function<void(std::span<const double>, std::span<double>)>;
  CallableParametrization(int ambient_dim, std::vector<std::array<double, 2>> domain, Map map, Map derivative)
      : BoxParametrization(ambient_dim, std::move(domain)), map_(std::move(map)), derivative_(std::move(derivative)) {
    if (!map_) throw InvalidInput("parametric_manifold: map is an empty std::function");
    if (ambient_dim < 1) throw InvalidInput("parametric_manifold: ambient_dim must be at least 1");
  }
  void evaluate(std::span<const double> u, std::span<double> x) const override { map_(u, x); }
  void derivative(std::span<const double> u, std::span<double> jacobian) const override {
    if (derivative_) return derivative_(u, jacobian);
    // Five points: the error is of order step^4.
    const std::size_t n = u.size(), d = ambient_dim();
    Buffer v(u.begin(), u.end()), a(d), b(d), e(d), f(d);
    for (std::size_t i = 0; i < n; ++i) {
      const double step = 1e-3 * scale(static_cast<int>(i));
      const auto at = [&](double factor, Buffer& values) {
        v[i] = u[i] + factor * step;
        map_(const_span_of(v), span_of(values));
      };
      at(1, a), at(-1, b), at(2, e), at(-2, f);
      v[i] = u[i];
      for (std::size_t c = 0; c < d; ++c) jacobian[c * n + i] = (8 * (a[c] - b[c]) - (e[c] - f[c])) / (12 * step);
    }
  }
  double derivative_precision() const override { return derivative_ ? 1e-14 : 1e-10; }

 private:
  Map map_, derivative_;
};

class CompiledParametrization : public BoxParametrization {
 public:
  CompiledParametrization(CompiledMap map, std::vector<std::array<double, 2>> domain)
      : BoxParametrization(map.values.num_outputs(), std::move(domain)), map_(std::move(map)) {}
  void evaluate(std::span<const double> u, std::span<double> x) const override { map_.values.run_batch(u, x); }
  void derivative(std::span<const double> u, std::span<double> jacobian) const override {
    map_.jacobian.run_batch(u, jacobian);
  }

 private:
  CompiledMap map_;
};

}  // namespace

void Parametrization::move(std::span<const double> u, std::span<const double> t, std::span<double> moved) const {
  for (std::size_t i = 0; i < u.size(); ++i) moved[i] = u[i] + t[i];
}

Submanifold parametric_manifold(std::shared_ptr<const Parametrization> phi) {
  return Submanifold(std::make_shared<ParametricModel>(std::move(phi)));
}

Submanifold parametric_manifold(int ambient_dim, std::vector<std::array<double, 2>> domain,
                                std::function<void(std::span<const double> u, std::span<double> x)> map,
                                std::function<void(std::span<const double> u, std::span<double> jacobian)> derivative) {
  return parametric_manifold(
      std::make_shared<CallableParametrization>(ambient_dim, std::move(domain), std::move(map), std::move(derivative)));
}

Submanifold parametric_manifold(std::span<const std::string> parameters, std::vector<std::array<double, 2>> domain,
                                std::span<const std::string> map) {
  if (domain.size() != parameters.size())
    throw InvalidInput("parametric_manifold: the domain needs one side for each parameter");
  return parametric_manifold(std::make_shared<CompiledParametrization>(compile(parameters, map), std::move(domain)));
}

}  // namespace whitney
