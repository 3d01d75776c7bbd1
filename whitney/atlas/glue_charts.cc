// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/glue_charts.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include <coxeter/base/error.h>
#include <coxeter/base/text.h>
#include <whitney/atlas/boundary_strands.h>
#include <whitney/atlas/polyline.h>
#include <whitney/atlas/quilt.h>
#include <whitney/atlas/seam_matching.h>
#include <whitney/topology/orientation.h>

namespace whitney {
namespace {

using internal::BoundaryStrands;
using internal::CommonRefinement;
using internal::distance;
using internal::kSmallerEdges;
using internal::LoopMatching;
using internal::Matching;
using internal::Polyline;
using internal::PolylinePlace;
using internal::Quilt;
using internal::SeamMatcher;
using Vertex = Quilt::Vertex;

std::string plural(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// The method, step by step: patches and their boundary strands; for every seam, what belongs together (seam_matching),
/// common refinement and sewing; the quotient made simplicial; one mesh of it.
class Gluer {
 public:
  Gluer(std::span<const ChartPiece> pieces, std::span<const Seam> seams, const GlueOptions& options)
      : pieces_(pieces),
        seams_(seams),
        options_(options),
        names_(pieces, seams),
        dim_(check_pieces()),
        ambient_dim_(pieces[0].mesh.ambient_dim),
        quilt_(dim_, ambient_dim_) {}

  GluedMesh run() {
    check_seams();
    first_vertex_ = internal::add_patches(pieces_, names_, quilt_);
    internal::StrandsBySide strands = internal::boundary_strands(pieces_, names_, dim_, quilt_, first_vertex_);
    GluedMesh result;
    for (std::size_t s = 0; s < seams_.size(); ++s) {
      const Seam& seam = seams_[s];
      result.seams.push_back(glue(s, strands[{seam.first_chart, seam.first_inequality}],
                                  strands[{seam.second_chart, seam.second_inequality}]));
    }
    quilt_.make_simplicial();
    collect(result);
    return result;
  }

 private:
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
        throw InvalidInput(names_.chart(c) + ": a mesh of dimension " + std::to_string(mesh.dim) + " in R^" +
                           std::to_string(mesh.ambient_dim) + ", but " + names_.chart(0) + " has dimension " +
                           std::to_string(n) + " in R^" + std::to_string(d));
      }
      if (mesh.points.size() % d != 0 || mesh.simplices.size() % (n + 1) != 0) {
        throw InvalidInput(names_.chart(c) + ": the lengths of points and simplices do not fit the dimensions");
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
      if (!seam.transition) throw InvalidInput(names_.seam(s) + ": the transition is an empty std::function");
      const auto use = [&](int chart, int inequality) {
        const auto [at, is_new] = seam_of.try_emplace({chart, inequality}, s);
        if (!is_new) {
          throw InvalidInput(names_.seam(s) + ": " + names_.side(chart, inequality) + " is in " +
                             names_.seam(at->second) + " already");
        }
      };
      const bool is_own_mirror =
          seam.first_chart == seam.second_chart && seam.first_inequality == seam.second_inequality;
      use(seam.first_chart, seam.first_inequality);
      if (!is_own_mirror) use(seam.second_chart, seam.second_inequality);
    }
  }

  SeamReport glue(std::size_t s, const BoundaryStrands& first, const BoundaryStrands& second) {
    SeamMatcher seam(seams_, s, names_, dim_, ambient_dim_, quilt_, options_.max_distance, first, second);
    const Matching corners = seam.match_corners(first, second);
    for (std::size_t i = 0; i < corners.size(); ++i) quilt_.unite(first.corners[i], second.corners[corners[i]]);
    glue_arcs(seam, first, second, corners);
    glue_loops(seam, first, second);
    return seam.report();
  }

  void glue_arcs(SeamMatcher& seam, const BoundaryStrands& first, const BoundaryStrands& second,
                 const Matching& corners) {
    const auto corner = [](const BoundaryStrands& part, Vertex v) {
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
        throw SeamMismatch(seam.name() + ": the arc from " + text(quilt_.point(arc.front())) + " to " +
                           text(quilt_.point(arc.back())) + " of " + names_.chart(seam.seam().first_chart) +
                           " should end at " + text(quilt_.point(end)) + " of " +
                           names_.chart(seam.seam().second_chart) + ", but ends at " +
                           text(quilt_.point(other.back())) + " there; " + kSmallerEdges);
      }
      if (seam.is_own_mirror()) {
        seam.check_involution(a == b, true, "the arc from " + text(quilt_.point(start)));
        if (b < a) continue;
      }
      sew(seam, arc, other);
    }
  }

