// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/error.h>
#include <coxeter/quality.h>

#include <cmath>
#include <string>

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

}  // namespace whitney::coxeter
