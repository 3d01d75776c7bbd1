// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <coxeter/base/matrix.h>

namespace whitney::coxeter {

// Where a triangulation stands in R^d, by chance: from a fixed generator, so that a seed gives the same on every
// platform, up to the rounding of log, sin and cos. The two draw from different streams: neither depends on whether the
// other was asked for.

/// A rotation matrix, d x d, uniform on SO(d). Throws InvalidInput unless ambient_dim >= 1.
Matrix random_rotation(int ambient_dim, std::uint64_t rng_seed);

/// A shift, uniform over the parallelepiped that the columns of `linear` (d x d) span: a cell of the lattice.
std::vector<double> random_offset(const Matrix& linear, std::uint64_t rng_seed);

}  // namespace whitney::coxeter
