// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <whitney/construction/complex_quality.h>
#include <whitney/topology/topology.h>

namespace whitney {

/// What `whitney triangulate` proves.
struct CertificateStatistics {
  std::string verdict;                       ///< "certified", "violated", "not certified"
  double margin_min = 0, margin_median = 0;  ///< certified above 1
  double displacement_max = 0;               ///< largest displacement / edge length
  std::size_t rounds = 0;                    ///< of the search of displacements
  std::size_t vertices_near = 0, vertices_moved = 0;
  double reach = 0, curvature_radius = 0;  ///< lengths
  std::string reach_source;                ///< "proven", "caller", "estimated"
  double edge_length_over_reach = 0;
  std::optional<double> hausdorff_bound;       ///< between K and M (a length); null when it is not proved
  bool cut = false;                            ///< the verdict is about the part of M near the inequalities' domain
  std::string reason;                          ///< why it is not certified
  std::optional<std::vector<double>> witness;  ///< where: d coordinates
};

/// The boundary of what was traced, piece by piece.
struct BoundaryStatistics {
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
struct ChartStatistics {
  std::string name;
  std::size_t simplices = 0;  ///< of dimension k that the zero set meets
  std::map<int, std::size_t> strata_per_dim;
  double smallest_singular_value = 1;  ///< see CutRegularity
  std::vector<std::vector<double>> singular_points;
};

/// What was glued at a seam of two charts.
struct SeamStatistics {
  std::string first, second;  ///< names of the charts
  std::size_t corners = 0, arcs = 0, loops = 0;
  double worst_distance = 0;  ///< between the two sides, a length in the second chart
};

/// What a run of the program reports; the keys of the JSON file are the names of the members.
struct Statistics {
  int ambient_dim = 0, intrinsic_dim = 0;
  std::optional<double> edge_length;  ///< of the triangulation (a length)
  std::size_t num_seeds_used = 0, num_seeds_merged = 0, num_seeds_dropped = 0;
  std::size_t num_seeds_too_small = 0;           ///< that lie on parts too small for the edge length, see SeedReport
  std::vector<double> too_small_point;           ///< where the first of them lies
  double too_small_edge_length = 0;              ///< at which all of them would be met; 0: not known
  std::map<int, std::size_t> simplices_per_dim;  ///< ambient simplices that the manifold meets, by their dimension
  Topology topology;                             ///< of the mesh that is written
  std::size_t oracle_evaluations = 0;            ///< of f by the trace
  std::size_t seed_evaluations = 0;              ///< of f by the search for seeds and around them
  std::size_t distinct_vertices = 0;             ///< lattice vertices at which the trace asked for f
  std::size_t exact_decisions = 0;               ///< pivots decided by exact arithmetic
  std::map<std::string, double> seconds;         ///< by phase
  std::string stop_reason = "none";
  std::optional<CertificateStatistics> certificate{};
  std::optional<BoundaryStatistics> boundary{};  ///< when there are inequalities, or the box cut something off
  /// Points where Df is not of full rank, see check_interior, and the smallest singular value found.
  std::vector<std::vector<double>> interior_singular_points{};
  double interior_singular_value = 1;
  std::vector<ChartStatistics> charts{};  ///< of a manifold made of charts; ambient_dim is that of the charts
  std::vector<SeamStatistics> seams{};
  std::optional<ComplexQuality> quality{};  ///< of the mesh that is written; angles in radians
};

/// JSON text, one key a line, ending in a newline. Adds peak_rss_bytes of this process.
std::string to_json(const Statistics& statistics);

}  // namespace whitney
