// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/barycentric_kernel.h>

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <whitney/tracing/exact_pivot.h>

namespace {

using whitney::BarycentricKernel;
constexpr int kLanes = BarycentricKernel::kLanes;

struct Case {
  std::vector<std::vector<double>> columns;  // k + 1
  std::vector<double> w;
};

// Random columns shifted so that a random positive combination of them vanishes: a simplex that is hit.
Case random_hit(int k, double scale, std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  Case out{std::vector(k + 1, std::vector<double>(k)), std::vector<double>(k)};
  std::vector<double> mean(k, 0.0), weight(k + 1);
  double total = 0;
  for (double& x : weight) total += x = std::abs(normal(rng)) + 1e-3;
  for (int q = 0; q <= k; ++q)
    for (int r = 0; r < k; ++r) mean[r] += weight[q] / total * (out.columns[q][r] = scale * normal(rng));
  for (auto& column : out.columns)
    for (int r = 0; r < k; ++r) column[r] -= mean[r];
  for (double& x : out.w) x = scale * normal(rng);
  return out;
}

std::vector<const double*> pointers(const Case& c) {
  std::vector<const double*> out;
  for (const auto& column : c.columns) out.push_back(column.data());
  return out;
}

class Kernel : public testing::TestWithParam<int> {};

TEST_P(Kernel, DecisionsAgreeWithExactArithmeticInEveryLane) {
  const int k = GetParam();
  BarycentricKernel kernel(k);
  std::mt19937_64 rng(k);
  int undecided = 0, wrong = 0;
  double worst = 0;
  for (int batch = 0; batch < 20; ++batch) {
    std::vector<Case> cases;
    for (int lane = 0; lane < kLanes; ++lane) {
      cases.push_back(random_hit(k, std::pow(10.0, lane - 4), rng));
      for (int q = 0; q <= k; ++q) kernel.set_vertex(lane, q, cases[lane].columns[q].data());
    }
    kernel.factor();
    for (int lane = 0; lane < kLanes; ++lane) kernel.set_candidate(lane, cases[lane].w.data());
    kernel.pivot();
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto columns = pointers(cases[lane]);
      if (!whitney::exactly_hit(columns)) continue;
      const auto weights = whitney::exact_weights(columns);
      for (int q = 0; q <= k; ++q) {
        const double error = std::abs(kernel.weight(lane, q) - weights[q]);
        EXPECT_LE(error, kernel.weight_error(lane) + 1e-16);
        worst = std::max(worst, error);
      }
      if (kernel.leaving(lane) == BarycentricKernel::kUndecided)
        ++undecided;
      else
        wrong += kernel.leaving(lane) != whitney::exactly_leaving(columns, cases[lane].w.data());
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_LE(undecided, 2);
  EXPECT_LT(worst, 1e-9);
}

TEST_P(Kernel, ResultsDoNotDependOnTheLane) {
  const int k = GetParam();
  std::mt19937_64 rng(7);
  const Case c = random_hit(k, 1, rng);
  BarycentricKernel kernel(k);
  for (int lane = 0; lane < kLanes; ++lane) {
    const Case other = random_hit(k, 1, rng);
    for (int q = 0; q <= k; ++q) kernel.set_vertex(lane, q, lane % 3 ? other.columns[q].data() : c.columns[q].data());
  }
  kernel.factor();
  BarycentricKernel alone(k);
  for (int q = 0; q <= k; ++q) alone.set_vertex(5, q, c.columns[q].data());
  alone.factor();
  for (int q = 0; q <= k; ++q)
    for (int lane = 0; lane < kLanes; lane += 3) EXPECT_EQ(kernel.weight(lane, q), alone.weight(5, q));
}

// Beyond 12 the size is a run-time value.
INSTANTIATE_TEST_SUITE_P(Codimensions, Kernel, testing::Values(1, 2, 3, 5, 8, 12, 13, 30));

TEST(BarycentricKernel, TiesAndSingularMatricesAreUndecided) {
  BarycentricKernel kernel(2);
  const double a[] = {1, 0}, b[] = {-1, 1}, c[] = {-1, -1};
  auto load = [&](const double* u, const double* v, const double* w) {
    kernel.set_vertex(0, 0, u);
    kernel.set_vertex(0, 1, v);
    kernel.set_vertex(0, 2, w);
    kernel.factor();
  };
  load(a, b, c);
  EXPECT_TRUE(kernel.reliable(0));
  kernel.set_candidate(0, a);  // w equals vertex 0: that one leaves, no tie
  kernel.pivot();
  EXPECT_EQ(kernel.leaving(0), 0);
  const double zero[] = {0, 0};  // the ratios of all three are equal
  kernel.set_candidate(0, zero);
  kernel.pivot();
  EXPECT_EQ(kernel.leaving(0), BarycentricKernel::kUndecided);
  load(a, a, c);
  EXPECT_FALSE(kernel.reliable(0));
  kernel.set_candidate(0, b);
  kernel.pivot();
  EXPECT_EQ(kernel.leaving(0), BarycentricKernel::kUndecided);
}

TEST(BarycentricKernel, SignsDecideForOneEquation) {
  BarycentricKernel kernel(1);
  const double values[] = {0.0, 3.0, -2.0};
  kernel.set_vertex(0, 0, &values[0]);  // zero counts as negative
  kernel.set_vertex(0, 1, &values[1]);
  kernel.factor();
  EXPECT_EQ(kernel.weight(0, 0), 1.0);
  kernel.set_candidate(0, &values[2]);
  kernel.pivot();
  EXPECT_EQ(kernel.leaving(0), 0);
  kernel.set_candidate(0, &values[1]);
  kernel.pivot();
  EXPECT_EQ(kernel.leaving(0), 1);
}

}  // namespace
