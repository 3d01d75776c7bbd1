// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/bending.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

using Vector = std::vector<double>;

struct Foot {
  Vector point, frame;
};

/// The feet of one manifold, and what can be measured at them.
class Walker {
 public:
  explicit Walker(const Submanifold& manifold)
      : manifold_(manifold), d_(manifold.ambient_dim()), n_(manifold.intrinsic_dim()) {}

  std::size_t d() const { return d_; }
  std::size_t n() const { return n_; }

  std::optional<Foot> foot(const Vector& x) const {
    Foot result{Vector(d_), Vector(d_ * d_)};
    FootErrors errors;
    if (!manifold_.project(x, result.point, result.frame, errors)) return std::nullopt;
    return result;
  }
  /// From a foot along its tangent space: t in coordinates of the frame, n.
  std::optional<Foot> move(const Foot& from, const double* t) const {
    Vector x = from.point;
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t c = 0; c < d_; ++c) x[c] += t[i] * from.frame[i * d_ + c];
    return foot(x);
  }
  /// Federer's quotient |q - p|^2 / (2 dist(q - p, T_p)).
  double quotient(const Foot& p, const double* q) const {
    double squared = 0, normal_squared = 0;
    for (std::size_t c = 0; c < d_; ++c) squared += (q[c] - p.point[c]) * (q[c] - p.point[c]);
    for (std::size_t i = n_; i < d_; ++i) {
      double along = 0;
      for (std::size_t c = 0; c < d_; ++c) along += p.frame[i * d_ + c] * (q[c] - p.point[c]);
      normal_squared += along * along;
    }
    return squared / (2 * std::sqrt(normal_squared));
  }
  /// 1 / |II(v, v)| for a unit tangent v (n coordinates), by feet at distance `step` both ways: error of order step^2.
  double curvature_radius(const Foot& p, const double* v, double step) const {
    Vector t(v, v + n_), form(d_ - n_, 0.0);
    for (const double sign : {1.0, -1.0}) {
      for (std::size_t i = 0; i < n_; ++i) t[i] = sign * step * v[i];
      const auto q = move(p, t.data());
      if (!q) return std::numeric_limits<double>::infinity();
      double squared = 0;
      for (std::size_t c = 0; c < d_; ++c) squared += (q->point[c] - p.point[c]) * (q->point[c] - p.point[c]);
      for (std::size_t i = n_; i < d_; ++i) {
        double along = 0;
        for (std::size_t c = 0; c < d_; ++c) along += p.frame[i * d_ + c] * (q->point[c] - p.point[c]);
        form[i - n_] += along / squared;
      }
    }
    double squared = 0;
    for (const double component : form) squared += component * component;
    return 1 / std::sqrt(squared);
  }

 private:
  const Submanifold& manifold_;
  std::size_t d_, n_;
};

double squared_distance(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t c = 0; c < a.size(); ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

/// A step over which M visibly leaves its tangent space at p.
double first_step(const Walker& walker, const Foot& p) {
  double size = 0;
  for (const double c : p.point) size = std::max(size, std::abs(c));
  Vector t(walker.n(), 0.0);
  for (double step = std::max(1e-6 * size, 1e-100); step < 1e100; step *= 1.5) {
    for (std::size_t i = 0; i < walker.n(); ++i) {
      std::fill(t.begin(), t.end(), 0.0);
      t[i] = step;
      const auto q = walker.move(p, t.data());
      if (!q || !(walker.quotient(p, q->point.data()) > 2 * step)) return step;
    }
  }
  throw InvalidInput("estimate_bending: the manifold looks flat from its first seed point");
}

/// Points of M about `step` apart, by steps along the tangent axes; at most max_points.
std::vector<Foot> walk(const Walker& walker, const std::vector<Foot>& seeds, double step, std::size_t max_points) {
  std::vector<Foot> feet;
  const auto add = [&](std::optional<Foot> foot) {
    if (!foot || feet.size() >= max_points) return;
    for (const Foot& other : feet)
      if (squared_distance(other.point, foot->point) < 0.49 * step * step) return;
    feet.push_back(std::move(*foot));
  };
  for (const Foot& seed : seeds) add(seed);
  Vector t(walker.n());
  for (std::size_t i = 0; i < feet.size() && feet.size() < max_points; ++i) {
    for (std::size_t axis = 0; axis < walker.n(); ++axis) {
      for (const double sign : {1.0, -1.0}) {
        std::fill(t.begin(), t.end(), 0.0);
        t[axis] = sign * step;
        add(walker.move(feet[i], t.data()));
      }
    }
  }
  return feet;
}

/// Indices of the smallest values, `count` of them, ties by index.
std::vector<std::size_t> smallest(const Vector& values, std::size_t count) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  count = std::min(count, order.size());
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
      [&](std::size_t a, std::size_t b) { return values[a] != values[b] ? values[a] < values[b] : a < b; });
  order.resize(count);
  return order;
}

