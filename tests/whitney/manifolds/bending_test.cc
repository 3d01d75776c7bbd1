// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/bending.h>

#include <string>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/functions/expression.h>
#include <whitney/manifolds/closed_form_manifolds.h>
#include <whitney/manifolds/implicit_manifold.h>
#include <whitney/manifolds/matrix_manifolds.h>
#include <whitney/manifolds/submanifold_combinators.h>
#include "submanifold_checks.h"

namespace whitney {
namespace {

using Strings = std::vector<std::string>;

void check(const Submanifold& M, double reach, double curvature_radius, double tolerance = 1e-6) {
  const BendingEstimate estimate = estimate_bending(M);
  EXPECT_EQ(estimate.bending.source, Bending::Source::kEstimated);
  EXPECT_NEAR(estimate.bending.reach, reach, tolerance * reach);
  EXPECT_NEAR(estimate.bending.curvature_radius, curvature_radius, tolerance * curvature_radius);
  EXPECT_GE(estimate.num_points, 500);
  // The witnesses lie on M.
  const std::size_t d = M.ambient_dim();
  std::vector<double> point(d), frame(d * d);
  FootErrors errors;
  for (const auto* witness : {&estimate.p, &estimate.q, &estimate.most_curved}) {
    ASSERT_EQ(witness->size(), d);
    ASSERT_TRUE(M.project(*witness, point, frame, errors));
    EXPECT_LT(distance(point.data(), witness->data(), d), 1e-9 * reach);
  }
}

TEST(EstimateBending, MeetsTheory) {
  check(closed_form::sphere(1, 2), 1, 1);
  check(closed_form::sphere(2, 3), 1, 1);
  check(closed_form::torus_of_revolution(2, 1), 1, 1);
  check(closed_form::flat_torus(4, 2, 0.5), 0.5, 0.5);
  check(projective_plane_projectors(), std::sqrt(0.5), std::sqrt(0.5));
  check(so3_matrices(), std::sqrt(2.0), std::sqrt(2.0));
}

TEST(EstimateBending, FindsNarrowPlacesThatAreNotCurved) {
  // The hole of this torus is narrower than its tube, and is where it curves most: 1/(R - r).
  check(closed_form::torus_of_revolution(1, 0.75), 0.25, 0.25);
  // The oval x^2 + y^2 (1 + 20 x^2)... a peanut: two bulges and a neck of half width 0.2, measured along its axis.
  const Submanifold peanut =
      implicit_manifold(parse_equations(Strings{"x", "y"}, Strings{"y^2-(1-x^2)*(1/25+x^2)"}), {1, 0});
  const BendingEstimate estimate = estimate_bending(peanut);
  EXPECT_NEAR(estimate.bending.reach, 0.2, 1e-6);
  EXPECT_GT(estimate.bending.curvature_radius, 0.201);
  EXPECT_NEAR(distance(estimate.p.data(), estimate.q.data(), 2), 0.4, 1e-4);
}

TEST(EstimateBending, FollowsTheManifold) {
  for (const double s : {1e-9, 1e9}) check(scale(closed_form::torus_of_revolution(2, 1), s), s, s);
  check(translate(closed_form::sphere(2, 3), std::vector<double>{5, -7, 11}), 1, 1);
}

TEST(EstimateBending, IsDeterministic) {
  const BendingEstimate a = estimate_bending(so3_matrices()), b = estimate_bending(so3_matrices());
  EXPECT_EQ(a.bending.reach, b.bending.reach);
  EXPECT_EQ(a.p, b.p);
  EXPECT_EQ(a.direction, b.direction);
}

TEST(EstimateBending, NeedsSeeds) {
  EXPECT_THROW(estimate_bending(implicit_manifold(parse_equations(Strings{"x", "y"}, Strings{"x^2+y^2-1"}), {})),
               InvalidInput);
}

}  // namespace
}  // namespace whitney
