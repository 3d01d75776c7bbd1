// SPDX-License-Identifier: GPL-3.0-or-later
// Whitney's construction at the scales that the README quotes: what it costs per d-simplex, and how that grows with d.
// No peer: none exists (the constants of BKW20 ask for edge lengths of 10^-20 and below).
#include <chrono>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include <whitney/cells/subdivide.h>
#include <whitney/construction/triangulate.h>
#include <whitney/io/read_problem.h>
#include <whitney/manifolds/closed_form_manifolds.h>
#include <whitney/manifolds/immersed_surfaces.h>
#include <whitney/manifolds/matrix_manifolds.h>
#include <whitney/topology/topology.h>

namespace {

using namespace whitney;

struct Case {
  std::string name;
  Submanifold manifold;
  double ratio;  ///< edge length / reach
};

double since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void run(const Case& one) {
  const int d = one.manifold.ambient_dim(), n = one.manifold.intrinsic_dim();
  const Bending bending = *one.manifold.bending();
  TriangulationSpec spec;
  spec.rotation = TriangulationSpec::Rotation::kRandom;
  const coxeter::Triangulation triangulation = make_triangulation(spec, d, one.ratio * bending.reach);
  const auto begin = std::chrono::steady_clock::now();
  const TriangulateResult result = triangulate(one.manifold, bending, triangulation, one.manifold.seed_points());
  const double built = since(begin);
  const SimplicialMesh K = barycentric_subdivision(result.complex);
  const Topology topology = topology_of(K);
  const double all = since(begin);
  const auto simplices = static_cast<double>(result.certificate.simplices);
  std::printf("| %-28s | %d, %d | %5.2f | %-13s | %7.0f | %6zu | %5.3f | %6.1f | %5.1f | %6.2f | %+lld |\n",
              one.name.c_str(), d, n, one.ratio, to_string(result.certificate.verdict), simplices,
              result.vertices_moved, result.certificate.margin_min, 1e6 * built / simplices,
              static_cast<double>(result.oracle_evaluations) / simplices, all,
              static_cast<long long>(topology.euler_characteristic));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const bool everything = argc > 1 && std::strcmp(argv[1], "--all") == 0;
  std::printf(
      "| manifold | d, n | L / reach | verdict | d-simplices | moved | worst margin | us per simplex | oracle calls "
      "per "
      "simplex | s, all | chi |\n|---|---|--:|---|--:|--:|--:|--:|--:|--:|--:|\n");
  const std::vector<double> circles = {1.0, 0.4, 0.25, 0.15, 0.1, 0.06, 0.04};
  for (int d = 2; d <= (everything ? 8 : 6); ++d)
    run({"circle", closed_form::sphere(1, d), circles[static_cast<std::size_t>(d - 2)]});
  // The same scale in every dimension, for the growth of the cost.
  for (int d = 2; d <= (everything ? 8 : 6); ++d) run({"circle", closed_form::sphere(1, d), 0.04});
  run({"sphere", closed_form::sphere(2, 3), 0.7});
  run({"torus of revolution", closed_form::torus_of_revolution(), 0.7});
  run({"sphere", closed_form::sphere(2, 4), 0.3});
  run({"flat torus", closed_form::flat_torus(), 0.3});
  run({"flat torus", closed_form::flat_torus(), 0.1});
  run({"Klein bottle", klein_bottle(), 0.4});
  run({"Klein bottle", klein_bottle(), 0.15});
  run({"projective plane", projective_plane(), 0.3});
  run({"S^3", closed_form::sphere(3, 4), 0.4});
  run({"sphere", closed_form::sphere(2, 5), 0.15});
  run({"projective plane, projectors", projective_plane_projectors(), 0.14});
  if (everything) {
    run({"sphere", closed_form::sphere(2, 6), 0.1});
    run({"S^3", closed_form::sphere(3, 5), 0.2});
    run({"SO(3) as two vectors", stiefel(2, 3), 0.2});
  }
}
