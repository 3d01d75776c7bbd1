// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/range.h>

namespace whitney {
namespace {

using outward::down, outward::up;

// ln 2 and pi / 2 as a double with few digits, whose small multiples are exact, plus a remainder that is enclosed by
// the neighbors of its nearest double.
constexpr double kLn2 = 0x1.62e42feep-1, kLn2Rest = 0x1.a39ef35793c76p-33;
constexpr double kHalfPi = 0x1.921fb544p+0, kHalfPiRest = 0x1.0b4611a626331p-34;
Range neighbors(double x) { return {down(x), up(x)}; }

/// The largest argument of sin that is reduced; k below stays under 2^17.
constexpr double kLargestAngle = 1e5;

Range divide(const Range& a, double n) { return {down(a.lo / n), up(a.hi / n)}; }  // n > 0

Range exp_at(double x) {
  if (x > 700) return {1e304, std::numeric_limits<double>::infinity()};  // e^700 = 1.01e304
  if (x < -700) return {0, 1e-303};
  const double k = std::nearbyint(x / (kLn2 + kLn2Rest));
  const Range r = (Range(x) - Range(k * kLn2)) - k * neighbors(kLn2Rest);  // |k| <= 1010: k * kLn2 is exact
  if (!(r.mag() < 0.36)) return Range::everything();
  // Taylor to r^14 with Lagrange's remainder r^15 / 15! e^xi, e^xi in [.69, 1.44].
  Range p(0.69, 1.44);
  for (int n = 15; n >= 1; --n) p = Range(1) + divide(r * p, n);
  return {std::ldexp(p.lo, int(k)), std::ldexp(p.hi, int(k))};
}

/// x > 0, finite.
Range log_at(double x) {
  int k = 0;
  double m = std::frexp(x, &k);
  if (m < 0.70710678) {
    m *= 2;
    --k;
  }
  // log m = 2 artanh(s), the series s^(2i+1) / (2i+1) with a tail in [0, z^13 / (1 - z) / 27], z = s^2 < .03.
  const Range s = Range(m - 1) / (Range(m) + Range(1));  // m - 1 is exact
  const Range z = sqr(s);
  Range q(0, 1);
  for (int i = 12; i >= 0; --i) q = divide(Range(1), 2 * i + 1) + z * q;
  const Range log_m = 2.0 * (s * q);
  if (k == 0) return log_m;
  return (Range(k * kLn2) + k * neighbors(kLn2Rest)) + log_m;  // |k| <= 1074: k * kLn2 is exact
}

struct SinCos {
  Range sin, cos;
};

SinCos sin_cos_at(double x) {
  const Range all(-1, 1);
  if (!(std::fabs(x) <= kLargestAngle)) return {all, all};
  const double k = std::nearbyint(x / (kHalfPi + kHalfPiRest));
  const Range r = (Range(x) - Range(k * kHalfPi)) - k * neighbors(kHalfPiRest);  // kHalfPi has 33 bits, k at most 17
  if (!(r.mag() < 0.79)) return {all, all};
  // Alternating series with decreasing terms: a tail divided by its first term is in [0, 1].
  const Range z = sqr(r);
  Range s(0, 1), c(0, 1);
  for (int i = 10; i >= 1; --i) {
    s = Range(1) - divide(z * s, (2 * i) * (2 * i + 1));
    c = Range(1) - divide(z * c, (2 * i - 1) * (2 * i));
  }
  s = r * s;
  const int quadrant = static_cast<int>(static_cast<long>(k) & 3);
  const SinCos turned = quadrant == 0   ? SinCos{s, c}
                        : quadrant == 1 ? SinCos{c, -s}
                        : quadrant == 2 ? SinCos{-s, -c}
                                        : SinCos{-c, s};
  const auto clip = [](const Range& a) { return Range(std::max(a.lo, -1.0), std::min(a.hi, 1.0)); };
  return {clip(turned.sin), clip(turned.cos)};
}

/// 0 <= y <= 1, a thin range.
Range atan_unit(Range y) {
  const bool large = y.hi > 0.4143;
  if (large) y = (y - Range(1)) / (y + Range(1));
  const Range z = sqr(y);
  Range q(0, 1);
  for (int i = 24; i >= 0; --i) q = divide(Range(1), 2 * i + 1) - z * q;
  const Range a = y * q;
  return large ? 0.25 * pi_range() + a : a;
}

Range atan_at(double x) {
  const double t = std::fabs(x);
  const Range a = t > 1 ? 0.5 * pi_range() - atan_unit(Range(1) / Range(t)) : atan_unit(Range(t));
  return x < 0 ? -a : a;
}

/// -1 <= x <= 1.
Range asin_at(double x) {
  const double t = std::fabs(x);
  Range a = 0.5 * pi_range();
  if (t < 1) {
    const Range root = sqrt((Range(1) - Range(t)) * (Range(1) + Range(t)));
    // The angle of the point (root, t): the smaller one over the larger one keeps it in the unit range.
    a = t <= root.lo ? atan_unit(Range(t) / root) : a - atan_unit(root / Range(t));
  }
  return x < 0 ? -a : a;
}

Range sinh_at(double x) { return 0.5 * (exp_at(x) - exp_at(-x)); }
Range cosh_at(double x) { return 0.5 * (exp_at(x) + exp_at(-x)); }
Range tanh_at(double x) {
  const double t = std::fabs(x);
  if (t > 20) return x > 0 ? Range(1 - 0x1p-52, 1) : Range(-1, -1 + 0x1p-52);  // 1 - tanh 20 < 2 e^-40 < 2^-56
  const Range e = exp_at(2 * t), a = (e - Range(1)) / (e + Range(1));
  const Range clipped(std::max(a.lo, 0.0), std::min(a.hi, 1.0));
  return x < 0 ? -clipped : clipped;
}

/// The range of an increasing function, from enclosures at the ends; the ends may be infinite.
template <class F>
Range increasing(const Range& a, F at) {
  return {at(a.lo).lo, at(a.hi).hi};
}

/// Whether phase + period * m may be in a for an integer m; errors of the quotients are below 1e-10.
bool may_hold(const Range& a, double phase, double period) {
  return std::floor((a.hi - phase) / period + 1e-9) >= std::ceil((a.lo - phase) / period - 1e-9);
}

Range wave(const Range& a, double top, Range SinCos::*part) {
  if (!(a.lo >= -kLargestAngle && a.hi <= kLargestAngle && a.hi - a.lo < 6.28)) return {-1, 1};
  constexpr double kPi = 2 * (kHalfPi + kHalfPiRest);
  Range r = hull(sin_cos_at(a.lo).*part, sin_cos_at(a.hi).*part);
  if (may_hold(a, top, 2 * kPi)) r.hi = 1;
  if (may_hold(a, top + kPi, 2 * kPi)) r.lo = -1;
  return r;
}

}  // namespace

bool rounds_to_nearest() {
  const volatile double one = 1, half_ulp = 0x1p-53, small = 0x1p-1022, least = 0x1p-1074;
  const volatile double down = one + half_ulp, up = (one + 0x1p-52) + half_ulp, negative = -one - half_ulp;
  const volatile double subnormal = small * 0.5, doubled = least + least;
  return down == 1 && up == 1 + 0x1p-51 && negative == -1 && subnormal > 0 && doubled == 0x1p-1073;
}

Range pi_range() { return {0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1}; }

Range operator/(const Range& a, const Range& b) {
  if (b.lo <= 0 && b.hi >= 0) return Range::everything();
  const double p = a.lo / b.lo, q = a.lo / b.hi, r = a.hi / b.lo, s = a.hi / b.hi;
  if (p != p || q != q || r != r || s != s) return Range::everything();
  return {down(std::min(std::min(p, q), std::min(r, s))), up(std::max(std::max(p, q), std::max(r, s)))};
}

Range sqr(const Range& a) {
  const double p = a.lo * a.lo, q = a.hi * a.hi;
  if (a.lo <= 0 && a.hi >= 0) return {0, up(std::max(p, q))};
  return {std::max(0.0, down(std::min(p, q))), up(std::max(p, q))};
}

Range pow(const Range& a, int n) {
  if (n < 0) return n == std::numeric_limits<int>::min() ? Range::everything() : Range(1) / pow(a, -n);
  if (n == 0) return Range(1);
  if (n == 1) return a;
  if (n == 2) return sqr(a);
  const auto at = [n](double x) {
    Range base(x), result(1);
    for (int m = n; m > 0; m /= 2, base = m > 0 ? sqr(base) : base) {
      if (m % 2 != 0) result = result * base;
    }
    return result;
  };
  if (!a.is_bounded()) return Range::everything();
  if (n % 2 != 0) return increasing(a, at);
  if (a.lo >= 0) return {std::max(0.0, at(a.lo).lo), at(a.hi).hi};
  if (a.hi <= 0) return {std::max(0.0, at(a.hi).lo), at(a.lo).hi};
  return {0, std::max(at(a.lo).hi, at(a.hi).hi)};
}

Range pow(const Range& a, const Range& b) { return a.lo > 0 ? exp(b * log(a)) : Range::everything(); }

Range sqrt(const Range& a) {
  if (!(a.lo >= 0)) return Range::everything();
  return {std::max(0.0, down(std::sqrt(a.lo))), up(std::sqrt(a.hi))};
}

Range exp(const Range& a) {
  const Range r = increasing(a, exp_at);
  return {std::max(0.0, r.lo), r.hi};
}

Range log(const Range& a) {
  if (!(a.lo > 0)) return Range::everything();
  return {log_at(a.lo).lo, a.hi <= DBL_MAX ? log_at(a.hi).hi : a.hi};
}

Range sin(const Range& a) { return wave(a, kHalfPi + kHalfPiRest, &SinCos::sin); }
Range cos(const Range& a) { return wave(a, 0, &SinCos::cos); }

Range tan(const Range& a) {
  const Range c = cos(a);
  if (c.lo <= 0 && c.hi >= 0) return Range::everything();
  return increasing(a, [](double x) {
    const SinCos at = sin_cos_at(x);
    return at.sin / at.cos;
  });
}

Range asin(const Range& a) { return a.lo >= -1 && a.hi <= 1 ? increasing(a, asin_at) : Range::everything(); }
Range acos(const Range& a) {
  return a.lo >= -1 && a.hi <= 1 ? 0.5 * pi_range() - increasing(a, asin_at) : Range::everything();
}
Range atan(const Range& a) { return increasing(a, atan_at); }
Range sinh(const Range& a) { return increasing(a, sinh_at); }
Range cosh(const Range& a) {
  const Range low = cosh_at(a.lo), high = cosh_at(a.hi);
  if (a.lo >= 0) return {std::max(1.0, low.lo), high.hi};
  if (a.hi <= 0) return {std::max(1.0, high.lo), low.hi};
  return {1, std::max(low.hi, high.hi)};
}
Range tanh(const Range& a) { return increasing(a, tanh_at); }
Range abs(const Range& a) {
  if (a.lo >= 0) return a;
  if (a.hi <= 0) return -a;
  return {0, std::max(-a.lo, a.hi)};
}

}  // namespace whitney
