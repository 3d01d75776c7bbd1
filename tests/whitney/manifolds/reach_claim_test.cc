// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/reach_claim.h>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/manifolds/closed_form_manifolds.h>
#include "submanifold_checks.h"

namespace whitney {
namespace {

FeetView view(const Feet& feet, int d, int n) { return {d, n, feet.points, feet.frames, feet.errors}; }

TEST(ReachClaim, CurvatureContradicts) {
  const Feet feet = random_feet(closed_form::sphere(2, 3), 1, 500);
  EXPECT_TRUE(check_reach(view(feet, 3, 2), 1).consistent());
  const ReachVerdict verdict = check_reach(view(feet, 3, 2), 1.001);
  EXPECT_FALSE(verdict.consistent());
  EXPECT_NE(verdict.p, verdict.q);
  EXPECT_NEAR(verdict.largest_possible, 1, 1e-9);
  EXPECT_GE(verdict.largest_possible, 1);
  EXPECT_EQ(verdict.num_pairs, 500 * 499);
}

TEST(ReachClaim, ABottleneckContradicts) {
  // Two points of two far sheets suffice.
  const std::vector<double> points = {0, 0, 0, 1}, frames = {1, 0, 0, 1, 1, 0, 0, 1};
  const FeetView feet{2, 1, points, frames, {}};
  EXPECT_TRUE(check_reach(feet, 0.5).consistent());
  const ReachVerdict verdict = check_reach(feet, 0.6);
  EXPECT_EQ(verdict.law, ReachVerdict::Law::kDistance);
  EXPECT_NEAR(verdict.largest_possible, 0.5, 1e-12);
}

TEST(ReachClaim, AnglesContradict) {
  // The second point lies in the tangent line of the first, where distances say nothing; but its tangent is turned.
  const double c = std::cos(0.5), s = std::sin(0.5);
  const std::vector<double> points = {0, 0, 0, 0.1, 0, 0}, frames = {1, 0, 0, 0,  1, 0, 0, 0, 1,  //
                                                                     c, s, 0, -s, c, 0, 0, 0, 1};
  const ReachVerdict verdict = check_reach({3, 1, points, frames, {}}, 10);
  EXPECT_FALSE(verdict.consistent());
  EXPECT_LE(verdict.largest_possible, 0.1 / (2 * std::sin(0.25)) + 1e-12);
}

TEST(ReachClaim, ErrorsAreInTheClaimsFavour) {
  const std::vector<double> points = {0, 0, 0, 1}, frames = {1, 0, 0, 1, 1, 0, 0, 1};
  const std::vector<FootErrors> vague(2, {0.1, 0});
  EXPECT_TRUE(check_reach({2, 1, points, frames, vague}, 0.6).consistent());
  const std::vector<FootErrors> useless(2, {1, 2});
  EXPECT_EQ(check_reach({2, 1, points, frames, useless}, 1e9).largest_possible, INFINITY);
  // Points moved off a sphere by 1e-3, said so: no false alarm. Not said: one.
  Feet feet = random_feet(closed_form::sphere(2, 3), 1, 300);
  for (std::size_t i = 0; i < feet.points.size(); ++i) feet.points[i] += 1e-3 * ((i * 2654435761u >> 7) % 3 - 1.0);
  EXPECT_FALSE(check_reach(view(feet, 3, 2), 0.99).consistent());
  for (FootErrors& errors : feet.errors) errors.point = 2e-3;
  EXPECT_TRUE(check_reach(view(feet, 3, 2), 0.99).consistent());
}

TEST(ReachClaim, FollowsScale) {
  for (const double s : {1e-9, 1e9}) {
    const Feet feet = random_feet(closed_form::torus_of_revolution(2 * s, s), s, 500);
    EXPECT_TRUE(check_reach(view(feet, 3, 2), s).consistent());
    EXPECT_FALSE(check_reach(view(feet, 3, 2), 1.05 * s).consistent());
  }
}

TEST(ReachClaim, ManyPairsAreThinnedOut) {
  const Feet feet = random_feet(closed_form::sphere(1, 2), 1, 2000);
  const ReachVerdict verdict = check_reach(view(feet, 2, 1), 1.01, 50000);
  EXPECT_LE(verdict.num_pairs, 52000);
  EXPECT_FALSE(verdict.consistent());
}

TEST(ReachClaim, FewFeetSayNothing) {
  EXPECT_TRUE(check_reach({2, 1, {}, {}, {}}, 1).consistent());
  const Feet one = random_feet(closed_form::sphere(1, 2), 1, 1);
  EXPECT_TRUE(check_reach(view(one, 2, 1), 1e6).consistent());
}

TEST(ReachClaim, RejectsBadInput) {
  const Feet feet = random_feet(closed_form::sphere(1, 2), 1, 5);
  for (const double bad : {0.0, -1.0, double{NAN}, double{INFINITY}})
    EXPECT_THROW(check_reach(view(feet, 2, 1), bad), InvalidInput);
  EXPECT_THROW(check_reach(view(feet, 2, 2), 1), InvalidInput);
  EXPECT_THROW(check_reach(view(feet, 3, 1), 1), InvalidInput);
  EXPECT_THROW(check_reach({2, 1, feet.points, feet.frames, std::span(feet.errors).first(2)}, 1), InvalidInput);
  std::vector<double> points = feet.points;
  points[3] = NAN;
  EXPECT_THROW(check_reach({2, 1, points, feet.frames, feet.errors}, 1), InvalidInput);
}

}  // namespace
}  // namespace whitney
