// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include <coxeter/base/matrix.h>
#include <whitney/functions/function.h>

namespace whitney {

// New isomanifolds from old ones. M is the zero set of f in R^d. Batches stay batches, exact Jacobians stay exact, and
// the value at a point does not depend on its batch when that of f does not. Every function throws InvalidInput on a
// size that does not fit or a number that is not finite.

/// M x N in R^(d+e): f on the first d coordinates, g on the last e; values (f, g).
Function product(Function f, Function g);

/// M in R^ambient_dim, with zeros for the further coordinates: values (f, x_(d), .., x_(ambient_dim-1)).
/// ambient_dim >= d.
Function embed(Function f, int ambient_dim);

/// Q M. Q: d x d, orthogonal up to 1e-9 in each entry of Q^T Q; a reflection is allowed.
Function rotate(Function f, const Matrix& Q);

/// M + b. b: d.
Function translate(Function f, std::span<const double> b);

/// s M, s > 0. The values of f are not scaled.
Function scale(Function f, double s);

/// M itself, from (c_0 f_0, .., c_(k-1) f_(k-1)). factors: k, not 0.
Function multiply_values(Function f, std::span<const double> factors);

/// The image of M under the map that makes coordinate i of a point coordinate permutation[i]. permutation: d.
Function permute_variables(Function f, std::span<const int> permutation);

}  // namespace whitney
