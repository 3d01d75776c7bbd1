// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <coxeter/base/error.h>
#include <whitney/io/read_problem.h>
#include "bytes.h"

namespace whitney::fuzz {

/// A problem file: a problem whose parts fit together and can be evaluated, or an Error.
inline void problem_body(Bytes bytes) {
  Problem problem;
  try {
    problem = parse_problem(text_of(bytes), "fuzz");
  } catch (const Error&) {
    return;
  }
  const int d = problem.ambient_dim();
  demand(d >= 1 && problem.codim() >= 1, "a problem has dimensions");
  const auto rows = static_cast<std::size_t>(d);
  demand(problem.box.empty() || problem.box.size() == rows, "a box has d sides");
  for (const auto& [lower, upper] : problem.box) demand(lower < upper, "a side of a box is not empty");
  for (const auto& point : problem.seed_points) demand(point.size() == rows, "a seed point has d coordinates");
  if (problem.function) {
    const std::vector<double> x(rows, 0.5);
    std::vector<double> value(static_cast<std::size_t>(problem.function->codim())), jacobian(value.size() * rows);
    problem.function->evaluate(x, value);
    problem.function->jacobian(x, jacobian);
  }
}

}  // namespace whitney::fuzz
