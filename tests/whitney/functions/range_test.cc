// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/range.h>

#include <cfenv>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace whitney {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
using Extended = long double;
static_assert(std::numeric_limits<Extended>::digits >= 64);

/// Numbers of all sizes, with both signs, and the special ones among them.
double any_double(std::mt19937_64& rng) {
  switch (rng() % 8) {
    case 0:
      return std::ldexp(double(std::int64_t(rng())), int(rng() % 2000) - 1063);
    case 1:
      return double(std::int64_t(rng() % 41) - 20);
    case 2: {
      const double special[] = {0, -0.0, 5e-324, -5e-324, 0x1p-1022, 1.7e308, -1.7e308, 1, -1, 0x1p-53};
      return special[rng() % 10];
    }
    case 3:
      return std::ldexp(double(std::int64_t(rng())), -1137);  // subnormal
    default:
      return std::ldexp(double(std::int64_t(rng())), int(rng() % 12) - 66);
  }
}

Range any_range(std::mt19937_64& rng) {
  double a = any_double(rng), b = rng() % 3 == 0 ? a : any_double(rng);
  if (rng() % 2 == 0) b = a + std::fabs(a) * 1e-3;
  if (a > b) std::swap(a, b);
  if (rng() % 50 == 0) b = kInf;
  if (rng() % 50 == 0) a = -kInf;
  return {a, b};
}

double point_of(const Range& r, std::mt19937_64& rng) {
  const double lo = std::max(r.lo, -DBL_MAX), hi = std::min(r.hi, DBL_MAX);
  switch (rng() % 4) {
    case 0:
      return lo;
    case 1:
      return hi;
    default: {
      const double t = std::uniform_real_distribution<double>(0, 1)(rng);
      return std::clamp(lo * (1 - t) + hi * t, lo, hi);
    }
  }
}

/// value was computed in extended precision, within a few units of its 64 bits.
void expect_holds(const Range& r, Extended value, const char* what, double a, double b = 0) {
  ASSERT_TRUE(r.lo <= r.hi) << what << a << " " << b;
  ASSERT_TRUE(r.lo < kInf && r.hi > -kInf);
  if (std::isnan(value)) return;
  if (std::isinf(value)) {
    ASSERT_TRUE(value > 0 ? r.hi == kInf : r.lo == -kInf) << what << a << " " << b;
    return;
  }
  const Extended slack = 8 * std::fabs(value) * std::numeric_limits<Extended>::epsilon();
  ASSERT_TRUE(Extended(r.lo) <= value + slack && value - slack <= Extended(r.hi))
      << what << " at " << a << ", " << b << ": " << double(value) << " not in [" << r.lo << ", " << r.hi << "]";
}

TEST(Range, ArithmeticHoldsWhatItShould) {
  std::mt19937_64 rng(1);
  for (int i = 0; i < 150'000; ++i) {
    const Range a = any_range(rng), b = any_range(rng);
    const double x = point_of(a, rng), y = point_of(b, rng);
    const Extended ex = x, ey = y;
    expect_holds(a + b, ex + ey, "+", x, y);
    expect_holds(a - b, ex - ey, "-", x, y);
    expect_holds(a * b, ex * ey, "*", x, y);
    expect_holds(x * b, ex * ey, "scale", x, y);
    if (y != 0) expect_holds(a / b, ex / ey, "/", x, y);
    expect_holds(sqr(a), ex * ex, "sqr", x);
    const int n = int(rng() % 9) - 3;
    if (x != 0 || n >= 0) expect_holds(pow(a, n), std::pow(ex, Extended(n)), "pow", x, n);
    expect_holds(abs(a), std::fabs(ex), "abs", x);
    if (x >= 0) expect_holds(sqrt(a), std::sqrt(ex), "sqrt", x);
  }
}

TEST(Range, ExactRationalsShowTheRoundingOutward) {
  // Sums and products whose rounding error is known exactly must be strictly inside.
  std::mt19937_64 rng(2);
  for (int i = 0; i < 200'000; ++i) {
    const double x = any_double(rng), y = any_double(rng);
    const Range sum = Range(x) + Range(y), product = Range(x) * Range(y);
    if (std::fabs(x + y) < 1e300) {
      const double s = x + y, z = s - x, error = (x - (s - z)) + (y - z);
      ASSERT_TRUE(sum.lo - s <= error && error <= sum.hi - s) << x << " " << y;
    }
    const double p = x * y;
    if (std::fabs(p) < 1e300 && std::fabs(p) > 1e-280) {
      const double error = std::fma(x, y, -p);
      ASSERT_TRUE(product.lo - p <= error && error <= product.hi - p) << x << " " << y;
    }
  }
}

