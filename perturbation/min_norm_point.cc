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

/// x = sum lambda_i points_i; returns abs(x).
double combine(const double* const* points, int m, int k, const double* lambda, double* x) {
  double squared = 0;
  for (int c = 0; c < k; ++c) {
    double sum = 0;
    for (int i = 0; i < m; ++i) sum += lambda[i] * points[i][c];
    x[c] = sum;
    squared += sum * sum;
  }
  return std::sqrt(squared);
}

void closest_of_segment(const double* a, const double* b, int k, double* lambda) {
  double along = 0, length = 0;
  for (int c = 0; c < k; ++c) {
    const double edge = a[c] - b[c];
    along += a[c] * edge;
    length += edge * edge;
  }
  const double t = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
  lambda[0] = 1 - t;
  lambda[1] = t;
}

/// False when the triangle has next to no area: then another way must be taken.
/// By the regions of the triangle's plane: a corner, an edge or the inside is closest. Ericson, Real-Time Collision
/// Detection (2005), Sect. 5.1.5, with the origin as the point.
bool closest_of_triangle(const double* const* points, int k, double* lambda) {
  const double *a = points[0], *b = points[1], *c = points[2];
  double d1 = 0, d2 = 0, d3 = 0, d4 = 0, d5 = 0, d6 = 0, size = 0;
  for (int i = 0; i < k; ++i) {
    const double ab = b[i] - a[i], ac = c[i] - a[i];
    size += ab * ab + ac * ac;
    d1 -= ab * a[i];
    d2 -= ac * a[i];
    d3 -= ab * b[i];
    d4 -= ac * b[i];
    d5 -= ab * c[i];
    d6 -= ac * c[i];
  }
  const auto set = [&](double x, double y, double z) {
    lambda[0] = x;
    lambda[1] = y;
    lambda[2] = z;
    return true;
  };
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (!(va + vb + vc > 1e-10 * size * size)) return false;  // the squared area, times 4
  if (d1 <= 0 && d2 <= 0) return set(1, 0, 0);
  if (d3 >= 0 && d4 <= d3) return set(0, 1, 0);
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return set(1 - d1 / (d1 - d3), d1 / (d1 - d3), 0);
  if (d6 >= 0 && d5 <= d6) return set(0, 0, 1);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return set(1 - d2 / (d2 - d6), 0, d2 / (d2 - d6));
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return set(0, 1 - t, t);
  }
  const double inverse = 1 / (va + vb + vc);
  return set(1 - vb * inverse - vc * inverse, vb * inverse, vc * inverse);
}

}  // namespace

double MinNormPoint::operator()(const double* const* points, int m, int k, double enough, double* lambda, double* x) {
  if (m == 1) {
    lambda[0] = 1;
    std::copy_n(points[0], k, x);
    return std::sqrt(dot(x, x, k));
  }
  // The mean is a good guess of the direction for faces that are far away, and they are most.
  double length = 0;
  for (int c = 0; c < k; ++c) {
    double sum = 0;
    for (int i = 0; i < m; ++i) sum += points[i][c];
    x[c] = sum;
    length += sum * sum;
  }
  double least = dot(x, points[0], k);
  for (int i = 1; i < m; ++i) least = std::min(least, dot(x, points[i], k));
  length = std::sqrt(length);
  if (least >= enough * length && length > 0) return least / length;

  if (m == 2) {
    closest_of_segment(points[0], points[1], k, lambda);
    return combine(points, m, k, lambda, x);
  }
  if (m == 3 && closest_of_triangle(points, k, lambda)) return combine(points, m, k, lambda, x);
  return wolfe(points, m, k, enough, lambda, x);
}

double MinNormPoint::wolfe(const double* const* points, int m, int k, double enough, double* lambda, double* x) {
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
    double lowest = norm;  // the least of x . points[i]
    if (enter >= 0) lowest = least;
    if (lowest > 0 && lowest * lowest >= enough * enough * norm) {
      std::fill_n(x, k, 0.0);
      for (int a = 0; a < s; ++a)
        for (int c = 0; c < k; ++c) x[c] += weights_[a] * points[active_[a]][c];
      return lowest / std::sqrt(norm);
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
  return combine(points, m, k, lambda, x);
}

}  // namespace whitney::perturbation
