// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <coxeter/base/run_control.h>
#include <whitney/construction/scale_search.h>
#include <whitney/problem/problem.h>
#include <whitney/problem/report.h>
#include <whitney/topology/mesh.h>

namespace whitney {

struct TriangulatedProblem;

struct TriangulateProblemOptions {
  /// In place of the problem's. Without either: searched for, from the reach downwards.
  std::optional<double> edge_length{};
  bool auto_refine = false;  ///< halve an edge length that was given until the result is certified
  TriangulateOptions::Scheme scheme = TriangulateOptions::Scheme::kRepair;
  int max_rounds = 16;
  MeshKind mesh = MeshKind::kBarycentric;
  TopologyLevel topology = TopologyLevel::kFull;
  bool ambient = false;  ///< also the subdivided ambient simplices around the manifold, 2 <= d <= 4
  bool inside = false;   ///< also the inside of a closed hypersurface, 2 <= d <= 4
  /// Limits of the whole run. max_simplices counts d-simplices. When time is up, the search for displacements stops and
  /// what was found is certified and meshed; what comes after is left out. Memory likewise, see TraceProblemOptions.
  RunControl run{.max_simplices = 20'000'000};
  /// Unless empty: called when the mesh is there, before topology and quality are computed.
  std::function<void(const TriangulatedProblem&)> mesh_ready{};
};

/// What came of Whitney's construction.
struct TriangulatedProblem {
  enum class Outcome {
    kTriangulated,  ///< there is a mesh; what is proved of it says report.certificate
    kNothingFound,  ///< no simplex near the seed points meets the manifold; `explanation` says what was tried
    kNoSubmanifold  ///< the set crosses itself or is singular, by an estimate of its reach; `explanation` says where
  };
  Outcome outcome = Outcome::kTriangulated;
  std::string explanation;  ///< sentences; empty when triangulated
  Report report;
  std::vector<ScaleAttempt> attempts;  ///< edge lengths tried; the mesh is that of the last
  SimplicialMesh mesh;                 ///< oriented
  std::optional<PolygonMesh> cells;    ///< with MeshKind::kCells
  std::optional<SimplicialMesh> ambient, inside;
  std::vector<std::string> no_solids;  ///< why `ambient` or `inside` is not there, a sentence each
  std::vector<std::string> variables;  ///< names of the coordinates of the mesh
};

/// Whitney's complex of the submanifold of a problem and its certificate: seeds, displacements, certificate, complex,
/// mesh, topology, quality. Deterministic up to report.seconds.
///
/// Throws InvalidInput (the key or option first) when the problem is made of charts, leaves no dimension, lacks a box
/// or seed points, its manifold leaves the box, or a solid is asked for that this manifold does not have; OracleError
/// as triangulate does; std::bad_alloc when not even a part fits.
TriangulatedProblem triangulate_problem(const Problem& problem, const TriangulateProblemOptions& options = {});

}  // namespace whitney
