// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/distance_bound.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace whitney {
namespace {

// A foot at the origin of R^2, tangent along the first axis.
const double kPoint[2] = {0, 0}, kFrame[4] = {1, 0, 0, 1};

std::optional<double> bound(std::vector<double> points, const Bending& bending, FootErrors errors = {}) {
  return distance_from_manifold(points, 2, 1, {kPoint, kFrame, errors}, bending);
}

TEST(DistanceFromManifold, ChordsOfACircle) {
  // The circle of radius 1 through the origin, centre (0, 1): what is farthest from it on a chord is the middle.
  for (const double angle : {0.01, 0.1, 0.5, 1.0, 1.4}) {
    const double x = std::sin(angle), y = 1 - std::cos(angle);
    const auto b = bound({x, y, -x, y}, {1, 1, Bending::Source::kProven});
    ASSERT_TRUE(b);
    EXPECT_GE(*b, y);           // the middle of the chord
    EXPECT_LT(*b, 2.0001 * y);  // the points and the circle may leave the plane on different sides
  }
}

TEST(DistanceFromManifold, BeyondTheReachThereIsNone) {
  // Hardly curved, but another sheet may be near: the curvature radius says nothing about where M is.
  EXPECT_TRUE(bound({0.09, 0, -0.09, 0}, {0.1, 10, Bending::Source::kProven}));
  EXPECT_FALSE(bound({0.11, 0, -0.09, 0}, {0.1, 10, Bending::Source::kProven}));
  EXPECT_FALSE(bound({0.1, 0, -0.09, 0}, {0.1, 10, Bending::Source::kProven}));
  // The errors of the foot count.
  EXPECT_FALSE(bound({0.09, 0, -0.09, 0}, {0.1, 10, Bending::Source::kProven}, {0.02, 0}));
  EXPECT_FALSE(bound({0.09, 0, -0.09, 0}, {0.1, 10, Bending::Source::kProven}, {0, 0.2}));
  EXPECT_FALSE(bound({NAN, 0}, {0.1, 10, Bending::Source::kProven}));
}

TEST(DistanceFromManifold, GrowsWithTheErrors) {
  const Bending bending{1, 1, Bending::Source::kProven};
  const double exact = *bound({0.5, 0.1}, bending), off = *bound({0.5, 0.1}, bending, {1e-3, 0}),
               turned = *bound({0.5, 0.1}, bending, {0, 1e-3});
  EXPECT_GT(off, exact + 1e-3);
  EXPECT_GT(turned, exact + 0.5e-3);
}

TEST(HausdorffBound, OnlyInsideTheTube) {
  EXPECT_EQ(hausdorff_bound(0.1, 0.5, 1), 0.1);
  EXPECT_EQ(hausdorff_bound(0.1, 1.8, 1), 0.1);
  EXPECT_FALSE(hausdorff_bound(0.1, 1.9, 1));  // a segment of K to its point of M may cross the medial axis
  EXPECT_FALSE(hausdorff_bound(0.1, 3, 1));
  EXPECT_FALSE(hausdorff_bound(1, 0.1, 1));
}

}  // namespace
}  // namespace whitney
