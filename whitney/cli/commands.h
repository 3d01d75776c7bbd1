// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <whitney/construction/triangulate.h>
#include <whitney/tracing/trace.h>

namespace whitney::cli {

/// Exit statuses of the program.
enum ExitStatus { kDone = 0, kBadInput = 1, kStopped = 2, kNotAManifold = 3, kNotCertified = 3, kSingular = 3 };

struct TraceArguments {
  std::string problem;
  std::vector<std::string> outputs;
  std::string stats;
  std::string strata;  // file name pattern
  std::optional<double> edge_length;
  std::string mesh = "pulled";
  std::size_t max_simplices = TraceOptions{}.run.max_simplices;
  double time_limit = std::numeric_limits<double>::infinity();
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
  std::size_t max_simplices = TriangulateOptions{}.run.max_simplices;
  double time_limit = std::numeric_limits<double>::infinity();
  std::string projection = "pca";
  std::string color_by;
  bool quiet = false;
};
int run_triangulate(const TriangulateArguments& arguments);

struct CheckArguments {
  std::string mesh;
  std::string stats;
  bool quiet = false;
};
int run_check(const CheckArguments& arguments);

struct ParametersArguments {
  int ambient_dim = 0, intrinsic_dim = 0;
  std::string stats;
};
int run_parameters(const ParametersArguments& arguments);

}  // namespace whitney::cli
