// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/find_seeds.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/functions/zero_sets.h>

namespace whitney {
namespace {

Box box_of(const NamedManifold& m) {
  Box box;
  for (const auto& [lower, upper] : m.box) {
    box.lower.push_back(lower);
    box.upper.push_back(upper);
  }
  return box;
}

TEST(FindSeeds, PointsLieOnTheManifoldAndInTheBox) {
  for (const NamedManifold& m : {sphere(2, 3), flat_torus(6), pentagon_linkage(), so3_vectors(), trefoil(), chair(3)}) {
    const Box box = box_of(m);
    const FoundSeeds found = find_seeds(m.function, box);
    const int d = m.function.ambient_dim(), k = m.function.codim();
    ASSERT_GT(found.points.size(), 0u);
    std::vector<double> f(k);
    for (std::size_t i = 0; i < found.points.size(); i += d) {
      m.function.evaluate({&found.points[i], std::size_t(d)}, f);
      for (double x : f) EXPECT_NEAR(x, 0, 1e-9);
      for (int c = 0; c < d; ++c) {
        EXPECT_GE(found.points[i + c], box.lower[c]);
        EXPECT_LE(found.points[i + c], box.upper[c]);
      }
    }
  }
}

TEST(FindSeeds, FindsEveryComponentOfModerateInputs) {
  // Eight spheres of very different sizes, the smallest a hundredth of the box.
  const Function f = make_function(3, 1, [](std::span<const double> x, std::span<double> v) {
    v[0] = 1;
    for (int i = 0; i < 8; ++i) {
      const double cx = i & 1 ? 1.5 : -1.5, cy = i & 2 ? 1.5 : -1.5, cz = i & 4 ? 1.5 : -1.5, r = 0.05 * (i + 1);
      v[0] *= (x[0] - cx) * (x[0] - cx) + (x[1] - cy) * (x[1] - cy) + (x[2] - cz) * (x[2] - cz) - r * r;
    }
  });
  const FoundSeeds found = find_seeds(f, {{-3, -3, -3}, {3, 3, 3}});
  std::vector<bool> seen(8);
  for (std::size_t i = 0; i < found.points.size(); i += 3)
    seen[(found.points[i] > 0) + 2 * (found.points[i + 1] > 0) + 4 * (found.points[i + 2] > 0)] = true;
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(seen[i]) << "sphere " << i;
}

TEST(FindSeeds, SaysWhenTheJacobianIsSingular) {
  const Function squared = make_function(2, 1, [](std::span<const double> x, std::span<double> v) {
    const double circle = x[0] * x[0] + x[1] * x[1] - 1;
    v[0] = circle * circle;
  });
  const FoundSeeds found = find_seeds(squared, {{-2, -2}, {2, 2}});
  EXPECT_TRUE(found.points.empty());
  EXPECT_GT(found.num_singular, found.num_starts / 4);
  const Function nothing = make_function(2, 1, [](auto, auto v) { v[0] = 3; });
  EXPECT_TRUE(find_seeds(nothing, {{-2, -2}, {2, 2}}).points.empty());
}

TEST(FindSeeds, TheUnitsDoNotMatter) {
  for (double unit : {1e-9, 1.0, 1e9})
    for (double factor : {1e-12, 1e12}) {
      const Function f = make_function(2, 1, [=](std::span<const double> x, std::span<double> v) {
        v[0] = factor * ((x[0] * x[0] + x[1] * x[1]) / unit / unit - 1);
      });
      EXPECT_GT(find_seeds(f, {{-2 * unit, -2 * unit}, {2 * unit, 2 * unit}}).points.size(), 100u);
    }
}

// The unit circle in R^3, its two equations in units of their own, and lengths in another: squares of the rows of Df
// overflow or underflow.
TEST(FindSeeds, TheUnitsOfTheEquationsDoNotMatter) {
  struct Units {
    double length, first, second;
  };
  for (const auto& [length, first, second] :
       {Units{1e-9, 1e200, 1e-200}, Units{1, 1e300, 1}, Units{1, 1e-300, 1e300}, Units{1e-200, 1, 1e-100},
        Units{1e200, 1, 1}, Units{1e9, 1e-290, 1e290}}) {
    const auto values = [=](std::span<const double> x, std::span<double> v) {
      const double X = x[0] / length, Y = x[1] / length, Z = x[2] / length;
      v[0] = first * (X * X + Y * Y + Z * Z - 1);
      v[1] = second * (X + Y + Z);
    };
    const Box box{{-2 * length, -1.5 * length, -2 * length}, {2 * length, 2 * length, 1.5 * length}};
    const FoundSeeds found = find_seeds(make_function(3, 2, values), box);
    EXPECT_GT(found.points.size(), 3 * 300u) << length << " " << first << " " << second;
    EXPECT_EQ(found.num_singular, 0u);
    double v[2];
    for (std::size_t i = 0; i < found.points.size(); i += 3) {
      values({&found.points[i], 3}, v);
      EXPECT_NEAR(v[0] / first, 0, 1e-9);
      EXPECT_NEAR(v[1] / second, 0, 1e-9);
    }
  }
}

TEST(FindSeeds, PowersOfTwoChangeNothing) {
  const auto circle = [](double length, double factor) {
    const Function f = make_function(2, 1, [=](std::span<const double> x, std::span<double> v) {
      const double X = x[0] / length, Y = x[1] / length;
      v[0] = factor * (X * X + Y * Y - 1);
    });
    std::vector<double> points = find_seeds(f, {{-2 * length, -2 * length}, {2 * length, 3 * length}}).points;
    for (double& x : points) x /= length;
    return points;
  };
  const std::vector<double> points = circle(1, 1);
  EXPECT_EQ(circle(0x1p-300, 0x1p200), points);
  EXPECT_EQ(circle(0x1p300, 0x1p-600), points);
}

TEST(FindSeeds, KeepsEachPointOnce) {
  const Function f =
      make_function(1, 1, [](std::span<const double> x, std::span<double> v) { v[0] = x[0] * x[0] - 1; });
  const FoundSeeds found = find_seeds(f, {{-3}, {3}});
  EXPECT_EQ(found.points.size(), 2u);
  EXPECT_GT(found.num_converged, 300u);
}

TEST(FindSeeds, StopsAtLimits) {
  const NamedManifold m = flat_torus(6);
  const FoundSeeds late = find_seeds(m.function, box_of(m), {.run = {.time_limit = -1}});
  EXPECT_EQ(late.stop_reason, StopReason::kTimeLimit);
  EXPECT_EQ(late.evaluations, 0u);
  EXPECT_TRUE(late.points.empty());
  // What was found until then is there: the beginning of what the whole search finds.
  const FoundSeeds whole = find_seeds(m.function, box_of(m));
  EXPECT_EQ(whole.stop_reason, StopReason::kNone);
  int calls = 0;
  const FoundSeeds some =
      find_seeds(m.function, box_of(m), {.run = {.progress = [&](const Progress&) { return ++calls < 200; }}});
  EXPECT_EQ(some.stop_reason, StopReason::kCancelled);
  EXPECT_EQ(calls, 200);
  ASSERT_GT(some.points.size(), 0u);
  ASSERT_LT(some.points.size(), whole.points.size());
  EXPECT_TRUE(std::equal(some.points.begin(), some.points.end(), whole.points.begin()));
  // So on the strata.
  const Domain domain(3, make_function(3, 1, [](auto x, auto v) { v[0] = x[0]; }), Box{{-2, -2, -2}, {2, 2, 2}});
  const Function sphere =
      make_function(3, 1, [](auto x, auto v) { v[0] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 1; });
  const std::size_t all = find_seeds(sphere, domain).evaluations;
  std::size_t evaluations = 0;
  const FoundSeeds cut =
      find_seeds(sphere, domain, {.run = {.progress = [&](const Progress&) { return ++evaluations < all - 20; }}});
  EXPECT_EQ(cut.stop_reason, StopReason::kCancelled);
  EXPECT_EQ(cut.evaluations, all - 21);
}

TEST(FindSeeds, PassesOverPointsWhereFIsNotFinite) {
  const Function f = make_function(2, 1, [](std::span<const double> x, std::span<double> v) {
    v[0] = std::sqrt(x[0]) + x[1] * x[1] - 1;  // NaN on half of the box
  });
  EXPECT_GT(find_seeds(f, {{-2, -2}, {2, 2}}).points.size(), 0u);
  EXPECT_THROW(find_seeds(f, {{-2}, {2}}), InvalidInput);
}

}  // namespace
}  // namespace whitney
