// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/min_norm_point.h>

#include <algorithm>
#include <cmath>

namespace whitney::perturbation {
namespace {

double dot(const double* a, const double* b, int k) {
  double sum = 0;
  for (int c = 0; c < k; ++c) sum += a[c] * b[c];
  return sum;
}

/// Solves (G + J) y = 1 for the s active points, J all ones, by Cholesky; y / sum(y) are the coordinates of the point
/// of least norm in their affine hull. False when a pivot vanishes: the points are affinely dependent.
bool least_in_affine_hull(const double* gram, int m, const int* active, int s, double scale, double* factor,
                          double* y) {
  for (int i = 0; i < s; ++i) {
    for (int j = 0; j <= i; ++j) {
      double entry = gram[active[i] * m + active[j]] + scale;
      for (int l = 0; l < j; ++l) entry -= factor[i * m + l] * factor[j * m + l];
      if (i == j) {
        if (!(entry > 1e-14 * (gram[active[i] * m + active[i]] + scale))) return false;
        factor[i * m + i] = std::sqrt(entry);
      } else {
        factor[i * m + j] = entry / factor[j * m + j];
      }
    }
  }
  for (int i = 0; i < s; ++i) {
    double entry = 1;
    for (int l = 0; l < i; ++l) entry -= factor[i * m + l] * y[l];
    y[i] = entry / factor[i * m + i];
  }
  for (int i = s - 1; i >= 0; --i) {
    for (int l = i + 1; l < s; ++l) y[i] -= factor[l * m + i] * y[l];
    y[i] /= factor[i * m + i];
  }
  double sum = 0;
  for (int i = 0; i < s; ++i) sum += y[i];
  if (!(sum > 0)) return false;
  for (int i = 0; i < s; ++i) y[i] /= sum;
  return true;
}

}  // namespace

double MinNormPoint::operator()(const double* const* points, int m, int k, double* lambda, double* x) {
  if (m == 1) {
    lambda[0] = 1;
    std::copy_n(points[0], k, x);
    return dot(x, x, k);
  }
  if (m == 2) {
    const double *a = points[0], *b = points[1];
    double along = 0, length = 0;
    for (int c = 0; c < k; ++c) {
      const double edge = a[c] - b[c];
      along += a[c] * edge;
      length += edge * edge;
    }
    const double t = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
    lambda[0] = 1 - t;
    lambda[1] = t;
    double norm = 0;
    for (int c = 0; c < k; ++c) {
      x[c] = (1 - t) * a[c] + t * b[c];
      norm += x[c] * x[c];
    }
    return norm;
  }
  return wolfe(points, m, k, lambda, x);
}

double MinNormPoint::wolfe(const double* const* points, int m, int k, double* lambda, double* x) {
  gram_.resize(static_cast<std::size_t>(m) * m);
  factor_.resize(gram_.size());
  weights_.resize(m);
  solution_.resize(m);
  active_.resize(m);
  double* gram = gram_.data();
  double scale = 0;
  int start = 0;
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j <= i; ++j) gram[i * m + j] = gram[j * m + i] = dot(points[i], points[j], k);
    scale = std::max(scale, gram[i * m + i]);
    if (gram[i * m + i] < gram[start * m + start]) start = i;
  }
  if (!(scale > 0)) scale = 1;
  // weights_ belong to the active points, in order; x = sum over them.
  int s = 1;
  active_[0] = start;
  weights_[0] = 1;
  double norm = gram[start * m + start];
  for (int major = 0; major < 4 * m + 20; ++major) {
    int enter = -1;
    double least = norm - 1e-13 * scale;
    for (int i = 0; i < m; ++i) {
      double value = 0;  // x . points[i]
      for (int a = 0; a < s; ++a) value += weights_[a] * gram[active_[a] * m + i];
      if (value < least) {
        least = value;
        enter = i;
      }
    }
    if (enter < 0 || std::find(active_.begin(), active_.begin() + s, enter) != active_.begin() + s) break;
    active_[s] = enter;
    weights_[s++] = 0;
    bool solved = true;
    for (;;) {
      solved = least_in_affine_hull(gram, m, active_.data(), s, scale, factor_.data(), solution_.data());
      if (!solved) break;
      double step = 1;
      int leaves = -1;
      for (int a = 0; a < s; ++a) {
        if (solution_[a] > 1e-15) continue;
        const double t = weights_[a] / (weights_[a] - solution_[a]);
        if (leaves < 0 || t < step) {
          step = std::min(1.0, t);
          leaves = a;
        }
      }
      if (leaves < 0) {
        std::copy_n(solution_.begin(), s, weights_.begin());
        break;
      }
      for (int a = 0; a < s; ++a) weights_[a] += step * (solution_[a] - weights_[a]);
      for (int a = leaves; a + 1 < s; ++a) {
        active_[a] = active_[a + 1];
        weights_[a] = weights_[a + 1];
      }
      --s;
      if (s == 1) {
        weights_[0] = 1;
        break;
      }
    }
    double next = 0;
    for (int a = 0; a < s; ++a)
      for (int b = 0; b < s; ++b) next += weights_[a] * weights_[b] * gram[active_[a] * m + active_[b]];
    if (!solved || !(next < norm)) {
      norm = next;
      break;
    }
    norm = next;
  }
  std::fill_n(lambda, m, 0.0);
  double sum = 0;
  for (int a = 0; a < s; ++a) sum += std::max(0.0, weights_[a]);
  for (int a = 0; a < s; ++a) lambda[active_[a]] = std::max(0.0, weights_[a]) / sum;
  std::fill_n(x, k, 0.0);
  for (int i = 0; i < m; ++i)
    if (lambda[i] > 0)
      for (int c = 0; c < k; ++c) x[c] += lambda[i] * points[i][c];
  return dot(x, x, k);
}

}  // namespace whitney::perturbation
