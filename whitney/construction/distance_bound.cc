// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/distance_bound.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace whitney {
namespace {

/// For the roundings of the sums, products and roots below, as a factor of the result.
constexpr double kOutward = 1 + 1e-12;

}  // namespace

std::optional<double> distance_from_manifold(std::span<const double> points, int ambient_dim, int intrinsic_dim,
                                             const perturbation::FootView& foot, const Bending& bending) {
  const std::size_t d = ambient_dim, n = intrinsic_dim;
  double tangential = 0, normal = 0, farthest = 0;
  for (std::size_t i = 0; i + d <= points.size(); i += d) {
    double along = 0, off = 0;
    for (std::size_t row = 0; row < d; ++row) {
      double sum = 0;
      for (std::size_t c = 0; c < d; ++c) sum += foot.frame[row * d + c] * (points[i + c] - foot.point[c]);
      (row < n ? along : off) += sum * sum;
    }
    if (!std::isfinite(along + off)) return std::nullopt;
    tangential = std::max(tangential, along);
    normal = std::max(normal, off);
    farthest = std::max(farthest, along + off);
  }
  // What the frame lacks of orthonormality, and the rounding of the products, count as a turn.
  const double turn = foot.errors.angle + 16 * static_cast<double>(d) * std::numeric_limits<double>::epsilon();
  const double error = foot.errors.point + turn * std::sqrt(farthest);
  const double rho = (std::sqrt(tangential) + error) * kOutward;
  if (!(rho < bending.reach)) return std::nullopt;
  const double radius = std::max(bending.reach, bending.curvature_radius);
  // (radius - rho) (radius + rho): what the root loses where rho is close to the radius is in its first factor.
  const double off_plane = rho * rho / (radius + std::sqrt((radius - rho) * (radius + rho)));
  return (std::sqrt(normal) + error + off_plane) * kOutward;
}

std::optional<double> hausdorff_bound(double distance_bound, double longest_edge, double reach) {
  const bool stays_in_the_tube = (distance_bound + longest_edge) / 2 * kOutward < reach && distance_bound < reach;
  return stays_in_the_tube ? std::optional(distance_bound) : std::nullopt;
}

}  // namespace whitney
