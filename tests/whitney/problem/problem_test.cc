// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/problem.h>

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <coxeter/placement.h>

namespace whitney {
namespace {

TEST(Problem, ABoxFromItsSides) {
  EXPECT_FALSE(to_box({}));
  const Box box = *to_box({{-1, 2}, {0, 3}});
  EXPECT_EQ(box.lower, (std::vector<double>{-1, 0}));
  EXPECT_EQ(box.upper, (std::vector<double>{2, 3}));
}

TEST(MakeTriangulation, FollowsTheSpec) {
  TriangulationSpec spec;
  spec.offset = TriangulationSpec::Offset::kZero;
  const coxeter::Triangulation plain = make_triangulation(spec, 4, 0.3);
  EXPECT_EQ(plain.linear(), coxeter::coxeter_a(4, 0.3).linear());
  EXPECT_EQ(plain.offset(), std::vector<double>(4));

  spec.type = TriangulationSpec::Type::kFreudenthal;
  EXPECT_EQ(make_triangulation(spec, 4, 2).linear(), Matrix::identity(4));

  spec.rotation = TriangulationSpec::Rotation::kRandom;
  spec.rng_seed = 5;
  const Matrix linear = make_triangulation(spec, 4, 2).linear(), Q = coxeter::random_rotation(4, 5);
  EXPECT_LT((as_eigen(linear) - as_eigen(Q)).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(make_triangulation(spec, 4, 2).offset(), std::vector<double>(4));

  spec.offset = TriangulationSpec::Offset::kGiven;
  spec.given_offset = {1, 2, 3, 4};
  EXPECT_EQ(make_triangulation(spec, 4, 2).offset(), (std::vector<double>{1, 2, 3, 4}));
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
    const Eigen::Vector3d u = as_eigen(t.linear()).partialPivLu().solve(as_eigen(t.offset()));
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
