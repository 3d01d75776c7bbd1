// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace whitney::perturbation {

/// X = M^-1 for the k x k matrix M (row-major), in closed form for k <= 3, else by Gauss-Jordan elimination
/// with row pivoting; M is destroyed. False when the determinant or a pivot is zero.
bool invert(double* M, double* X, int k);

}  // namespace whitney::perturbation
