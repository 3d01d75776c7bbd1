// SPDX-License-Identifier: GPL-3.0-or-later
#include <cfenv>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <perturbation/certificate_proof.h>

namespace whitney::perturbation {
namespace {

/// Triangles in the plane, the foot at the origin with the axes as its frame, no errors. v_0 = (a, b) is the vertex
/// nearest to the tangent: (A+) holds if and only if b > h(a), that is, if R_c is above (a^2 + b^2) / (2 b). The other
/// conditions hold by a wide margin.
class NearlyTouching {
 public:
  NearlyTouching(double a, double b) : v_{{a, b}, {0, -0.3}, {0.05, 0.4}} {}

  bool proved(double curvature_radius, double point_error = 0) const {
    Certificate certificate(2, 1, curvature_radius, curvature_radius);
    CertificateProver prover(certificate);
    const double origin[] = {0, 0}, frame[] = {1, 0, 0, 1};
    const double* vertices[] = {v_[0], v_[1], v_[2]};
    return prover.prove(vertices, {origin, frame, {point_error, 0}}).proven();
  }

  /// The least R_c with which the proof succeeds; 0 if there is none.
  double threshold() const {
    double low = bound() * (1 - 1e-9), high = bound() * (1 + 1e-9);
    if (proved(low) || !proved(high)) return 0;
    for (double middle; (middle = low + (high - low) / 2) > low && middle < high;)
      (proved(middle) ? high : low) = middle;
    return high;
  }

  /// (a^2 + b^2) / (2 b) with 11 bits more than a double has.
  long double bound() const {
    const long double a = v_[0][0], b = v_[0][1];
    return (a * a + b * b) / (2 * b);
  }

 private:
  double v_[3][2];
};

// Without directed rounding the last bits are a matter of luck, and half of these proofs would be of something untrue.
TEST(RoundingGuard, NothingUntrueIsProvedInTheLastBits) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> along(0.2, 0.35), above(0.04, 0.08);
  for (int trial = 0; trial < 200; ++trial) {
    const NearlyTouching triangle(along(random), above(random));
    const double threshold = triangle.threshold();
    ASSERT_GT(threshold, 0) << "the triangle tests nothing";
    EXPECT_GT(static_cast<long double>(threshold), triangle.bound());
    EXPECT_LT(threshold, triangle.bound() * (1 + 1e-13L));
  }
}

/// Whether sums round to nearest. (fegetround reads another register than the one that matters on x86-64.)
bool rounds_to_nearest() {
  volatile double one = 1, tiny = 1e-30;
  return one + tiny == one && -one - tiny == -one && one - tiny == one;
}

// The mode belongs to the thread: a proof must hand it back, also when it fails half-way.
TEST(RoundingGuard, TheModeIsBackAfterAProof) {
  const NearlyTouching triangle(0.25, 0.05);
  ASSERT_TRUE(rounds_to_nearest());
  for (const double factor : {0.5, 0.999, 1.001, 2.0}) {
    EXPECT_EQ(triangle.proved(static_cast<double>(triangle.bound()) * factor), factor > 1);
    EXPECT_TRUE(rounds_to_nearest()) << factor;
    std::fesetround(FE_TONEAREST);
  }
}

// (A+) asks for b > h(a + eta) + eta: here h is .0063 to .0068 and b is .01, so that eta decides, while neither of the
// two alone would refuse.
TEST(Errors, AreAddedToTheHeightThatTheManifoldMayReach) {
  const NearlyTouching triangle(0.1, 0.01);
  EXPECT_TRUE(triangle.proved(0.83));
  EXPECT_TRUE(triangle.proved(0.83, 0.002));
  EXPECT_FALSE(triangle.proved(0.83, 0.006));
  EXPECT_TRUE(triangle.proved(83, 0.006));
}

}  // namespace
}  // namespace whitney::perturbation
