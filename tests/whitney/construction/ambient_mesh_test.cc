// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/ambient_mesh.h>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>
#include <whitney/topology/topology.h>
#include "whitney_cases.h"

namespace whitney {
namespace {

double volume_of_cells(const WhitneyCase& c) {
  SimplicialMesh whole{c.result.complex.ambient_dim, c.result.complex.ambient_dim, {}, {}};
  const int n = c.result.complex.intrinsic_dim;
  double sum = 0;
  for (std::size_t i = 0; i < c.result.complex.num_cells(n); ++i) {
    whole.points.clear();
    whole.simplices.clear();
    for (const auto& v : c.result.complex.simplex(n, i).vertices()) {
      const std::vector<double> x = perturbation::position(c.triangulation, c.result.displacements, v);
      whole.points.insert(whole.points.end(), x.begin(), x.end());
      whole.simplices.push_back(static_cast<std::uint32_t>(whole.simplices.size()));
    }
    sum += std::abs(volume(whole));
  }
  return sum;
}

struct Shape {
  const char* name;
  double edge_length;
  std::map<std::string, double> parameters;
};

TEST(AmbientMesh, SubdividesTheSimplicesAroundMAndContainsK) {
  for (const Shape& shape : {Shape{"sphere", 0.6, {{"intrinsic_dim", 1}}}, Shape{"sphere", 0.5, {{"intrinsic_dim", 2}}},
                             Shape{"sphere", 0.25, {{"intrinsic_dim", 1}, {"ambient_dim", 3}}},
                             Shape{"sphere", 0.2, {{"intrinsic_dim", 1}, {"ambient_dim", 4}}},
                             Shape{"sphere", 0.7, {{"intrinsic_dim", 3}}}}) {
    const WhitneyCase c = whitney_case(shape.name, shape.edge_length, shape.parameters);
    const CellComplex& complex = c.result.complex;
    const int d = complex.ambient_dim, n = complex.intrinsic_dim;
    SCOPED_TRACE("d = " + std::to_string(d) + ", n = " + std::to_string(n));
    EXPECT_EQ(c.result.certificate.verdict, perturbation::Verdict::kCertified);
    const AmbientMesh ambient = ambient_mesh(complex, c.triangulation, c.result.displacements);
    EXPECT_EQ(ambient.not_positive, 0u);
    std::size_t chains = 1;
    for (int i = 2; i <= d + 1; ++i) chains *= i;
    EXPECT_EQ(ambient.mesh.num_simplices(), chains * complex.num_cells(n));

    const SimplicialMesh k = barycentric_subdivision(complex);
    EXPECT_EQ(ambient.num_complex_points, k.num_points());
    EXPECT_TRUE(is_subcomplex(k, ambient.mesh));
    // The pieces fill the simplices exactly: all positive, and volumes add up.
    const double expected = volume_of_cells(c);
    EXPECT_NEAR(volume(ambient.mesh), expected, 1e-11 * expected);
    // Throws when two simplices are equal; a neighbourhood of M: each facet in one or two simplices.
    TopologyOptions quick;
    quick.homology = quick.links = false;
    const Topology topology = topology_of(ambient.mesh, quick);
    EXPECT_EQ(topology.branching_faces, 0u);
    EXPECT_EQ(topology.unused_points, 0u);
    EXPECT_EQ(topology.components, 1u);
    // Only K's vertices say that they are.
    const auto& index = ambient.mesh.point_data[0].values;
    for (std::size_t i = 0; i < index.size(); ++i) EXPECT_EQ(index[i], i < k.num_points() ? double(i) : -1.0);
  }
}

TEST(AmbientMesh, IsAnAnnulusAroundTheCircle) {
  const WhitneyCase c = whitney_case("sphere", 0.3, {{"intrinsic_dim", 1}});
  const AmbientMesh ambient = ambient_mesh(c.result.complex, c.triangulation, c.result.displacements);
  const Topology topology = topology_of(ambient.mesh);
  EXPECT_EQ(topology.manifold, ManifoldKind::kWithBoundary);
  EXPECT_EQ(topology.euler_characteristic, 0);
  EXPECT_EQ(topology.boundary_components, 2u);
}

TEST(AmbientMesh, SubcomplexCheckRejects) {
  const WhitneyCase c = whitney_case("sphere", 0.6, {{"intrinsic_dim", 1}});
  const AmbientMesh ambient = ambient_mesh(c.result.complex, c.triangulation, c.result.displacements);
  SimplicialMesh k = barycentric_subdivision(c.result.complex);
  SimplicialMesh moved = k;
  moved.points[0] = std::nextafter(moved.points[0], 10);
  EXPECT_FALSE(is_subcomplex(moved, ambient.mesh));
  std::swap(k.simplices[0], k.simplices[6]);
  EXPECT_FALSE(is_subcomplex(k, ambient.mesh));
}

TEST(AmbientMesh, DeterminantsAreDecidedExactly) {
  const double tiny = 1e-17;  // below the rounding of 1 + x: the determinant in floating point is 0
  SimplicialMesh mesh{
      2, 2, {1, 1, 2, 2, 3, 3 + 4e-16, 0, 0, 1, 0, 0, tiny}, {0, 1, 2, 0, 2, 1, 3, 4, 5, 3, 5, 4, 0, 1, 1}};
  EXPECT_EQ(count_not_positive(mesh), 3u);
  EXPECT_THROW(count_not_positive(SimplicialMesh{3, 2, {}, {}}), InvalidInput);
}

TEST(AmbientMesh, RefusesOtherDimensions) {
  const WhitneyCase c = whitney_case("sphere", 0.6, {{"intrinsic_dim", 1}});
  EXPECT_THROW(ambient_mesh(c.result.complex, coxeter::coxeter_a(3, 1), c.result.displacements), InvalidInput);
  EXPECT_THROW(ambient_mesh(c.result.complex, c.triangulation, perturbation::DisplacementMap(3)), InvalidInput);
  CellComplex high = c.result.complex;
  high.ambient_dim = 5;
  EXPECT_THROW(ambient_mesh(high, c.triangulation, c.result.displacements), InvalidInput);
}

}  // namespace
}  // namespace whitney
