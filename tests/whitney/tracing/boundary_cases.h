// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <coxeter/faces/faces.h>
#include <coxeter/placement.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/cells/strata.h>
#include <whitney/cells/subdivide.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/io/read_problem.h>
#include <whitney/topology/topology.h>
#include <whitney/tracing/cut_regularity.h>
#include <whitney/tracing/exact_pivot.h>
#include <whitney/tracing/trace.h>

// Functions and domains with known strata, and what must hold for every manifold with boundary.

namespace whitney::boundary_cases {

using coxeter::Simplex;
using Values = std::span<double>;
using Point = std::span<const double>;

inline Function sphere_function(int d, double radius) {
  return make_function(d, 1, [=](Point x, Values v) {
    v[0] = -radius * radius;
    for (double c : x) v[0] += c * c;
  });
}

inline Function torus_function() {
  return make_function(4, 2, [](Point x, Values v) {
    v[0] = x[0] * x[0] + x[1] * x[1] - 1;
    v[1] = x[2] * x[2] + x[3] * x[3] - 1;
  });
}

inline Function torus_cut(double squared_radius) {
  return make_function(4, 1, [=](Point x, Values v) {
    v[0] = squared_radius - (x[0] - 1) * (x[0] - 1) - x[1] * x[1] - (x[2] - 1) * (x[2] - 1) - x[3] * x[3];
  });
}

/// x_0 >= 0, .., x_{m-1} >= 0.
inline Function coordinates(int d, int m) {
  return make_function(d, m, [=](Point x, Values v) { std::copy_n(x.begin(), m, v.begin()); });
}

/// The unit Freudenthal triangulation: lattice vertices are the integer points.
inline coxeter::Triangulation integer_lattice(int d) { return coxeter::freudenthal(d, std::sqrt(double(d))); }

inline std::map<int, int> count_by_dim(const Strata& strata) {
  std::map<int, int> count;
  for (const Stratum& stratum : strata.strata) ++count[stratum.dim];
  return count;
}

inline std::string bytes_of(const TraceResult& traced) {
  std::string bytes;
  auto append = [&](const auto& list) {
    bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0]));
  };
  append(traced.vertex_coordinates());
  append(traced.points());
  append(traced.parts<std::uint8_t>());
  for (const BoundarySimplices& stratum : traced.boundary) {
    append(stratum.inequalities);
    append(stratum.base);
    append(stratum.parts);
    append(stratum.points);
  }
  return bytes;
}

/// The double: two copies glued along the boundary.
inline SimplicialMesh doubled(const CellComplex& complex) {
  // In the barycentric subdivision a simplex is determined by its vertices even after gluing, and no simplex of the
  // interior has all its vertices on the boundary.
  const Strata strata = strata_of(complex);
  SimplicialMesh mesh = barycentric_subdivision(complex, &strata);
  const auto& labels = mesh.point_data.back().values;
  const std::uint32_t count = static_cast<std::uint32_t>(mesh.num_points());
  std::vector<std::uint32_t> copy(count);
  for (std::uint32_t v = 0; v < count; ++v) {
    copy[v] = v;
    if (strata.strata[static_cast<std::size_t>(labels[v])].dim < mesh.dim) continue;
    copy[v] = static_cast<std::uint32_t>(mesh.num_points());
    for (int c = 0; c < mesh.ambient_dim; ++c)
      mesh.points.push_back(mesh.points[std::size_t{v} * mesh.ambient_dim + c]);
  }
  mesh.point_data.clear();
  mesh.cell_data.clear();
  mesh.strata.clear();
  const std::vector<std::uint32_t> first = mesh.simplices;
  for (std::uint32_t v : first) mesh.simplices.push_back(copy[v]);
  return mesh;
}

/// What must hold for every manifold with boundary: manifold links, both subdivisions agree, the double is closed with
/// chi = 2 chi - chi(boundary), and no boundary without inequality.
inline Topology expect_manifold(const CellComplex& complex) {
  const Topology of_cells = topology_of(complex.facets);
  TopologyOptions links_only;
  links_only.homology = false;
  for (const SimplicialMesh& mesh : {pulled_subdivision(complex), barycentric_subdivision(complex)}) {
    const Topology t = topology_of(mesh, links_only);
    EXPECT_TRUE(t.is_manifold()) << (t.witness ? t.witness->reason : "");
    EXPECT_EQ(t.euler_characteristic, of_cells.euler_characteristic);
    EXPECT_EQ(t.components, of_cells.components);
    EXPECT_EQ(t.boundary_components, of_cells.boundary_components);
  }
  const Topology twice = topology_of(doubled(complex), links_only);
  EXPECT_TRUE(twice.is_closed_manifold()) << (twice.witness ? twice.witness->reason : "");
  std::int64_t boundary = 0;
  for (int j = 0; j <= complex.intrinsic_dim; ++j)
    boundary += (j % 2 ? -1 : 1) * std::int64_t(complex.num_cells(j) - complex.set_begin[j][1]);
  EXPECT_EQ(twice.euler_characteristic, 2 * of_cells.euler_characteristic - boundary);
  return of_cells;
}

struct Cut {
  TraceResult traced;
  CellComplex complex;
  Strata strata;
  Topology topology;
};

inline Cut cut(const Function& f, std::optional<Function> g, const coxeter::Triangulation& triangulation,
               const std::vector<double>& seeds, std::optional<Box> box = {}) {
  TraceOptions options;
  options.inequalities = std::move(g);
  options.box = std::move(box);
  Cut out{trace(f, triangulation, seeds, options), {}, {}, {}};
  EXPECT_GT(out.traced.num_points(), 0u) << out.traced.seeds[0].reason;
  EXPECT_EQ(out.traced.evaluations, out.traced.num_vertices());
  out.complex = cell_complex(out.traced);
  EXPECT_EQ(out.complex.num_dropped, 0u);
  out.strata = strata_of(out.complex);
  out.topology = expect_manifold(out.complex);
  return out;
}

}  // namespace whitney::boundary_cases
