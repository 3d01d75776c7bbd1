// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <whitney/tracing/barycentric_kernel.h>

namespace whitney {

/// The point in which one K-simplex meets the zero set of the interpolant of a map F: R^d -> R^K, and every decision
/// about it: in floating point with a proof, in exact arithmetic where that fails. The target of F is (eps, .., eps^K)
/// as in exact_pivot.h.
///
/// For one simplex at a time; the tracer's main loop takes several at once (BarycentricKernel itself).
class CrossingPoint {
 public:
  explicit CrossingPoint(int codim);

  /// The simplex: F(v_0), .., F(v_K), pointers to K finite doubles each, which stay as they are until the next call.
  void load(std::span<const double* const> columns);

  /// Whether the simplex meets the zero set. What follows is for simplices that do.
  bool hit();
  /// The same where floating point decides it, else nothing.
  std::optional<bool> quick_hit() const;
  /// The vertex (its number) to be replaced by a further vertex w of a cofacet, given F(w).
  int leaving(const double* w);
  /// Whether the interpolant of one more component, its values at v_0..v_K, is below its target at the point: see
  /// exactly_below for `position`.
  bool below(std::span<const double> component, int position);
  /// The barycentric coordinates of the point, eps = 0; K + 1 of them, >= 0, for a simplex that is hit.
  const std::vector<double>& weights();

  /// Decisions that were left to exact arithmetic so far.
  std::size_t exact_decisions() const { return exact_decisions_; }

 private:
  int codim_;
  std::vector<const double*> columns_;
  BarycentricKernel kernel_;
  std::vector<double> weights_;
  std::size_t exact_decisions_ = 0;
};

}  // namespace whitney
