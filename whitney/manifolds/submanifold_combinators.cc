// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/submanifold_combinators.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <boost/container/small_vector.hpp>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// A frame up to d = 8 without a trip to the heap.
using Buffer = boost::container::small_vector<double, 64>;

void require(bool condition, const std::string& message) {
  if (!condition) throw InvalidInput(message);
}

/// A double that is at most a b, for a, b > 0: a bound that is proved stays one.
double product_below(double a, double b) {
  const double product = a * b;
  // The residual of a rounded product is a double, unless it is too small for one.
  const bool is_below = product > 1e-280 && std::fma(a, b, -product) >= 0;
  return is_below ? product : std::nextafter(product, 0.0);
}

double largest(std::span<const double> x) {
  double size = 0;
  for (const double c : x) size = std::max(size, std::abs(c));
  return size;
}

/// The image of M under a similarity x -> s Q x + b of R^d. A Similarity offers
///   apply(x, y): y is the image of x;  invert(x, y);  turn(v, w): w = Q v;  ratio: s;
///   rounding(x): of apply at a result x, a length;  turn_rounding: of turn, relative.
template <class Similarity>
class MovedModel : public Submanifold::Model {
 public:
  MovedModel(Submanifold M, Similarity map) : M_(std::move(M)), map_(std::move(map)) {}
  int ambient_dim() const override { return M_.ambient_dim(); }
  int intrinsic_dim() const override { return M_.intrinsic_dim(); }
  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
               FootErrors& errors) const override {
    const std::size_t d = x.size();
    Buffer moved(d, boost::container::default_init), row(d, boost::container::default_init);
    map_.invert(x.data(), moved.data(), d);
    if (!M_.project({moved.data(), d}, point, frame, errors)) return false;
    std::copy(point.begin(), point.end(), moved.begin());
    map_.apply(moved.data(), point.data(), d);
    if (map_.turn_rounding(d) > 0) {
      for (std::size_t i = 0; i < d; ++i) {
        std::copy_n(&frame[i * d], d, row.data());
        map_.turn(row.data(), &frame[i * d], d);
      }
    }
    errors.point = map_.ratio() * errors.point + map_.rounding(point, d);
    errors.angle += map_.turn_rounding(d);
    return true;
  }
  FootPromise promise() const override { return M_.promise(); }
  std::optional<Bending> bending() const override {
    std::optional<Bending> bending = M_.bending();
    if (bending) {
      bending->reach = product_below(bending->reach, map_.ratio());
      bending->curvature_radius = product_below(bending->curvature_radius, map_.ratio());
    }
    return bending;
  }
  bool is_connected() const override { return M_.is_connected(); }
  std::vector<double> seed_points() const override {
    const std::size_t d = ambient_dim();
    const std::vector<double> seeds = M_.seed_points();
    std::vector<double> moved(seeds.size());
    for (std::size_t i = 0; i + d <= seeds.size(); i += d) map_.apply(&seeds[i], &moved[i], d);
    return moved;
  }

 private:
  Submanifold M_;
  Similarity map_;
};

template <class Similarity>
Submanifold moved(Submanifold M, Similarity map) {
  return Submanifold(std::make_shared<MovedModel<Similarity>>(std::move(M), std::move(map)));
}

struct Rotation {
  std::vector<double> rows;  ///< of Q

  void apply(const double* x, double* y, std::size_t d) const {
    for (std::size_t i = 0; i < d; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < d; ++j) sum += rows[i * d + j] * x[j];
      y[i] = sum;
    }
  }
  void invert(const double* x, double* y, std::size_t d) const {
    std::fill(y, y + d, 0.0);
    for (std::size_t i = 0; i < d; ++i)
      for (std::size_t j = 0; j < d; ++j) y[j] += rows[i * d + j] * x[i];
  }
  void turn(const double* v, double* w, std::size_t d) const { apply(v, w, d); }
  double ratio() const { return 1; }
  double turn_rounding(std::size_t d) const { return 4 * kEps * static_cast<double>(d); }
  double rounding(std::span<const double> point, std::size_t d) const {
    return turn_rounding(d) * std::sqrt(static_cast<double>(d)) * largest(point);
  }
};

