// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/glue_charts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include <coxeter/base/error.h>
#include <whitney/atlas/polyline.h>
#include <whitney/atlas/quilt.h>
#include <whitney/topology/orientation.h>

namespace whitney {
namespace {

using internal::CommonRefinement;
using internal::distance;
using internal::Polyline;
using internal::PolylinePlace;
using internal::Quilt;
using Vertex = Quilt::Vertex;

std::string text(std::span<const double> point) {
  std::ostringstream out;
  out.precision(6);
  for (std::size_t i = 0; i < point.size(); ++i) out << (i == 0 ? "(" : ", ") << point[i];
  out << ")";
  return out.str();
}

std::string text(double value) {
  std::ostringstream out;
  out.precision(4);
  out << value;
  return out.str();
}

std::string plural(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// A boundary part of a patch of the quilt, taken apart. An arc goes from corner to corner, and these two differ: a
/// boundary vertex has two boundary edges, and is a corner only where they belong to different parts.
struct Part {
  std::vector<Vertex> corners;             ///< ends of arcs; of a curve: its end points
  std::vector<std::vector<Vertex>> arcs;   ///< vertices in order
  std::vector<std::vector<Vertex>> loops;  ///< vertices in cyclic order, each once
};

/// The pairs of a matching of points: partner[i] of the second side belongs to i of the first.
using Matching = std::vector<std::size_t>;

class Gluer {
 public:
  Gluer(std::span<const ChartPiece> pieces, std::span<const Seam> seams, const GlueOptions& options)
      : pieces_(pieces),
        seams_(seams),
        options_(options),
        dim_(check_pieces()),
        ambient_dim_(pieces[0].mesh.ambient_dim),
        quilt_(dim_, ambient_dim_) {}

  GluedMesh run() {
    check_seams();
    add_pieces();
    GluedMesh result;
    for (std::size_t s = 0; s < seams_.size(); ++s) result.seams.push_back(glue(s));
    quilt_.make_simplicial();
    collect(result);
    return result;
  }

 private:
  static constexpr const char* kAdvice = "use a smaller edge length";
  /// Another candidate must be this many times as far as the one that is taken.
  static constexpr double kUnambiguous = 2;
  static constexpr std::size_t kSamples = 32;

  std::string chart_name(int c) const {
    return "chart " + (pieces_[c].name.empty() ? std::to_string(c) : pieces_[c].name);
  }
  std::string side_name(int chart, int inequality) const {
    return chart_name(chart) + ", inequality " + std::to_string(inequality);
  }
  std::string seam_name(std::size_t s) const {
    const Seam& seam = seams_[s];
    return "seam " + std::to_string(s) + " (" + side_name(seam.first_chart, seam.first_inequality) + ", with " +
           side_name(seam.second_chart, seam.second_inequality) + ")";
  }
  static bool is_own_mirror(const Seam& seam) {
    return seam.first_chart == seam.second_chart && seam.first_inequality == seam.second_inequality;
  }

  int check_pieces() const {
    if (pieces_.empty()) throw InvalidInput("there are no pieces to glue");
    const int n = pieces_[0].mesh.dim, d = pieces_[0].mesh.ambient_dim;
    if (n != 1 && n != 2) {
      throw InvalidInput("gluing is for curves and surfaces, not for dimension " + std::to_string(n) +
                         ": a common refinement of seams of dimension 2 or more is not built");
    }
    for (std::size_t c = 0; c < pieces_.size(); ++c) {
      const SimplicialMesh& mesh = pieces_[c].mesh;
      if (mesh.dim != n || mesh.ambient_dim != d || d < 1) {
        throw InvalidInput(chart_name(c) + ": a mesh of dimension " + std::to_string(mesh.dim) + " in R^" +
                           std::to_string(mesh.ambient_dim) + ", but " + chart_name(0) + " has dimension " +
                           std::to_string(n) + " in R^" + std::to_string(d));
      }
      if (mesh.points.size() % d != 0 || mesh.simplices.size() % (n + 1) != 0) {
        throw InvalidInput(chart_name(c) + ": the lengths of points and simplices do not fit the dimensions");
      }
    }
    if (!options_.embeddings.empty()) {
      if (options_.embeddings.size() != pieces_.size()) {
        throw InvalidInput(plural(options_.embeddings.size(), "embedding") + " for " + plural(pieces_.size(), "chart"));
      }
      if (options_.embedding_dim < 1) throw InvalidInput("embedding_dim must be at least 1");
    }
    if (!(options_.max_distance > 0)) throw InvalidInput("max_distance must be positive");
    return n;
  }

  void check_seams() const {
    std::map<std::pair<int, int>, std::size_t> seam_of;
    for (std::size_t s = 0; s < seams_.size(); ++s) {
      const Seam& seam = seams_[s];
      for (const int chart : {seam.first_chart, seam.second_chart}) {
        if (chart < 0 || static_cast<std::size_t>(chart) >= pieces_.size()) {
          throw InvalidInput("seam " + std::to_string(s) + ": there is no chart " + std::to_string(chart));
        }
      }
      if (!seam.transition) throw InvalidInput(seam_name(s) + ": the transition is an empty std::function");
      const auto use = [&](int chart, int inequality) {
        const auto [at, is_new] = seam_of.try_emplace({chart, inequality}, s);
        if (!is_new) {
          throw InvalidInput(seam_name(s) + ": " + side_name(chart, inequality) + " is in " + seam_name(at->second) +
                             " already");
        }
      };
      use(seam.first_chart, seam.first_inequality);
      if (!is_own_mirror(seam)) use(seam.second_chart, seam.second_inequality);
    }
  }

  /// Boundary edges of surfaces, from both ends, and the inequality of the part that they belong to.
  using BoundaryEdges = std::map<Vertex, std::map<Vertex, int>>;
  static constexpr int kFree = -1;  ///< in no part

  void add_pieces() {
    for (std::size_t c = 0; c < pieces_.size(); ++c) {
      try {
        first_vertex_.push_back(quilt_.add_patch(pieces_[c].mesh));
      } catch (const InvalidInput& error) {
        throw InvalidInput(chart_name(c) + ": " + error.what());
      }
    }
    BoundaryEdges beside;
    if (dim_ == 2) {
      for (const auto& [a, b] : quilt_.boundary_edges()) beside[a][b] = beside[b][a] = kFree;
    }
    for (const auto& [v, edges] : beside) {
      if (edges.size() == 2) continue;
      const int c = quilt_.patch_of(v);
      throw InvalidInput(chart_name(c) + ": " + std::to_string(edges.size()) + " boundary edges meet at vertex " +
                         std::to_string(v - first_vertex_[c]) + ": the piece is no surface there");
    }
    std::set<Vertex> ends;
    for (std::size_t c = 0; c < pieces_.size(); ++c) {
      for (const BoundaryPart& boundary : pieces_[c].boundary) {
        const std::string name = side_name(c, boundary.inequality);
        if (boundary.inequality < 0) throw InvalidInput(name + ": inequalities are numbered from 0");
        const auto [part, is_new] = parts_.try_emplace({static_cast<int>(c), boundary.inequality});
        if (!is_new) throw InvalidInput(name + ": has two boundary parts");
        for (const std::uint32_t v : boundary.simplices) {
          if (v >= pieces_[c].mesh.num_points()) {
            throw InvalidInput(name + ": there is no vertex " + std::to_string(v));
          }
        }
        if (dim_ == 1) {
          part->second.corners = end_points(c, boundary, ends);
        } else {
          mark_edges(c, boundary, beside);
        }
      }
    }
    if (dim_ == 2) take_apart(beside);
    for (auto& [where, part] : parts_) std::sort(part.corners.begin(), part.corners.end());
  }

  std::vector<Vertex> end_points(std::size_t c, const BoundaryPart& boundary, std::set<Vertex>& taken) const {
    std::vector<Vertex> points;
    for (const std::uint32_t v : boundary.simplices) {
      const std::string what = side_name(c, boundary.inequality) + ": vertex " + std::to_string(v);
      points.push_back(first_vertex_[c] + v);
      if (quilt_.degree(points.back()) != 1) throw InvalidInput(what + " is no end of the curve");
      if (!taken.insert(points.back()).second) throw InvalidInput(what + " is there twice, or in two parts");
    }
    return points;
  }

  void mark_edges(std::size_t c, const BoundaryPart& boundary, BoundaryEdges& beside) const {
    const std::string name = side_name(c, boundary.inequality);
    if (boundary.simplices.size() % 2 != 0) throw InvalidInput(name + ": an odd number of vertices for edges");
    for (std::size_t i = 0; i < boundary.simplices.size(); i += 2) {
      const Vertex a = first_vertex_[c] + boundary.simplices[i], b = first_vertex_[c] + boundary.simplices[i + 1];
      const std::string edge = name + ": the edge of vertices " + std::to_string(boundary.simplices[i]) + " and " +
                               std::to_string(boundary.simplices[i + 1]);
      if (!beside.contains(a) || !beside[a].contains(b)) {
        throw InvalidInput(edge + " is not on the boundary of the piece");
      }
      if (beside[a][b] != kFree) {
        throw InvalidInput(edge + " is there twice, or is in the part of inequality " + std::to_string(beside[a][b]) +
                           ", too");
      }
      beside[a][b] = beside[b][a] = boundary.inequality;
    }
  }

  /// Fills the arcs, loops and corners of the parts.
  void take_apart(const BoundaryEdges& beside) {
    std::set<std::pair<Vertex, Vertex>> done;
    const auto is_corner = [&](Vertex v) {
      const auto& edges = beside.at(v);
      return edges.begin()->second != std::next(edges.begin())->second;
    };
    /// Along the part from edge (a, b), until a corner or back at a.
    const auto follow = [&](Vertex a, Vertex b) {
      std::vector<Vertex> strand{a};
      for (Vertex previous = a, v = b;;) {
        done.insert(std::minmax(previous, v));
        strand.push_back(v);
        if (v == a || is_corner(v)) return strand;
        const auto& edges = beside.at(v);
        const Vertex next = edges.begin()->first == previous ? std::next(edges.begin())->first : edges.begin()->first;
        previous = std::exchange(v, next);
      }
    };
    for (const bool arcs : {true, false}) {
      for (const auto& [a, edges] : beside) {
        if (arcs && !is_corner(a)) continue;
        for (const auto& [b, inequality] : edges) {
          const auto found = parts_.find({quilt_.patch_of(a), inequality});
          if (found == parts_.end()) continue;
          if (arcs) found->second.corners.push_back(a);
          if (done.contains(std::minmax(a, b))) continue;
          std::vector<Vertex> strand = follow(a, b);
          if (!arcs) strand.pop_back();
          (arcs ? found->second.arcs : found->second.loops).push_back(std::move(strand));
        }
      }
    }
  }

  std::vector<double> apply(const CoordinateMap& map, std::span<const double> x, std::size_t size,
                            const std::string& name) const {
    std::vector<double> y(size);
    map(x, y);
    if (!std::all_of(y.begin(), y.end(), [](double value) { return std::isfinite(value); })) {
      throw OracleError(name + " is not finite at " + text(x));
    }
    return y;
  }

  std::vector<double> own_points(std::span<const Vertex> vertices) const {
    std::vector<double> points;
    for (const Vertex v : vertices) points.insert(points.end(), quilt_.point(v).begin(), quilt_.point(v).end());
    return points;
  }
  std::vector<double> images(std::size_t s, std::span<const Vertex> vertices) const {
    std::vector<double> points;
    for (const Vertex v : vertices) {
      const std::vector<double> image =
          apply(seams_[s].transition, quilt_.point(v), ambient_dim_, seam_name(s) + ": the transition");
      points.insert(points.end(), image.begin(), image.end());
    }
    return points;
  }

  SeamReport glue(std::size_t s) {
    const Seam& seam = seams_[s];
    const Part& first = parts_[{seam.first_chart, seam.first_inequality}];
    const Part& second = parts_[{seam.second_chart, seam.second_inequality}];
    if (first.corners.size() != second.corners.size() || first.loops.size() != second.loops.size()) {
      const auto found = [&](const Part& part) {
        if (dim_ == 1) return plural(part.corners.size(), "point");
        return plural(part.arcs.size(), "arc") + " with " + plural(part.corners.size(), "corner") + " and " +
               plural(part.loops.size(), "loop");
      };
      throw SeamMismatch(seam_name(s) + ": " + found(first) + " on the first side, " + found(second) +
                         " on the second; " + kAdvice);
    }
    SeamReport report;
    report.num_corners = first.corners.size();
    report.num_arcs = first.arcs.size();
    report.num_loops = first.loops.size();
    allowed_ = options_.max_distance * longest_edge(s, first);
    const Matching corners = match_corners(s, first, second, report);
    glue_arcs(s, first, second, corners, report);
    glue_loops(s, first, second, report);
    return report;
  }

  /// Of the second piece, and of the first part in the second chart's coordinates. A part alone may consist of the tiny
  /// edges that a cut leaves.
  double longest_edge(std::size_t s, const Part& first) const {
    double longest = 0;
    const auto take = [&](std::vector<double> points) {
      longest = std::max(longest, Polyline(std::move(points), ambient_dim_).longest_segment());
    };
    for (const auto& arc : first.arcs) take(images(s, arc));
    for (std::vector<Vertex> loop : first.loops) {
      loop.push_back(loop.front());
      take(images(s, loop));
    }
    for (std::size_t i = 0; i < quilt_.num_simplices(); ++i) {
      if (quilt_.patch_of_simplex(i) == seams_[s].second_chart) take(own_points(quilt_.simplex(i)));
    }
    return longest;
  }

  void check_distance(std::size_t s, double apart, std::span<const double> place, const std::string& what,
                      SeamReport& report) const {
    if (report.worst_place.empty() || apart > report.worst_distance) {
      report.worst_distance = apart;
      report.worst_place.assign(place.begin(), place.end());
    }
    if (apart <= allowed_) return;
    throw SeamMismatch(seam_name(s) + ": " + what + " at " + text(place) + " in the coordinates of " +
                       chart_name(seams_[s].second_chart) + " are " + text(apart) + " apart, more than " +
                       text(allowed_) + " (" + text(options_.max_distance) + " of the longest edge there); " + kAdvice);
  }

  Matching match_corners(std::size_t s, const Part& first, const Part& second, SeamReport& report) {
    const std::size_t count = first.corners.size(), d = ambient_dim_;
    const std::vector<double> from = images(s, first.corners), to = own_points(second.corners);
    const auto point = [d](const std::vector<double>& points, std::size_t i) {
      return std::span<const double>(&points[i * d], d);
    };
    Matching partner(count);
    std::vector<std::size_t> taken_by(count, count);
    const std::string noun = dim_ == 1 ? "point" : "corner";
    const auto describe = [&](std::size_t i) {
      return noun + " " + text(quilt_.point(first.corners[i])) + " of " + chart_name(seams_[s].first_chart) +
             ", which comes to " + text(point(from, i)) + " in " + chart_name(seams_[s].second_chart);
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
      check_distance(s, best, point(from, i), "the " + describe(i) + ", and the nearest there,", report);
      const std::size_t other = std::exchange(taken_by[partner[i]], i);
      if (kUnambiguous * best >= next || other != count) {
        throw SeamMismatch(seam_name(s) + ": the " + describe(i) + ": " +
                           (other != count ? "another " + noun + ", " + text(quilt_.point(first.corners[other])) +
                                                 ", has the same nearest " + noun + " there"
                                           : noun + "s there are at " + text(best) + " and " + text(next) +
                                                 ", which does not tell which is meant") +
                           "; " + kAdvice);
      }
    }
    const bool mirror = is_own_mirror(seams_[s]);
    for (std::size_t i = 0; i < count; ++i) {
      if (mirror) check_involution(s, i == partner[i], partner[partner[i]] == i, describe(i));
      quilt_.unite(first.corners[i], second.corners[partner[i]]);
    }
    return partner;
  }

  void check_involution(std::size_t s, bool fixed, bool is_involution, const std::string& what) const {
    if (!fixed && is_involution) return;
    throw SeamMismatch(seam_name(s) + ": a part that is sewn to itself needs an involution without fixed points, but " +
                       what + (fixed ? " comes to itself" : " does not come back"));
  }

  void glue_arcs(std::size_t s, const Part& first, const Part& second, const Matching& corners, SeamReport& report) {
    const auto corner = [](const Part& part, Vertex v) {
      return static_cast<std::size_t>(std::lower_bound(part.corners.begin(), part.corners.end(), v) -
                                      part.corners.begin());
    };
    std::map<Vertex, std::size_t> arc_at;
    for (std::size_t a = 0; a < second.arcs.size(); ++a) {
      arc_at[second.arcs[a].front()] = arc_at[second.arcs[a].back()] = a;
    }
    for (std::size_t a = 0; a < first.arcs.size(); ++a) {
      const std::vector<Vertex>& arc = first.arcs[a];
      const Vertex start = second.corners[corners[corner(first, arc.front())]];
      const Vertex end = second.corners[corners[corner(first, arc.back())]];
      const std::size_t b = arc_at.at(start);
      std::vector<Vertex> other = second.arcs[b];
      if (other.front() != start) std::reverse(other.begin(), other.end());
      if (other.back() != end) {
        throw SeamMismatch(seam_name(s) + ": the arc from " + text(quilt_.point(arc.front())) + " to " +
                           text(quilt_.point(arc.back())) + " of " + chart_name(seams_[s].first_chart) +
                           " should end at " + text(quilt_.point(end)) + " of " + chart_name(seams_[s].second_chart) +
                           ", but ends at " + text(quilt_.point(other.back())) + " there; " + kAdvice);
      }
      if (is_own_mirror(seams_[s])) {
        check_involution(s, a == b, true, "the arc from " + text(quilt_.point(start)));
        if (b < a) continue;
      }
      sew(s, arc, other, report);
    }
  }

  /// A loop as a polyline that returns to its start.
  Polyline closed_polyline(std::vector<double> points) const {
    points.insert(points.end(), points.begin(), points.begin() + ambient_dim_);
    return Polyline(std::move(points), ambient_dim_);
  }

  /// The larger of the distances of points of each from the other.
  static double apart(const Polyline& first, const Polyline& second) {
    double worst = 0;
    for (const auto& [from, to] : {std::pair(&first, &second), std::pair(&second, &first)}) {
      for (std::size_t i = 0; i < kSamples; ++i) {
        const double arc = from->length() * static_cast<double>(i) / kSamples;
        worst = std::max(worst, to->nearest(from->point_at(arc)).distance);
      }
    }
    return worst;
  }

  void glue_loops(std::size_t s, const Part& first, const Part& second, SeamReport& report) {
    const bool mirror = is_own_mirror(seams_[s]);
    const std::size_t count = first.loops.size();
    std::vector<Polyline> from, to;
    for (const auto& loop : first.loops) from.push_back(closed_polyline(images(s, loop)));
    for (const auto& loop : second.loops) to.push_back(closed_polyline(own_points(loop)));
    Matching partner(count);
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
          "the loop through " + text(quilt_.point(first.loops[i][0])) + " of " + chart_name(seams_[s].first_chart);
      check_distance(s, best, from[i].vertex(0), what + " and the nearest there, somewhere on it,", report);
      if (kUnambiguous * best >= next || std::exchange(taken_by[partner[i]], i) != count) {
        throw SeamMismatch(seam_name(s) + ": " + what + " is at " + text(best) + " from the nearest loop of " +
                           chart_name(seams_[s].second_chart) + " and " + text(next) +
                           " from another, which does not tell which is meant; " + kAdvice);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (mirror && partner[partner[i]] != i) {
        check_involution(s, false, false, "the loop through " + text(quilt_.point(first.loops[i][0])));
      }
      if (mirror && partner[i] < i) continue;
      glue_loop(s, first.loops[i], second.loops[partner[i]], from[i], to[partner[i]], mirror && partner[i] == i,
                report);
    }
  }

  /// Opens both loops at a common vertex; then they are arcs.
  void glue_loop(std::size_t s, std::vector<Vertex> loop, std::vector<Vertex> other, const Polyline& from,
                 const Polyline& to, bool is_own_mirror, SeamReport& report) {
    const bool same_direction = runs_along(s, from, to);
    // A vertex whose foot is near a vertex of the other loop, so that none has to be inserted, if there is one.
    std::size_t start = 0;
    Polyline::Foot foot;
    double best = std::numeric_limits<double>::infinity();
    const std::size_t step = std::max<std::size_t>(1, loop.size() / kSamples);
    for (std::size_t i = 0; i < loop.size(); i += step) {
      const Polyline::Foot candidate = to.nearest(from.vertex(i));
      const double off = std::min(candidate.fraction, 1 - candidate.fraction);
      if (off >= best) continue;
      best = off;
      start = i;
      foot = candidate;
    }
    constexpr double kNear = 0.1;  // of the segment
    std::size_t anchor = foot.segment;
    if (best <= kNear) {
      anchor = (foot.segment + (foot.fraction > 0.5)) % other.size();
    } else {
      const Vertex inserted =
          quilt_.split(other[foot.segment], other[(foot.segment + 1) % other.size()], foot.fraction);
      anchor = foot.segment + 1;
      if (is_own_mirror) {
        loop.insert(loop.begin() + anchor, inserted);
        if (anchor <= start) ++start;
      }
      other.insert(other.begin() + anchor, inserted);
    }
    const Vertex start_vertex = loop[start];
    std::rotate(loop.begin(), loop.begin() + start, loop.end());
    std::rotate(other.begin(), other.begin() + anchor, other.end());
    loop.push_back(loop.front());
    other.push_back(other.front());
    if (!is_own_mirror) {
      if (!same_direction) std::reverse(other.begin(), other.end());
      sew(s, loop, other, report);
      return;
    }
    // From `start` to its image, and from the image on to `start`.
    const auto image = std::find(loop.begin(), loop.end(), other.front());
    const bool fixed = image == loop.begin() || !same_direction;
    check_involution(s, fixed, true, "a point near " + text(quilt_.point(start_vertex)));
    const std::vector<Vertex> half(loop.begin(), image + 1), rest(image, loop.end());
    sew(s, half, rest, report);
  }

  /// Whether the loops have the same direction.
  bool runs_along(std::size_t s, const Polyline& from, const Polyline& to) const {
    double turned = 0, last = 0;
    for (std::size_t i = 0; i <= kSamples; ++i) {
      const double arc = to.nearest(from.point_at(from.length() * static_cast<double>(i) / kSamples)).arc;
      if (i > 0) turned += std::remainder(arc - last, to.length());
      last = arc;
    }
    if (!(std::abs(std::abs(turned) - to.length()) < 0.5 * to.length())) {
      throw SeamMismatch(seam_name(s) + ": the loop through " + text(from.vertex(0)) + " in the coordinates of " +
                         chart_name(seams_[s].second_chart) + " does not run once along the loop there; " + kAdvice);
    }
    return turned > 0;
  }

  /// Sews two strands, ends to ends, after splitting the edges of each at the vertices of the other.
  void sew(std::size_t s, const std::vector<Vertex>& first, const std::vector<Vertex>& second, SeamReport& report) {
    const Polyline from(images(s, first), ambient_dim_), to(own_points(second), ambient_dim_);
    const CommonRefinement refinement = internal::common_refinement(from, to, 4 * allowed_);
    check_distance(s, refinement.worst_distance, refinement.worst_place, "the two sides", report);
    std::vector<PolylinePlace> first_places, second_places;
    for (const CommonRefinement::Station& station : refinement.stations) {
      first_places.push_back(station.first);
      second_places.push_back(station.second);
    }
    const std::vector<Vertex> a = split(first, first_places), b = split(second, second_places);
    for (std::size_t i = 1; i < a.size(); ++i) quilt_.sew({a[i - 1], a[i]}, {b[i - 1], b[i]});
  }

  std::vector<Vertex> split(const std::vector<Vertex>& strand, const std::vector<PolylinePlace>& places) {
    std::vector<Vertex> result;
    double done = 0;  // fraction of the segment
    for (const PolylinePlace& place : places) {
      if (place.is_vertex) {
        result.push_back(strand[place.index]);
        done = 0;
        continue;
      }
      const double rest = done < 1 ? std::clamp((place.fraction - done) / (1 - done), 0.0, 1.0) : 0;
      result.push_back(quilt_.split(result.back(), strand[place.index + 1], rest));
      done = place.fraction;
    }
    return result;
  }

  void collect(GluedMesh& result) const {
    const std::size_t total = quilt_.num_vertices();
    const bool embedded = !options_.embeddings.empty();
    SimplicialMesh mesh;
    mesh.dim = dim_;
    mesh.ambient_dim = embedded ? options_.embedding_dim : static_cast<int>(ambient_dim_);
    NamedArray chart_of_point{"chart", 1, {}}, chart_of_simplex{"chart", 1, {}};
    std::vector<std::uint32_t> number(total);
    for (Vertex v = 0; v < total; ++v) {
      if (quilt_.representative(v) != v) continue;
      number[v] = static_cast<std::uint32_t>(chart_of_point.values.size());
      const std::vector<double> point = place(v);
      mesh.points.insert(mesh.points.end(), point.begin(), point.end());
      result.chart_points.insert(result.chart_points.end(), quilt_.point(v).begin(), quilt_.point(v).end());
      chart_of_point.values.push_back(quilt_.patch_of(v));
    }
    for (std::size_t s = 0; s < quilt_.num_simplices(); ++s) {
      for (const Vertex v : quilt_.simplex(s)) mesh.simplices.push_back(number[quilt_.representative(v)]);
      chart_of_simplex.values.push_back(quilt_.patch_of_simplex(s));
    }
    mesh.point_data.push_back(std::move(chart_of_point));
    mesh.cell_data.push_back(std::move(chart_of_simplex));
    for (std::size_t c = 0; c < pieces_.size(); ++c) {
      std::vector<std::uint32_t>& map = result.vertex_of.emplace_back();
      for (std::size_t v = 0; v < pieces_[c].mesh.num_points(); ++v) {
        map.push_back(number[quilt_.representative(first_vertex_[c] + v)]);
      }
    }
    if (embedded) check_embeddings(mesh, number);
    result.mesh = orient(std::move(mesh)).mesh;
  }

  /// The coordinates of a vertex in the result, as its own chart has them.
  std::vector<double> place(Vertex v) const {
    const auto own = quilt_.point(v);
    if (options_.embeddings.empty()) return {own.begin(), own.end()};
    const int c = quilt_.patch_of(v);
    return apply(options_.embeddings[c], own, options_.embedding_dim, chart_name(c) + ": the embedding");
  }

  /// Charts must agree on where an identified vertex is. Seams that contradict each other fail here: around a corner of
  /// three charts, every two may agree, and the three not.
  void check_embeddings(const SimplicialMesh& mesh, const std::vector<std::uint32_t>& number) const {
    const auto point = [&](std::uint32_t v) {
      return std::span<const double>(&mesh.points[v * mesh.ambient_dim], mesh.ambient_dim);
    };
    double longest = 0;
    for (std::size_t s = 0; s < mesh.num_simplices(); ++s) {
      for (int i = 0; i < dim_; ++i) {
        const std::uint32_t* simplex = &mesh.simplices[s * (dim_ + 1)];
        longest = std::max(longest, distance(point(simplex[i]), point(simplex[i + 1])));
      }
    }
    for (Vertex v = 0; v < number.size(); ++v) {
      const Vertex same = quilt_.representative(v);
      if (same == v) continue;
      const std::vector<double> here = place(v);
      const double apart = distance(here, point(number[same]));
      if (apart <= options_.max_distance * longest) continue;
      throw SeamMismatch("the vertex " + text(quilt_.point(same)) + " of " + chart_name(quilt_.patch_of(same)) +
                         " is identified with " + text(quilt_.point(v)) + " of " + chart_name(quilt_.patch_of(v)) +
                         ", but their embeddings are " + text(apart) +
                         " apart: the transitions of the seams or the embeddings contradict each other, or " + kAdvice);
    }
  }

  std::span<const ChartPiece> pieces_;
  std::span<const Seam> seams_;
  const GlueOptions& options_;
  int dim_;
  std::size_t ambient_dim_;
  Quilt quilt_;
  std::vector<Vertex> first_vertex_;           ///< of every piece, in the quilt
  std::map<std::pair<int, int>, Part> parts_;  ///< by chart and inequality
  double allowed_ = 0;                         ///< distance, at the seam being glued
};

}  // namespace

ChartPiece chart_piece(std::string name, SimplicialMesh mesh, const Strata& strata) {
  std::map<int, BoundaryPart> parts;
  for (const MeshStratum& stratum : mesh.strata) {
    const std::vector<int>& inequalities = strata.strata.at(stratum.stratum).inequalities;
    if (inequalities.size() != 1 || stratum.dim + 1 != mesh.dim) continue;
    BoundaryPart& part = parts[inequalities[0]];
    part.inequality = inequalities[0];
    part.simplices.insert(part.simplices.end(), stratum.simplices.begin(), stratum.simplices.end());
  }
  ChartPiece piece{std::move(name), std::move(mesh)};
  for (auto& [inequality, part] : parts) piece.boundary.push_back(std::move(part));
  return piece;
}

GluedMesh glue_charts(std::span<const ChartPiece> pieces, std::span<const Seam> seams, const GlueOptions& options) {
  return Gluer(pieces, seams, options).run();
}

}  // namespace whitney
