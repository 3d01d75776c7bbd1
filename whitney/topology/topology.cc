// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/topology.h>

#include <algorithm>
#include <numeric>

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
  std::vector<std::uint32_t> parent(in[0].size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](std::uint32_t x) {
    while (parent[x] != x) x = parent[x] = parent[parent[x]];
    return x;
  };
  std::size_t components = std::count(in[0].begin(), in[0].end(), 1);
  if (in.size() == 1) return components;
  for (std::size_t i = 0; i < in[1].size(); ++i) {
    if (!in[1][i]) continue;
    const std::uint32_t a = find(facets[1][i][0]);
    const std::uint32_t b = find(facets[1][i][1]);
    components -= a != b;
    parent[std::max(a, b)] = std::min(a, b);
  }
  return components;
}

bool begins(const TopologyOptions& options, const char* part, const Topology& counts) {
  return !options.begin_part || options.begin_part(part, counts.f_vector);
}

Topology topology_of(std::span<const Incidence> facets, const IncidenceSigns& signs, const TopologyOptions& options) {
  Topology result;
  std::size_t num_cells = 0;
  std::vector<std::vector<char>> every_cell;
  for (std::size_t j = 0; j < facets.size(); ++j) {
    result.f_vector.push_back(facets[j].size());
    result.euler_characteristic += (j % 2 == 0 ? 1 : -1) * static_cast<std::int64_t>(facets[j].size());
    num_cells += facets[j].size();
    if (j < 2) every_cell.emplace_back(facets[j].size(), 1);
  }
  result.components = count_components(facets, std::move(every_cell));

  const std::size_t n = facets.empty() ? 0 : facets.size() - 1;
  if (n > 0) {
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
  }
  if (options.homology && num_cells <= options.max_homology_cells && begins(options, "homology", result)) {
    result.homology_z = homology(facets, signs).groups;
    result.betti_z2 = betti_z2(*result.homology_z);
  }
  return result;
}

}  // namespace

Topology topology_of(const SimplicialMesh& mesh, const TopologyOptions& options) {
  const FaceLattice lattice = face_lattice(mesh);
  Topology result = topology_of(lattice.facets, simplicial_signs(lattice.facets), options);
  result.unused_points = mesh.num_points() - lattice.num_faces(0);
  if (options.links && begins(options, "vertex links", result)) {
    LinkReport report = check_vertex_links(mesh);
    result.manifold = report.first.has_value()    ? ManifoldKind::kSingular
                      : result.boundary_faces > 0 ? ManifoldKind::kWithBoundary
                                                  : ManifoldKind::kClosed;
    result.links_proved = report.proved;
    result.singular_vertices = report.singular_vertices;
    result.witness = std::move(report.first);
  }
  return result;
}

Topology topology_of(std::span<const Incidence> facets, const TopologyOptions& options) {
  return topology_of(facets, regular_cell_signs(facets), options);
}

}  // namespace whitney