struct Translation {
  std::vector<double> b;

  void apply(const double* x, double* y, std::size_t d) const {
    for (std::size_t i = 0; i < d; ++i) y[i] = x[i] + b[i];
  }
  void invert(const double* x, double* y, std::size_t d) const {
    for (std::size_t i = 0; i < d; ++i) y[i] = x[i] - b[i];
  }
  void turn(const double*, double*, std::size_t) const {}
  double ratio() const { return 1; }
  double turn_rounding(std::size_t) const { return 0; }
  double rounding(std::span<const double> point, std::size_t d) const {
    return 2 * kEps * std::sqrt(static_cast<double>(d)) * (largest(point) + largest(b));
  }
};

struct Scaling {
  double s;

  void apply(const double* x, double* y, std::size_t d) const {
    for (std::size_t i = 0; i < d; ++i) y[i] = s * x[i];
  }
  void invert(const double* x, double* y, std::size_t d) const {
    for (std::size_t i = 0; i < d; ++i) y[i] = x[i] / s;
  }
  void turn(const double*, double*, std::size_t) const {}
  double ratio() const { return s; }
  double turn_rounding(std::size_t) const { return 0; }
  double rounding(std::span<const double> point, std::size_t d) const {
    return kEps * std::sqrt(static_cast<double>(d)) * largest(point);
  }
};

class ProductModel : public Submanifold::Model {
 public:
  ProductModel(Submanifold M, Submanifold N) : M_(std::move(M)), N_(std::move(N)) {}
  int ambient_dim() const override { return M_.ambient_dim() + N_.ambient_dim(); }
  int intrinsic_dim() const override { return M_.intrinsic_dim() + N_.intrinsic_dim(); }
  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
               FootErrors& errors) const override {
    const std::size_t d = M_.ambient_dim(), e = N_.ambient_dim(), m = M_.intrinsic_dim(), n = N_.intrinsic_dim();
    Buffer F(d * d, boost::container::default_init), G(e * e, boost::container::default_init);
    FootErrors of_N;
    if (!M_.project(x.first(d), point.first(d), {F.data(), F.size()}, errors) ||
        !N_.project(x.last(e), point.last(e), {G.data(), G.size()}, of_N))
      return false;
    errors = {std::hypot(errors.point, of_N.point), std::max(errors.angle, of_N.angle)};
    std::fill(frame.begin(), frame.end(), 0.0);
    // Tangent rows of both, then normal rows of both.
    for (std::size_t i = 0; i < d; ++i) std::copy_n(&F[i * d], d, &frame[(i < m ? i : i + n) * (d + e)]);
    for (std::size_t i = 0; i < e; ++i) std::copy_n(&G[i * e], e, &frame[(i < n ? i + m : i + d) * (d + e) + d]);
    return true;
  }
  FootPromise promise() const override { return perturbation::weaker(M_.promise(), N_.promise()); }
  std::optional<Bending> bending() const override {
    const std::optional<Bending> a = M_.bending(), b = N_.bending();
    if (!a || !b) return std::nullopt;
    return Bending{std::min(a->reach, b->reach), std::min(a->curvature_radius, b->curvature_radius),
                   std::max(a->source, b->source)};
  }
  bool is_connected() const override { return M_.is_connected() && N_.is_connected(); }
  std::vector<double> seed_points() const override {
    const std::size_t d = M_.ambient_dim(), e = N_.ambient_dim();
    const std::vector<double> a = M_.seed_points(), b = N_.seed_points();
    std::vector<double> seeds;
    for (std::size_t i = 0; i + d <= a.size(); i += d) {
      for (std::size_t j = 0; j + e <= b.size(); j += e) {
        seeds.insert(seeds.end(), &a[i], &a[i] + d);
        seeds.insert(seeds.end(), &b[j], &b[j] + e);
      }
    }
    return seeds;
  }

 private:
  Submanifold M_, N_;
};

