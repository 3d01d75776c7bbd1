// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/triangulate_problem.h>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/io/read_problem.h>

namespace whitney {
namespace {

TEST(TriangulateProblem, SaysWhatTheVerdictRestsOn) {
  const Problem circle = parse_problem(R"({"variables": ["x","y"], "equations": ["x^2+y^2-1"], "reach": 1,
      "box": [[-2,2],[-2,2]], "triangulation": {"edge_length": 0.3}})",
                                       "p");
  const TriangulatedProblem result = triangulate_problem(circle);
  ASSERT_TRUE(result.report.certificate);
  EXPECT_EQ(result.report.certificate->verdict, "certified");
  EXPECT_EQ(result.report.certificate->reach_source, "caller");
  EXPECT_EQ(result.report.certificate->feet_source, "modelled");
  EXPECT_EQ(result.report.certificate->components, "seeds_searched");
  const TriangulatedProblem sphere = triangulate_problem(
      parse_problem(R"({"named": {"name": "sphere"}, "triangulation": {"edge_length": 0.5}})", "p"));
  EXPECT_EQ(sphere.report.certificate->reach_source, "proven");
  EXPECT_EQ(sphere.report.certificate->feet_source, "proven");
}

TEST(TriangulateProblem, ASetThatCrossesItselfIsAnOutcome) {
  const Problem eight = parse_problem(
      R"json({"variables": ["x","y"], "equations": ["(x^2+y^2)^2 - x^2 + y^2"], "box": [[-2,2],[-2,2]]})json", "p");
  EXPECT_EQ(triangulate_problem(eight).outcome, TriangulatedProblem::Outcome::kNoSubmanifold);
}

TEST(TriangulateProblem, NoInsideOfACurveInSpace) {
  TriangulateProblemOptions options;
  options.inside = true;
  EXPECT_THROW(
      triangulate_problem(parse_problem(R"({"named": {"name": "sphere", "intrinsic_dim": 1, "ambient_dim": 3}})", "p"),
                          options),
      InvalidInput);
}

}  // namespace
}  // namespace whitney
