// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <whitney/manifolds/submanifold.h>

namespace whitney {

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
