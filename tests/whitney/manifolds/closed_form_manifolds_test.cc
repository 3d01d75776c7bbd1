// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/closed_form_manifolds.h>

#include <string>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/manifolds/reach_claim.h>
#include "submanifold_checks.h"

namespace whitney {
namespace {

struct Case {
  const char* name;
  Submanifold manifold;
  double size, reach;
};

std::vector<Case> cases() {
  return {{"circle", closed_form::sphere(1, 2), 1, 1},
          {"circle in R^5", closed_form::sphere(1, 5, 3), 3, 3},
          {"sphere", closed_form::sphere(2, 3), 1, 1},
          {"S^3 in R^6", closed_form::sphere(3, 6, 0.5), 0.5, 0.5},
          {"small sphere", closed_form::sphere(2, 3, 1e-9), 1e-9, 1e-9},
          {"large sphere", closed_form::sphere(2, 3, 1e9), 1e9, 1e9},
          {"torus", closed_form::torus_of_revolution(2, 1), 3, 1},
          {"thin torus", closed_form::torus_of_revolution(1, 0.25), 1.25, 0.25},
          {"thick torus", closed_form::torus_of_revolution(1, 0.75), 1.75, 0.25},
          {"flat torus", closed_form::flat_torus(), 1, 1},
          {"flat torus in R^6", closed_form::flat_torus(6, 2, 0.5), 2, 0.5}};
}

TEST(ClosedFormManifolds, Feet) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    check_feet(c.manifold, c.size, c.reach);
    check_bad_points(c.manifold);
  }
}

TEST(ClosedFormManifolds, TheReachIsTight) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Bending bending = c.manifold.bending().value();
    EXPECT_EQ(bending.source, Bending::Source::kProven);
    EXPECT_NEAR(bending.reach, c.reach, 1e-15 * c.reach);
    EXPECT_EQ(bending.curvature_radius, bending.reach);
    const Feet feet = random_feet(c.manifold, c.reach, 600);
    const FeetView view{c.manifold.ambient_dim(), c.manifold.intrinsic_dim(), feet.points, feet.frames, feet.errors};
    EXPECT_TRUE(check_reach(view, bending.reach).consistent());
    EXPECT_FALSE(check_reach(view, 1.05 * bending.reach).consistent());
  }
}

TEST(ClosedFormManifolds, FeetLieOnTheZeroSets) {
  const auto check = [](const Submanifold& M, const Function& f, double reach) {
    const Feet feet = random_feet(M, reach, 100);
    std::vector<double> values(feet.size() * f.codim());
    f.evaluate(feet.points, values);
    for (const double value : values) EXPECT_NEAR(value, 0, 1e-12);
  };
  check(closed_form::sphere(2, 5, 1.5), sphere(2, 5, 1.5).function, 1);
  check(closed_form::torus_of_revolution(2, 0.5), torus_of_revolution(2, 0.5).function, 0.5);
  check(closed_form::flat_torus(6, 2, 0.5), flat_torus(6, 2, 0.5).function, 0.5);
}

TEST(ClosedFormManifolds, NoFootOnTheMedialAxis) {
  std::vector<double> point(4), frame(16);
  FootErrors errors;
  const auto has_foot = [&](const Submanifold& M, std::vector<double> x) {
    const std::size_t d = x.size();
    return M.project(x, std::span(point).first(d), std::span(frame).first(d * d), errors);
  };
  EXPECT_FALSE(has_foot(closed_form::sphere(2, 3), {0, 0, 0}));
  EXPECT_FALSE(has_foot(closed_form::sphere(2, 3), {1e-14, 0, 0}));
  EXPECT_TRUE(has_foot(closed_form::sphere(2, 3), {1e-3, 0, 0}));
  EXPECT_GT(errors.point, 1e-13);  // worse conditioned than near the sphere
  EXPECT_FALSE(has_foot(closed_form::sphere(1, 3), {0, 0, 5}));
  EXPECT_FALSE(has_foot(closed_form::torus_of_revolution(2, 1), {0, 0, 1}));
  EXPECT_FALSE(has_foot(closed_form::torus_of_revolution(2, 1), {0, 2, 0}));
  EXPECT_FALSE(has_foot(closed_form::flat_torus(), {1, 0, 0, 0}));
  EXPECT_FALSE(has_foot(closed_form::flat_torus(), {0, 0, 1, 0}));
}

TEST(ClosedFormManifolds, RejectBadParameters) {
  EXPECT_THROW(closed_form::sphere(0, 2), InvalidInput);
  EXPECT_THROW(closed_form::sphere(3, 3), InvalidInput);
  for (const double bad : {0.0, -1.0, double{NAN}, double{INFINITY}, 1e200}) {
    EXPECT_THROW(closed_form::sphere(1, 2, bad), InvalidInput);
    EXPECT_THROW(closed_form::torus_of_revolution(2, bad), InvalidInput);
    EXPECT_THROW(closed_form::flat_torus(4, 1, bad), InvalidInput);
  }
  EXPECT_THROW(closed_form::torus_of_revolution(1, 1), InvalidInput);
  EXPECT_THROW(closed_form::flat_torus(3), InvalidInput);
}

}  // namespace
}  // namespace whitney
