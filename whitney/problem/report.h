// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <coxeter/base/run_control.h>
#include <whitney/construction/complex_quality.h>
#include <whitney/topology/topology.h>

namespace whitney {

/// How much of the topology of the mesh is computed.
enum class TopologyLevel {
  kNone,   ///< only the numbers of points and of top simplices
  kEuler,  ///< f-vector, Euler characteristic, components, boundary, orientability
  kFull    ///< these, the links of the vertices (is it a manifold?) and homology
};

/// What is made of the cell complex.
enum class MeshKind {
  kPulled,       ///< simplices, without new vertices
  kBarycentric,  ///< simplices, a new vertex in every cell: K of the theorem
  kCells         ///< the polygons or edges themselves, n <= 2; the topology is that of the pulled subdivision
};

/// A part of the work that was not done because a limit stood in its way.
struct Omission {
  std::string what;  ///< "homology", "vertex links", "quality", ..
  StopReason reason = StopReason::kNone;
  std::uint64_t estimated_bytes = 0;  ///< what it would have needed, where memory is the reason
};

/// What `triangulate_problem` proves.
struct CertificateSummary {
  std::string verdict;                       ///< "certified", "violated", "not certified"
  double margin_min = 0, margin_median = 0;  ///< certified above 1
  double displacement_max = 0;               ///< largest displacement / edge length
  std::size_t rounds = 0;                    ///< of the search of displacements
  std::size_t vertices_near = 0, vertices_moved = 0;
  double reach = 0, curvature_radius = 0;  ///< lengths
  std::string reach_source;                ///< what the reach rests on: "proven", "caller", "estimated"
  /// What the feet rest on: "proven" (an analysis of the formulas bounds their errors), "modelled" (a model of the
  /// errors, which may be wrong); and which point a foot is: "global" (the closest, proved), "local", "unknown".
  std::string feet_source, feet_place;
  /// Which components of M the verdict is about: "seeds_given" (those that the seed points lie on), "seeds_searched"
  /// (likely all, not proved), "connected_by_definition" (all).
  std::string components;
  double edge_length_over_reach = 0;
  std::optional<double> hausdorff_bound;       ///< between K and M (a length); null when it is not proved
  bool cut = false;                            ///< the verdict is about the part of M near the inequalities' domain
  std::string reason;                          ///< why it is not certified
  std::optional<std::vector<double>> witness;  ///< where: d coordinates
  bool reach_contradicted = false;             ///< the feet say that the reach is less: no smaller edge length helps
};

/// The boundary of what was traced, piece by piece.
struct BoundarySummary {
  struct Piece {
    int dim = 0;
    std::vector<std::string> inequalities;  ///< that vanish on it: "1 - x^2 = 0", or "x = 2" for a side of the box
    bool is_cut = false;                    ///< one of them is a side of the box
    std::size_t num_cells = 0;              ///< of dimension dim
    std::int64_t euler_characteristic = 0;  ///< of its closure
    std::vector<std::uint32_t> faces;       ///< the strata one dimension down in its closure: the stratum graph
  };
  std::vector<Piece> strata;
  std::size_t boundary_components = 0;  ///< where an inequality of the problem vanishes
  std::size_t cut_components = 0;       ///< where the box cuts
  double smallest_singular_value = 1;   ///< see CutRegularity
  std::vector<double> smallest_singular_point;
  std::vector<std::vector<double>> singular_points;
};

/// What was traced in one chart.
struct ChartSummary {
  std::string name;
  std::size_t simplices = 0;  ///< of dimension k that the zero set meets
  std::map<int, std::size_t> strata_per_dim;
  double smallest_singular_value = 1;  ///< see CutRegularity
  std::vector<std::vector<double>> singular_points;
};

/// What was glued at a seam of two charts.
struct SeamSummary {
  std::string first, second;  ///< names of the charts
  std::size_t corners = 0, arcs = 0, loops = 0;
  double worst_distance = 0;  ///< between the two sides, a length in the second chart
};

/// What became of the points where the search began.
struct SeedSummary {
  bool searched = false;       ///< none were given; that every component was found is then likely, not proved
  std::size_t num_starts = 0;  ///< Newton iterations of that search
  std::size_t num_used = 0, num_merged = 0, num_dropped = 0;
  std::size_t num_too_small = 0;        ///< that lie on parts too small for the edge length, see SeedReport
  std::vector<double> too_small_point;  ///< where the first of them lies, d
  double finer_edge_length = 0;         ///< at which all of them would be met, as far as that is known; 0: not known
  std::vector<std::string> dropped;     ///< of seeds that were given: "seed point 3 dropped: <why>"
};

/// What a run found, as data.
struct Report {
  int ambient_dim = 0, intrinsic_dim = 0;
  std::optional<double> edge_length;  ///< of the triangulation (a length)
  SeedSummary seeds;
  std::map<int, std::size_t> simplices_per_dim;  ///< ambient simplices that the manifold meets, by their dimension
  std::size_t simplices_met = 0;                 ///< those of dimension k, with those of the boundary
  TopologyLevel topology_level = TopologyLevel::kFull;  ///< how much of `topology` was computed
  Topology topology;                                    ///< of the mesh
  std::size_t oracle_evaluations = 0;                   ///< of f by the trace
  std::size_t seed_evaluations = 0;                     ///< of f by the search for seeds and around them
  std::size_t distinct_vertices = 0;                    ///< lattice vertices at which the trace asked for f
  std::size_t exact_decisions = 0;                      ///< pivots decided by exact arithmetic
  std::map<std::string, double> seconds;                ///< by phase
  StopReason stop_reason = StopReason::kNone;
  bool cut_short = false;   ///< a limit ended the search: the mesh is a part of what the seeds lead to
  bool whole_cells = true;  ///< false where f has no value outside the box, so that whole simplices were left out there
  std::vector<Omission> left_out{};
  std::optional<CertificateSummary> certificate{};
  std::optional<BoundarySummary> boundary{};  ///< when there are inequalities, or the box cut something off
  /// Points where f = 0 is no submanifold because Df is not of full rank, d each (in the coordinates of their chart),
  /// and the smallest singular value found, see check_interior.
  std::vector<std::vector<double>> interior_singular_points{};
  double interior_singular_value = 1;
  bool interior_searched = false;      ///< those points were looked for
  std::vector<ChartSummary> charts{};  ///< of a manifold made of charts; ambient_dim is that of the charts
  std::vector<SeamSummary> seams{};
  std::optional<ComplexQuality> quality{};  ///< of the mesh; angles in radians

  /// A limit, or the caller, ended the run before it was done.
  bool stopped() const { return stop_reason != StopReason::kNone && stop_reason != StopReason::kBox; }
  /// A point was found where the manifold or its boundary crosses or touches itself.
  bool singular() const;
};

/// "(1, 0.5)", six digits a coordinate.
std::string point_text(const std::vector<double>& point);

/// "none", "euler", "full".
const char* to_string(TopologyLevel level);

}  // namespace whitney
