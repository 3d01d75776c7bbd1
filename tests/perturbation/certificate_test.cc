// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <perturbation/certificate_proof.h>
#include "sphere_oracle.h"

namespace whitney::perturbation {
namespace {

std::vector<const double*> columns(const Eigen::MatrixXd& V) {
  std::vector<const double*> pointers;
  for (Eigen::Index i = 0; i < V.cols(); ++i) pointers.push_back(V.col(i).data());
  return pointers;
}

struct Foot {
  std::vector<double> point, frame;
  FootErrors errors;
  FootView view() const { return {point.data(), frame.data(), errors}; }
};

Foot foot_of(const SphereOracle& oracle, const Eigen::VectorXd& x) {
  Foot foot{std::vector<double>(x.size()), std::vector<double>(x.size() * x.size()), {}};
  EXPECT_TRUE(oracle.foot({x.data(), std::size_t(x.size())}, foot.point, foot.frame, foot.errors));
  return foot;
}

/// A random simplex with its centre near the sphere.
Eigen::MatrixXd random_simplex(std::mt19937_64& random, int d, int n, double size) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd centre(d);
  for (double& c : centre) c = normal(random);
  centre.head(n + 1).normalize();
  centre.tail(d - n - 1) *= 0.2 * size;
  Eigen::MatrixXd V(d, d + 1);
  for (int i = 0; i <= d; ++i)
    for (int c = 0; c < d; ++c) V(c, i) = centre[c] + size * normal(random);
  return V;
}

class OnSpheres : public testing::TestWithParam<std::pair<int, int>> {};

// The theorem on one simplex, against what can be computed by hand: certified means that every k-face is met in exactly
// one point when it is called hit, and in none otherwise.
TEST_P(OnSpheres, CertifiedSimplicesAreMetAsTheCertificateSays) {
  const auto [d, n] = GetParam();
  const int k = d - n;
  const SphereOracle oracle(d, n);
  Certificate certificate(d, n, 1, 1);
  CertificateProver prover(certificate);
  std::mt19937_64 random(d * 10 + n);
  int certified = 0, hit = 0, not_certified = 0, wrong_when_not_certified = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    const double size = 0.05 + 0.3 * (trial % 10) / 10.0;
    const Eigen::MatrixXd V = random_simplex(random, d, n, size);
    const Foot foot = foot_of(oracle, trial % 2 == 0 ? Eigen::VectorXd(V.rowwise().mean()) : Eigen::VectorXd(V.col(0)));
    const auto vertices = columns(V);
    const Proof proof = prover.prove(vertices.data(), foot.view());
    const double margin = proof.margins.margin();
    if (proof.proven()) {
      // At a foot of a vertex the margin is lower than the truth: its h_i is not taken below a thousandth of the
      // largest.
      if (trial % 2 == 0) {
        EXPECT_GT(margin, 1 - 1e-9);
      }
    } else if (margin > 1 + 1e-6) {
      ADD_FAILURE() << "margin " << margin << " but " << to_string(proof.outcome);
    }
    certificate.evaluate(vertices.data(), foot.view());
    int hits = 0;
    bool agrees = true;
    for (std::size_t f = 0; f < certificate.hit_candidates().num(); ++f) {
      Eigen::MatrixXd face(d, k + 1);
      for (int j = 0; j <= k; ++j) face.col(j) = V.col(certificate.hit_candidates()[f][j]);
      const int crossings = oracle.crossings(face);
      agrees = agrees && crossings == (certificate.face_is_hit(f) ? 1 : 0);
      hits += crossings;
    }
    if (proof.proven()) {
      ++certified;
      hit += proof.num_hit > 0;
      EXPECT_TRUE(agrees) << "trial " << trial << " margin " << margin;
      EXPECT_EQ(hits, proof.num_hit);
    } else {
      ++not_certified;
      wrong_when_not_certified += !agrees;
    }
  }
  // The test is worth something only if all three cases occur.
  EXPECT_GT(certified, 100);
  EXPECT_GT(hit, 10);
  EXPECT_GT(wrong_when_not_certified, 10);
  EXPECT_GT(not_certified, 100);
}

INSTANTIATE_TEST_SUITE_P(Certificate, OnSpheres,
                         testing::Values(std::pair{2, 1}, std::pair{3, 2}, std::pair{3, 1}, std::pair{4, 2},
                                         std::pair{4, 3}, std::pair{5, 2}),
                         [](const auto& test) {
                           return "n" + std::to_string(test.param.second) + "d" + std::to_string(test.param.first);
                         });

TEST(Certificate, FigureByHand) {
  // The circle at p = (0, 1): T is the x-axis, N the y-axis. One vertex below, two above.
  const SphereOracle oracle(2, 1);
  Certificate certificate(2, 1, 1, 1);
  Eigen::MatrixXd V(2, 3);
  V << 0, -0.3, 0.3,  //
      0.8, 1.2, 1.2;
  const Foot foot = foot_of(oracle, Eigen::Vector2d(0, 2));
  const Margins margins = certificate.evaluate(columns(V).data(), foot.view());
  ASSERT_TRUE(margins.single_sheet);
  const double leave = 1 - std::sqrt(1 - 0.09);  // h(0.3)
  EXPECT_NEAR(margins.separation, 0.2 / leave, 1e-9);
  // The hit edges run from (0, .8) to (+-.3, 1.2): N^T U = 0.4 / 0.5, r = 0.3.
  EXPECT_NEAR(margins.transversality, 0.8 / 0.3, 1e-9);
  EXPECT_EQ(margins.num_hit, 2);
  EXPECT_EQ(margins.hit_facets, 0b110u);  // opposite to v_1 and v_2
}

