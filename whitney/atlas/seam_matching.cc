// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/seam_matching.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <coxeter/base/error.h>
#include <coxeter/base/text.h>

namespace whitney::internal {
namespace {

using Vertex = Quilt::Vertex;

/// Another candidate must be this many times as far as the one that is taken.
constexpr double kUnambiguous = 2;
constexpr std::size_t kSamples = 32;  ///< of a loop

std::string plural(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// The larger of the distances of points of each from the other.
double apart(const Polyline& first, const Polyline& second) {
  double worst = 0;
  for (const auto& [from, to] : {std::pair(&first, &second), std::pair(&second, &first)}) {
    for (std::size_t i = 0; i < kSamples; ++i) {
      const double arc = from->length() * static_cast<double>(i) / kSamples;
      worst = std::max(worst, to->nearest(from->point_at(arc)).distance);
    }
  }
  return worst;
}

}  // namespace

Polyline closed_polyline(std::vector<double> points, std::size_t ambient_dim) {
  points.insert(points.end(), points.begin(), points.begin() + ambient_dim);
  return Polyline(std::move(points), ambient_dim);
}

std::vector<double> apply(const CoordinateMap& map, std::span<const double> x, std::size_t size,
                          const std::string& name) {
  std::vector<double> y(size);
  map(x, y);
  if (!std::all_of(y.begin(), y.end(), [](double value) { return std::isfinite(value); })) {
    throw OracleError(name + " is not finite at " + text(x));
  }
  return y;
}

SeamMatcher::SeamMatcher(std::span<const Seam> seams, std::size_t s, const SeamNames& names, int dim,
                         std::size_t ambient_dim, const Quilt& quilt, double max_distance, const BoundaryStrands& first,
                         const BoundaryStrands& second)
    : s_(s),
      seam_(seams[s]),
      names_(names),
      dim_(dim),
      ambient_dim_(ambient_dim),
      quilt_(quilt),
      max_distance_(max_distance) {
  if (first.corners.size() != second.corners.size() || first.loops.size() != second.loops.size()) {
    const auto found = [&](const BoundaryStrands& part) {
      if (dim_ == 1) return plural(part.corners.size(), "point");
      return plural(part.arcs.size(), "arc") + " with " + plural(part.corners.size(), "corner") + " and " +
             plural(part.loops.size(), "loop");
    };
    throw SeamMismatch(names_.seam(s_) + ": " + found(first) + " on the first side, " + found(second) +
                       " on the second; " + kSmallerEdges);
  }
  report_.num_corners = first.corners.size();
  report_.num_arcs = first.arcs.size();
  report_.num_loops = first.loops.size();
  allowed_ = max_distance * longest_edge(first);
}

bool SeamMatcher::is_own_mirror() const {
  return seam_.first_chart == seam_.second_chart && seam_.first_inequality == seam_.second_inequality;
}

std::vector<double> SeamMatcher::own_points(std::span<const Vertex> vertices) const {
  std::vector<double> points;
  for (const Vertex v : vertices) points.insert(points.end(), quilt_.point(v).begin(), quilt_.point(v).end());
  return points;
}

std::vector<double> SeamMatcher::images(std::span<const Vertex> vertices) const {
  std::vector<double> points;
  for (const Vertex v : vertices) {
    const std::vector<double> image =
        apply(seam_.transition, quilt_.point(v), ambient_dim_, names_.seam(s_) + ": the transition");
    points.insert(points.end(), image.begin(), image.end());
  }
  return points;
}

/// Of the second piece, and of the first part in the second chart's coordinates. A part alone may consist of the tiny
/// edges that a cut leaves.
double SeamMatcher::longest_edge(const BoundaryStrands& first) const {
  double longest = 0;
  const auto take = [&](std::vector<double> points) {
    longest = std::max(longest, Polyline(std::move(points), ambient_dim_).longest_segment());
  };
  for (const auto& arc : first.arcs) take(images(arc));
  for (std::vector<Vertex> loop : first.loops) {
    loop.push_back(loop.front());
    take(images(loop));
  }
  for (std::size_t i = 0; i < quilt_.num_simplices(); ++i) {
    if (quilt_.patch_of_simplex(i) == seam_.second_chart) take(own_points(quilt_.simplex(i)));
  }
  return longest;
}

void SeamMatcher::check_distance(double apart, std::span<const double> place, const std::string& what) {
  if (report_.worst_place.empty() || apart > report_.worst_distance) {
    report_.worst_distance = apart;
    report_.worst_place.assign(place.begin(), place.end());
  }
  if (apart <= allowed_) return;
  throw SeamMismatch(names_.seam(s_) + ": " + what + " at " + text(place) + " in the coordinates of " +
                     names_.chart(seam_.second_chart) + " are " + text(apart, 4) + " apart, more than " +
                     text(allowed_, 4) + " (" + text(max_distance_, 4) + " of the longest edge there); " +
                     kSmallerEdges);
}

Matching SeamMatcher::match_corners(const BoundaryStrands& first, const BoundaryStrands& second) {
  const std::size_t count = first.corners.size(), d = ambient_dim_;
  const std::vector<double> from = images(first.corners), to = own_points(second.corners);
  const auto point = [d](const std::vector<double>& points, std::size_t i) {
    return std::span<const double>(&points[i * d], d);
  };
  Matching partner(count);
  std::vector<std::size_t> taken_by(count, count);
  const std::string noun = dim_ == 1 ? "point" : "corner";
  const auto describe = [&](std::size_t i) {
    return noun + " " + text(quilt_.point(first.corners[i])) + " of " + names_.chart(seam_.first_chart) +
           ", which comes to " + text(point(from, i)) + " in " + names_.chart(seam_.second_chart);
  };
  for (std::size_t i = 0; i < count; ++i) {
    double best = std::numeric_limits<double>::infinity(), next = best;
    for (std::size_t j = 0; j < count; ++j) {
      const double apart = distance(point(from, i), point(to, j));
      if (apart < best) {
        next = std::exchange(best, apart);
        partner[i] = j;
      } else {
        next = std::min(next, apart);
      }
    }
    check_distance(best, point(from, i), "the " + describe(i) + ", and the nearest there,");
    const std::size_t other = std::exchange(taken_by[partner[i]], i);
    if (kUnambiguous * best >= next || other != count) {
      throw SeamMismatch(names_.seam(s_) + ": the " + describe(i) + ": " +
                         (other != count ? "another " + noun + ", " + text(quilt_.point(first.corners[other])) +
                                               ", has the same nearest " + noun + " there"
                                         : noun + "s there are at " + text(best, 4) + " and " + text(next, 4) +
                                               ", which does not tell which is meant") +
                         "; " + kSmallerEdges);
    }
  }
  if (is_own_mirror()) {
    for (std::size_t i = 0; i < count; ++i) {
      check_involution(i == partner[i], partner[partner[i]] == i, describe(i));
    }
  }
  return partner;
}

void SeamMatcher::check_involution(bool fixed, bool is_involution, const std::string& what) const {
  if (!fixed && is_involution) return;
  throw SeamMismatch(names_.seam(s_) +
                     ": a part that is sewn to itself needs an involution without fixed points, but " + what +
                     (fixed ? " comes to itself" : " does not come back"));
}

LoopMatching SeamMatcher::match_loops(const BoundaryStrands& first, const BoundaryStrands& second) {
  const std::size_t count = first.loops.size();
  LoopMatching result;
  std::vector<Polyline>&from = result.from, &to = result.to;
  for (const auto& loop : first.loops) from.push_back(closed_polyline(images(loop), ambient_dim_));
  for (const auto& loop : second.loops) to.push_back(closed_polyline(own_points(loop), ambient_dim_));
  Matching& partner = result.partner;
  partner.resize(count);
  std::vector<std::size_t> taken_by(count, count);
  for (std::size_t i = 0; i < count; ++i) {
    double best = std::numeric_limits<double>::infinity(), next = best;
    for (std::size_t j = 0; j < count; ++j) {
      const double here = apart(from[i], to[j]);
      if (here < best) {
        next = std::exchange(best, here);
        partner[i] = j;
      } else {
        next = std::min(next, here);
      }
    }
    const std::string what =
        "the loop through " + text(quilt_.point(first.loops[i][0])) + " of " + names_.chart(seam_.first_chart);
    check_distance(best, from[i].vertex(0), what + " and the nearest there, somewhere on it,");
    if (kUnambiguous * best >= next || std::exchange(taken_by[partner[i]], i) != count) {
      throw SeamMismatch(names_.seam(s_) + ": " + what + " is at " + text(best, 4) + " from the nearest loop of " +
                         names_.chart(seam_.second_chart) + " and " + text(next, 4) +
                         " from another, which does not tell which is meant; " + kSmallerEdges);
    }
  }
  return result;
}

bool SeamMatcher::runs_along(const Polyline& from, const Polyline& to) const {
  double turned = 0, last = 0;
  for (std::size_t i = 0; i <= kSamples; ++i) {
    const double arc = to.nearest(from.point_at(from.length() * static_cast<double>(i) / kSamples)).arc;
    if (i > 0) turned += std::remainder(arc - last, to.length());
    last = arc;
  }
  if (!(std::abs(std::abs(turned) - to.length()) < 0.5 * to.length())) {
    throw SeamMismatch(names_.seam(s_) + ": the loop through " + text(from.vertex(0)) + " in the coordinates of " +
                       names_.chart(seam_.second_chart) + " does not run once along the loop there; " + kSmallerEdges);
  }
  return turned > 0;
}

}  // namespace whitney::internal
