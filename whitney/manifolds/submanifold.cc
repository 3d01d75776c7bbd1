// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/submanifold.h>

#include <cmath>
#include <cstddef>

#include <coxeter/base/error.h>
#include <coxeter/base/text.h>

namespace whitney {
namespace {

class WithBending : public Submanifold::Model {
 public:
  WithBending(Submanifold manifold, Bending bending) : manifold_(std::move(manifold)), bending_(bending) {}

  int ambient_dim() const override { return manifold_.ambient_dim(); }
  int intrinsic_dim() const override { return manifold_.intrinsic_dim(); }
  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
               FootErrors& errors) const override {
    return manifold_.project(x, point, frame, errors);
  }
  FootPromise promise() const override { return manifold_.promise(); }
  std::optional<Bending> bending() const override { return bending_; }
  std::vector<double> seed_points() const override { return manifold_.seed_points(); }
  bool is_connected() const override { return manifold_.is_connected(); }

 private:
  Submanifold manifold_;
  Bending bending_;
};

bool all_finite(std::span<const double> values) {
  double sum = 0;  // NaN or infinite as soon as one of them is: 0 * x
  for (const double value : values) sum += 0 * value;
  return sum == 0;
}

double dot(const double* a, const double* b, std::size_t d) {
  double sum = 0;
  for (std::size_t c = 0; c < d; ++c) sum += a[c] * b[c];
  return sum;
}

/// Takes the components along the `count` orthonormal rows of `rows` off `row`, twice; returns what is left of its
/// length, as a fraction.
double orthogonalise(const double* rows, std::size_t count, double* row, std::size_t d) {
  const double before = std::sqrt(dot(row, row, d));
  if (!(before > 0)) return 0;
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t i = 0; i < count; ++i) {
      const double along = dot(rows + i * d, row, d);
      for (std::size_t c = 0; c < d; ++c) row[c] -= along * rows[i * d + c];
    }
  }
  const double after = std::sqrt(dot(row, row, d));
  if (after > 0)
    for (std::size_t c = 0; c < d; ++c) row[c] /= after;
  return after / before;
}

}  // namespace

bool Submanifold::project(std::span<const double> x, std::span<double> point, std::span<double> frame,
                          FootErrors& errors) const {
  const auto d = static_cast<std::size_t>(ambient_dim());
  if (x.size() != d || point.size() != d || frame.size() != d * d)
    throw InvalidInput("project: x and point must have " + std::to_string(d) + " entries, frame " +
                       std::to_string(d * d));
  if (!model_->project(x, point, frame, errors)) return false;
  if (!all_finite(point) || !all_finite(frame) || !(errors.point >= 0) || !(errors.angle >= 0)) {
    throw OracleError("the closest-point oracle returned values that are not finite at x = " + text(x));
  }
  return true;
}

Submanifold with_bending(Submanifold manifold, Bending bending) {
  if (!(bending.reach > 0) || !std::isfinite(bending.reach)) throw InvalidInput("reach must be positive and finite");
  if (bending.curvature_radius == 0) bending.curvature_radius = bending.reach;
  if (!(bending.curvature_radius >= bending.reach) || !std::isfinite(bending.curvature_radius))
    throw InvalidInput("curvature_radius must be at least reach, and finite");
  return Submanifold(std::make_shared<WithBending>(std::move(manifold), bending));
}

bool complete_frame(std::span<double> frame, int ambient_dim, int num_given) {
  const auto d = static_cast<std::size_t>(ambient_dim);
  if (frame.size() != d * d || num_given < 0 || num_given > ambient_dim)
    throw InvalidInput("complete_frame: frame must be d x d and 0 <= num_given <= d");
  const auto given = static_cast<std::size_t>(num_given);
  for (std::size_t i = 0; i < given; ++i)
    if (!(orthogonalise(frame.data(), i, &frame[i * d], d) > 1e-12)) return false;
  // Each further row is the unit vector e_c that the rows so far cover least.
  for (std::size_t i = given; i < d; ++i) {
    std::size_t best = 0;
    double least = 2;
    for (std::size_t c = 0; c < d; ++c) {
      double covered = 0;
      for (std::size_t j = 0; j < i; ++j) covered += frame[j * d + c] * frame[j * d + c];
      if (covered < least) {
        least = covered;
        best = c;
      }
    }
    for (std::size_t c = 0; c < d; ++c) frame[i * d + c] = c == best ? 1 : 0;
    if (!(orthogonalise(frame.data(), i, &frame[i * d], d) > 0)) return false;
  }
  return true;
}

}  // namespace whitney
