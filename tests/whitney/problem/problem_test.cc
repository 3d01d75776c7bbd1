// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/problem.h>

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

TEST(Problem, ABoxFromItsSides) {
  EXPECT_FALSE(to_box({}));
  const Box box = *to_box({{-1, 2}, {0, 3}});
  EXPECT_EQ(box.lower, (std::vector<double>{-1, 0}));
  EXPECT_EQ(box.upper, (std::vector<double>{2, 3}));
}

TEST(RandomRotation, IsARotationAndFixed) {
  for (int d : {1, 2, 3, 4, 7, 10, 40}) {
    for (std::uint64_t seed : {1, 2, 3}) {
      const Eigen::MatrixXd Q = random_rotation(d, seed);
      EXPECT_LT((Q.transpose() * Q - Eigen::MatrixXd::Identity(d, d)).cwiseAbs().maxCoeff(), 1e-14);
      EXPECT_NEAR(Q.determinant(), 1, 1e-12);
      EXPECT_EQ(Q, random_rotation(d, seed));
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
    const Eigen::MatrixXd Q = random_rotation(d, seed);
    mean += Q / n;
    variance += Q.cwiseAbs2() / n;
  }
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 5 / std::sqrt(3.0 * n));
  EXPECT_LT((variance.array() - 1.0 / d).abs().maxCoeff(), 0.015);
}

TEST(MakeTriangulation, FollowsTheSpec) {
  TriangulationSpec spec;
  spec.offset = TriangulationSpec::Offset::kZero;
  const coxeter::Triangulation plain = make_triangulation(spec, 4, 0.3);
  EXPECT_EQ(plain.linear(), coxeter::coxeter_a(4, 0.3).linear());
  EXPECT_TRUE(plain.offset().isZero(0));

  spec.type = TriangulationSpec::Type::kFreudenthal;
  EXPECT_EQ(make_triangulation(spec, 4, 2).linear(), Eigen::MatrixXd::Identity(4, 4));

  spec.rotation = TriangulationSpec::Rotation::kRandom;
  spec.rng_seed = 5;
  EXPECT_LT((make_triangulation(spec, 4, 2).linear() - random_rotation(4, 5)).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_TRUE(make_triangulation(spec, 4, 2).offset().isZero(0));

  spec.offset = TriangulationSpec::Offset::kGiven;
  spec.given_offset = {1, 2, 3, 4};
  EXPECT_EQ(make_triangulation(spec, 4, 2).offset(), Eigen::Vector4d(1, 2, 3, 4));
  EXPECT_THROW(make_triangulation(spec, 3, 2), InvalidInput);
}

TEST(MakeTriangulation, RandomOffsetIsUniformInACell) {
  TriangulationSpec spec;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  constexpr int n = 2000;
  for (int seed = 0; seed < n; ++seed) {
    spec.rng_seed = seed;
    spec.rotation = seed % 2 != 0 ? TriangulationSpec::Rotation::kRandom : TriangulationSpec::Rotation::kNone;
    const coxeter::Triangulation t = make_triangulation(spec, 3, 0.5);
    const Eigen::Vector3d u = t.linear().partialPivLu().solve(t.offset());
    EXPECT_GE(u.minCoeff(), -1e-14);
    EXPECT_LT(u.maxCoeff(), 1 + 1e-14);
    mean += u / n;
    EXPECT_EQ(make_triangulation(spec, 3, 0.5).offset(), t.offset());
  }
  EXPECT_LT((mean.array() - 0.5).abs().maxCoeff(), 5 / std::sqrt(12.0 * n));
}

TEST(MakeTriangulation, RejectsBadInput) {
  EXPECT_THROW(make_triangulation({}, 0, 1), InvalidInput);
  EXPECT_THROW(make_triangulation({}, -3, 1), InvalidInput);
  EXPECT_THROW(make_triangulation({}, 3, 0), InvalidInput);
  EXPECT_THROW(make_triangulation({}, 3, NAN), InvalidInput);
}

}  // namespace
}  // namespace whitney