/// Compass search: tries steps along the axes of a space of moves, halving them when none helps; returns the value.
/// attempt(moves, value): the value after the moves, which it makes lasting when it is less than `value`.
double compass(std::size_t num_axes, double step, double last_step, double value,
               const std::function<double(const Vector& moves, double value)>& attempt) {
  Vector moves(num_axes, 0.0);
  for (int rounds = 0; step > last_step && rounds < 400; ++rounds) {
    const double before = value;
    for (std::size_t axis = 0; axis < num_axes; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        moves[axis] = sign * step;
        const double next = attempt(moves, value);
        moves[axis] = 0;
        if (next < value) {
          value = next;
          break;
        }
      }
    }
    if (!(value < before)) step /= 2;
  }
  return value;
}

/// A sample of the manifold, and how far apart its points are (a length).
struct Sample {
  std::vector<Foot> feet;
  double step = 0;
};

Sample sample_of(const Submanifold& manifold, const Walker& walker, const EstimateBendingOptions& options) {
  const std::size_t d = walker.d(), n = walker.n();
  std::vector<Foot> seeds;
  const Vector seed_points = manifold.seed_points();
  for (std::size_t i = 0; i + d <= seed_points.size(); i += d)
    if (auto foot = walker.foot(Vector(&seed_points[i], &seed_points[i] + d))) seeds.push_back(std::move(*foot));
  if (seeds.empty()) throw InvalidInput("estimate_bending: no seed point of the manifold has a foot");

  double step = first_step(walker, seeds[0]);
  std::vector<Foot> feet = walk(walker, seeds, step, options.max_points);
  for (int rounds = 0; feet.size() < options.min_points && rounds < 60; ++rounds) {
    step *= std::clamp(std::pow(static_cast<double>(feet.size()) / (1.6 * static_cast<double>(options.min_points)),
                                1.0 / static_cast<double>(n)),
                       0.2, 0.9);
    feet = walk(walker, seeds, step, options.max_points);
  }
  return {std::move(feet), step};
}

/// The smallest quotient of a pair of points: the worst partner of every point, then descents of both. The pair goes
/// into the result.
double worst_pair(const Walker& walker, const Sample& sample, const EstimateBendingOptions& options,
                  BendingEstimate& result) {
  const std::size_t n = walker.n();
  const std::vector<Foot>& feet = sample.feet;
  const double step = sample.step;
  double best_pair = std::numeric_limits<double>::infinity();
  Vector worst(feet.size(), best_pair);
  std::vector<std::size_t> partner(feet.size(), 0);
  for (std::size_t i = 0; i < feet.size(); ++i) {
    for (std::size_t j = 0; j < feet.size(); ++j) {
      if (i == j) continue;
      const double quotient = walker.quotient(feet[i], feet[j].point.data());
      if (quotient < worst[i]) {
        worst[i] = quotient;
        partner[i] = j;
      }
    }
  }
  for (const std::size_t i : smallest(worst, options.num_descents)) {
    Foot p = feet[i], q = feet[partner[i]];
    const double value = compass(2 * n, step / 2, 1e-8 * step, worst[i], [&](const Vector& moves, double best) {
      const auto new_p = walker.move(p, moves.data()), new_q = walker.move(q, moves.data() + n);
      // Where p and q meet the quotient loses its digits; the curvature is found below.
      if (!new_p || !new_q || squared_distance(new_p->point, new_q->point) < 1e-4 * step * step) return best;
      const double quotient = walker.quotient(*new_p, new_q->point.data());
      if (quotient < best) {
        p = *new_p;
        q = *new_q;
      }
      return quotient;
    });
    if (value < best_pair) {
      best_pair = value;
      result.p = p.point;
      result.q = q.point;
    }
  }
  return best_pair;
}

