// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <whitney/tracing/barycentric_kernel.h>

namespace {

using whitney::BarycentricKernel;

// Where the inverse is exact the computed residual vanishes, and what is left of the error bound is what the rounding
// of the residual itself may have hidden: with n = k + 1 terms of |M||B| in each of n entries of a row, (n + 1) u times
// the sum (Higham, Accuracy and Stability, Sect. 3.1). A smaller bound would prove what it has not looked at. B is a
// Hadamard matrix: all weights are 1/n.
TEST(KernelBounds, CoverTheRoundingOfAResidualThatVanishes) {
  constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon() / 2;
  for (const int n : {4, 8, 16}) {
    BarycentricKernel kernel(n - 1);
    std::vector<double> column(n - 1);
    for (int q = 0; q < n; ++q) {
      for (int r = 1; r < n; ++r) column[r - 1] = std::popcount(static_cast<unsigned>(r & q)) % 2 ? -1 : 1;
      kernel.set_vertex(0, q, column.data());
    }
    kernel.factor();
    for (int q = 0; q < n; ++q) EXPECT_EQ(kernel.weight(0, q), 1.0 / n);
    const double row_of_products = n;  // sum over l and j of |M_il||B_lj| = n n / n
    EXPECT_GE(kernel.weight_error(0), (n + 1) * kUnitRoundoff * row_of_products / n) << "n = " << n;
    EXPECT_LE(kernel.weight_error(0), 1e-12);
  }
}

}  // namespace
