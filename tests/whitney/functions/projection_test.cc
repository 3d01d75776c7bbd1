// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/projection.h>

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>

namespace whitney {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A few hundred points of an ellipsoid in R^d with different half-axes.
std::vector<double> ellipsoid(int d, double scale = 1) {
  std::vector<double> points;
  for (int i = 0; i < 400; ++i) {
    double norm = 0;
    std::vector<double> p;
    for (int k = 0; k < d; ++k) p.push_back(std::sin(1.3 * i + 0.7 * k * i + k));
    for (const double x : p) norm += x * x;
    for (int k = 0; k < d; ++k) points.push_back(scale * (d - k) * (d - k) * p[k] / std::sqrt(norm) + scale * 10 * k);
  }
  return points;
}

TEST(Projection, CoordinatesAreCopiedExactly) {
  const std::vector<double> points = {0.1, 0.2, 0.3, 0.4, -1e300, 1e-300, 3, 4};
  EXPECT_THAT(project(make_projection("4, 1,2", points, 4), points),
              ElementsAre(0.4, 0.1, 0.2, 0.3, 4, -1e300, 1e-300, 3));
}

TEST(Projection, LowDimensionsAreFilledUpWithZeros) {
  const std::vector<double> points = {1, 2, 3, 4};
  EXPECT_THAT(project(make_projection("pca", points, 2), points), ElementsAre(1, 2, 0, 0, 3, 4, 0, 0));
  EXPECT_THAT(project(make_projection("2,1,3", points, 2), points), ElementsAre(2, 1, 0, 0, 4, 3, 0, 0));
  EXPECT_THAT(project(make_projection("pca", points, 1), points),
              ElementsAre(1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 4, 0, 0, 0));
}

TEST(Projection, VariablesMayBeNamed) {
  const std::vector<std::string> names = {"u", "v", "w", "t"};
  const Projection p = make_projection(" t ,u,2", std::vector<double>{0, 0, 0, 0}, 4, names);
  EXPECT_EQ(p.A(0, 3), 1);
  EXPECT_EQ(p.A(1, 0), 1);
  EXPECT_EQ(p.A(2, 1), 1);
  EXPECT_EQ(p.A(3, 2), 1);
}

TEST(Projection, PrincipalDirectionsAreOrthonormalAndOrderedByVariance) {
  for (const int d : {4, 7, 10}) {
    const auto points = ellipsoid(d);
    const Projection p = principal_projection(points, d);
    EXPECT_LT((as_eigen(p.A) * as_eigen(p.A).transpose() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
    const auto placed = project(p, points);
    Eigen::Vector4d mean = Eigen::Vector4d::Zero(), variance = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < placed.size(); ++i) {
      mean[static_cast<int>(i % 4)] += placed[i];
      variance[static_cast<int>(i % 4)] += placed[i] * placed[i];
    }
    EXPECT_LT(mean.norm(), 1e-9 * variance[0]);
    for (int k = 0; k < 3; ++k) EXPECT_GT(variance[k], variance[k + 1]);
    // No orthonormal frame catches more variance than the principal one: here, against the coordinate axes.
    double along_axis = 0;
    for (std::size_t i = 0; i < points.size(); i += static_cast<std::size_t>(d))
      along_axis += std::pow(points[i] - p.center[0], 2);
    EXPECT_GE(variance[0], along_axis * (1 - 1e-12));
  }
}

TEST(Projection, PrincipalDirectionsDoNotDependOnUnitsOrPlace) {
  const auto points = ellipsoid(5);
  const Projection p = principal_projection(points, 5);
  for (const double scale : {1e-9, 1e9, 1e-160, 1e150}) {
    EXPECT_LT((as_eigen(p.A) - as_eigen(principal_projection(ellipsoid(5, scale), 5).A)).norm(), 1e-9) << scale;
  }
  auto moved = points;
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += 100;
  EXPECT_LT((as_eigen(p.A) - as_eigen(principal_projection(moved, 5).A)).norm(), 1e-9);
  // The point set as a whole mirrored: the directions keep their signs.
  for (double& x : moved) x = -x;
  EXPECT_LT((as_eigen(p.A) - as_eigen(principal_projection(moved, 5).A)).norm(), 1e-9);
}

TEST(Projection, EqualVariancesGiveAFixedFrame) {
  // A flat torus has the same variance in all four directions, so rounding alone would choose the frame.
  const auto torus = [](double noise) {
    std::vector<double> points;
    for (int i = 0; i < 60; ++i) {
      for (int j = 0; j < 60; ++j) {
        const double u = 2 * M_PI * i / 60, v = 2 * M_PI * j / 60;
        for (const double x : {std::cos(u), std::sin(u), std::cos(v), std::sin(v)}) {
          points.push_back(x + noise * std::sin(static_cast<double>(points.size())));
        }
      }
    }
    return points;
  };
  const Projection p = principal_projection(torus(0), 4);
  EXPECT_LT((as_eigen(p.A) * as_eigen(p.A).transpose() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
  EXPECT_LT((as_eigen(p.A) - as_eigen(principal_projection(torus(1e-6), 4).A)).norm(), 1e-9);
  // Not along an axis, which would put the torus on a cylinder twice.
  EXPECT_LT(as_eigen(p.A).row(3).cwiseAbs().maxCoeff(), 0.95);
}

TEST(Projection, DegeneratePointsHaveAFrameToo) {
  const std::vector<double> points(4 * 5, 3.0);  // five times the same point
  const Projection p = principal_projection(points, 4);
  EXPECT_LT((as_eigen(p.A) * as_eigen(p.A).transpose() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
  for (const double x : project(p, points)) EXPECT_EQ(x, 0);
}

TEST(Projection, WrongTextIsNamed) {
  const std::vector<double> points(5, 0.0);
  for (const char* text :
       {"", "pc", "1,2", "1,2,3,4", "1,2,6", "0,1,2", "1,1,2", "1,2,x", "-1,2,3", "1,,2", "1.5,2,3"}) {
    EXPECT_THROW(make_projection(text, points, 5), InvalidInput) << text;
  }
  try {
    make_projection("1,2,seven", points, 5);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("\"seven\""));
  }
  EXPECT_THROW(make_projection("pca", {}, 5), InvalidInput);
  EXPECT_THROW(make_projection("pca", points, 4), InvalidInput);
  EXPECT_THROW(make_projection("pca", points, 5, std::vector<std::string>{"a"}), InvalidInput);
}

}  // namespace
}  // namespace whitney
