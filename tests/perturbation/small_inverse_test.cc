// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/small_inverse.h>

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace whitney::perturbation {
namespace {

TEST(SmallInverse, TimesTheMatrixIsTheIdentity) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 1; k <= 9; ++k)
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<double> M(k * k), X(k * k);
      for (double& entry : M) entry = uniform(generator);
      for (int i = 0; i < k; ++i) M[i * k + i] += 3;
      std::vector<double> destroyed = M;
      ASSERT_TRUE(invert(destroyed.data(), X.data(), k));
      for (int i = 0; i < k; ++i)
        for (int j = 0; j < k; ++j) {
          double sum = 0;
          for (int l = 0; l < k; ++l) sum += M[i * k + l] * X[l * k + j];
          EXPECT_NEAR(sum, i == j, 1e-12) << k;
        }
    }
}

TEST(SmallInverse, PivotsWhereTheDiagonalVanishes) {
  std::vector<double> M{0, 0, 0, 2, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 4, 0}, X(16);
  ASSERT_TRUE(invert(M.data(), X.data(), 4));
  EXPECT_EQ(X, (std::vector<double>{0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.25, 0.5, 0, 0, 0}));
}

TEST(SmallInverse, NoneOfASingularMatrix) {
  for (int k = 1; k <= 5; ++k) {
    std::vector<double> M(k * k, 0.0), X(k * k);
    for (int i = 0; i + 1 < k; ++i) M[i * k + i] = 1;
    EXPECT_FALSE(invert(M.data(), X.data(), k)) << k;
  }
}

}  // namespace
}  // namespace whitney::perturbation
