// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

namespace whitney {

class Matrix;

/// Whatever tells its rows, its columns and its entries m(i, j) as numbers: the matrices of most libraries, and many
/// of their expressions.
template <class M>
concept MatrixLike = !std::same_as<M, Matrix> && requires(const M& m) {
  { m.rows() } -> std::convertible_to<std::ptrdiff_t>;
  { m.cols() } -> std::convertible_to<std::ptrdiff_t>;
  { m(0, 0) } -> std::convertible_to<double>;
};

/// A dense matrix of doubles, column after column: a value that passes through interfaces, so that no library for
/// linear algebra, whose layout depends on compiler flags, has to. It has no arithmetic.
class Matrix {
 public:
  /// 0 x 0.
  Matrix() = default;
  /// Zeros. rows, cols >= 0, else InvalidInput.
  Matrix(std::ptrdiff_t rows, std::ptrdiff_t cols);
  /// From the entries, column after column: rows * cols, else InvalidInput.
  Matrix(std::ptrdiff_t rows, std::ptrdiff_t cols, std::vector<double> entries);
  /// A copy of another library's matrix.
  template <MatrixLike M>
  Matrix(const M& other) : Matrix(other.rows(), other.cols()) {
    for (std::ptrdiff_t j = 0; j < cols_; ++j)
      for (std::ptrdiff_t i = 0; i < rows_; ++i) (*this)(i, j) = other(i, j);
  }
  static Matrix identity(std::ptrdiff_t size);

  std::ptrdiff_t rows() const { return rows_; }
  std::ptrdiff_t cols() const { return cols_; }
  /// 0 <= i < rows(), 0 <= j < cols().
  double& operator()(std::ptrdiff_t i, std::ptrdiff_t j) { return entries_[static_cast<std::size_t>(j * rows_ + i)]; }
  double operator()(std::ptrdiff_t i, std::ptrdiff_t j) const {
    return entries_[static_cast<std::size_t>(j * rows_ + i)];
  }
  double* data() { return entries_.data(); }
  const double* data() const { return entries_.data(); }
  std::span<const double> entries() const { return entries_; }
  /// Column j.
  std::span<const double> col(std::ptrdiff_t j) const {
    return {entries_.data() + j * rows_, static_cast<std::size_t>(rows_)};
  }

  friend bool operator==(const Matrix&, const Matrix&) = default;

 private:
  std::ptrdiff_t rows_ = 0, cols_ = 0;
  std::vector<double> entries_;
};

/// M x, each entry a sum from left to right. Throws InvalidInput when x has not as many entries as M columns.
std::vector<double> multiply(const Matrix& M, std::span<const double> x);

/// Whether all are finite.
bool all_finite(std::span<const double> x);

}  // namespace whitney
