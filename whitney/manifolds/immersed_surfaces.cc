// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/immersed_surfaces.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <whitney/manifolds/parametric_manifold.h>

namespace whitney {
namespace {

/// The parameters are the unit vectors of R^3; antipodal ones are the same point.
class ProjectivePlane : public Parametrization {
 public:
  int ambient_dim() const override { return 4; }
  int intrinsic_dim() const override { return 2; }
  int parameter_size() const override { return 3; }
  void evaluate(std::span<const double> u, std::span<double> x) const override {
    x[0] = u[0] * u[1];
    x[1] = u[0] * u[2];
    x[2] = (u[1] - u[2]) * (u[1] + u[2]);
    x[3] = 2 * u[1] * u[2];
  }
  void derivative(std::span<const double> u, std::span<double> jacobian) const override {
    const double full[4][3] = {{u[1], u[0], 0}, {u[2], 0, u[0]}, {0, 2 * u[1], -2 * u[2]}, {0, 2 * u[2], 2 * u[1]}};
    double axes[2][3];
    tangent_axes(u, axes);
    for (int c = 0; c < 4; ++c)
      for (int i = 0; i < 2; ++i)
        jacobian[c * 2 + i] = full[c][0] * axes[i][0] + full[c][1] * axes[i][1] + full[c][2] * axes[i][2];
  }
  void move(std::span<const double> u, std::span<const double> t, std::span<double> moved) const override {
    double axes[2][3];
    tangent_axes(u, axes);
    double squared = 0;
    for (int c = 0; c < 3; ++c) {
      moved[c] = u[c] + t[0] * axes[0][c] + t[1] * axes[1][c];
      squared += moved[c] * moved[c];
    }
    for (double& c : moved) c /= std::sqrt(squared);
  }
  double scale(int) const override { return 1; }
  std::vector<double> samples(double spacing, std::size_t max_samples) const override {
    // A Fibonacci lattice on the half x >= 0. The map stretches lengths by at most 2.
    const double wanted = std::isfinite(spacing) ? 2 * std::numbers::pi * 4 / (spacing * spacing) : 60;
    const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
    const auto count = static_cast<std::size_t>(std::clamp(wanted, 20.0, static_cast<double>(max_samples)));
    std::vector<double> parameters;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(count), rho = std::sqrt(1 - x * x);
      const double angle = golden_angle * static_cast<double>(i);
      parameters.insert(parameters.end(), {x, rho * std::cos(angle), rho * std::sin(angle)});
    }
    return parameters;
  }

 private:
  /// Two columns of the reflection that takes the first axis to u, or to its opposite.
  static void tangent_axes(std::span<const double> u, double axes[2][3]) {
    const double sign = u[0] < 0 ? -1 : 1, factor = 1 / (1 + std::abs(u[0]));
    for (int i = 0; i < 2; ++i) {
      axes[i][0] = -sign * u[i + 1];
      for (int c = 1; c < 3; ++c) axes[i][c] = (c == i + 1 ? 1 : 0) - factor * u[c] * u[i + 1];
    }
  }
};

}  // namespace

Submanifold klein_bottle() {
  constexpr double kTurn = 2 * std::numbers::pi;
  const auto map = [](std::span<const double> u, std::span<double> x) {
    const double rho = 2 + std::cos(u[1]), height = std::sin(u[1]);
    x[0] = rho * std::cos(u[0]);
    x[1] = rho * std::sin(u[0]);
    x[2] = height * std::cos(u[0] / 2);
    x[3] = height * std::sin(u[0] / 2);
  };
  const auto derivative = [](std::span<const double> u, std::span<double> J) {
    const double cos_u = std::cos(u[0]), sin_u = std::sin(u[0]), cos_half = std::cos(u[0] / 2),
                 sin_half = std::sin(u[0] / 2), cos_v = std::cos(u[1]), sin_v = std::sin(u[1]);
    J[0] = -(2 + cos_v) * sin_u;
    J[1] = -sin_v * cos_u;
    J[2] = (2 + cos_v) * cos_u;
    J[3] = -sin_v * sin_u;
    J[4] = -sin_v * sin_half / 2;
    J[5] = cos_v * cos_half;
    J[6] = sin_v * cos_half / 2;
    J[7] = cos_v * sin_half;
  };
  return with_bending(parametric_manifold(4, {{0, kTurn}, {0, kTurn}}, map, derivative),
                      {1, 1, Bending::Source::kEstimated});
}

Submanifold projective_plane() {
  return with_bending(parametric_manifold(std::make_shared<ProjectivePlane>()),
                      {0.5, 0.5, Bending::Source::kEstimated});
}

}  // namespace whitney
