// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/parametric_manifold.h>

#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/manifolds/bending.h>
#include <whitney/manifolds/closed_form_manifolds.h>
#include <whitney/manifolds/immersed_surfaces.h>
#include <whitney/manifolds/reach_claim.h>
#include "submanifold_checks.h"

namespace whitney {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
using Strings = std::vector<std::string>;

Submanifold parametric_torus() {
  return parametric_manifold(Strings{"u", "v"}, {{0, kTurn}, {0, kTurn}},
                             Strings{"(2+cos(v))*cos(u)", "(2+cos(v))*sin(u)", "sin(v)"});
}

TEST(ParametricManifold, Feet) {
  check_feet(parametric_torus(), 3, 1);
  check_feet(klein_bottle(), 3, 1);
  check_feet(projective_plane(), 1, 0.5);
  for (const double scale : {1e-9, 1e9}) {
    SCOPED_TRACE(scale);
    check_feet(parametric_manifold(2, {{0, kTurn}},
                                   [scale](std::span<const double> u, std::span<double> x) {
                                     x[0] = 3 * scale * std::cos(u[0]);
                                     x[1] = scale * std::sin(u[0]);
                                   }),
               3 * scale, scale / 3);
  }
  check_bad_points(klein_bottle());
  check_bad_points(projective_plane());
}

TEST(ParametricManifold, AgreesWithTheClosedForm) {
  const Submanifold M = parametric_torus(), exact = closed_form::torus_of_revolution(2, 1);
  // Far beyond the reach too: the closest point is the global one.
  const Feet feet = random_feet(exact, 4, 500);
  std::vector<double> point(3), frame(9);
  FootErrors errors;
  double worst = 0;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    ASSERT_TRUE(M.project(std::span(feet.sources).subspan(3 * i, 3), point, frame, errors)) << i;
    worst = std::max(worst, distance(point.data(), &feet.points[3 * i], 3));
  }
  EXPECT_LT(worst, 1e-10);
}

TEST(ParametricManifold, TheClosestPointIsGlobal) {
  // Two loops of a curve pass each other at distance 0.2: (cos t, sin 2t, 0.1 cos t...) in R^3, a lifted figure eight.
  const Submanifold M = parametric_manifold(Strings{"t"}, {{0, kTurn}}, Strings{"sin(2*t)", "2*sin(t)", "cos(t)/10"});
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> point(3), frame(9);
  FootErrors errors;
  for (int i = 0; i < 500; ++i) {
    const std::vector<double> x = {0.5 * uniform(generator), 0.5 * uniform(generator), 0.2 * uniform(generator)};
    double nearest = 1e9;
    for (int j = 0; j < 20000; ++j) {
      const double t = kTurn * j / 20000;
      const double y[3] = {std::sin(2 * t), 2 * std::sin(t), std::cos(t) / 10};
      nearest = std::min(nearest, distance(x.data(), y, 3));
    }
    ASSERT_TRUE(M.project(x, point, frame, errors));
    const double found = distance(x.data(), point.data(), 3);
    EXPECT_LE(found, nearest + 1e-12);
    EXPECT_GT(found, nearest - 1e-5);
  }
}

TEST(ParametricManifold, MeasuredReach) {
  const auto check = [](const Submanifold& M, double reach, double curvature_radius) {
    EXPECT_EQ(M.bending()->source, Bending::Source::kEstimated);
    EXPECT_NEAR(M.bending()->reach, reach, 1e-5 * reach);
    const Bending bending = estimate_bending(M).bending;
    EXPECT_NEAR(bending.reach, reach, 1e-5 * reach);
    EXPECT_NEAR(bending.curvature_radius, curvature_radius, 1e-5 * curvature_radius);
    const Feet feet = random_feet(M, reach, 1500);
    const FeetView view{M.ambient_dim(), M.intrinsic_dim(), feet.points, feet.frames, feet.errors};
    EXPECT_TRUE(check_reach(view, bending.reach * (1 - 1e-6)).consistent());
    EXPECT_FALSE(check_reach(view, 1.1 * reach).consistent());
  };
  check(parametric_torus(), 1, 1);
  check(klein_bottle(), 1, 1);
  check(projective_plane(), 0.5, 0.5);
}

TEST(ParametricManifold, KleinBottleAndProjectivePlaneAreNotOrientable) {
  // Following the tangent plane along a loop brings it back turned over. The frame itself may jump, so: transport.
  const auto transported_sign = [](const Submanifold& M, const auto& loop) {
    std::vector<double> point(4), frame(16), start, carried;
    FootErrors errors;
    double sign = 0;
    for (int i = 0; i <= 400; ++i) {
      if (!M.project(loop(i / 400.0), point, frame, errors)) return 0.0;
      const std::vector<double> tangent(frame.begin(), frame.begin() + 8);
      if (i == 0) {
        start = carried = tangent;
        continue;
      }
      const auto determinant = [&](const std::vector<double>& other) {
        double g[2][2] = {};
        for (int a = 0; a < 2; ++a)
          for (int b = 0; b < 2; ++b)
            for (int c = 0; c < 4; ++c) g[a][b] += other[a * 4 + c] * tangent[b * 4 + c];
        return g[0][0] * g[1][1] - g[0][1] * g[1][0];
      };
      const bool flip = determinant(carried) < 0;
      carried = tangent;
      if (flip)
        for (int c = 0; c < 4; ++c) carried[c] = -carried[c];
      sign = determinant(start) * (flip ? -1 : 1);
    }
    return sign;
  };
  EXPECT_LT(transported_sign(klein_bottle(),
                             [](double s) {
                               return std::vector<double>{3 * std::cos(kTurn * s), 3 * std::sin(kTurn * s), 0, 0};
                             }),
            -0.9);
  EXPECT_LT(transported_sign(projective_plane(),
                             [](double s) {
                               const double x = std::cos(kTurn * s / 2), y = std::sin(kTurn * s / 2);
                               return std::vector<double>{x * y, 0, y * y, 0};
                             }),
            -0.9);
}

TEST(ParametricManifold, RejectsBadInput) {
  EXPECT_THROW(parametric_manifold(Strings{"u"}, {{0, 1}}, Strings{"u"}), InvalidInput);
  EXPECT_THROW(parametric_manifold(Strings{"u"}, {{0, 1}, {0, 1}}, Strings{"u", "u"}), InvalidInput);
  EXPECT_THROW(parametric_manifold(Strings{"u"}, {{1, 1}}, Strings{"u", "u"}), InvalidInput);
  EXPECT_THROW(parametric_manifold(Strings{"u"}, {{0, 1}}, Strings{"1", "2"}), InvalidInput);
  EXPECT_THROW(parametric_manifold(Strings{"u"}, {{-1, 1}}, Strings{"log(u)", "u"}), InvalidInput);
  // Of rank 1 everywhere.
  EXPECT_THROW(parametric_manifold(Strings{"u", "v"}, {{0, 1}, {0, 1}}, Strings{"u+v", "(u+v)^2", "0"}), InvalidInput);
  EXPECT_THROW(parametric_manifold(3, {{0, 1}}, {}), InvalidInput);
  EXPECT_THROW(parametric_manifold(nullptr), InvalidInput);
}

}  // namespace
}  // namespace whitney
