// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include <CGAL/Interval_nt.h>

// The one place for intervals and directed rounding. Internal: it wraps CGAL, so no installed header includes it, and a
// .cc file that does is compiled with -frounding-math (see CMakeLists.txt).
static_assert(std::numeric_limits<double>::is_iec559, "interval arithmetic needs IEEE 754 doubles");
#ifdef __FAST_MATH__
#error "interval arithmetic cannot be compiled with -ffast-math"
#endif

namespace whitney::perturbation {

/// [inf, sup]; sums, products, quotients and roots are rounded outward, provided that a Rounding is alive. Comparisons
/// of intervals throw when they are undecided: compare inf() and sup() instead.
using Interval = CGAL::Interval_nt<false>;

/// What is wrong with the arithmetic of this thread as it stands, in one clause, when it is used for intervals; empty
/// when nothing is, as it must be while a Rounding is alive.
std::string rounding_defect();

/// Throws Error unless rounding_defect() is empty; looks the first time only.
void require_directed_rounding();

/// While one is alive, this thread rounds upward, which is what Interval needs. Floating-point guesses (inverses,
/// directions) belong before it. Throws Error when the machine or the compiler does not round as told.
class Rounding {
 public:
  Rounding() { require_directed_rounding(); }
  Rounding(const Rounding&) = delete;
  Rounding& operator=(const Rounding&) = delete;

 private:
  Interval::Protector upward_;
};

/// The largest absolute value in x.
inline double above(const Interval& x) { return std::max(std::abs(x.inf()), std::abs(x.sup())); }

/// [-r, r], r >= 0.
inline Interval ball(double r) { return {-r, r}; }

/// An upper bound of the distance of the points x and y.
double distance_above(std::span<const double> x, std::span<const double> y);
/// A lower bound of it.
double distance_below(std::span<const double> x, std::span<const double> y);

/// An upper bound of the spectral norm of every matrix in A (rows x cols, row-major); infinite when that would be
/// beyond 1e75.
double norm_above(std::span<const Interval> A, int rows, int cols);

}  // namespace whitney::perturbation
