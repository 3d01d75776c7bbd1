// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <whitney/functions/function.h>
#include <whitney/manifolds/submanifold.h>

namespace whitney {

/// What theory says of a closed manifold.
struct ExpectedTopology {
  std::int64_t euler_characteristic = 0;
  bool orientable = true;
  std::size_t components = 1;
  /// H_0 .. H_n with integer coefficients, as to_string(HomologyGroup) writes them ("Z^2", "Z + Z/2", "0"); empty when
  /// nobody has filled it in.
  std::vector<std::string> homology;
};

/// A manifold with a name: by its equations, by its closest points, or both (then the same set of points).
struct KnownManifold {
  std::optional<Function> function;          ///< f: R^d -> R^k, the manifold is f = 0 (see functions/zero_sets.h)
  std::optional<Submanifold> submanifold;    ///< its closest points
  std::vector<double> point;                 ///< d: one point of it, up to rounding
  std::vector<std::array<double, 2>> box;    ///< d x (lower, upper): holds it; empty when there are no equations
  std::optional<ExpectedTopology> topology;  ///< empty where it was found by computing, not by theory
};

/// The one registry of named manifolds. parameters: those not given take the defaults of known_manifolds().
/// Throws InvalidInput on an unknown name or parameter (the message lists the known ones) and values out of range.
KnownManifold known_manifold(std::string_view name, const std::map<std::string, double>& parameters = {});

/// What can be asked for.
struct KnownName {
  std::string name;
  std::vector<std::pair<std::string, double>> parameters;  ///< with defaults; 0 for ambient_dim: intrinsic_dim + 1
  bool has_function = false, has_submanifold = false;
  std::string description;  ///< one line
};

/// All names, sorted.
std::vector<KnownName> known_manifolds();

/// The submanifold of a problem file: its name and values for its parameters; those not given take these defaults.
///   flat_torus                   ambient_dim 4, r1 1, r2 1      closed_form::flat_torus
///   grassmann                    p 2, q 4                       grassmann
///   klein_bottle                                                klein_bottle
///   projective_plane                                            projective_plane
///   projective_plane_projectors                                 projective_plane_projectors
///   so3_matrices                                                so3_matrices
///   so3_vectors                                                 stiefel(2, 3)
///   special_orthogonal           q 3                            special_orthogonal
///   sphere                       intrinsic_dim 2, ambient_dim intrinsic_dim + 1, radius 1     closed_form::sphere
///   stiefel                      p 2, q 3                       stiefel
///   torus_of_revolution          R 2, r 1                       closed_form::torus_of_revolution
/// Names that named_manifold knows too mean the same set of points.
/// Throws InvalidInput on an unknown name or parameter (the message lists the known ones) and values out of range.
Submanifold named_submanifold(std::string_view name, const std::map<std::string, double>& parameters = {});

/// The names that named_submanifold knows, sorted.
std::vector<std::string> submanifold_names();

}  // namespace whitney
