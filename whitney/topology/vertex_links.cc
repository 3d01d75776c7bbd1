// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/vertex_links.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include <coxeter/base/disjoint_sets.h>
#include <coxeter/base/run_watch.h>
#include <whitney/topology/chain_complex.h>
#include <whitney/topology/face_lattice.h>
#include <whitney/topology/homology.h>

namespace whitney {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class LinkChecker {
 public:
  LinkChecker(const SimplicialMesh& mesh, const RunControl& run)
      : n_(mesh.dim), links_(mesh.dim + 1), singular_(mesh.num_points()), run_(run), watch_(run, "links") {
    for (Link& link : links_) link.number.assign(mesh.num_points(), kNone);
    links_[0].simplices = mesh.simplices;
  }

  LinkReport run() {
    try {
      if (!watch_.fits(star_bytes()) || watch_.stopped_now()) throw RunWatch::Stopped{};
      visit(0);
    } catch (const RunWatch::Stopped&) {
      report_.stop_reason = watch_.reason();
      report_.proved = false;
    }
    report_.singular_vertices = std::count(singular_.begin(), singular_.end(), true);
    return std::move(report_);
  }

 private:
  /// What visit() takes for the mesh; smaller links take less.
  std::uint64_t star_bytes() const {
    return 4 * (links_[0].simplices.size() + singular_.size() * static_cast<std::size_t>(n_ + 4));
  }

  /// The link of a face, with vertices numbered 0, 1, ..; reused for all faces of one dimension.
  struct Link {
    std::vector<std::uint32_t> simplices;  // first in vertices of the mesh, then in numbers
    std::vector<std::uint32_t> vertices;   // of the mesh, ascending
    std::vector<std::uint32_t> number;     // of a vertex of the mesh in this link, or kNone
    std::vector<std::uint32_t> star_begin;
    std::vector<std::uint32_t> star;  // simplices around each vertex
    DisjointSets sets;
    std::vector<std::uint32_t> count;
  };

  /// Checks the link in links_[level] of face_, which has `level` vertices, and the links of the faces that add larger
  /// vertices. For level 0 the link is the mesh.
  void visit(int level) {
    watch_.check();
    Link& link = links_[level];
    const int m = n_ - level;  // its dimension
    number_vertices(link);
    if (m >= 2 || (m == 1 && level == 0)) {
      list_stars(link, m);
      const std::uint32_t largest = level == 0 ? 0 : face_.back() + 1;
      const auto begin = std::lower_bound(link.vertices.begin(), link.vertices.end(), largest) - link.vertices.begin();
      for (std::size_t w = begin; w < link.vertices.size(); ++w) {
        std::vector<std::uint32_t>& simplices = links_[level + 1].simplices;
        simplices.clear();
        for (std::uint32_t s = link.star_begin[w]; s < link.star_begin[w + 1]; ++s) {
          const std::uint32_t* simplex = link.simplices.data() + std::size_t{link.star[s]} * (m + 1);
          for (int k = 0; k <= m; ++k) {
            if (simplex[k] != w) simplices.push_back(link.vertices[simplex[k]]);
          }
        }
        face_.push_back(link.vertices[w]);
        visit(level + 1);
        face_.pop_back();
      }
    }
    if (level > 0) judge(link, m);
    for (std::uint32_t v : link.vertices) link.number[v] = kNone;
  }

  static void number_vertices(Link& link) {
    link.vertices.clear();
    for (std::uint32_t v : link.simplices) {
      if (link.number[v] != kNone) continue;
      link.number[v] = 0;
      link.vertices.push_back(v);
    }
    std::sort(link.vertices.begin(), link.vertices.end());
    for (std::size_t i = 0; i < link.vertices.size(); ++i) link.number[link.vertices[i]] = i;
    for (std::uint32_t& v : link.simplices) v = link.number[v];
  }

  static void list_stars(Link& link, int m) {
    link.star_begin.assign(link.vertices.size() + 1, 0);
    for (std::uint32_t v : link.simplices) ++link.star_begin[v + 1];
    std::partial_sum(link.star_begin.begin(), link.star_begin.end(), link.star_begin.begin());
    link.count.assign(link.star_begin.begin(), link.star_begin.end() - 1);
    link.star.resize(link.simplices.size());
    for (std::size_t e = 0; e < link.simplices.size(); ++e) link.star[link.count[link.simplices[e]]++] = e / (m + 1);
  }

