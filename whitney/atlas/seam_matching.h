// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <whitney/atlas/boundary_strands.h>
#include <whitney/atlas/glue_charts.h>
#include <whitney/atlas/polyline.h>
#include <whitney/atlas/quilt.h>

namespace whitney::internal {

/// What to do about most mismatches.
inline constexpr const char* kSmallerEdges = "use a smaller edge length";

/// partner[i] of the second side belongs to i of the first.
using Matching = std::vector<std::size_t>;

/// Loops that belong together, as closed polylines in the second chart's coordinates.
struct LoopMatching {
  Matching partner;
  std::vector<Polyline> from, to;  ///< of the loops of the first and the second side
};

/// A loop as a polyline that returns to its start; points: m x d.
Polyline closed_polyline(std::vector<double> points, std::size_t ambient_dim);

/// f(x) in R^dim. Throws OracleError when a value is not finite; `name` says of what.
std::vector<double> apply(const CoordinateMap& f, std::span<const double> x, std::size_t dim, const std::string& name);

/// Decides what of the two sides of one seam belongs together, and how far apart it is. Everything is compared in the
/// second chart's coordinates. Changes nothing.
class SeamMatcher {
 public:
  /// seams[s]; max_distance: see GlueOptions. The arguments must outlive this. Throws SeamMismatch where the sides have
  /// different numbers of corners or loops.
  SeamMatcher(std::span<const Seam> seams, std::size_t s, const SeamNames& names, int dim, std::size_t ambient_dim,
              const Quilt& quilt, double max_distance, const BoundaryStrands& first, const BoundaryStrands& second);

  const Seam& seam() const { return seam_; }
  std::string name() const { return names_.seam(s_); }  ///< in messages
  const SeamReport& report() const { return report_; }
  double allowed() const { return allowed_; }  ///< distance of the two sides
  /// Whether the seam sews a part to itself.
  bool is_own_mirror() const;

  /// The points of vertices of the first side, in the second chart's coordinates; of the second side, as they are.
  std::vector<double> images(std::span<const Quilt::Vertex> vertices) const;
  std::vector<double> own_points(std::span<const Quilt::Vertex> vertices) const;

  /// Every corner with the nearest. Throws SeamMismatch where that is ambiguous, too far, or no involution.
  Matching match_corners(const BoundaryStrands& first, const BoundaryStrands& second);
  /// Every loop with the nearest, likewise; involutions are left to the caller.
  LoopMatching match_loops(const BoundaryStrands& first, const BoundaryStrands& second);
  /// Whether two loops that belong together have the same direction. Throws SeamMismatch where one does not run once
  /// along the other.
  bool runs_along(const Polyline& from, const Polyline& to) const;

  /// Notes a distance of the two sides and where it is. Throws SeamMismatch when it is more than allowed; `what` is the
  /// subject of the sentence.
  void check_distance(double apart, std::span<const double> place, const std::string& what);
  /// For is_own_mirror(). Throws SeamMismatch where what is matched comes to itself or does not come back.
  void check_involution(bool fixed, bool is_involution, const std::string& what) const;

 private:
  double longest_edge(const BoundaryStrands& first) const;

  std::size_t s_;
  const Seam& seam_;
  const SeamNames& names_;
  int dim_;
  std::size_t ambient_dim_;
  const Quilt& quilt_;
  double max_distance_;
  double allowed_;
  SeamReport report_;
};

}  // namespace whitney::internal
