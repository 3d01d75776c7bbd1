// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/violation.h>

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tests/perturbation/circle_oracle.h>

namespace whitney::perturbation {
namespace {

using coxeter::coxeter_a;

struct Centre {
  double x, y;
};

Centre centre_of(const std::vector<double>& corners) {
  return {(corners[0] + corners[2] + corners[4]) / 3, (corners[1] + corners[3] + corners[5]) / 3};
}

std::optional<Violation> examine(const FootOracle& oracle, const coxeter::Triangulation& triangulation, Centre at) {
  PerturbedTriangulation near(triangulation, oracle);
  const double point[] = {at.x, at.y};
  const std::uint32_t s = near.locate(point);
  return find_violation(near, std::span(&s, 1));
}

TEST(Violation, ACircleInsideATriangleMeetsNoEdge) {
  const auto triangulation = coxeter_a(2, 1);
  const Centre c = centre_of(triangle_at(triangulation, 0.31, 0.17));
  const CircleOracle circle(c.x, c.y, 0.1);
  const auto violation = examine(circle, triangulation, c);
  ASSERT_TRUE(violation);
  EXPECT_EQ(violation->kind, Violation::Kind::kMissesAllFaces);
  ASSERT_EQ(violation->points.size(), 2u);
  EXPECT_NEAR(std::hypot(violation->points[0] - c.x, violation->points[1] - c.y), 0.1, 1e-12);
}

TEST(Violation, FeetThatAreNotProvedToBeClosestProveNoEmptiness) {
  // M: that circle, and one of radius 10 through the triangle, which the local feet do not see. M meets the edges.
  const auto triangulation = coxeter_a(2, 1);
  const Centre c = centre_of(triangle_at(triangulation, 0.31, 0.17));
  CircleOracle circle(c.x, c.y, 0.1);
  circle.promised = {FootPromise::Place::kLocal, FootPromise::Errors::kProven};
  EXPECT_FALSE(examine(circle, triangulation, c));
  circle.promised = {FootPromise::Place::kUnknown, FootPromise::Errors::kProven};
  EXPECT_FALSE(examine(circle, triangulation, c));
  // The closest point, but nobody knows how far off.
  circle.promised = {FootPromise::Place::kGlobal, FootPromise::Errors::kModelled};
  EXPECT_FALSE(examine(circle, triangulation, c));
}

TEST(Violation, TwoPointsOnAnEdge) {
  const auto triangulation = coxeter_a(2, 1);
  const std::vector<double> v = triangle_at(triangulation, 0.31, 0.17);
  const Centre middle{(v[0] + v[2]) / 2, (v[1] + v[3]) / 2};
  CircleOracle circle(middle.x, middle.y, 0.2);
  for (const auto place : {FootPromise::Place::kGlobal, FootPromise::Place::kLocal}) {
    circle.promised.place = place;  // one sheet about each foot is enough
    const auto violation = examine(circle, triangulation, centre_of(v));
    ASSERT_TRUE(violation);
    EXPECT_EQ(violation->kind, Violation::Kind::kTwoPointsOnFace);
    ASSERT_EQ(violation->points.size(), 4u);
    for (const int i : {0, 2})
      EXPECT_NEAR(std::hypot(violation->points[i] - middle.x, violation->points[i + 1] - middle.y), 0.2, 1e-12);
    EXPECT_GT(std::hypot(violation->points[0] - violation->points[2], violation->points[1] - violation->points[3]),
              0.3);
    EXPECT_FALSE(describe(*violation).empty());
  }
}

TEST(Violation, NoneWhereTheTriangulationIsFine) {
  const auto triangulation = coxeter_a(2, 1);
  const Centre c = centre_of(triangle_at(triangulation, 0.31, 0.17));
  const CircleOracle circle(c.x, c.y - 20, 20);
  EXPECT_FALSE(examine(circle, triangulation, c));
}

TEST(Violation, LimitsAreKept) {
  const auto triangulation = coxeter_a(2, 1);
  const Centre c = centre_of(triangle_at(triangulation, 0.31, 0.17));
  const CircleOracle circle(c.x, c.y, 0.1);
  PerturbedTriangulation near(triangulation, circle);
  const double point[] = {c.x, c.y};
  const std::uint32_t s = near.locate(point);
  ViolationOptions options;
  options.max_simplices = 0;
  EXPECT_FALSE(find_violation(near, std::span(&s, 1), options));
  options = {};
  options.max_pieces = 1;
  EXPECT_FALSE(find_violation(near, std::span(&s, 1), options));
}

}  // namespace
}  // namespace whitney::perturbation
