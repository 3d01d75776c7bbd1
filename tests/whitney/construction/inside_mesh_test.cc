// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/inside_mesh.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>
#include <whitney/topology/face_lattice.h>
#include <whitney/topology/orientation.h>
#include <whitney/topology/topology.h>
#include "whitney_cases.h"

namespace whitney {
namespace {

constexpr double kPi = std::numbers::pi;

using Faces = std::set<std::vector<std::uint32_t>>;

Faces boundary_of(const SimplicialMesh& mesh) {
  const FaceLattice lattice = face_lattice(mesh, mesh.dim - 1);
  std::vector<int> count(lattice.num_faces(mesh.dim - 1), 0);
  for (const std::uint32_t f : lattice.facets[mesh.dim].index) ++count[f];
  Faces faces;
  for (std::size_t f = 0; f < count.size(); ++f) {
    EXPECT_LE(count[f], 2);
    const std::uint32_t* v = &lattice.vertices[mesh.dim - 1][f * mesh.dim];
    if (count[f] == 1) faces.insert({v, v + mesh.dim});
  }
  return faces;
}

Faces simplices_of(const SimplicialMesh& mesh) {
  Faces faces;
  for (std::size_t s = 0; s < mesh.num_simplices(); ++s) {
    std::vector<std::uint32_t> face(&mesh.simplices[s * (mesh.dim + 1)],
                                    &mesh.simplices[s * (mesh.dim + 1)] + mesh.dim + 1);
    std::sort(face.begin(), face.end());
    faces.insert(face);
  }
  return faces;
}

/// Everything that does not depend on the shape; returns the volume.
double check(const WhitneyCase& c, std::int64_t euler_characteristic) {
  EXPECT_EQ(c.result.certificate.verdict, perturbation::Verdict::kCertified);
  const AmbientMesh inside = inside_mesh(c.result.complex, c.triangulation, c.result.displacements);
  EXPECT_EQ(inside.not_positive, 0u);
  EXPECT_EQ(boundary_of(inside.mesh), simplices_of(barycentric_subdivision(c.result.complex)));
  TopologyOptions options;
  options.homology = false;
  const Topology topology = topology_of(inside.mesh, options);
  EXPECT_EQ(topology.manifold, ManifoldKind::kWithBoundary);
  EXPECT_EQ(topology.euler_characteristic, euler_characteristic);
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(topology.unused_points, 0u);
  return volume(inside.mesh);
}

TEST(InsideMesh, BallOfTheSphere) {
  for (const double edge_length : {0.5, 0.2}) {
    const WhitneyCase c = whitney_case("sphere", edge_length);
    const double v = check(c, 1), h = *c.result.hausdorff_bound;
    EXPECT_GT(v, 4 * kPi / 3 * std::pow(1 - h, 3));
    EXPECT_LT(v, 4 * kPi / 3 * std::pow(1 + h, 3));
  }
}

TEST(InsideMesh, SolidTorus) {
  const WhitneyCase c = whitney_case("torus_of_revolution", 0.4);
  const double v = check(c, 0), h = *c.result.hausdorff_bound;
  EXPECT_GT(v, 2 * kPi * kPi * 2 * std::pow(1 - h, 2));
  EXPECT_LT(v, 2 * kPi * kPi * 2 * std::pow(1 + h, 2));
}

TEST(InsideMesh, DiskOfTheCircle) {
  const WhitneyCase c = whitney_case("sphere", 0.2, {{"intrinsic_dim", 1}});
  const double v = check(c, 1), h = *c.result.hausdorff_bound;
  EXPECT_GT(v, kPi * std::pow(1 - h, 2));
  EXPECT_LT(v, kPi * std::pow(1 + h, 2));
}

TEST(InsideMesh, BallOfTheThreeSphere) {
  const WhitneyCase c = whitney_case("sphere", 0.7, {{"intrinsic_dim", 3}});
  const double v = check(c, 1), h = *c.result.hausdorff_bound;
  EXPECT_GT(v, kPi * kPi / 2 * std::pow(1 - h, 4));
  EXPECT_LT(v, kPi * kPi / 2 * std::pow(1 + h, 4));
}

/// Spheres of radius 1 and 2 about the origin.
struct TwoSpheres : Submanifold::Model {
  int ambient_dim() const override { return 3; }
  int intrinsic_dim() const override { return 2; }
  std::optional<Bending> bending() const override { return Bending{0.5, 1, Bending::Source::kProven}; }
  std::vector<double> seed_points() const override { return {1, 0, 0, 2, 0, 0}; }
  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
               FootErrors& errors) const override {
    const double s = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    if (!(s > 1e-9)) return false;
    const double radius = s < 1.5 ? 1 : 2;
    std::vector<double> g(9, 0.0);
    for (int c = 0; c < 3; ++c) {
      point[c] = x[c] / s * radius;
      g[c] = x[c] / s;
    }
    if (!complete_frame(g, 3, 1)) return false;
    std::copy(g.begin() + 3, g.end(), frame.begin());
    std::copy(g.begin(), g.begin() + 3, frame.begin() + 6);
    errors.point = errors.angle = 1e-14;
    return true;
  }
};

TEST(InsideMesh, TheShellBetweenNestedSpheres) {
  const Submanifold manifold(std::make_shared<TwoSpheres>());
  TriangulationSpec spec;
  spec.rotation = TriangulationSpec::Rotation::kRandom;
  const auto triangulation = make_triangulation(spec, 3, 0.25);
  WhitneyCase c{manifold, triangulation,
                triangulate(manifold, *manifold.bending(), triangulation, manifold.seed_points())};
  const double v = check(c, 2), h = *c.result.hausdorff_bound;
  EXPECT_GT(v, 4 * kPi / 3 * (std::pow(2 - h, 3) - std::pow(1 + h, 3)));
  EXPECT_LT(v, 4 * kPi / 3 * (std::pow(2 + h, 3) - std::pow(1 - h, 3)));
}

TEST(InsideMesh, RefusesWhatHasNoInside) {
  const WhitneyCase curve = whitney_case("sphere", 0.25, {{"intrinsic_dim", 1}, {"ambient_dim", 3}});
  EXPECT_THROW(inside_mesh(curve.result.complex, curve.triangulation, curve.result.displacements), InvalidInput);

  // A surface with a hole: the walk was cut short.
  const Submanifold manifold = named_submanifold("sphere");
  const auto triangulation = coxeter::coxeter_a(3, 0.3);
  TriangulateOptions options;
  options.scheme = TriangulateOptions::Scheme::kNone;
  options.run.max_simplices = 400;
  const TriangulateResult cut =
      triangulate(manifold, *manifold.bending(), triangulation, manifold.seed_points(), options);
  ASSERT_NE(cut.stop_reason, StopReason::kNone);
  ASSERT_GT(cut.complex.num_cells(2), 0u);
  EXPECT_THROW(inside_mesh(cut.complex, triangulation, cut.displacements), InvalidInput);
}

}  // namespace
}  // namespace whitney
