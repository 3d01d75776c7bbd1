// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/closed_form_manifolds.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <coxeter/base/error.h>

namespace whitney::closed_form {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
/// Closer to the medial axis than this, relative to the size of x, there is no foot.
constexpr double kMedial = 1e-12;
/// Roundings in one of the formulas below, generously.
constexpr double kRoundings = 32;
/// The closest point is written out, and its roundings are counted.
constexpr FootPromise kPromise{FootPromise::Place::kGlobal, FootPromise::Errors::kProven};

void require(bool condition, const std::string& message) {
  if (!condition) throw InvalidInput(message);
}

double norm(std::span<const double> x) {
  double squared = 0;
  for (const double c : x) squared += c * c;
  return std::sqrt(squared);
}

/// Whether a point at this distance from the medial axis has a foot; false for NaN and infinite sizes.
bool has_foot(double distance_to_axis, double size) { return std::isfinite(size) && distance_to_axis > kMedial * size; }

/// length: of M; size: of x and M; distance_to_axis: of x.
FootErrors rounding(double length, double size, double distance_to_axis) {
  const double relative = kRoundings * kEps * (1 + size / distance_to_axis);
  return {relative * length, relative};
}

class Sphere : public Submanifold::Model {
 public:
  Sphere(int n, int d, double radius) : n_(n), d_(d), radius_(radius) {}
  int ambient_dim() const override { return d_; }
  int intrinsic_dim() const override { return n_; }
  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
               FootErrors& errors) const override {
    const std::size_t n = n_, d = d_;
    const double length = norm(x.first(n + 1)), size = std::max(norm(x), radius_);
    if (!has_foot(length, size)) return false;
    std::fill(point.begin(), point.end(), 0.0);
    std::fill(frame.begin(), frame.end(), 0.0);
    double* normal = &frame[n * d];
    for (std::size_t c = 0; c <= n; ++c) {
      normal[c] = x[c] / length;
      point[c] = radius_ * normal[c];
    }
    // The other columns of the reflection that takes the first axis to the normal (or its opposite) are tangent.
    const double sign = normal[0] < 0 ? -1 : 1, factor = 1 / (1 + std::abs(normal[0]));
    for (std::size_t i = 0; i < n; ++i) {
      double* row = &frame[i * d];
      row[0] = -factor * (normal[0] + sign) * normal[i + 1];
      for (std::size_t c = 1; c <= n; ++c) row[c] = (c == i + 1 ? 1 : 0) - factor * normal[c] * normal[i + 1];
    }
    for (std::size_t i = n + 1; i < d; ++i) frame[i * d + i] = 1;
    errors = rounding(radius_, size, length);
    return true;
  }
  FootPromise promise() const override { return kPromise; }
  std::optional<Bending> bending() const override { return Bending{radius_, radius_, Bending::Source::kProven}; }
  bool is_connected() const override { return true; }
  std::vector<double> seed_points() const override {
    std::vector<double> seed(d_, 0.0);
    seed[0] = radius_;
    return seed;
  }

 private:
  int n_, d_;
  double radius_;
};

class TorusOfRevolution : public Submanifold::Model {
 public:
  TorusOfRevolution(double R, double r) : R_(R), r_(r) {}
  int ambient_dim() const override { return 3; }
  int intrinsic_dim() const override { return 2; }
  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
               FootErrors& errors) const override {
    const double rho = std::hypot(x[0], x[1]), size = std::max(rho + std::abs(x[2]), R_ + r_);
    if (!has_foot(rho, size)) return false;
    const double length = std::hypot(rho - R_, x[2]);
    if (!has_foot(length, size)) return false;
    const double cos_u = x[0] / rho, sin_u = x[1] / rho, cos_v = (rho - R_) / length, sin_v = x[2] / length;
    const double to_axis = R_ + r_ * cos_v;
    point[0] = to_axis * cos_u;
    point[1] = to_axis * sin_u;
    point[2] = r_ * sin_v;
    const double rows[9] = {-sin_u,        cos_u,         0,    -sin_v * cos_u, -sin_v * sin_u, cos_v,
                            cos_v * cos_u, cos_v * sin_u, sin_v};
    std::copy(std::begin(rows), std::end(rows), frame.begin());
    errors = rounding(R_ + r_, size, std::min(rho, length));
    return true;
  }
  FootPromise promise() const override { return kPromise; }
  std::optional<Bending> bending() const override {
    // Rounded down: R - r was rounded.
    const double reach = std::min(r_, std::nextafter(R_ - r_, 0.0));
    return Bending{reach, reach, Bending::Source::kProven};
  }
  bool is_connected() const override { return true; }
  std::vector<double> seed_points() const override { return {R_ + r_, 0, 0}; }

 private:
  double R_, r_;
};

