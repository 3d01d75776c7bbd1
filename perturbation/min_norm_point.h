// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace whitney::perturbation {

/// The point of least norm in the convex hull of m points of R^k. Keeps its scratch memory between calls; one object
/// per thread.
///
/// m = 1, 2, 3: closed forms. Otherwise Wolfe's algorithm on the Gram matrix: P. Wolfe, Finding the nearest point in a
/// polytope, Math. Programming 11 (1976). In floating point; whoever needs a proof verifies the direction it returns.
class MinNormPoint {
 public:
  /// points: m of them, k numbers each. Writes the barycentric coordinates (m, nonnegative, sum 1) of the point of
  /// least norm x and x itself (k); returns abs(x). m >= 1, k >= 1.
  ///
  /// When it turns out that the distance is at least `enough`, the work stops: then lambda is not written, the result
  /// is a lower bound of the distance, at least `enough`, and x a direction that shows it: x . p_i >= enough abs(x) for
  /// all points p_i.
  double operator()(const double* const* points, int m, int k, double enough, double* lambda, double* x);

 private:
  double wolfe(const double* const* points, int m, int k, double enough, double* lambda, double* x);

  std::vector<double> gram_, factor_, weights_, solution_;
  std::vector<int> active_;
};

}  // namespace whitney::perturbation
