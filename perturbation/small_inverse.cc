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
  if (k == 3) {
    const double a = M[4] * M[8] - M[5] * M[7], b = M[5] * M[6] - M[3] * M[8], c = M[3] * M[7] - M[4] * M[6];
    const double determinant = M[0] * a + M[1] * b + M[2] * c;
    if (determinant == 0) return false;
    const double r = 1 / determinant;
    X[0] = r * a;
    X[1] = r * (M[2] * M[7] - M[1] * M[8]);
    X[2] = r * (M[1] * M[5] - M[2] * M[4]);
    X[3] = r * b;
    X[4] = r * (M[0] * M[8] - M[2] * M[6]);
    X[5] = r * (M[2] * M[3] - M[0] * M[5]);
    X[6] = r * c;
    X[7] = r * (M[1] * M[6] - M[0] * M[7]);
    X[8] = r * (M[0] * M[4] - M[1] * M[3]);
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
