// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <coxeter/base/run_control.h>
#include <whitney/problem/problem.h>
#include <whitney/problem/report.h>
#include <whitney/topology/mesh.h>

namespace whitney {

struct TracedProblem;

struct TraceProblemOptions {
  std::optional<double> edge_length{};  ///< in place of the problem's
  MeshKind mesh = MeshKind::kPulled;
  TopologyLevel topology = TopologyLevel::kFull;
  /// Label the strata in the mesh even when there is no boundary.
  bool always_label_strata = false;
  /// Limits of the whole run. max_simplices counts k-simplices. time_limit: seeds and trace stop, what was found
  /// becomes a mesh all the same, and what comes after it is left out. memory_limit: the trace stops where the complex
  /// and the mesh of what it found would not fit, and parts that would not fit are left out.
  RunControl run{.max_simplices = 50'000'000};
  /// Unless empty: called when the mesh is there, before its topology is computed, so that it can be put away safely.
  std::function<void(const TracedProblem&)> mesh_ready{};
};

/// What came of tracing a problem.
struct TracedProblem {
  enum class Outcome {
    kTraced,        ///< there is a mesh, of the whole or of what a limit left; whether it is singular says the report
    kNothingFound,  ///< no simplex meets the zero set; `explanation` says what was tried
    kSeamsDisagree  ///< charts were traced, but do not fit together; `explanation` says where
  };
  Outcome outcome = Outcome::kTraced;
  std::string explanation;  ///< sentences; empty when traced
  Report report;
  SimplicialMesh mesh;                 ///< oriented; with strata where there is a boundary
  std::optional<PolygonMesh> cells;    ///< with MeshKind::kCells
  std::size_t num_strata = 0;          ///< that the mesh has labels of
  std::vector<std::string> variables;  ///< names of the coordinates of the mesh
};

/// Traces the zero set of a problem: seeds, trace, cell complex, mesh, topology; or, when the problem is made of
/// charts, each of them, glued (see trace_atlas.h). Deterministic up to report.seconds.
///
/// Throws InvalidInput (the key or option first) when the problem is no zero set, leaves no dimension, or lacks an edge
/// length, box or seed points; OracleError and LatticeOverflow as trace does; std::bad_alloc when not even a part fits.
TracedProblem trace_problem(const Problem& problem, const TraceProblemOptions& options = {});

}  // namespace whitney
