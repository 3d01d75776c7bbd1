// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/placement.h>

#include <cmath>
#include <cstdint>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>

namespace whitney::coxeter {
namespace {

TEST(RandomRotation, IsARotationAndFixed) {
  for (int d : {1, 2, 3, 4, 7, 10, 40}) {
    for (std::uint64_t seed : {1, 2, 3}) {
      const Eigen::MatrixXd Q = as_eigen(random_rotation(d, seed));
      EXPECT_LT((Q.transpose() * Q - Eigen::MatrixXd::Identity(d, d)).cwiseAbs().maxCoeff(), 1e-14);
      EXPECT_NEAR(Q.determinant(), 1, 1e-12);
      EXPECT_EQ(random_rotation(d, seed), random_rotation(d, seed));
    }
  }
  EXPECT_NE(random_rotation(3, 1), random_rotation(3, 2));
  EXPECT_THROW(random_rotation(0, 1), InvalidInput);
}

TEST(RandomRotation, IsUniform) {
  // Over many seeds: entries have mean 0 and variance 1/d, in every place.
  constexpr int d = 3, n = 20000;
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero(), variance = Eigen::Matrix3d::Zero();
  for (int seed = 0; seed < n; ++seed) {
    const Eigen::MatrixXd Q = as_eigen(random_rotation(d, seed));
    mean += Q / n;
    variance += Q.cwiseAbs2() / n;
  }
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 5 / std::sqrt(3.0 * n));
  EXPECT_LT((variance.array() - 1.0 / d).abs().maxCoeff(), 0.015);
}

}  // namespace
}  // namespace whitney::coxeter
