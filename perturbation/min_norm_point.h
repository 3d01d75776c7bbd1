// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace whitney::perturbation {

/// The point of least norm in the convex hull of m points of R^k. Keeps its scratch memory between calls; one object
/// per thread.
///
/// m = 1, 2: closed forms. Otherwise Wolfe's algorithm on the Gram matrix: P. Wolfe, Finding the nearest point in a
/// polytope, Math. Programming 11 (1976). In floating point; whoever needs a proof verifies the direction it returns.
class MinNormPoint {
 public:
  /// points: m of them, k numbers each. Writes the barycentric coordinates (m, nonnegative, sum 1) of the point of least
  /// norm x and x itself (k); returns abs(x)^2. m >= 1, k >= 1.
  double operator()(const double* const* points, int m, int k, double* lambda, double* x);

 private:
  double wolfe(const double* const* points, int m, int k, double* lambda, double* x);

  std::vector<double> gram_, factor_, weights_, solution_;
  std::vector<int> active_;
};

}  // namespace whitney::perturbation
