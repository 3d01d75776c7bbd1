// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/boundary_strands.h>

#include <algorithm>
#include <set>

#include <coxeter/base/error.h>

namespace whitney::internal {
namespace {

using Vertex = Quilt::Vertex;

class StrandFinder {
 public:
  StrandFinder(std::span<const ChartPiece> pieces, const SeamNames& names, int dim, const Quilt& quilt,
               std::span<const Vertex> first_vertex)
      : pieces_(pieces), names_(names), dim_(dim), quilt_(quilt), first_vertex_(first_vertex) {}

  StrandsBySide run() {
    BoundaryEdges beside = boundary_edges();
    std::set<Vertex> ends;
    for (std::size_t c = 0; c < pieces_.size(); ++c) {
      for (const BoundaryPart& boundary : pieces_[c].boundary) {
        const std::string name = names_.side(c, boundary.inequality);
        if (boundary.inequality < 0) throw InvalidInput(name + ": inequalities are numbered from 0");
        const auto [part, is_new] = strands_.try_emplace({static_cast<int>(c), boundary.inequality});
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
    for (auto& [where, part] : strands_) std::sort(part.corners.begin(), part.corners.end());
    return std::move(strands_);
  }

 private:
  /// Boundary edges of surfaces, from both ends, and the inequality of the part that they belong to.
  using BoundaryEdges = std::map<Vertex, std::map<Vertex, int>>;
  static constexpr int kFree = -1;  ///< in no part

  BoundaryEdges boundary_edges() const {
    BoundaryEdges beside;
    if (dim_ == 2) {
      for (const auto& [a, b] : quilt_.boundary_edges()) beside[a][b] = beside[b][a] = kFree;
    }
    for (const auto& [v, edges] : beside) {
      if (edges.size() == 2) continue;
      const int c = quilt_.patch_of(v);
      throw InvalidInput(names_.chart(c) + ": " + std::to_string(edges.size()) + " boundary edges meet at vertex " +
                         std::to_string(v - first_vertex_[c]) + ": the piece is no surface there");
    }
    return beside;
  }

  std::vector<Vertex> end_points(std::size_t c, const BoundaryPart& boundary, std::set<Vertex>& taken) const {
    std::vector<Vertex> points;
    for (const std::uint32_t v : boundary.simplices) {
      const std::string what = names_.side(c, boundary.inequality) + ": vertex " + std::to_string(v);
      points.push_back(first_vertex_[c] + v);
      if (quilt_.degree(points.back()) != 1) throw InvalidInput(what + " is no end of the curve");
      if (!taken.insert(points.back()).second) throw InvalidInput(what + " is there twice, or in two parts");
    }
    return points;
  }

  void mark_edges(std::size_t c, const BoundaryPart& boundary, BoundaryEdges& beside) const {
    const std::string name = names_.side(c, boundary.inequality);
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
          const auto found = strands_.find({quilt_.patch_of(a), inequality});
          if (found == strands_.end()) continue;
          if (arcs) found->second.corners.push_back(a);
          if (done.contains(std::minmax(a, b))) continue;
          std::vector<Vertex> strand = follow(a, b);
          if (!arcs) strand.pop_back();
          (arcs ? found->second.arcs : found->second.loops).push_back(std::move(strand));
        }
      }
    }
  }

  std::span<const ChartPiece> pieces_;
  const SeamNames& names_;
  int dim_;
  const Quilt& quilt_;
  std::span<const Vertex> first_vertex_;
  StrandsBySide strands_;
};

}  // namespace

std::string SeamNames::chart(int c) const {
  return "chart " + (pieces_[c].name.empty() ? std::to_string(c) : pieces_[c].name);
}

std::string SeamNames::side(int chart_number, int inequality) const {
  return chart(chart_number) + ", inequality " + std::to_string(inequality);
}

std::string SeamNames::seam(std::size_t s) const {
  const Seam& its = seams_[s];
  return "seam " + std::to_string(s) + " (" + side(its.first_chart, its.first_inequality) + ", with " +
         side(its.second_chart, its.second_inequality) + ")";
}

std::vector<Vertex> add_patches(std::span<const ChartPiece> pieces, const SeamNames& names, Quilt& quilt) {
  std::vector<Vertex> first_vertex;
  for (std::size_t c = 0; c < pieces.size(); ++c) {
    try {
      first_vertex.push_back(quilt.add_patch(pieces[c].mesh));
    } catch (const InvalidInput& error) {
      throw InvalidInput(names.chart(c) + ": " + error.what());
    }
  }
  return first_vertex;
}

StrandsBySide boundary_strands(std::span<const ChartPiece> pieces, const SeamNames& names, int dim, const Quilt& quilt,
                               std::span<const Vertex> first_vertex) {
  return StrandFinder(pieces, names, dim, quilt, first_vertex).run();
}

}  // namespace whitney::internal
