// SPDX-License-Identifier: GPL-3.0-or-later
// The traceable cases of theory, and motions of them, for the tests of the tracer and of what comes after it.
#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include <coxeter/base/eigen_view.h>
#include <coxeter/triangulation.h>
#include <whitney/functions/combinators.h>
#include <whitney/functions/function.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/tracing/trace.h>

namespace whitney::testing {

/// An isomanifold with a point on it and what theory says about it.
struct TraceCase {
  std::string name;
  Function function;
  std::vector<double> seeds;
  double edge_length;
  long euler_characteristic;
  std::size_t components;
  std::vector<std::string> homology;  ///< H_0 .. H_n

  int dim() const { return function.ambient_dim() - function.codim(); }
};

/// A fixed rotation (the Q factor of a fixed matrix) and shift in R^d.
inline Eigen::MatrixXd fixed_rotation(int d) {
  Eigen::MatrixXd A(d, d);
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) A(i, j) = std::sin(1.0 + 3.7 * i + 1.3 * j * j + (i == j ? 2.0 : 0.0));
  Eigen::MatrixXd Q = A.householderQr().householderQ();
  if (Q.determinant() < 0) Q.col(0) *= -1;
  return Q;
}
inline Eigen::VectorXd fixed_shift(int d) {
  Eigen::VectorXd b(d);
  for (int i = 0; i < d; ++i) b[i] = std::cos(0.7 + 2.1 * i) * 0.41;
  return b;
}

template <class Motion>
std::vector<double> moved_points(const std::vector<double>& points, int d, Motion&& motion) {
  std::vector<double> out;
  for (std::size_t i = 0; i < points.size(); i += d) {
    const Eigen::VectorXd y = motion(Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(&points[i], d)));
    out.insert(out.end(), y.data(), y.data() + d);
  }
  return out;
}

inline TraceCase rotated_and_shifted(TraceCase c) {
  const int d = c.function.ambient_dim();
  const Eigen::MatrixXd Q = fixed_rotation(d);
  const Eigen::VectorXd b = fixed_shift(d);
  c.function = translate(rotate(c.function, Q), as_vector(b));
  c.seeds = moved_points(c.seeds, d, [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return Q * x + b; });
  c.name += " moved";
  return c;
}
inline TraceCase in_other_lengths(TraceCase c, double unit) {
  const int d = c.function.ambient_dim();
  c.function = scale(c.function, unit);
  c.seeds = moved_points(c.seeds, d, [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return unit * x; });
  c.edge_length *= unit;
  c.name += " in units of " + std::to_string(unit);
  return c;
}
inline TraceCase with_values_times(TraceCase c, double factor) {
  c.function = multiply_values(c.function, std::vector<double>(c.function.codim(), factor));
  c.name += " f times " + std::to_string(factor);
  return c;
}

inline std::vector<TraceCase> trace_cases() {
  std::vector<TraceCase> cases;
  auto add = [&](std::string name, const NamedManifold& m, double edge, long chi, std::size_t components,
                 std::vector<std::string> homology) {
    cases.push_back({std::move(name), m.function, m.point, edge, chi, components, std::move(homology)});
  };
  add("circle in R^2", sphere(1, 2), 0.3, 0, 1, {"Z", "Z"});
  add("circle in R^5", sphere(1, 5), 0.3, 0, 1, {"Z", "Z"});
  add("S^2 in R^3", sphere(2, 3), 0.3, 2, 1, {"Z", "0", "Z"});
  add("S^2 in R^5", sphere(2, 5), 0.5, 2, 1, {"Z", "0", "Z"});
  add("S^3 in R^4", sphere(3, 4), 0.6, 0, 1, {"Z", "0", "0", "Z"});
  add("S^3 in R^6", sphere(3, 6), 1.0, 0, 1, {"Z", "0", "0", "Z"});
  add("S^4 in R^5", sphere(4, 5), 1.0, 2, 1, {"Z", "0", "0", "0", "Z"});
  add("flat torus in R^4", flat_torus(4), 0.3, 0, 1, {"Z", "Z^2", "Z"});
  add("flat torus in R^10", flat_torus(10), 0.9, 0, 1, {"Z", "Z^2", "Z"});
  add("torus of revolution", torus_of_revolution(), 0.4, 0, 1, {"Z", "Z^2", "Z"});
  add("SO(3)", so3_vectors(), 0.85, 0, 1, {"Z", "Z/2", "0", "Z"});
  add("trefoil", trefoil(), 0.2, 0, 1, {"Z", "Z"});
  add("chair", chair(3), 0.12, -4, 1, {"Z", "Z^6", "Z"});
  add("pentagon linkage", pentagon_linkage(), 0.25, -6, 1, {"Z", "Z^8", "Z"});
  {
    TraceCase two{"two spheres", two_spheres().function, {3, 0, 0, -3, 0, 0}, 0.3, 4, 2, {"Z^2", "0", "Z^2"}};
    cases.push_back(std::move(two));
  }
  return cases;
}

}  // namespace whitney::testing
