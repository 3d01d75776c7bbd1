// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/verdict.h>

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tests/perturbation/circle_oracle.h>

#include <coxeter/quality.h>

namespace whitney::perturbation {
namespace {

using coxeter::coxeter_a;

CertificateReport verdict_on(const CircleOracle& circle, double edge_length, std::vector<double> seed) {
  const auto triangulation = coxeter_a(2, edge_length);
  PerturbedTriangulation near(triangulation, circle);
  const std::uint32_t start = find_start(near, seed);
  const HitWalk walk = walk_hit_facets(near, std::span(&start, 1));
  return certify(near, walk, coxeter::simplex_width(triangulation));
}

TEST(VerdictBasis, IsTakenFromTheOracle) {
  CircleOracle circle(0.013, 0.027, 1);
  const std::vector<double> seed{1.013, 0.027};
  const CertificateReport proven = verdict_on(circle, 0.1, seed);
  ASSERT_EQ(proven.verdict, Verdict::kCertified) << proven.reason;
  EXPECT_TRUE(proven.basis.unconditional());
  EXPECT_EQ(proven.basis.components, Components::kOfSeeds);
  EXPECT_EQ(describe(proven), "certified");

  circle.source = ReachSource::kCaller;
  const CertificateReport caller = verdict_on(circle, 0.1, seed);
  EXPECT_EQ(caller.basis.reach, ReachSource::kCaller);
  EXPECT_FALSE(caller.basis.unconditional());
  EXPECT_EQ(describe(caller), "certified, if the reach is at least what the caller says");

  circle.source = ReachSource::kEstimated;
  circle.promised.errors = FootPromise::Errors::kModelled;
  const CertificateReport guessed = verdict_on(circle, 0.1, seed);
  ASSERT_EQ(guessed.verdict, Verdict::kCertified);
  EXPECT_EQ(guessed.basis.feet.errors, FootPromise::Errors::kModelled);
  EXPECT_EQ(describe(guessed),
            "certified, if the reach is at least what was estimated and the errors of the feet are at most what is "
            "modelled");

  circle.source = ReachSource::kProven;
  EXPECT_EQ(describe(verdict_on(circle, 0.1, seed)),
            "certified, if the errors of the feet are at most what is modelled");
}

TEST(VerdictBasis, AViolationHasItsConditionsToo) {
  // Inside one triangle: emptiness is told by distances, whatever the reach.
  const std::vector<double> v = triangle_at(coxeter_a(2, 1), 0.31, 0.17);
  const double x = (v[0] + v[2] + v[4]) / 3, y = (v[1] + v[3] + v[5]) / 3;
  CircleOracle circle(x, y, 0.1);
  circle.source = ReachSource::kEstimated;
  const CertificateReport missed = verdict_on(circle, 1, {x + 0.1, y});
  ASSERT_EQ(missed.verdict, Verdict::kViolated) << missed.reason;
  EXPECT_EQ(describe(missed), "violated");
  // And with local feet it is not claimed.
  circle.promised.place = FootPromise::Place::kLocal;
  const CertificateReport open = verdict_on(circle, 1, {x + 0.1, y});
  EXPECT_EQ(open.verdict, Verdict::kNotCertified);
  EXPECT_EQ(describe(open), "not certified");
  // Two points on an edge rest on the reach.
  CircleOracle across((v[0] + v[2]) / 2, (v[1] + v[3]) / 2, 0.2);
  across.source = ReachSource::kEstimated;
  const CertificateReport twice = verdict_on(across, 1, {(v[0] + v[2]) / 2 + 0.2, (v[1] + v[3]) / 2});
  ASSERT_EQ(twice.verdict, Verdict::kViolated) << twice.reason;
  EXPECT_EQ(describe(twice), "violated, if the reach is at least what was estimated");
}

TEST(Verdict, Words) {
  EXPECT_STREQ(to_string(Verdict::kCertified), "certified");
  EXPECT_STREQ(to_string(Verdict::kViolated), "violated");
  EXPECT_STREQ(to_string(Verdict::kNotCertified), "not certified");
  EXPECT_STREQ(to_string(Components::kOfSeeds), "those of the seeds");
  EXPECT_STREQ(to_string(Components::kLikelyAll), "likely all");
  EXPECT_STREQ(to_string(Components::kAll), "all");
}

TEST(Verdict, OfAnEmptyTrace) {
  const CircleOracle circle(0, 0, 1);
  const auto triangulation = coxeter_a(2, 0.1);
  PerturbedTriangulation near(triangulation, circle);
  const CertificateReport report = certify(near, HitWalk{}, coxeter::simplex_width(triangulation));
  EXPECT_EQ(report.verdict, Verdict::kNotCertified);
  EXPECT_EQ(report.margin_min, 0);
  EXPECT_EQ(report.reason, "no simplex meets the manifold");
}

}  // namespace
}  // namespace whitney::perturbation
