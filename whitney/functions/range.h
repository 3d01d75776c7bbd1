// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "Range needs IEEE arithmetic: no -ffast-math"
#endif
static_assert(FLT_EVAL_METHOD == 0, "Range needs double arithmetic without excess precision");

namespace whitney {

/// A closed interval of reals [lo, hi], rounded outward: an operation on Ranges holds every value of the operation on
/// reals taken from them. lo < inf and hi > -inf always; "everything" is [-inf, inf]; never NaN. A function that is not
/// defined, or not smooth where a derivative is asked for, on all of its argument gives everything.
///
/// The rounding mode stays at "to nearest", so nothing is switched, threads need no care and the compiler may move and
/// fuse as it likes: x = fl(r) for a real r lies strictly between the neighbors of x, and up(x) is at least the upper
/// one. **Proof.** For normal x, ulp(x) <= 2^-52 |x|, and ulp(x) is a double, so fl(2^-52 |x| + eta) >= ulp(x) with eta
/// = 2^-1074, fused or not; for subnormal x it is at least eta = ulp(x). Rounding is monotone: fl(x + s) >= fl(x +
/// ulp(x)) >= the neighbor. Where a product r = a b is fused into the addition, fl(r + s) >= fl(r) = x, enough when
/// r <= x; when r > x, r + s > x + ulp(x), so fl(r + s) is at least the neighbor, which is above r. [] An overflow to
/// the wrong side is put back to the largest double.
///
/// Why not CGAL's: it switches the rounding mode, and it has no exp, log, sin. The functions here are Taylor series run
/// in this arithmetic itself with their remainders as intervals, so that they need no bound on anybody's libm.
struct Range {
  double lo = 0, hi = 0;

  Range() = default;
  explicit Range(double a) : Range(a, a) {}
  Range(double a, double b) : lo(a), hi(b) {
    if (!(a <= b && a < std::numeric_limits<double>::infinity() && b > -std::numeric_limits<double>::infinity())) {
      lo = -std::numeric_limits<double>::infinity();
      hi = -lo;
    }
  }

  static Range everything() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }

  bool contains(double a) const { return lo <= a && a <= hi; }
  bool is_bounded() const { return lo >= -DBL_MAX && hi <= DBL_MAX; }
  bool is_zero() const { return lo == 0 && hi == 0; }
  /// A point near the middle, any double if the range is not bounded.
  double mid() const { return 0.5 * lo + 0.5 * hi; }
  double mag() const { return std::max(std::fabs(lo), std::fabs(hi)); }
};

namespace outward {
inline constexpr double kUlp = 0x1p-52, kEta = 0x1p-1074;
/// At least the upper neighbor of x = fl(r); of -inf, which an overflow made, the least double.
inline double up(double x) { return x >= -DBL_MAX ? x + (std::fabs(x) * kUlp + kEta) : x != x ? x : -DBL_MAX; }
inline double down(double x) { return x <= DBL_MAX ? x - (std::fabs(x) * kUlp + kEta) : x != x ? x : DBL_MAX; }
}  // namespace outward

/// Every y in a has |y - m| <= radius(a, m).
inline double radius(const Range& a, double m) { return outward::up(std::max(a.hi - m, m - a.lo)); }
inline Range hull(const Range& a, const Range& b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }

inline Range operator+(const Range& a, const Range& b) {
  return {outward::down(a.lo + b.lo), outward::up(a.hi + b.hi)};
}
inline Range operator-(const Range& a, const Range& b) {
  return {outward::down(a.lo - b.hi), outward::up(a.hi - b.lo)};
}
inline Range operator-(const Range& a) { return {-a.hi, -a.lo}; }
inline Range operator*(const Range& a, const Range& b) {
  const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  const double low = std::min(std::min(p, q), std::min(r, s)), high = std::max(std::max(p, q), std::max(r, s));
  // 0 times an infinite bound is NaN, and min and max may drop it: 0 is then among the others, or nothing is.
  if (p != p || q != q || r != r || s != s) return Range::everything();
  return {outward::down(low), outward::up(high)};
}
/// c a for a finite c; exact zero where one of them is zero and the other one bounded.
inline Range operator*(double c, const Range& a) {
  const double p = c * a.lo, q = c * a.hi;
  if (a.is_zero() || (c == 0 && a.is_bounded())) return {};
  return c >= 0 ? Range(outward::down(p), outward::up(q)) : Range(outward::down(q), outward::up(p));
}
Range operator/(const Range& a, const Range& b);

Range sqr(const Range& a);
/// a^n, any n; everything when n < 0 and 0 is in a.
Range pow(const Range& a, int n);
/// exp(b log a): everything unless a > 0.
Range pow(const Range& a, const Range& b);
Range sqrt(const Range& a);
Range exp(const Range& a);
Range log(const Range& a);
Range sin(const Range& a);
Range cos(const Range& a);
Range tan(const Range& a);
Range asin(const Range& a);
Range acos(const Range& a);
Range atan(const Range& a);
Range sinh(const Range& a);
Range cosh(const Range& a);
Range tanh(const Range& a);
Range abs(const Range& a);

/// Whether arithmetic of this thread is what Range rests on: to nearest, with subnormal numbers. Asked once per
/// certificate, as a library may have changed it.
bool rounds_to_nearest();

/// pi.
Range pi_range();

}  // namespace whitney
