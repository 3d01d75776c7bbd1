// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <whitney/problem/trace_problem.h>
#include <whitney/problem/triangulate_problem.h>

namespace whitney::cli {

/// Exit statuses of the program.
enum ExitStatus {
  kDone = 0,      ///< and certified, where that was asked for
  kBadInput = 1,  ///< named with file, key and reason; also a file that could not be written
  kStopped = 2,   ///< by a limit: what was found is written
  kNotProved = 3  ///< done, but not certified, violated, singular, or (check) not a manifold
};

struct LimitArguments {
  std::size_t max_simplices = 0;
  double time_limit = std::numeric_limits<double>::infinity();
  std::optional<std::uint64_t> memory_limit{};  ///< without: what the machine has free
};

struct TraceArguments {
  std::string problem;
  std::vector<std::string> outputs;
  std::string stats;
  std::string strata;  // file name pattern
  std::optional<double> edge_length;
  std::string mesh = "pulled";
  std::string topology = "full";
  LimitArguments limits{.max_simplices = TraceProblemOptions{}.run.max_simplices};
  std::string projection = "pca";
  std::string color_by;
  bool quiet = false;
};
int run_trace(const TraceArguments& arguments);

struct TriangulateArguments {
  std::string problem;
  std::vector<std::string> outputs;
  std::string stats;
  std::string ambient, inside;
  std::optional<double> edge_length;
  bool auto_refine = false;
  std::string scheme = "repair";
  int max_rounds = 16;
  std::string mesh = "barycentric";
  std::string topology = "full";
  LimitArguments limits{.max_simplices = TriangulateProblemOptions{}.run.max_simplices};
  std::string projection = "pca";
  std::string color_by;
  bool quiet = false;
};
int run_triangulate(const TriangulateArguments& arguments);

struct CheckArguments {
  std::string mesh;
  std::string stats;
  std::string topology = "full";
  LimitArguments limits{};
  bool quiet = false;
};
int run_check(const CheckArguments& arguments);

struct ParametersArguments {
  int ambient_dim = 0, intrinsic_dim = 0;
  std::string stats;
};
int run_parameters(const ParametersArguments& arguments);

}  // namespace whitney::cli
