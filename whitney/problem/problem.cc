// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/problem.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include <Eigen/LU>

#include <coxeter/base/error.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/manifolds/implicit_manifold.h>

namespace whitney {
namespace {

/// Uniform in [0, 1) from one word, as the words are the same on every platform and the distributions of <random> are
/// not.
double uniform(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

}  // namespace

std::optional<Box> to_box(const std::vector<std::array<double, 2>>& sides) {
  if (sides.empty()) return std::nullopt;
  Box box;
  for (const auto& [lower, upper] : sides) {
    box.lower.push_back(lower);
    box.upper.push_back(upper);
  }
  return box;
}

Submanifold submanifold_of(const Problem& problem) {
  if (problem.submanifold) return *problem.submanifold;
  if (problem.atlas) throw InvalidInput("charts are traced and glued; a submanifold needs its closest points");
  std::vector<double> seeds;
  ImplicitManifoldOptions options;
  if (!problem.box.empty()) {
    options.length_scale = 0;
    for (const auto& [lower, upper] : problem.box)
      options.length_scale = std::max(options.length_scale, (upper - lower) / 4);
  }
  for (const auto& point : problem.seed_points) seeds.insert(seeds.end(), point.begin(), point.end());
  if (seeds.empty()) {
    if (problem.box.empty()) throw InvalidInput("give seed_points, or a box in which they can be searched for");
    seeds = find_seeds(*problem.function, *problem.bounding_box()).points;
    if (seeds.empty()) throw InvalidInput("no point of the manifold was found in the box");
  }
  Submanifold manifold = implicit_manifold(*problem.function, std::move(seeds), options);
  if (!problem.reach) return manifold;
  return with_bending(std::move(manifold), {*problem.reach, 0, Bending::Source::kCaller});
}

Eigen::MatrixXd random_rotation(int ambient_dim, std::uint64_t rng_seed) {
  if (ambient_dim < 1) throw InvalidInput("ambient_dim must be at least 1, not " + std::to_string(ambient_dim));
  std::mt19937_64 generator(rng_seed);
  // Normal numbers by Box and Muller, then columns orthonormalised: uniform on O(d).
  Eigen::MatrixXd Q(ambient_dim, ambient_dim);
  for (Eigen::Index i = 0; i < Q.size(); i += 2) {
    const double radius = std::sqrt(-2 * std::log(1 - uniform(generator)));
    const double angle = 2 * std::numbers::pi * uniform(generator);
    Q.data()[i] = radius * std::cos(angle);
    if (i + 1 < Q.size()) Q.data()[i + 1] = radius * std::sin(angle);
  }
  // Gram and Schmidt; one pass loses digits, two do not.
  for (Eigen::Index j = 0; j < Q.cols(); ++j) {
    for (int pass = 0; pass < 2; ++pass) {
      for (Eigen::Index i = 0; i < j; ++i) {
        double dot = 0;
        for (Eigen::Index l = 0; l < Q.rows(); ++l) dot += Q(l, i) * Q(l, j);
        for (Eigen::Index l = 0; l < Q.rows(); ++l) Q(l, j) -= dot * Q(l, i);
      }
      double squared = 0;
      for (Eigen::Index l = 0; l < Q.rows(); ++l) squared += Q(l, j) * Q(l, j);
      for (Eigen::Index l = 0; l < Q.rows(); ++l) Q(l, j) /= std::sqrt(squared);
    }
  }
  if (Q.partialPivLu().determinant() < 0) Q.col(0) = -Q.col(0);
  return Q;
}

coxeter::Triangulation make_triangulation(const TriangulationSpec& spec, int ambient_dim, double edge_length) {
  coxeter::Triangulation result = spec.type == TriangulationSpec::Type::kCoxeter
                                      ? coxeter::coxeter_a(ambient_dim, edge_length)
                                      : coxeter::freudenthal(ambient_dim, edge_length);
  if (spec.rotation == TriangulationSpec::Rotation::kRandom) {
    result = result.transformed(random_rotation(ambient_dim, spec.rng_seed), Eigen::VectorXd::Zero(ambient_dim));
  }
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(ambient_dim);
  if (spec.offset == TriangulationSpec::Offset::kGiven) {
    if (spec.given_offset.size() != static_cast<std::size_t>(ambient_dim)) {
      throw InvalidInput("offset: " + std::to_string(spec.given_offset.size()) +
                         " numbers instead of d = " + std::to_string(ambient_dim));
    }
    for (int i = 0; i < ambient_dim; ++i) offset[i] = spec.given_offset[i];
  } else if (spec.offset == TriangulationSpec::Offset::kRandom) {
    // Another stream than the rotation's, so that neither depends on whether the other was asked for.
    constexpr std::uint64_t kOffsetStream = 0x9e3779b97f4a7c15;
    std::mt19937_64 generator(spec.rng_seed ^ kOffsetStream);
    for (int j = 0; j < ambient_dim; ++j) {
      const double u = uniform(generator);
      for (int i = 0; i < ambient_dim; ++i) offset[i] += u * result.linear()(i, j);
    }
  }
  return coxeter::Triangulation(result.linear(), std::move(offset));
}

}  // namespace whitney
