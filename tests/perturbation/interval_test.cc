// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/interval.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>

namespace whitney::perturbation {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

TEST(Interval, TheGuardMakesAllOperationsRoundOutward) {
  // Without it they do not, and that is noticed.
  EXPECT_NE(rounding_defect(), "");
  {
    const Rounding rounding;
    EXPECT_EQ(rounding_defect(), "");
    {
      const Rounding nested;
      EXPECT_EQ(rounding_defect(), "");
    }
    EXPECT_EQ(rounding_defect(), "");
  }
  EXPECT_NE(rounding_defect(), "");
  EXPECT_NO_THROW(require_directed_rounding());
}

TEST(Interval, TheGuardLeavesTheRoundingAsItFoundIt) {
  volatile double one = 1, tiny = kEps / 1024;
  {
    const Rounding rounding;
    EXPECT_GT(one + tiny, 1);
  }
  EXPECT_EQ(one + tiny, 1);
}

TEST(Interval, HoldsTheExactResultOfALongSum) {
  // sum of 1/2 + 1/2 eps a million times over, exactly 5e5 (1 + eps).
  const Rounding rounding;
  Interval sum(0);
  for (int i = 0; i < 1'000'000; ++i) sum += Interval(0.5) * Interval(1 + kEps);
  EXPECT_LE(sum.inf(), 5e5);
  EXPECT_GE(sum.sup(), std::nextafter(5e5, 1e6));
}

TEST(Interval, Distances) {
  const double x[] = {0, 0, 0}, y[] = {1, 2, 2}, z[] = {1, 1, 0};
  const Rounding rounding;
  EXPECT_EQ(distance_above(x, y), 3);
  EXPECT_EQ(distance_below(x, y), 3);
  EXPECT_EQ(distance_below(y, y), 0);
  const double low = distance_below(x, z), high = distance_above(x, z);
  EXPECT_LT(std::fma(low, low, -2.0), 0);
  EXPECT_GT(std::fma(high, high, -2.0), 0);
  EXPECT_LE(high, low * (1 + 4 * kEps));
}

TEST(Interval, NormsAreBoundsAndNotFarOff) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  for (const auto& [rows, cols] : {std::pair{1, 1}, {1, 5}, {2, 2}, {2, 6}, {5, 2}, {3, 3}, {4, 7}, {7, 4}}) {
    Eigen::MatrixXd A(rows, cols);
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < cols; ++c) A(r, c) = normal(generator);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A.transpose() * A, Eigen::EigenvaluesOnly);
    const double norm = std::sqrt(solver.eigenvalues().maxCoeff());
    std::vector<Interval> entries;
    const Rounding rounding;
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < cols; ++c) entries.emplace_back(A(r, c));
    const double bound = norm_above(entries, rows, cols);
    EXPECT_GE(bound, norm * (1 - 1e-13)) << rows << " x " << cols;
    EXPECT_LE(bound, norm * 1.1) << rows << " x " << cols;
    // A wider matrix has a larger norm.
    for (Interval& entry : entries) entry += ball(0.01);
    EXPECT_GT(norm_above(entries, rows, cols), bound);
  }
}

TEST(Interval, NormsOutOfRangeAreInfinite) {
  const Rounding rounding;
  const std::vector<Interval> huge{Interval(1e80)}, zero(9, Interval(0));
  EXPECT_EQ(norm_above(huge, 1, 1), std::numeric_limits<double>::infinity());
  EXPECT_EQ(norm_above(zero, 3, 3), 0);
}

}  // namespace
}  // namespace whitney::perturbation