/// Tangent directions to try: the axes and the diagonals between two of them.
std::vector<Vector> trial_directions(std::size_t n) {
  std::vector<Vector> directions;
  for (std::size_t i = 0; i < n; ++i) {
    directions.emplace_back(n, 0.0)[i] = 1;
    for (std::size_t j = 0; j < i; ++j) {
      for (const double sign : {1.0, -1.0}) {
        Vector& v = directions.emplace_back(n, 0.0);
        v[i] = std::sqrt(0.5);
        v[j] = sign * std::sqrt(0.5);
      }
    }
  }
  return directions;
}

/// The smallest radius of curvature: the worst of a few directions at every point, then descents of point and
/// direction. Both go into the result.
double worst_curvature(const Walker& walker, const Sample& sample, double small_step,
                       const EstimateBendingOptions& options, BendingEstimate& result) {
  const std::size_t d = walker.d(), n = walker.n();
  const std::vector<Foot>& feet = sample.feet;
  const std::vector<Vector> directions = trial_directions(n);
  const double step = sample.step;
  double best_radius = std::numeric_limits<double>::infinity();
  Vector radius(feet.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> along(feet.size(), 0);
  for (std::size_t i = 0; i < feet.size(); ++i) {
    for (std::size_t j = 0; j < directions.size(); ++j) {
      const double value = walker.curvature_radius(feet[i], directions[j].data(), small_step);
      if (value < radius[i]) {
        radius[i] = value;
        along[i] = j;
      }
    }
  }
  for (const std::size_t i : smallest(radius, options.num_descents)) {
    Foot p = feet[i];
    // The direction lives in R^d, so that it can follow the point.
    Vector v(d, 0.0);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t c = 0; c < d; ++c) v[c] += directions[along[i]][a] * p.frame[a * d + c];
    // Moves of the direction are in radians times `step`.
    const double value = compass(2 * n, step / 2, 1e-6 * step, radius[i], [&](const Vector& moves, double best) {
      const auto new_p = walker.move(p, moves.data());
      if (!new_p) return best;
      Vector t(n, 0.0);
      double squared = 0;
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t c = 0; c < d; ++c) t[a] += v[c] * new_p->frame[a * d + c];
        t[a] += moves[n + a] / step;
        squared += t[a] * t[a];
      }
      if (!(squared > 0)) return best;
      for (double& component : t) component /= std::sqrt(squared);
      const double curvature_radius = walker.curvature_radius(*new_p, t.data(), small_step);
      if (curvature_radius < best) {
        p = *new_p;
        std::fill(v.begin(), v.end(), 0.0);
        for (std::size_t a = 0; a < n; ++a)
          for (std::size_t c = 0; c < d; ++c) v[c] += t[a] * p.frame[a * d + c];
      }
      return curvature_radius;
    });
    if (value < best_radius) {
      best_radius = value;
      result.most_curved = p.point;
      result.direction = v;
    }
  }
  return best_radius;
}

}  // namespace

BendingEstimate estimate_bending(const Submanifold& manifold, const EstimateBendingOptions& options) {
  const Walker walker(manifold);
  const std::size_t d = walker.d();
  const Sample sample = sample_of(manifold, walker, options);
  BendingEstimate result;
  result.num_points = sample.feet.size();
  const double best_pair = worst_pair(walker, sample, options, result);
  // Balances the rounding of feet, eps (reach / step)^2, against (step / reach)^2.
  const double small_step = 3e-4 * best_pair;
  const double best_radius = worst_curvature(walker, sample, small_step, options, result);
  result.bending = {std::min(best_pair, best_radius), best_radius, Bending::Source::kEstimated};
  if (best_radius < best_pair) {
    result.p = result.q = result.most_curved;
    for (std::size_t c = 0; c < d; ++c) result.q[c] += small_step * result.direction[c];
    if (const auto q = walker.foot(result.q)) result.q = q->point;
  }
  return result;
}

}  // namespace whitney