class EmbeddedModel : public Submanifold::Model {
 public:
  EmbeddedModel(Submanifold M, int ambient_dim) : M_(std::move(M)), ambient_dim_(ambient_dim) {}
  int ambient_dim() const override { return ambient_dim_; }
  int intrinsic_dim() const override { return M_.intrinsic_dim(); }
  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
               FootErrors& errors) const override {
    const std::size_t d = M_.ambient_dim(), e = ambient_dim_;
    for (std::size_t i = d; i < e; ++i)
      if (!std::isfinite(x[i])) return false;
    Buffer F(d * d, boost::container::default_init);
    if (!M_.project(x.first(d), point.first(d), {F.data(), F.size()}, errors)) return false;
    std::fill(point.begin() + static_cast<std::ptrdiff_t>(d), point.end(), 0.0);
    std::fill(frame.begin(), frame.end(), 0.0);
    for (std::size_t i = 0; i < d; ++i) std::copy_n(&F[i * d], d, &frame[i * e]);
    for (std::size_t i = d; i < e; ++i) frame[i * e + i] = 1;
    return true;
  }
  FootPromise promise() const override { return M_.promise(); }
  std::optional<Bending> bending() const override { return M_.bending(); }
  bool is_connected() const override { return M_.is_connected(); }
  std::vector<double> seed_points() const override {
    const std::size_t d = M_.ambient_dim(), e = ambient_dim_;
    const std::vector<double> seeds = M_.seed_points();
    std::vector<double> embedded(seeds.size() / d * e, 0.0);
    for (std::size_t i = 0; i < seeds.size() / d; ++i) std::copy_n(&seeds[i * d], d, &embedded[i * e]);
    return embedded;
  }

 private:
  Submanifold M_;
  int ambient_dim_;
};

}  // namespace

Submanifold product(Submanifold M, Submanifold N) {
  return Submanifold(std::make_shared<ProductModel>(std::move(M), std::move(N)));
}

Submanifold embed(Submanifold M, int ambient_dim) {
  require(ambient_dim >= M.ambient_dim(), "embed: ambient_dim " + std::to_string(ambient_dim) +
                                              " is less than that of the manifold, " + std::to_string(M.ambient_dim()));
  if (ambient_dim == M.ambient_dim()) return M;
  return Submanifold(std::make_shared<EmbeddedModel>(std::move(M), ambient_dim));
}

Submanifold rotate(Submanifold M, const Matrix& Q) {
  const std::ptrdiff_t d = M.ambient_dim();
  require(Q.rows() == d && Q.cols() == d, "rotate: Q must be d x d with d = " + std::to_string(d));
  require(all_finite(Q.entries()), "rotate: Q has an entry that is not finite");
  for (std::ptrdiff_t i = 0; i < d; ++i) {
    for (std::ptrdiff_t j = 0; j <= i; ++j) {
      double dot = 0;
      for (std::ptrdiff_t l = 0; l < d; ++l) dot += Q(l, i) * Q(l, j);
      require(std::abs(dot - (i == j)) <= 1e-9, "rotate: Q is not orthogonal");
    }
  }
  Rotation map;
  for (std::ptrdiff_t i = 0; i < d; ++i)
    for (std::ptrdiff_t j = 0; j < d; ++j) map.rows.push_back(Q(i, j));
  complete_frame(map.rows, static_cast<int>(d), static_cast<int>(d));
  return moved(std::move(M), std::move(map));
}

Submanifold translate(Submanifold M, std::span<const double> b) {
  require(std::ssize(b) == M.ambient_dim(),
          "translate: b must have d = " + std::to_string(M.ambient_dim()) + " entries");
  require(all_finite(b), "translate: b has an entry that is not finite");
  return moved(std::move(M), Translation{{b.begin(), b.end()}});
}

Submanifold scale(Submanifold M, double s) {
  require(s > 0 && std::isfinite(s), "scale: s must be positive and finite, not " + std::to_string(s));
  return moved(std::move(M), Scaling{s});
}

}  // namespace whitney
