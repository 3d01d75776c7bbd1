// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/problem.h>

#include <algorithm>
#include <string>
#include <utility>

#include <coxeter/base/error.h>
#include <coxeter/placement.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/manifolds/implicit_manifold.h>

namespace whitney {
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

coxeter::Triangulation make_triangulation(const TriangulationSpec& spec, int ambient_dim, double edge_length) {
  coxeter::Triangulation result = spec.type == TriangulationSpec::Type::kCoxeter
                                      ? coxeter::coxeter_a(ambient_dim, edge_length)
                                      : coxeter::freudenthal(ambient_dim, edge_length);
  if (spec.rotation == TriangulationSpec::Rotation::kRandom) {
    const std::vector<double> no_shift(static_cast<std::size_t>(ambient_dim));
    result = result.transformed(coxeter::random_rotation(ambient_dim, spec.rng_seed), no_shift);
  }
  std::vector<double> offset(static_cast<std::size_t>(ambient_dim));
  if (spec.offset == TriangulationSpec::Offset::kGiven) {
    if (spec.given_offset.size() != offset.size()) {
      throw InvalidInput("offset: " + std::to_string(spec.given_offset.size()) +
                         " numbers instead of d = " + std::to_string(ambient_dim));
    }
    offset = spec.given_offset;
  } else if (spec.offset == TriangulationSpec::Offset::kRandom) {
    offset = coxeter::random_offset(result.linear(), spec.rng_seed);
  }
  return coxeter::Triangulation(result.linear(), std::move(offset));
}

}  // namespace whitney
