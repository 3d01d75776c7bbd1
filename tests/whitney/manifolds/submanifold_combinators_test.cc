// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/submanifold_combinators.h>

#include <cmath>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <coxeter/placement.h>
#include <whitney/io/read_problem.h>
#include <whitney/manifolds/closed_form_manifolds.h>
#include <whitney/manifolds/immersed_surfaces.h>
#include <whitney/manifolds/matrix_manifolds.h>
#include "submanifold_checks.h"

namespace whitney {
namespace {

TEST(SubmanifoldCombinators, Feet) {
  const Submanifold circle = closed_form::sphere(1, 2), torus = closed_form::torus_of_revolution(2, 0.5);
  check_feet(product(circle, circle), 1, 1);
  check_feet(product(closed_form::sphere(2, 3), scale(circle, 0.5)), 1, 0.5);
  check_feet(embed(torus, 5), 2.5, 0.5);
  check_feet(rotate(embed(torus, 4), coxeter::random_rotation(4, 1)), 2.5, 0.5);
  check_feet(translate(torus, std::vector<double>{1, -2, 3}), 5, 0.5);
  check_feet(rotate(klein_bottle(), coxeter::random_rotation(4, 2)), 3, 1);
  for (const double s : {1e-9, 1e9}) {
    check_feet(scale(torus, s), 2.5 * s, 0.5 * s);
    check_feet(scale(klein_bottle(), s), 3 * s, s);
  }
  check_bad_points(rotate(embed(torus, 4), coxeter::random_rotation(4, 1)));
  check_bad_points(embed(torus, 4));
  check_bad_points(product(circle, circle));
}

TEST(SubmanifoldCombinators, ProductOfCirclesIsTheFlatTorus) {
  const Submanifold M = product(closed_form::sphere(1, 2, 2), closed_form::sphere(1, 2, 0.5));
  const Feet feet = random_feet(closed_form::flat_torus(4, 2, 0.5), 0.3, 100);
  std::vector<double> point(4), frame(16);
  FootErrors errors;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    ASSERT_TRUE(M.project(std::span(feet.sources).subspan(4 * i, 4), point, frame, errors));
    EXPECT_LT(distance(point.data(), &feet.points[4 * i], 4), 1e-14);
    // Tangent rows first: they are orthogonal to both normals.
    for (int a = 0; a < 2; ++a) {
      for (int b = 2; b < 4; ++b) {
        double dot = 0;
        for (int c = 0; c < 4; ++c) dot += frame[a * 4 + c] * feet.frames[i * 16 + b * 4 + c];
        EXPECT_NEAR(dot, 0, 1e-14);
      }
    }
  }
  EXPECT_EQ(M.bending()->reach, 0.5);
  EXPECT_EQ(M.bending()->source, Bending::Source::kProven);
}

TEST(SubmanifoldCombinators, BendingFollows) {
  const Submanifold circle = closed_form::sphere(1, 2);
  EXPECT_EQ(scale(circle, 3).bending()->reach, 3);
  EXPECT_EQ(scale(circle, 3).bending()->curvature_radius, 3);
  EXPECT_EQ(rotate(circle, coxeter::random_rotation(2, 1)).bending()->reach, 1);
  EXPECT_EQ(translate(circle, std::vector<double>{1, 1}).bending()->source, Bending::Source::kProven);
  const Submanifold guessed = with_bending(circle, {0.25, 0.5, Bending::Source::kEstimated});
  EXPECT_EQ(product(circle, guessed).bending()->source, Bending::Source::kEstimated);
  EXPECT_EQ(product(circle, guessed).bending()->reach, 0.25);
  EXPECT_EQ(product(circle, guessed).bending()->curvature_radius, 0.5);
}

TEST(SubmanifoldCombinators, AProvenReachStaysALowerBound) {
  int rounded_up = 0;
  for (int i = 1; i < 200; ++i) {
    const double radius = 1 + i / 7.0, ratio = i / 3.0;
    const Bending bending = *scale(closed_form::sphere(1, 2, radius), ratio).bending();
    rounded_up += std::fma(radius, ratio, -radius * ratio) < 0;
    // Exact: the residual against radius * ratio, rounded once.
    EXPECT_GE(std::fma(radius, ratio, -bending.reach), 0) << radius << " " << ratio;
    EXPECT_GE(std::fma(radius, ratio, -bending.curvature_radius), 0) << radius << " " << ratio;
    EXPECT_GE(bending.reach, radius * ratio * (1 - 3e-16));
  }
  EXPECT_GT(rounded_up, 20);  // products rounded to nearest would not do
  // Constants too: 2 reach^2 <= 1 and reach^2 <= 2.
  const double half = grassmann(1, 3).bending()->reach, two = special_orthogonal(3).bending()->reach;
  EXPECT_LE(std::fma(half, half, -0.5), 0);
  EXPECT_LE(std::fma(two, two, -2.0), 0);
  const Bending tiny = *scale(scale(closed_form::sphere(1, 2, 1e-140), 1e-140), 0.7e-30).bending();
  EXPECT_LT(tiny.reach, 0.7e-310);
}

TEST(SubmanifoldCombinators, SeedsLieOnTheManifold) {
  const Submanifold M =
      translate(rotate(product(closed_form::sphere(1, 2), closed_form::sphere(2, 3)), coxeter::random_rotation(5, 4)),
                std::vector<double>{-1, -0.5, 0, 0.5, 1});
  const std::vector<double> seed = M.seed_points();
  ASSERT_EQ(seed.size(), 5);
  std::vector<double> point(5), frame(25);
  FootErrors errors;
  ASSERT_TRUE(M.project(seed, point, frame, errors));
  EXPECT_LT(distance(seed.data(), point.data(), 5), 1e-14);
}

TEST(SubmanifoldCombinators, RejectBadInput) {
  const Submanifold circle = closed_form::sphere(1, 2);
  EXPECT_THROW(embed(circle, 1), InvalidInput);
  EXPECT_THROW(rotate(circle, Matrix::identity(3)), InvalidInput);
  EXPECT_THROW(rotate(circle, Matrix(2, 2, {2, 0, 0, 2})), InvalidInput);
  EXPECT_THROW(rotate(circle, Matrix(2, 2, std::vector<double>(4, NAN))), InvalidInput);
  EXPECT_THROW(translate(circle, std::vector<double>(3)), InvalidInput);
  EXPECT_THROW(translate(circle, std::vector<double>{0, INFINITY}), InvalidInput);
  for (const double s : {0.0, -1.0, double{NAN}, double{INFINITY}}) EXPECT_THROW(scale(circle, s), InvalidInput);
}

}  // namespace
}  // namespace whitney
