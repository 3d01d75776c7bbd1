// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include <coxeter/base/matrix.h>
#include <whitney/manifolds/submanifold.h>

namespace whitney {

// New submanifolds from old ones: the foot, frame, seed points, bending and errors are carried over exactly, up to
// rounding, which is added to the errors. Every function throws InvalidInput on a size that does not fit or a number
// that is not finite. (The namesakes for zero sets: combinators.h.)

/// M x N in R^(d+e). Reach and curvature radius are the smaller ones: distances from M x N add by squares, and so do
/// the second fundamental forms, each on its own factor. The source of the bending is the weaker one.
Submanifold product(Submanifold M, Submanifold N);

/// M in R^ambient_dim, with zeros for the further coordinates. ambient_dim >= d.
Submanifold embed(Submanifold M, int ambient_dim);

/// Q M. Q: d x d, orthogonal up to 1e-9 in each entry of Q^T Q (a reflection is allowed); what is applied is the
/// orthonormal matrix that Gram and Schmidt make of its rows.
Submanifold rotate(Submanifold M, const Matrix& Q);

/// M + b. b: d.
Submanifold translate(Submanifold M, std::span<const double> b);

/// s M, s > 0: lengths times s; reach and curvature radius too, rounded down.
Submanifold scale(Submanifold M, double s);

}  // namespace whitney
