// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/min_norm_point.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace whitney::perturbation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Optimality decides: x is the point of least norm of the hull exactly when x . p_i >= x . x for all i.
void expect_optimal(const std::vector<std::vector<double>>& points, double scale) {
  const int m = static_cast<int>(points.size()), k = static_cast<int>(points[0].size());
  std::vector<const double*> pointers;
  for (const auto& p : points) pointers.push_back(p.data());
  std::vector<double> lambda(m), x(k);
  MinNormPoint min_norm;
  const double length = min_norm(pointers.data(), m, k, kInfinity, lambda.data(), x.data());
  double sum = 0, squared = 0;
  std::vector<double> combination(k, 0.0);
  for (int i = 0; i < m; ++i) {
    EXPECT_GE(lambda[i], 0);
    sum += lambda[i];
    for (int c = 0; c < k; ++c) combination[c] += lambda[i] * points[i][c];
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  for (int c = 0; c < k; ++c) {
    EXPECT_NEAR(combination[c], x[c], 1e-12 * scale);
    squared += x[c] * x[c];
  }
  EXPECT_NEAR(std::sqrt(squared), length, 1e-12 * scale);
  for (int i = 0; i < m; ++i) {
    double along = 0;
    for (int c = 0; c < k; ++c) along += x[c] * points[i][c];
    EXPECT_GE(along, squared - 2e-9 * scale * scale) << "m " << m << " k " << k << " point " << i;
  }
}

TEST(MinNormPoint, IsOptimalForRandomPoints) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const double shift : {0.0, 0.5, 3.0})
    for (int m = 1; m <= 9; ++m)
      for (int k = 1; k <= 8; ++k)
        for (int trial = 0; trial < 60; ++trial) {
          std::vector<std::vector<double>> points(m, std::vector<double>(k));
          for (auto& p : points) {
            for (double& c : p) c = normal(random);
            p[0] += shift;
          }
          expect_optimal(points, 4);
        }
}

TEST(MinNormPoint, DegenerateInput) {
  expect_optimal({{1, 0}, {1, 0}, {1, 0}}, 1);                      // one point three times
  expect_optimal({{1, -1}, {1, 0}, {1, 1}}, 1);                     // on a line
  expect_optimal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1);  // the origin itself
  expect_optimal({{1, 1, 1}, {1, 1, 1}, {1, -1, 1}, {-1, 1, 1}, {-1, -1, 1}}, 2);
}

TEST(MinNormPoint, StopsWithADirectionWhenTheDistanceIsEnough) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  int stopped = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const int m = 1 + trial % 7, k = 1 + trial % 5;
    std::vector<std::vector<double>> points(m, std::vector<double>(k));
    std::vector<const double*> pointers;
    for (auto& p : points) {
      for (double& c : p) c = normal(random);
      p[0] += 3;
      pointers.push_back(p.data());
    }
    std::vector<double> lambda(m), x(k);
    MinNormPoint min_norm;
    const double exact = min_norm(pointers.data(), m, k, kInfinity, lambda.data(), x.data());
    const double enough = 1;
    const double bound = min_norm(pointers.data(), m, k, enough, lambda.data(), x.data());
    EXPECT_LE(bound, exact * (1 + 1e-9));
    if (exact < enough * (1 - 1e-9)) {
      EXPECT_NEAR(bound, exact, 1e-9);
      continue;
    }
    ++stopped;
    EXPECT_GE(bound, enough * (1 - 1e-9));
    double length = 0;
    for (const double c : x) length += c * c;
    for (const auto& p : points) {
      double along = 0;
      for (int c = 0; c < k; ++c) along += x[c] * p[c];
      EXPECT_GE(along, enough * std::sqrt(length) * (1 - 1e-9));
    }
  }
  EXPECT_GT(stopped, 300);
}

}  // namespace
}  // namespace whitney::perturbation