TEST(Certificate, EachConditionCanFail) {
  const SphereOracle oracle(2, 1);
  Certificate certificate(2, 1, 1, 1);
  CertificateProver prover(certificate);
  const Foot foot = foot_of(oracle, Eigen::Vector2d(0, 2));
  const auto outcome = [&](const Eigen::MatrixXd& V) { return prover.prove(columns(V).data(), foot.view()).outcome; };
  Eigen::MatrixXd V(2, 3);
  V << 0, -0.3, 0.3, 0.8, 1.2, 1.2;
  EXPECT_EQ(outcome(V), Proof::Outcome::kProven);
  V(0, 1) = -1.01;  // r >= R
  EXPECT_EQ(outcome(V), Proof::Outcome::kSingleSheet);
  V << 0, -0.3, 0.3, -0.99, 1.2, 1.2;  // abs(P_0) > R + sqrt(R^2 - r^2): the far side of the circle may come in
  EXPECT_EQ(outcome(V), Proof::Outcome::kSingleSheet);
  V << 0, -0.3, 0.3, 0.8, 1.02, 1.2;  // v_1 within h(.3) of the tangent
  EXPECT_EQ(outcome(V), Proof::Outcome::kSeparation);
  V << -0.6, 0.6, 0.0, 0.79, 1.21, 1.5;  // the edge v_0 v_1 is flatter than the circle may turn within r = .6
  EXPECT_EQ(outcome(V), Proof::Outcome::kTransversality);
}

TEST(Certificate, ErrorsOfTheOracleCount) {
  SphereOracle oracle(2, 1);
  Certificate certificate(2, 1, 1, 1);
  CertificateProver prover(certificate);
  Eigen::MatrixXd V(2, 3);
  V << 0, -0.3, 0.3, 0.8, 1.2, 1.2;
  const auto proven = [&](FootErrors errors) {
    oracle.state_errors(errors);
    return prover.prove(columns(V).data(), foot_of(oracle, Eigen::Vector2d(0, 2)).view()).proven();
  };
  EXPECT_TRUE(proven({0, 0}));
  EXPECT_TRUE(proven({0.01, 0.01}));
  EXPECT_FALSE(proven({0.2, 0}));
  EXPECT_FALSE(proven({0, 0.5}));
  EXPECT_FALSE(proven({std::numeric_limits<double>::quiet_NaN(), 0}));
  EXPECT_FALSE(proven({std::numeric_limits<double>::infinity(), 0}));
}

TEST(Certificate, FrameMustBeOrthonormal) {
  const SphereOracle oracle(3, 1);
  Certificate certificate(3, 1, 1, 1);
  CertificateProver prover(certificate);
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 1000; ++trial) {
    const Eigen::MatrixXd V = random_simplex(random, 3, 1, 0.05);
    Foot foot = foot_of(oracle, V.rowwise().mean());
    if (!prover.prove(columns(V).data(), foot.view()).proven()) continue;
    for (double& c : foot.frame) c *= 1.01;
    EXPECT_EQ(prover.prove(columns(V).data(), foot.view()).outcome, Proof::Outcome::kFrame);
    return;
  }
  FAIL() << "no certified simplex to start from";
}

TEST(Certificate, PushBringsAFaceToTheTarget) {
  const SphereOracle oracle(4, 2);
  Certificate certificate(4, 2, 1, 1);
  std::mt19937_64 random(5);
  int pushed = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::MatrixXd V = random_simplex(random, 4, 2, 0.1);
    const Foot foot = foot_of(oracle, V.rowwise().mean());
    if (!certificate.evaluate(columns(V).data(), foot.view()).single_sheet) continue;
    struct Copy {
      std::vector<int> face;
      std::vector<double> steps, direction;
    };
    std::vector<Copy> pushes;
    const std::vector<double> fallback{1, 0};
    certificate.for_each_push(0.5, fallback, [&](const Certificate::Push& push) {
      pushes.push_back(
          {{push.face[0], push.face[1]}, {push.steps[0], push.steps[1]}, {push.direction, push.direction + 4}});
    });
    for (const Copy& push : pushes) {
      Eigen::MatrixXd moved = V;
      for (int j = 0; j < 2; ++j)
        for (int c = 0; c < 4; ++c) moved(c, push.face[j]) += push.steps[j] * push.direction[c];
      // The push is along the normal space, so the weights stay as they are and the push is exact while the closest
      // point stays inside the edge.
      certificate.evaluate(columns(moved).data(), foot.view());
      double separation = -1;
      for (std::size_t f = 0; f < certificate.low_faces().num(); ++f)
        if (certificate.low_faces()[f][0] == push.face[0] && certificate.low_faces()[f][1] == push.face[1])
          separation = certificate.separation(f);
      EXPECT_GE(separation, 0.3) << trial;
      ++pushed;
    }
  }
  EXPECT_GT(pushed, 30);
}

TEST(Certificate, RejectsWrongArguments) {
  EXPECT_THROW(Certificate(2, 2, 1, 1), InvalidInput);
  EXPECT_THROW(Certificate(2, 0, 1, 1), InvalidInput);
  EXPECT_THROW(Certificate(32, 1, 1, 1), InvalidInput);
  EXPECT_THROW(Certificate(2, 1, 0, 1), InvalidInput);
  EXPECT_THROW(Certificate(2, 1, 2, 1), InvalidInput);
  EXPECT_THROW(Certificate(2, 1, 1, std::numeric_limits<double>::infinity()), InvalidInput);
  EXPECT_THROW(Certificate(4, 2, 1, 1, 1), InvalidInput);
}

}  // namespace
}  // namespace whitney::perturbation
