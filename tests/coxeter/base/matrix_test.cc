// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/matrix.h>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

TEST(Matrix, HoldsColumnAfterColumn) {
  Matrix M(2, 3, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(M(1, 0), 2);
  EXPECT_EQ(M(0, 2), 5);
  EXPECT_EQ(std::vector<double>(M.col(1).begin(), M.col(1).end()), (std::vector<double>{3, 4}));
  M(0, 2) = 7;
  EXPECT_EQ(M.data()[4], 7);
  EXPECT_EQ(Matrix(2, 2), Matrix(2, 2, {0, 0, 0, 0}));
  EXPECT_EQ(Matrix::identity(2), Matrix(2, 2, {1, 0, 0, 1}));
  EXPECT_NE(Matrix(1, 4), Matrix(2, 2));
}

TEST(Matrix, CopiesWhatLooksLikeAMatrix) {
  struct Hilbert {
    int rows() const { return 2; }
    int cols() const { return 3; }
    float operator()(int i, int j) const { return 1.0f / static_cast<float>(i + j + 1); }
  };
  const Matrix M = Hilbert{};
  EXPECT_EQ(M.rows(), 2);
  EXPECT_EQ(M.cols(), 3);
  EXPECT_EQ(M(1, 2), 0.25);
}

TEST(Matrix, MultipliesAndRefusesWrongSizes) {
  const Matrix M(2, 3, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(multiply(M, std::vector<double>{1, 10, 100}), (std::vector<double>{531, 642}));
  EXPECT_THROW(multiply(M, std::vector<double>{1, 10}), InvalidInput);
  EXPECT_THROW(Matrix(2, 2, {1, 2, 3}), InvalidInput);
  EXPECT_THROW(Matrix(-1, 2), InvalidInput);
  EXPECT_TRUE(all_finite(M.entries()));
  EXPECT_FALSE(all_finite(std::vector<double>{1, NAN}));
}

}  // namespace
}  // namespace whitney
