// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/topology.h>

#include <algorithm>
#include <utility>

#include <coxeter/base/disjoint_sets.h>
#include <coxeter/base/run_watch.h>
#include <whitney/topology/chain_complex.h>
#include <whitney/topology/face_lattice.h>
#include <whitney/topology/orientation.h>

namespace whitney {
namespace {

/// Connected components of the union of the given n-cells, n = in.size() - 1, with all their faces; `in` marks cells of
/// every dimension and is completed downwards. A cell of dimension >= 2 has a connected 1-skeleton, so edges decide.
std::size_t count_components(std::span<const Incidence> facets, std::vector<std::vector<char>> in) {
  for (std::size_t j = in.size(); j-- > 1;) {
    for (std::size_t i = 0; i < in[j].size(); ++i) {
      if (!in[j][i]) continue;
      for (std::uint32_t f : facets[j][i]) in[j - 1][f] = 1;
    }
  }
  if (in.empty()) return 0;
  DisjointSets classes(in[0].size());
  std::size_t components = std::count(in[0].begin(), in[0].end(), 1);
  if (in.size() == 1) return components;
  for (std::size_t i = 0; i < in[1].size(); ++i) {
    if (in[1][i]) components -= classes.unite(facets[1][i][0], facets[1][i][1]);
  }
  return components;
}

/// Everything but links and homology.
Topology count(std::span<const Incidence> facets, const IncidenceSigns& signs) {
  Topology result;
  std::vector<std::vector<char>> every_cell;
  for (std::size_t j = 0; j < facets.size(); ++j) {
    result.f_vector.push_back(facets[j].size());
    result.euler_characteristic += (j % 2 == 0 ? 1 : -1) * static_cast<std::int64_t>(facets[j].size());
    if (j < 2) every_cell.emplace_back(facets[j].size(), 1);
  }
  result.components = count_components(facets, std::move(every_cell));

  const std::size_t n = facets.empty() ? 0 : facets.size() - 1;
  if (n == 0) return result;
  std::vector<std::vector<char>> boundary(n);
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<std::uint32_t> cofacets(facets[j].size(), 0);
    for (std::uint32_t f : facets[j + 1].index) ++cofacets[f];
    result.pure = result.pure && std::find(cofacets.begin(), cofacets.end(), 0) == cofacets.end();
    boundary[j].assign(facets[j].size(), 0);
    if (j + 1 < n) continue;
    for (std::size_t f = 0; f < cofacets.size(); ++f) {
      boundary[j][f] = cofacets[f] == 1;
      result.boundary_faces += cofacets[f] == 1;
      result.branching_faces += cofacets[f] > 2;
    }
  }
  result.boundary_components = count_components(facets, std::move(boundary));
  result.orientable =
      result.branching_faces == 0 && orient_cells(facets[n], signs[n], facets[n - 1].size()).all_orientable();
  return result;
}

/// The parts beyond the counts, one after the other, under the limits of all of them.
class Parts {
 public:
  Parts(const TopologyOptions& options, Topology& result)
      : options_(options), result_(result), watch_(options.run, "topology") {}

  void add_homology(std::span<const Incidence> facets, const IncidenceSigns& signs) {
    std::size_t num_cells = 0;
    for (const Incidence& lists : facets) num_cells += lists.size();
    if (!options_.homology || num_cells > options_.max_homology_cells || !begins("homology")) return;
    Homology found = homology(facets, signs, rest());
    if (ended("homology", found.stop_reason)) return;
    result_.betti_z2 = betti_z2(found.groups);
    result_.homology_z = std::move(found.groups);
  }

  void add_links(const SimplicialMesh& mesh) {
    if (!options_.links || !begins("vertex links")) return;
    LinkReport report = check_vertex_links(mesh, rest());
    const bool is_stopped = ended("vertex links", report.stop_reason);
    if (report.first.has_value()) {
      result_.manifold = ManifoldKind::kSingular;
    } else if (!is_stopped) {
      result_.manifold = result_.boundary_faces > 0 ? ManifoldKind::kWithBoundary : ManifoldKind::kClosed;
    }
    result_.links_proved = report.proved;
    result_.singular_vertices = report.singular_vertices;
    result_.witness = std::move(report.first);
  }

 private:
  bool begins(const char* part) {
    if (options_.begin_part && !options_.begin_part(part, result_.f_vector)) {
      result_.left_out.push_back(part);
      return false;
    }
    return true;
  }
  RunControl rest() const {
    RunControl run = options_.run;
    run.time_limit -= watch_.seconds();
    return run;
  }
  bool ended(const char* part, StopReason reason) {
    if (reason == StopReason::kNone) return false;
    result_.left_out.push_back(part);
    result_.stop_reason = reason;
    return true;
  }

  const TopologyOptions& options_;
  Topology& result_;
  RunWatch watch_;
};

}  // namespace

Topology topology_of(const SimplicialMesh& mesh, const TopologyOptions& options) {
  // A mesh that is no simplicial complex throws here.
  const FaceLattice lattice = face_lattice(mesh);
  const IncidenceSigns signs = simplicial_signs(lattice.facets);
  Topology result = count(lattice.facets, signs);
  result.unused_points = mesh.num_points() - lattice.num_faces(0);
  Parts parts(options, result);
  parts.add_homology(lattice.facets, signs);
  parts.add_links(mesh);
  return result;
}

Topology topology_of(std::span<const Incidence> facets, const TopologyOptions& options) {
  const IncidenceSigns signs = regular_cell_signs(facets);
  Topology result = count(facets, signs);
  Parts(options, result).add_homology(facets, signs);
  return result;
}

}  // namespace whitney
