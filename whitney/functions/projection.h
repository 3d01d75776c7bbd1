// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <coxeter/base/matrix.h>

namespace whitney {

/// An affine map of R^d to R^3, and one more coordinate for what R^3 cannot show: x -> A (x - center).
struct Projection {
  /// 4 x d, rows orthonormal (zero rows where d has none left): three rows for x, y, z, and the `depth`, a direction
  /// that the picture loses. Where a projected surface runs through itself, the two sheets differ in depth.
  Matrix A;
  std::vector<double> center;  ///< d
};

/// The coordinates `variables[0..2]` (counted from 0) as x, y, z, unmoved; depth is the first variable left over. Where
/// d < 3, entries >= d give 0. Throws InvalidInput if one is negative, repeated, or too large.
Projection coordinate_projection(int ambient_dim, std::array<int, 3> variables);

/// Principal components of the points (m x d): x has the largest variance, then y, z, depth; the centroid goes to 0.
///
/// Deterministic, and stable where variances nearly coincide (as they do on a flat torus): directions whose variances
/// are within 1 % of the largest variance of one another span a subspace, in which the basis is a fixed one in general
/// position. Each direction points to where its largest entry is positive. (1 % is a heuristic: it
/// chooses a view and nothing depends on it.) Needs d >= 1, m >= 1, else InvalidInput.
Projection principal_projection(std::span<const double> points, int ambient_dim);

/// The projection a user asks for by text: "pca", or "i,j,k" where each entry is a variable's name, or its number
/// counted from 1. "pca" leaves R^d, d <= 3, as it is: there is nothing to lose. `variables` may be empty, or has d
/// names. Throws InvalidInput naming the entry that is not a variable.
Projection make_projection(std::string_view text, std::span<const double> points, int ambient_dim,
                           std::span<const std::string> variables = {});

/// x, y, z and depth of every point (m x d): the result is m x 4.
std::vector<double> project(const Projection& projection, std::span<const double> points);

}  // namespace whitney
