// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/find_seeds.h>

#include <cmath>
#include <limits>

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

TEST(FindSeeds, PassesOverPointsWhereFIsNotFinite) {
  const Function f = make_function(2, 1, [](std::span<const double> x, std::span<double> v) {
    v[0] = std::sqrt(x[0]) + x[1] * x[1] - 1;  // NaN on half of the box
  });
  EXPECT_GT(find_seeds(f, {{-2, -2}, {2, 2}}).points.size(), 0u);
  EXPECT_THROW(find_seeds(f, {{-2}, {2}}), InvalidInput);
}

}  // namespace
}  // namespace whitney
