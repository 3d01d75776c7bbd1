// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/small_inverse.h>

#include <algorithm>
#include <cmath>

namespace whitney::perturbation {

bool invert(double* M, double* X, int k) {
  if (k == 1) {
    if (M[0] == 0) return false;
    X[0] = 1 / M[0];
    return true;
  }
  if (k == 2) {
    const double determinant = M[0] * M[3] - M[1] * M[2];
    if (determinant == 0) return false;
    X[0] = M[3] / determinant;
    X[1] = -M[1] / determinant;
    X[2] = -M[2] / determinant;
    X[3] = M[0] / determinant;
    return true;
  }
  std::fill_n(X, k * k, 0.0);
  for (int i = 0; i < k; ++i) X[i * k + i] = 1;
  for (int c = 0; c < k; ++c) {
    int pivot = c;
    for (int i = c + 1; i < k; ++i)
      if (std::abs(M[i * k + c]) > std::abs(M[pivot * k + c])) pivot = i;
    if (M[pivot * k + c] == 0) return false;
    if (pivot != c) {
      std::swap_ranges(M + pivot * k, M + pivot * k + k, M + c * k);
      std::swap_ranges(X + pivot * k, X + pivot * k + k, X + c * k);
    }
    const double scale = 1 / M[c * k + c];
    for (int j = 0; j < k; ++j) {
      M[c * k + j] *= scale;
      X[c * k + j] *= scale;
    }
    for (int i = 0; i < k; ++i) {
      const double factor = M[i * k + c];
      if (i == c || factor == 0) continue;
      for (int j = 0; j < k; ++j) {
        M[i * k + j] -= factor * M[c * k + j];
        X[i * k + j] -= factor * X[c * k + j];
      }
    }
  }
  return true;
}

}  // namespace whitney::perturbation
