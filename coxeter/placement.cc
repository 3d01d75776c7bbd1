// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/placement.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>

#include <Eigen/LU>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>

namespace whitney::coxeter {
namespace {

/// Uniform on [0, 1), by its upper 53 bits: what the standard library's distributions make of them differs.
double uniform(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

}  // namespace

Matrix random_rotation(int ambient_dim, std::uint64_t rng_seed) {
  if (ambient_dim < 1) throw InvalidInput("ambient_dim must be at least 1, not " + std::to_string(ambient_dim));
  std::mt19937_64 generator(rng_seed);
  // Normal numbers by Box and Muller, then columns orthonormalised: uniform on O(d).
  Matrix Q(ambient_dim, ambient_dim);
  const std::size_t size = Q.entries().size();
  for (std::size_t i = 0; i < size; i += 2) {
    const double radius = std::sqrt(-2 * std::log(1 - uniform(generator)));
    const double angle = 2 * std::numbers::pi * uniform(generator);
    Q.data()[i] = radius * std::cos(angle);
    if (i + 1 < size) Q.data()[i + 1] = radius * std::sin(angle);
  }
  // Gram and Schmidt; one pass loses digits, two do not.
  for (int j = 0; j < ambient_dim; ++j) {
    for (int pass = 0; pass < 2; ++pass) {
      for (int i = 0; i < j; ++i) {
        double dot = 0;
        for (int l = 0; l < ambient_dim; ++l) dot += Q(l, i) * Q(l, j);
        for (int l = 0; l < ambient_dim; ++l) Q(l, j) -= dot * Q(l, i);
      }
      double squared = 0;
      for (int l = 0; l < ambient_dim; ++l) squared += Q(l, j) * Q(l, j);
      for (int l = 0; l < ambient_dim; ++l) Q(l, j) /= std::sqrt(squared);
    }
  }
  if (as_eigen(Q).partialPivLu().determinant() < 0)
    for (int l = 0; l < ambient_dim; ++l) Q(l, 0) = -Q(l, 0);
  return Q;
}

std::vector<double> random_offset(const Matrix& linear, std::uint64_t rng_seed) {
  constexpr std::uint64_t kStream = 0x9e3779b97f4a7c15;
  std::mt19937_64 generator(rng_seed ^ kStream);
  std::vector<double> offset(static_cast<std::size_t>(linear.rows()), 0.0);
  for (std::ptrdiff_t j = 0; j < linear.cols(); ++j) {
    const double u = uniform(generator);
    for (std::size_t i = 0; i < offset.size(); ++i) offset[i] += u * linear.col(j)[i];
  }
  return offset;
}

}  // namespace whitney::coxeter