class FlatTorus : public Submanifold::Model {
 public:
  FlatTorus(int d, double r1, double r2) : d_(d), radius_{r1, r2} {}
  int ambient_dim() const override { return d_; }
  int intrinsic_dim() const override { return 2; }
  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
               FootErrors& errors) const override {
    const std::size_t d = d_;
    const double size = std::max({norm(x), radius_[0], radius_[1]});
    std::fill(point.begin(), point.end(), 0.0);
    std::fill(frame.begin(), frame.end(), 0.0);
    double nearest_axis = size;
    for (std::size_t i = 0; i < 2; ++i) {
      const double a = x[2 * i], b = x[2 * i + 1], length = std::hypot(a, b);
      if (!has_foot(length, size)) return false;
      nearest_axis = std::min(nearest_axis, length);
      point[2 * i] = radius_[i] * (a / length);
      point[2 * i + 1] = radius_[i] * (b / length);
      frame[i * d + 2 * i] = -b / length;
      frame[i * d + 2 * i + 1] = a / length;
      frame[(i + 2) * d + 2 * i] = a / length;
      frame[(i + 2) * d + 2 * i + 1] = b / length;
    }
    for (std::size_t i = 4; i < d; ++i) frame[i * d + i] = 1;
    errors = rounding(std::max(radius_[0], radius_[1]), size, nearest_axis);
    return true;
  }
  FootPromise promise() const override { return kPromise; }
  std::optional<Bending> bending() const override {
    const double reach = std::min(radius_[0], radius_[1]);
    return Bending{reach, reach, Bending::Source::kProven};
  }
  bool is_connected() const override { return true; }
  std::vector<double> seed_points() const override {
    std::vector<double> seed(d_, 0.0);
    seed[0] = radius_[0];
    seed[2] = radius_[1];
    return seed;
  }

 private:
  int d_;
  double radius_[2];
};

/// Squares of lengths are taken: they must neither overflow nor vanish.
bool is_length(double value) { return value > 1e-150 && value < 1e150; }

}  // namespace

Submanifold sphere(int intrinsic_dim, int ambient_dim, double radius) {
  require(intrinsic_dim >= 1 && intrinsic_dim < ambient_dim,
          "sphere: 1 <= intrinsic_dim < ambient_dim is needed, not " + std::to_string(intrinsic_dim) + " and " +
              std::to_string(ambient_dim));
  require(is_length(radius), "sphere: radius must be positive (between 1e-150 and 1e150)");
  return Submanifold(std::make_shared<Sphere>(intrinsic_dim, ambient_dim, radius));
}

Submanifold torus_of_revolution(double R, double r) {
  require(is_length(r) && is_length(R) && R - r > kMedial * R, "torus_of_revolution: 0 < r < R is needed");
  return Submanifold(std::make_shared<TorusOfRevolution>(R, r));
}

Submanifold flat_torus(int ambient_dim, double r1, double r2) {
  require(ambient_dim >= 4, "flat_torus: ambient_dim must be at least 4, not " + std::to_string(ambient_dim));
  require(is_length(r1) && is_length(r2), "flat_torus: r1 and r2 must be positive (between 1e-150 and 1e150)");
  return Submanifold(std::make_shared<FlatTorus>(ambient_dim, r1, r2));
}

}  // namespace whitney::closed_form