  void glue_loops(SeamMatcher& seam, const BoundaryStrands& first, const BoundaryStrands& second) {
    const LoopMatching matching = seam.match_loops(first, second);
    const Matching& partner = matching.partner;
    const bool mirror = seam.is_own_mirror();
    for (std::size_t i = 0; i < first.loops.size(); ++i) {
      if (mirror && partner[partner[i]] != i) {
        seam.check_involution(false, false, "the loop through " + text(quilt_.point(first.loops[i][0])));
      }
      if (mirror && partner[i] < i) continue;
      glue_loop(seam, first.loops[i], second.loops[partner[i]], matching.from[i], matching.to[partner[i]],
                mirror && partner[i] == i);
    }
  }

  /// Where a loop is opened: at its vertex `start`, which goes to a point of the other.
  struct Opening {
    std::size_t start = 0;
    Polyline::Foot foot{};
    bool near_vertex = false;  ///< of the other loop
  };

  /// At a vertex whose foot is near a vertex of the other loop, so that none has to be inserted, if there is one.
  static Opening find_opening(std::size_t length, const Polyline& from, const Polyline& to) {
    constexpr double kNear = 0.1;  // of the segment
    constexpr std::size_t kSamples = 32;
    Opening opening;
    double best = std::numeric_limits<double>::infinity();
    const std::size_t step = std::max<std::size_t>(1, length / kSamples);
    for (std::size_t i = 0; i < length; i += step) {
      const Polyline::Foot candidate = to.nearest(from.vertex(i));
      const double off = std::min(candidate.fraction, 1 - candidate.fraction);
      if (off >= best) continue;
      best = off;
      opening.start = i;
      opening.foot = candidate;
    }
    opening.near_vertex = best <= kNear;
    return opening;
  }

  /// Opens both loops at a common vertex; then they are arcs.
  void glue_loop(SeamMatcher& seam, std::vector<Vertex> loop, std::vector<Vertex> other, const Polyline& from,
                 const Polyline& to, bool is_own_mirror) {
    const bool same_direction = seam.runs_along(from, to);
    auto [start, foot, near_vertex] = find_opening(loop.size(), from, to);
    std::size_t anchor = foot.segment;
    if (near_vertex) {
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
      sew(seam, loop, other);
      return;
    }
    // From `start` to its image, and from the image on to `start`.
    const auto image = std::find(loop.begin(), loop.end(), other.front());
    const bool fixed = image == loop.begin() || !same_direction;
    seam.check_involution(fixed, true, "a point near " + text(quilt_.point(start_vertex)));
    const std::vector<Vertex> half(loop.begin(), image + 1), rest(image, loop.end());
    sew(seam, half, rest);
  }

  /// Sews two strands, ends to ends, after splitting the edges of each at the vertices of the other.
  void sew(SeamMatcher& seam, const std::vector<Vertex>& first, const std::vector<Vertex>& second) {
    const Polyline from(seam.images(first), ambient_dim_), to(seam.own_points(second), ambient_dim_);
    const CommonRefinement refinement = internal::common_refinement(from, to, 4 * seam.allowed());
    seam.check_distance(refinement.worst_distance, refinement.worst_place, "the two sides");
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
    return internal::apply(options_.embeddings[c], own, options_.embedding_dim, names_.chart(c) + ": the embedding");
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
      throw SeamMismatch("the vertex " + text(quilt_.point(same)) + " of " + names_.chart(quilt_.patch_of(same)) +
                         " is identified with " + text(quilt_.point(v)) + " of " + names_.chart(quilt_.patch_of(v)) +
                         ", but their embeddings are " + text(apart, 4) +
                         " apart: the transitions of the seams or the embeddings contradict each other, or " +
                         kSmallerEdges);
    }
  }

  std::span<const ChartPiece> pieces_;
  std::span<const Seam> seams_;
  const GlueOptions& options_;
  internal::SeamNames names_;
  int dim_;
  std::size_t ambient_dim_;
  Quilt quilt_;
  std::vector<Vertex> first_vertex_;  ///< of every piece, in the quilt
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