TEST(Range, FunctionsHoldWhatTheyShould) {
  std::mt19937_64 rng(3);
  for (int i = 0; i < 60'000; ++i) {
    const Range a = any_range(rng), b = any_range(rng);
    const double x = point_of(a, rng), y = point_of(b, rng);
    const Extended ex = x;
    expect_holds(exp(a), std::exp(ex), "exp", x);
    if (x > 0) expect_holds(log(a), std::log(ex), "log", x);
    expect_holds(sin(a), std::sin(ex), "sin", x);
    expect_holds(cos(a), std::cos(ex), "cos", x);
    if (std::fabs(x) < 1e10) expect_holds(tan(a), std::tan(ex), "tan", x);
    if (std::fabs(x) <= 1) expect_holds(asin(a), std::asin(ex), "asin", x);
    if (std::fabs(x) <= 1) expect_holds(acos(a), std::acos(ex), "acos", x);
    expect_holds(atan(a), std::atan(ex), "atan", x);
    expect_holds(sinh(a), std::sinh(ex), "sinh", x);
    expect_holds(cosh(a), std::cosh(ex), "cosh", x);
    expect_holds(tanh(a), std::tanh(ex), "tanh", x);
    if (x > 0) expect_holds(pow(a, b), std::pow(ex, Extended(y)), "pow", x, y);
  }
}

TEST(Range, FunctionsOfPointsAreNarrow) {
  std::mt19937_64 rng(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double widest = 0;
  for (int i = 0; i < 5'000; ++i) {
    const double u = uniform(rng), x = 30 * u;
    const auto width = [&](const Range& r) { widest = std::max(widest, (r.hi - r.lo) / std::max(1.0, r.mag())); };
    for (const Range& r : {exp(Range(x)), sin(Range(x)), cos(Range(x)), atan(Range(x)), tanh(Range(x)), sinh(Range(x)),
                           cosh(Range(x)), log(Range(std::fabs(x) + 1e-3)), asin(Range(u)), acos(Range(u))}) {
      width(r);
    }
  }
  EXPECT_LT(widest, 1e-14);
}

TEST(Range, OutsideOfDomainsIsEverything) {
  const auto is_everything = [](const Range& r) { return r.lo == -kInf && r.hi == kInf; };
  EXPECT_TRUE(is_everything(sqrt(Range(-1, 1))));
  EXPECT_TRUE(is_everything(log(Range(0, 1))));
  EXPECT_TRUE(is_everything(Range(1) / Range(-1, 1)));
  EXPECT_TRUE(is_everything(Range(1) / Range(0, 1)));
  EXPECT_TRUE(is_everything(tan(Range(1.5, 1.6))));
  EXPECT_TRUE(is_everything(asin(Range(0.5, 1.5))));
  EXPECT_TRUE(is_everything(pow(Range(0, 1), Range(0.5))));
  EXPECT_TRUE(is_everything(pow(Range(-1, 1), -2)));
  EXPECT_TRUE(is_everything(Range(std::nan(""), 1)));
  EXPECT_TRUE(is_everything(Range(2, 1)));
  EXPECT_TRUE(is_everything(Range(0) * Range::everything()));
  EXPECT_TRUE(is_everything(Range::everything() - Range::everything()));
  EXPECT_EQ(sin(Range(0, 100)).hi, 1);
  EXPECT_EQ(sin(Range(1e9)).lo, -1);
  EXPECT_TRUE(sin(Range(1.5, 1.6)).hi >= 1);
  EXPECT_TRUE(cos(Range(3.1, 3.2)).lo <= -1);
}

TEST(Range, ThisBuildRoundsAsTheProofAssumes) {
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  EXPECT_TRUE(rounds_to_nearest());
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const bool is_noticed = !rounds_to_nearest();
    std::fesetround(FE_TONEAREST);
    EXPECT_TRUE(is_noticed);
  }
  std::mt19937_64 rng(5);
  for (int i = 0; i < 100'000; ++i) {
    const double x = any_double(rng);
    if (!std::isfinite(x)) continue;
    ASSERT_GE(outward::up(x), std::nextafter(x, kInf));
    ASSERT_LE(outward::down(x), std::nextafter(x, -kInf));
  }
  EXPECT_EQ(outward::up(-kInf), -DBL_MAX);
  EXPECT_EQ(outward::down(kInf), DBL_MAX);
}

}  // namespace
}  // namespace whitney
