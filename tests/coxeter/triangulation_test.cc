// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/triangulation.h>

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>

namespace whitney::coxeter {
namespace {

/// Longest Lambda e(U), U a subset of {0 .. d-1}, from the definition.
double brute_force_edge(const Eigen::MatrixXd& linear) {
  double best = 0;
  for (int mask = 1; mask < 1 << linear.cols(); ++mask) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(linear.cols());
    for (int j = 0; j < linear.cols(); ++j)
      if (mask >> j & 1) sum += linear.col(j);
    best = std::max(best, sum.norm());
  }
  return best;
}

/// Some fixed matrices without structure, and a rotation.
Eigen::MatrixXd skew(int d) {
  Eigen::MatrixXd a(d, d);
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) a(i, j) = std::sin(1.0 + 3 * i + 7 * j + i * j);
  return a + 2 * Eigen::MatrixXd::Identity(d, d);
}
Eigen::MatrixXd rotation(int d) { return Eigen::HouseholderQR<Eigen::MatrixXd>(skew(d)).householderQ(); }

TEST(Triangulation, EdgeLengthIsTheLongestEdge) {
  for (int d = 1; d <= 10; ++d) {
    for (const auto& t : {freudenthal(d, 0.3), coxeter_a(d, 0.3)}) {
      EXPECT_EQ(t.edge_length(), 0.3);
      EXPECT_NEAR(brute_force_edge(as_eigen(t.linear())), 0.3, 1e-14);
    }
    const Triangulation t(skew(d), std::vector<double>(d));
    EXPECT_NEAR(t.edge_length(), brute_force_edge(skew(d)), 1e-12);
  }
}

TEST(Triangulation, EdgeLengthSurvivesSimilarities) {
  for (const int d : {1, 3, 30, 100})
    for (const double length : {1e-9, 1.0, 1e9}) {
      const auto moved = coxeter_a(d, 1).transformed(rotation(d) * length, std::vector<double>(d, 1.0));
      EXPECT_NEAR(moved.edge_length() / length, 1, 1e-9);
    }
}

TEST(Triangulation, EdgeLengthIsAnUpperBoundInHighDimension) {
  const int d = 25;
  const Triangulation t(skew(d), std::vector<double>(d));
  EXPECT_GE(t.edge_length(), as_eigen(t.linear()).rowwise().sum().norm());
  EXPECT_TRUE(std::isfinite(t.edge_length()));
}

TEST(Triangulation, CoxeterGramMatrix) {
  for (const int d : {1, 2, 3, 10, 400}) {
    const Eigen::MatrixXd gram = as_eigen(coxeter_a(d, 1).linear()).transpose() * as_eigen(coxeter_a(d, 1).linear());
    const Eigen::MatrixXd expected = Eigen::MatrixXd::Identity(d, d) - Eigen::MatrixXd::Constant(d, d, 1.0 / (d + 1));
    EXPECT_LT((gram / gram(0, 0) - expected / expected(0, 0)).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(Triangulation, FreudenthalSpacingIsExactWhereItCanBe) {
  EXPECT_EQ(freudenthal(4, 2).linear(), Matrix::identity(4));
  EXPECT_EQ(freudenthal(9, 0.75).linear()(3, 3), 0.25);
}

TEST(Triangulation, LatticeCoordinatesInvertCartesian) {
  for (const int d : {1, 4, 40}) {
    const Triangulation t(skew(d), as_vector(Eigen::VectorXd::LinSpaced(d, -1, 1)));
    std::vector<std::int32_t> z(static_cast<std::size_t>(d));
    for (int i = 0; i < d; ++i) z[static_cast<std::size_t>(i)] = 17 * i - 40;
    std::vector<double> x(z.size()), again(z.size());
    t.cartesian(z, x);
    t.cartesian(z, again);
    EXPECT_EQ(x, again);
    const std::vector<double> back = t.lattice_coordinates(x);
    for (int i = 0; i < d; ++i) EXPECT_NEAR(back[i], z[static_cast<std::size_t>(i)], 1e-9);
  }
}

TEST(Triangulation, TransformedMovesThePoints) {
  const Triangulation t = coxeter_a(3, 1), moved = t.transformed(skew(3), std::vector<double>{1, 2, 3});
  const std::vector<std::int32_t> z{3, -1, 4};
  std::vector<double> x(3), y(3);
  t.cartesian(z, x);
  moved.cartesian(z, y);
  const Eigen::VectorXd expected = skew(3) * Eigen::Map<Eigen::VectorXd>(x.data(), 3) + Eigen::Vector3d(1, 2, 3);
  EXPECT_LT((Eigen::Map<Eigen::VectorXd>(y.data(), 3) - expected).norm(), 1e-13);
}

TEST(Triangulation, RejectsBadInput) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(3, 3);
  const std::vector<double> zero(3);
  EXPECT_THROW(Triangulation(Matrix(2, 3), zero), InvalidInput);
  EXPECT_THROW(Triangulation(Matrix(), {}), InvalidInput);
  EXPECT_THROW(Triangulation(one, std::vector<double>(2)), InvalidInput);
  EXPECT_THROW(Triangulation(one * kNan, zero), InvalidInput);
  EXPECT_THROW(Triangulation(one, {0, 0, kInf}), InvalidInput);
  EXPECT_THROW(Triangulation(one * 0, zero), InvalidInput);
  EXPECT_THROW(Triangulation(Eigen::MatrixXd::Ones(3, 3), zero), InvalidInput);
  EXPECT_NO_THROW(Triangulation(one * 1e-200, zero));  // small is not singular
  for (const double length : {0.0, -1.0, kNan, kInf}) {
    EXPECT_THROW(freudenthal(3, length), InvalidInput);
    EXPECT_THROW(coxeter_a(3, length), InvalidInput);
  }
  EXPECT_THROW(freudenthal(0, 1), InvalidInput);
  EXPECT_THROW(coxeter_a(-1, 1), InvalidInput);
  const Triangulation t(one, zero);
  std::vector<double> x(2);
  const std::vector<std::int32_t> z(3);
  EXPECT_THROW(t.cartesian(z, x), InvalidInput);
  EXPECT_THROW(t.lattice_coordinates(x), InvalidInput);
  EXPECT_THROW(t.transformed(Eigen::MatrixXd::Identity(2, 2), zero), InvalidInput);
  EXPECT_THROW(t.transformed(one, std::vector<double>(2)), InvalidInput);
}

}  // namespace
}  // namespace whitney::coxeter
