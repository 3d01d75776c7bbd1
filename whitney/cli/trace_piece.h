// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <coxeter/triangulation.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/cells/strata.h>
#include <whitney/cli/commands.h>
#include <whitney/cli/session.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/io/write_report.h>

namespace whitney::cli {

/// One zero set to be traced: that of the problem, or of one of its charts.
struct PieceProblem {
  std::string where;  ///< begins error messages: the file, or the file and the chart
  const Function& function;
  const std::optional<Function>& inequalities;
  std::optional<Box> box;
  const std::vector<std::vector<double>>& seed_points;
};

struct TracedPiece {
  FoundSeeds found;       ///< of the search, if there was one
  bool searched = false;  ///< no seed points were given
  TraceResult traced;     ///< without simplices when nothing was found
  CellComplex complex;
  Strata strata;

  bool empty() const { return traced.num_points() == 0; }
  /// Why it is empty.
  std::string where_to_look() const;
};

/// Finds seeds, traces and builds the complex; adds the seconds and counts of it to the statistics. `found_before`:
/// simplices of earlier pieces, which count for --max-simplices.
TracedPiece trace_piece(const PieceProblem& problem, const coxeter::Triangulation& triangulation,
                        const TraceArguments& arguments, std::size_t found_before, double seconds_before,
                        Stopwatch& watch, Statistics& statistics);

/// "3 seeds lie on parts too small for this edge length, e.g. at (..): try L <= ..", and a newline; or nothing.
std::string too_small_text(const Statistics& statistics);

/// That of the arguments, of the problem file, or the longest side of the box / 30.
double edge_length_of(const TraceArguments& arguments, const Problem& problem, const std::optional<Box>& box);

/// `whitney trace` for a problem that is made of charts.
int run_trace_charts(const Problem& problem, const TraceArguments& arguments);

}  // namespace whitney::cli
