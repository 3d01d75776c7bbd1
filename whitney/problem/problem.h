// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <coxeter/triangulation.h>
#include <whitney/atlas/chart_atlas.h>
#include <whitney/functions/domain.h>
#include <whitney/functions/function.h>
#include <whitney/manifolds/submanifold.h>

namespace whitney {

/// The ambient triangulation as a problem asks for it. A missing key of a problem file takes the default given here.
struct TriangulationSpec {
  enum class Type { kCoxeter, kFreudenthal };
  enum class Rotation { kNone, kRandom };
  enum class Offset { kZero, kRandom, kGiven };

  Type type = Type::kCoxeter;
  std::optional<double> edge_length{};  ///< longest edge of a d-simplex, > 0
  Rotation rotation = Rotation::kNone;
  Offset offset = Offset::kRandom;
  std::vector<double> given_offset{};  ///< d, with Offset::kGiven
  std::uint64_t rng_seed = 1;
};

/// The box with these sides (lower, upper); nothing for an empty list.
std::optional<Box> to_box(const std::vector<std::array<double, 2>>& sides);

/// What is to be triangulated. A problem file says the same in JSON (io/read_problem.h).
struct Problem {
  enum class Source { kEquations, kNamed, kParametrization, kCharts };

  Source source = Source::kEquations;
  std::vector<std::string> variables{};         ///< d names; where the file gives none: x1 .. xd
  std::optional<Function> function{};           ///< f: R^d -> R^k; kEquations, and kNamed where f is known
  std::optional<Function> inequalities{};       ///< g: R^d -> R^m, the domain is g >= 0
  std::vector<std::string> inequality_texts{};  ///< m, as they were written
  /// The closest-point oracle: kParametrization, and kNamed where it is known. With `reach`, where it is given.
  std::optional<Submanifold> submanifold{};
  /// Charts to be traced one by one and glued: kCharts, from "charts" or "projective". Then it alone has equations,
  /// boxes and seed points; those of the problem are empty.
  std::optional<ChartAtlas> atlas{};
  std::vector<std::array<double, 2>> box{};        ///< d x (lower, upper), or empty: none was given, and none is known
  std::vector<std::vector<double>> seed_points{};  ///< m x d; empty: to be searched for
  std::optional<double> reach{};                   ///< what the caller can prove, a length > 0
  TriangulationSpec triangulation{};

  int ambient_dim() const {
    return atlas ? atlas->ambient_dim() : function ? function->ambient_dim() : submanifold->ambient_dim();
  }
  int codim() const { return atlas ? atlas->codim() : function ? function->codim() : submanifold->codim(); }
  /// `box`, or nothing when it is empty.
  std::optional<Box> bounding_box() const { return to_box(box); }
};

/// The submanifold of a problem, with its reach if that is given: problem.submanifold, or else f = 0 as an implicit
/// manifold (whose foot is a local one), from the problem's seed points or, without them, from points found in the box.
/// Throws InvalidInput when there are neither, or none is found, where the equations leave no dimension, and for
/// charts, which have no closest points.
Submanifold submanifold_of(const Problem& problem);

/// The triangulation of R^d: type and edge_length (> 0, takes the place of spec.edge_length), rotated, then shifted by
/// b: zero, given, or uniform over a cell of the lattice. The random choices depend on rng_seed and d only, on every
/// platform (up to the rounding of log, sin and cos). Throws InvalidInput on an impossible dimension, edge length or
/// size of the given offset.
coxeter::Triangulation make_triangulation(const TriangulationSpec& spec, int ambient_dim, double edge_length);

}  // namespace whitney
