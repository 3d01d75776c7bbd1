// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <coxeter/base/error.h>
#include <whitney/cells/strata.h>
#include <whitney/topology/mesh.h>

namespace whitney {

/// A map between coordinate spaces: reads x, writes y. A pure function of x.
using CoordinateMap = std::function<void(std::span<const double> x, std::span<double> y)>;

/// The part of the boundary of a piece on which one of its chart's inequalities is an equality.
struct BoundaryPart {
  int inequality = 0;
  /// (n-1)-simplices of the boundary of the piece, n vertices each: edges of a surface, end points of a curve.
  std::vector<std::uint32_t> simplices{};
};

/// What was traced in one chart: a curve or surface with boundary, in the coordinates of the chart. It may be empty (a
/// mesh without simplices), but has the right dimensions then, too.
struct ChartPiece {
  std::string name{};                    ///< in messages; empty: its number
  SimplicialMesh mesh{};                 ///< in R^d; point_data and cell_data are ignored
  std::vector<BoundaryPart> boundary{};  ///< at most one for an inequality; none: nothing lies on it
};

/// The piece of a chart whose mesh was subdivided with its strata (see subdivide.h): its boundary parts are the strata
/// of dimension n - 1. Sides of the box that cut the manifold have numbers that no seam names, and stay boundary.
ChartPiece chart_piece(std::string name, SimplicialMesh mesh, const Strata& strata);

/// Says that the boundary part of one chart is the same set as that of another, or of the same chart.
///
/// A part may be sewn to itself (both ends the same chart and inequality), when `transition` is an involution of it
/// without fixed points: the antipodal map of the boundary of a disc gives the projective plane.
struct Seam {
  int first_chart = 0, first_inequality = 0, second_chart = 0, second_inequality = 0;
  /// First chart's coordinates -> second chart's. Called at vertices of the first part only.
  CoordinateMap transition{};
};

struct GlueOptions {
  /// One map per chart into a common R^D, D = embedding_dim, that agree on the seams; or none. With them, contradictory
  /// transitions (around a corner of three charts, say) are found; without, the transitions are believed.
  std::vector<CoordinateMap> embeddings{};
  int embedding_dim = 0;
  /// How far the two sides of a seam may be apart, in units of the longest edge of the second piece and of the first
  /// one's part, all in the second chart's coordinates. Both sides follow one curve up to O(L^2), L the edge length, so
  /// that the ratio tends to 0 with L.
  double max_distance = 0.5;
};

/// What was found at a seam. Each number is the same on both sides.
struct SeamReport {
  std::size_t num_corners = 0;  ///< ends of arcs; for curves, the points that are glued
  std::size_t num_arcs = 0, num_loops = 0;
  double worst_distance = 0;          ///< between the two sides, in the second chart's coordinates
  std::vector<double> worst_place{};  ///< where, in the second chart's coordinates; empty when nothing was glued
};

struct GluedMesh {
  /// In R^D where embeddings were given, in the coordinates of each vertex's own chart otherwise. Every orientable
  /// component is oriented. point_data "chart": the lowest chart that contains the vertex, which gave it its
  /// coordinates; cell_data "chart": the chart of a simplex. Points come in the order of the charts, first those of the
  /// pieces (also such as no simplex uses), then the points inserted.
  SimplicialMesh mesh;
  std::vector<double> chart_points;  ///< num_points x d: every point in the coordinates of its own chart
  std::vector<std::vector<std::uint32_t>> vertex_of;  ///< of chart c: vertex of the piece -> point of `mesh`
  std::vector<SeamReport> seams;
};

/// The pieces do not agree at a seam: different numbers of corners, arcs or loops, or too far apart. The message names
/// the seam, what was found on both sides, the distance and the place.
class SeamMismatch : public Error {
 public:
  using Error::Error;
};

/// Glues curves (n = 1) or surfaces (n = 2), each traced in its own chart, along their seams.
///
/// The boundary part of a surface is a disjoint union of loops and of arcs, which end at corners: vertices where
/// another part, or boundary that no seam names, begins. Corners are matched with the nearest ones, loops with the
/// nearest loops; both must be unambiguous (any other candidate at twice the distance at least). Two matched polylines
/// get a common refinement: each is walked along the other, and the vertices of one split edges of the other. Corners
/// of three and more charts become one vertex because every seam identifies them. Where the result would be no
/// simplicial complex (two discs of one triangle each), it is refined. Boundary that no seam names stays boundary.
///
/// Throws InvalidInput on n >= 3 (common refinements of seams of dimension 2 are not built), pieces that are no curves
/// or surfaces, boundary simplices that are none or are in two parts, parts in two seams, and wrong sizes; OracleError
/// when a map returns a value that is not finite; SeamMismatch when pieces disagree, which a smaller edge length mends
/// if the charts themselves are right.
GluedMesh glue_charts(std::span<const ChartPiece> pieces, std::span<const Seam> seams, const GlueOptions& options = {});

}  // namespace whitney
