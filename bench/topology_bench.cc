// SPDX-License-Identifier: GPL-3.0-or-later
// Topology of large meshes: the parts of topology_of() one by one, on tori made of grids. Every answer is checked.

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include <benchmark/benchmark.h>

#include <whitney/topology/chain_complex.h>
#include <whitney/topology/face_lattice.h>
#include <whitney/topology/homology.h>
#include <whitney/topology/orientation.h>
#include <whitney/topology/topology.h>
#include <whitney/topology/vertex_links.h>

namespace whitney {
namespace {

/// The n-torus as a grid of side^n cubes, each cut into n! simplices (Freudenthal); `dim` is 2 or 3.
SimplicialMesh grid_torus(int dim, std::uint32_t side) {
  SimplicialMesh mesh{.ambient_dim = 1, .dim = dim, .points = {}, .simplices = {}};
  const std::uint32_t layers = dim == 3 ? side : 1;
  mesh.points.assign(std::size_t{side} * side * layers, 0.0);
  for (std::uint32_t cube = 0; cube < mesh.points.size(); ++cube) {
    std::vector<int> axes{0, 1, 2};
    axes.resize(dim);
    do {
      std::array<std::uint32_t, 3> at{cube % side, cube / side % side, cube / side / side};
      mesh.simplices.push_back(cube);
      for (int axis : axes) {
        at[axis] = (at[axis] + 1) % side;
        mesh.simplices.push_back(at[0] + side * (at[1] + side * at[2]));
      }
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  return mesh;
}

void require(bool right) {
  if (!right) throw std::logic_error("wrong topology");
}

void set_rate(benchmark::State& state, const FaceLattice& lattice) {
  std::size_t cells = 0, bytes = 0;
  for (std::size_t j = 0; j < lattice.facets.size(); ++j) {
    cells += lattice.facets[j].size();
    bytes += 4 * (lattice.vertices[j].size() + lattice.facets[j].index.size() + lattice.facets[j].offset.size());
  }
  state.counters["cells"] = double(cells);
  state.counters["bytes_per_cell"] = double(bytes) / double(cells);
  state.counters["per_cell"] =
      benchmark::Counter(double(cells), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void face_lattice_of_torus(benchmark::State& state) {
  const SimplicialMesh mesh = grid_torus(state.range(0), state.range(1));
  for (auto _ : state) {
    const FaceLattice lattice = face_lattice(mesh);
    require(lattice.num_faces(0) == mesh.num_points());
  }
  set_rate(state, face_lattice(mesh));
}

void homology_of_torus(benchmark::State& state) {
  const FaceLattice lattice = face_lattice(grid_torus(state.range(0), state.range(1)));
  const IncidenceSigns signs = simplicial_signs(lattice.facets);
  std::size_t critical = 0;
  for (auto _ : state) {
    const Homology result = homology(lattice.facets, signs);
    require(to_string(result.groups[1]) == "Z^" + std::to_string(state.range(0)));
    critical = 0;
    for (std::size_t count : result.critical_cells) critical += count;
  }
  set_rate(state, lattice);
  state.counters["critical_cells"] = double(critical);
}

void regular_cell_signs_of_torus(benchmark::State& state) {
  const FaceLattice lattice = face_lattice(grid_torus(state.range(0), state.range(1)));
  for (auto _ : state) require(regular_cell_signs(lattice.facets).back().size() == lattice.facets.back().index.size());
  set_rate(state, lattice);
}

void vertex_links_of_torus(benchmark::State& state) {
  const SimplicialMesh mesh = grid_torus(state.range(0), state.range(1));
  for (auto _ : state) require(check_vertex_links(mesh).singular_vertices == 0);
  set_rate(state, face_lattice(mesh));
}

void orient_torus(benchmark::State& state) {
  const SimplicialMesh mesh = grid_torus(state.range(0), state.range(1));
  for (auto _ : state) require(orient(mesh).all_orientable());
  set_rate(state, face_lattice(mesh));
}

void topology_of_torus(benchmark::State& state) {
  const SimplicialMesh mesh = grid_torus(state.range(0), state.range(1));
  for (auto _ : state) {
    const Topology result = topology_of(mesh);
    require(result.is_closed_manifold() && result.orientable && result.components == 1 &&
            result.euler_characteristic == 0);
  }
  set_rate(state, face_lattice(mesh));
}

/// 200 000 and a million cells of a surface, a million of a 3-manifold.
void sizes(::benchmark::internal::Benchmark* bench) {
  bench->Args({2, 183})->Args({2, 408})->Args({3, 34})->Unit(benchmark::kMillisecond);
}
BENCHMARK(face_lattice_of_torus)->Apply(sizes);
BENCHMARK(regular_cell_signs_of_torus)->Apply(sizes);
BENCHMARK(homology_of_torus)->Apply(sizes);
BENCHMARK(vertex_links_of_torus)->Apply(sizes);
BENCHMARK(orient_torus)->Apply(sizes);
BENCHMARK(topology_of_torus)->Apply(sizes);

}  // namespace
}  // namespace whitney