  void judge(Link& link, int m) {
    if (m == 0) {
      if (link.vertices.size() > 2) {
        defect("lies in " + std::to_string(link.vertices.size()) + " edges, a point of a curve in 1 or 2");
      }
      return;
    }
    if (m == 1) {
      link.count.assign(link.vertices.size(), 0);
      for (std::uint32_t v : link.simplices) ++link.count[v];
      for (std::size_t v = 0; v < link.vertices.size(); ++v) {
        if (link.count[v] <= 2) continue;
        face_.push_back(link.vertices[v]);
        defect("lies in " + std::to_string(link.count[v]) + " simplices of dimension " + std::to_string(n_) +
               ", more than two");
        face_.pop_back();
        return;
      }
    }
    if (const std::size_t components = count_components(link, m); components != 1) {
      defect("has a link of " + std::to_string(components) + " components");
      return;
    }
    if (m == 2) judge_surface(link);
    if (m >= 3) judge_homology(link, m);
  }

  static std::size_t count_components(Link& link, int m) {
    link.sets.reset(link.vertices.size());
    std::size_t components = link.vertices.size();
    for (std::size_t i = 0; i < link.simplices.size(); i += m + 1) {
      for (int k = 1; k <= m; ++k) components -= link.sets.unite(link.simplices[i], link.simplices[i + k]);
    }
    return components;
  }

  /// A connected surface is a sphere when closed with Euler characteristic 2, a disc when with boundary and 1. (Where
  /// the link is no surface, a larger face has a defect already.)
  void judge_surface(Link& link) {
    link.count.assign(link.vertices.size(), 0);
    std::ptrdiff_t edge_ends = 0;
    bool closed = true;
    for (std::size_t v = 0; v < link.vertices.size(); ++v) {
      const auto star = [&](auto action) {
        for (std::uint32_t s = link.star_begin[v]; s < link.star_begin[v + 1]; ++s) {
          for (int k = 0; k < 3; ++k) {
            if (const std::uint32_t w = link.simplices[3 * std::size_t{link.star[s]} + k]; w != v) action(w);
          }
        }
      };
      star([&](std::uint32_t w) { edge_ends += link.count[w]++ == 0; });
      star([&](std::uint32_t w) { closed = closed && link.count[w] != 1; });
      star([&](std::uint32_t w) { link.count[w] = 0; });
    }
    const std::ptrdiff_t chi =
        std::ptrdiff_t(link.vertices.size()) - edge_ends / 2 + std::ptrdiff_t(link.simplices.size() / 3);
    if (chi == (closed ? 2 : 1)) return;
    defect("has as link a surface " + std::string(closed ? "without" : "with") + " boundary of Euler characteristic " +
           std::to_string(chi) + (closed ? ", not a sphere" : ", not a disc"));
  }

  void judge_homology(Link& link, int m) {
    const FaceLattice lattice = face_lattice(m, link.simplices, link.vertices.size());
    std::vector<std::uint32_t> cofacets(lattice.num_faces(m - 1), 0);
    for (std::uint32_t f : lattice.facets[m].index) ++cofacets[f];
    const bool closed = std::find(cofacets.begin(), cofacets.end(), 1) == cofacets.end();
    RunControl run = run_;
    run.time_limit -= watch_.seconds();
    const Homology found = homology(lattice.facets, simplicial_signs(lattice.facets), run);
    if (found.stop_reason != StopReason::kNone) {
      watch_.stop(found.stop_reason);
      throw RunWatch::Stopped{};
    }
    std::vector<HomologyGroup> wanted(m + 1);
    wanted[0].rank = 1;
    wanted[m].rank = closed ? 1 : 0;
    if (found.groups == wanted) {
      const std::size_t cells =
          std::accumulate(found.critical_cells.begin(), found.critical_cells.end(), std::size_t{0});
      if (cells > (closed ? 2 : 1)) report_.proved = false;
      return;
    }
    std::string groups;
    for (const HomologyGroup& group : found.groups) groups += (groups.empty() ? "" : ", ") + to_string(group);
    defect("has a link with homology " + groups + ", not that of a " + (closed ? "sphere" : "ball"));
  }

  void defect(const std::string& reason) {
    for (std::uint32_t v : face_) singular_[v] = true;
    if (report_.first.has_value()) return;
    report_.first = LinkDefect{face_, reason};
    std::sort(report_.first->face.begin(), report_.first->face.end());
  }

  int n_;
  std::vector<Link> links_;
  std::vector<bool> singular_;
  std::vector<std::uint32_t> face_;
  const RunControl& run_;
  RunWatch watch_;
  LinkReport report_;
};

}  // namespace

LinkReport check_vertex_links(const SimplicialMesh& mesh, const RunControl& run) {
  face_lattice(mesh, mesh.dim);  // rejects what is not a simplicial complex
  return LinkChecker(mesh, run).run();
}

}  // namespace whitney
