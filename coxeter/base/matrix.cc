// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/matrix.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

std::size_t checked_size(std::ptrdiff_t rows, std::ptrdiff_t cols) {
  if (rows < 0 || cols < 0) {
    throw InvalidInput("rows and cols must not be negative, are " + std::to_string(rows) + " and " +
                       std::to_string(cols));
  }
  return static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols);
}

}  // namespace

Matrix::Matrix(std::ptrdiff_t rows, std::ptrdiff_t cols)
    : rows_(rows), cols_(cols), entries_(checked_size(rows, cols)) {}

Matrix::Matrix(std::ptrdiff_t rows, std::ptrdiff_t cols, std::vector<double> entries)
    : rows_(rows), cols_(cols), entries_(std::move(entries)) {
  if (entries_.size() != checked_size(rows, cols)) {
    throw InvalidInput("a " + std::to_string(rows) + " x " + std::to_string(cols) + " matrix cannot have " +
                       std::to_string(entries_.size()) + " entries");
  }
}

Matrix Matrix::identity(std::ptrdiff_t size) {
  Matrix result(size, size);
  for (std::ptrdiff_t i = 0; i < size; ++i) result(i, i) = 1;
  return result;
}

std::vector<double> multiply(const Matrix& M, std::span<const double> x) {
  if (static_cast<std::ptrdiff_t>(x.size()) != M.cols())
    throw InvalidInput("x must have as many entries as the matrix has columns");
  std::vector<double> result(static_cast<std::size_t>(M.rows()), 0.0);
  for (std::ptrdiff_t j = 0; j < M.cols(); ++j) {
    const std::span<const double> column = M.col(j);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += column[i] * x[static_cast<std::size_t>(j)];
  }
  return result;
}

bool all_finite(std::span<const double> x) {
  return std::ranges::all_of(x, [](double value) { return std::isfinite(value); });
}

}  // namespace whitney
