// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/quality.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/LU>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <coxeter/triangulation.h>

namespace whitney::coxeter {
namespace {

void check(int ambient_dim, double edge_length) {
  if (ambient_dim < 1 || ambient_dim > 65534)
    throw InvalidInput("ambient_dim must be in 1 .. 65534, is " + std::to_string(ambient_dim));
  if (!std::isfinite(edge_length) || edge_length <= 0)
    throw InvalidInput("edge_length must be finite and positive, is " + std::to_string(edge_length));
}

}  // namespace

Quality coxeter_a_quality(int ambient_dim, double edge_length) {
  check(ambient_dim, edge_length);
  const double d = ambient_dim;
  const double half = (ambient_dim + 1) / 2;  // integer quotient
  const double s = edge_length / std::sqrt(half * (d + 1 - half) / (d + 1));
  Quality q{};
  q.ambient_dim = ambient_dim;
  q.longest_edge = edge_length;
  q.shortest_edge = s * std::sqrt(d / (d + 1));
  q.smallest_altitude = s / std::sqrt(2.0);
  q.thickness = q.smallest_altitude / edge_length;
  q.width = q.smallest_altitude / std::sqrt(half);
  q.circumradius = s * std::sqrt(d * (d + 2) / (12 * (d + 1)));
  q.inradius = q.smallest_altitude / (d + 1);
  // sqrt(R^2 + g) - R without cancellation, g = 2 s^2 / (d + 1).
  const double g = 2 * s * s / (d + 1);
  q.protection = g / (std::sqrt(q.circumradius * q.circumradius + g) + q.circumradius);
  return q;
}

Quality freudenthal_quality(int ambient_dim, double edge_length) {
  check(ambient_dim, edge_length);
  const double d = ambient_dim;
  const double spacing = edge_length / std::sqrt(d);
  Quality q{};
  q.ambient_dim = ambient_dim;
  q.longest_edge = edge_length;
  q.shortest_edge = spacing;
  q.smallest_altitude = ambient_dim == 1 ? spacing : spacing / std::sqrt(2.0);
  q.thickness = q.smallest_altitude / edge_length;
  q.width = spacing / std::sqrt(d);
  q.circumradius = edge_length / 2;
  q.inradius = spacing / (2 + std::sqrt(2.0) * (d - 1));
  q.protection = ambient_dim == 1 ? edge_length : 0;
  return q;
}

double simplex_width(const Triangulation& triangulation) {
  const int d = triangulation.ambient_dim();
  const Eigen::MatrixXd gram = as_eigen(triangulation.linear()).transpose() * as_eigen(triangulation.linear());
  const double diagonal = gram(0, 0), other = d > 1 ? gram(0, 1) : 0;
  bool symmetric = true;
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j)
      symmetric = symmetric && std::abs(gram(i, j) - (i == j ? diagonal : other)) <= 1e-12 * diagonal;
  double largest = 0;  // squared length of Lambda^-T g
  if (symmetric) {
    // (a I + b J)^-1 = (I - b / (a + d b) J) / a
    const double a = diagonal - other;
    const double beta = -other / (a + d * other) / a;
    for (int ones = 0; ones <= d; ++ones)
      for (int minus = std::max(0, ones - 1); minus <= ones + 1 && ones + minus <= d; ++minus)
        largest = std::max(largest, (ones + minus) / a + beta * (ones - minus) * (ones - minus));
  } else {
    if (d > 12)
      throw InvalidInput("simplex_width: ambient dimension " + std::to_string(d) +
                         " is above 12, and the triangulation is not similar to a Coxeter or Freudenthal one");
    const Eigen::MatrixXd gradients = as_eigen(triangulation.linear()).inverse().transpose();
    Eigen::VectorXi g = Eigen::VectorXi::Constant(d, -1);
    for (;;) {
      if (std::abs(g.sum()) <= 1) largest = std::max(largest, (gradients * g.cast<double>()).squaredNorm());
      int i = 0;
      while (i < d && g[i] == 1) g[i++] = -1;
      if (i == d) break;
      ++g[i];
    }
  }
  return (1 - 1e-6) / std::sqrt(largest);
}

}  // namespace whitney::coxeter
