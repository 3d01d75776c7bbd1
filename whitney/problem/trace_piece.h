// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <coxeter/triangulation.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/cells/strata.h>
#include <whitney/functions/domain.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/functions/function.h>
#include <whitney/problem/budget.h>
#include <whitney/problem/report.h>
#include <whitney/tracing/trace_result.h>

namespace whitney {

/// One zero set to be traced: that of a problem, or of one of its charts.
struct ZeroSetPiece {
  const Function& function;
  const std::optional<Function>& inequalities;
  std::optional<Box> box;
  const std::vector<std::vector<double>>& seed_points;
};

struct TracedPiece {
  FoundSeeds found;       ///< of the search, if there was one
  bool searched = false;  ///< no seed points were given
  TraceResult traced;     ///< without simplices when nothing was found
  StopReason stop_reason = StopReason::kNone;
  CellComplex complex;
  Strata strata;

  bool empty() const { return traced.num_points() == 0; }
  /// Why it is empty, a sentence.
  std::string why_empty() const;
};

/// The phases seeds, trace and complex; adds their seconds and counts to the report. found_before: simplices of earlier
/// pieces, which count for max_simplices. work_bytes: what is to be done with a k-simplex later takes so many bytes,
/// see Budget::rest. Throws InvalidInput when there are neither seed points nor a box, and as trace does.
TracedPiece trace_piece(const ZeroSetPiece& piece, const coxeter::Triangulation& triangulation,
                        std::size_t found_before, double work_bytes, Budget& budget, Report& report);

/// Looks for points where f = 0 is singular, if the budget allows, and adds them to the report.
void search_interior(const Function& f, const TraceResult& traced, double edge_length, Budget& budget, Report& report);

/// The edge length asked for, or that of the problem, or the longest side of the box / 30. Throws InvalidInput when
/// there is none of them.
double edge_length_of(const std::optional<double>& asked, const std::optional<double>& of_problem,
                      const std::optional<Box>& box);

}  // namespace whitney
