// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace whitney::internal {

/// A polygonal curve in R^d, parametrised by arc length. At least two vertices, which may coincide.
class Polyline {
 public:
  /// points: m x d, m >= 2, one after the other.
  Polyline(std::vector<double> points, std::size_t ambient_dim);

  std::size_t num_vertices() const { return arc_.size(); }
  std::span<const double> vertex(std::size_t i) const { return {&points_[i * dim_], dim_}; }
  double arc(std::size_t i) const { return arc_[i]; }  ///< arc length from the first vertex to vertex i
  double length() const { return arc_.back(); }
  double longest_segment() const;

  /// The point (1 - fraction) vertex(segment) + fraction vertex(segment + 1).
  std::vector<double> point(std::size_t segment, double fraction) const;
  /// The point at this arc length, which is clamped to [0, length()].
  std::vector<double> point_at(double arc) const;

  struct Foot {
    std::size_t segment = 0;  ///< between vertex(segment) and the next
    double fraction = 0;      ///< of the segment, in [0, 1]
    double arc = 0;
    double distance = std::numeric_limits<double>::infinity();
  };
  /// The nearest of the points whose arc length is in [from, to]; of several, the first.
  Foot nearest(std::span<const double> x, double from = 0, double to = std::numeric_limits<double>::infinity()) const;

 private:
  std::size_t dim_;
  std::vector<double> points_;
  std::vector<double> arc_;
};

/// The Euclidean distance of two points of the same space.
double distance(std::span<const double> x, std::span<const double> y);

/// A vertex of a polyline, or an inner point of one of its segments.
struct PolylinePlace {
  std::size_t index = 0;  ///< of the vertex, or of the first vertex of the segment
  bool is_vertex = true;
  double fraction = 0;  ///< of the segment, in [0, 1]; 0 at a vertex
};

/// A homeomorphism between two polylines, linear between stations. Every vertex of either is a station.
struct CommonRefinement {
  struct Station {
    PolylinePlace first, second;
  };
  std::vector<Station> stations;  ///< in order along both; the ends of one polyline go with those of the other
  /// Largest distance of a point from its image, before vertices were identified: bounds the Frechet distance.
  double worst_distance = 0;
  std::vector<double> worst_place{};  ///< where it occurs, on the first polyline
};

/// Matches two polylines, in the same coordinates, that are meant to be the same curve, from start to end.
///
/// The first is walked along; each of its vertices goes to the nearest point of the second among those not passed yet
/// and within reach: no further than three times the step on the first, plus `slack` (a length: what the polylines may
/// be apart, with room to spare). Points that fell together are spread by arc length. A vertex of one polyline
/// that is nearer to one of the other than a quarter of the segments at both is identified with it.
CommonRefinement common_refinement(const Polyline& first, const Polyline& second, double slack);

}  // namespace whitney::internal
