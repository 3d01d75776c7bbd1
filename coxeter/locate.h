// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include <coxeter/simplex.h>
#include <coxeter/triangulation.h>

namespace whitney::coxeter {

// Point location. With z the lattice coordinates of a point, the base vertex is floor(z) and the parts are the
// coordinates with equal fractional part, the largest first; the last part holds element d and the coordinates without
// fractional part. Fractional parts are compared exactly, without the rounding of z - floor(z). So the answer is exact
// for z as given; where z itself is computed from x, it carries that rounding. Source: SoCG 2021, Sect. 2.

/// The smallest simplex that contains the point with these lattice coordinates: the one whose relative interior holds
/// it. O(d log d). Throws InvalidInput when a coordinate is not finite, LatticeOverflow when it leaves the range of
/// int32.
Simplex locate_lattice(std::span<const double> lattice_coordinates);

/// locate_lattice of triangulation.lattice_coordinates(x); x: d. Throws InvalidInput when x has the wrong size or is
/// not finite, LatticeOverflow when it is too far away.
Simplex locate(const Triangulation& triangulation, std::span<const double> x);

/// A d-simplex that contains the point, always the same one: among equal fractional parts the smaller coordinate index
/// comes first. The result of locate is a face of it. Throws as the functions above.
Simplex locate_full_lattice(std::span<const double> lattice_coordinates);
Simplex locate_full(const Triangulation& triangulation, std::span<const double> x);

}  // namespace whitney::coxeter
