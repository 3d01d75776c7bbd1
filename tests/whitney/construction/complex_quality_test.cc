// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/complex_quality.h>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>
#include "whitney_cases.h"

namespace whitney {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(ComplexQuality, ThicknessOfKnownSimplices) {
  const SimplicialMesh equilateral{2, 2, {0, 0, 1, 0, 0.5, std::sqrt(0.75)}, {0, 1, 2}};
  EXPECT_NEAR(thickness(equilateral, 0), std::sqrt(0.75), 1e-15);
  const SimplicialMesh right{3, 2, {0, 0, 0, 3, 0, 0, 0, 0, 4}, {0, 1, 2}};
  EXPECT_NEAR(thickness(right, 0), 2.4 / 5, 1e-15);
  const SimplicialMesh corner{3, 3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 1, 2, 3}};
  EXPECT_NEAR(thickness(corner, 0), 1 / std::sqrt(3) / std::sqrt(2), 1e-15);
  const SimplicialMesh edge{4, 1, {0, 0, 0, 0, 1, 2, 3, 4}, {0, 1}};
  EXPECT_NEAR(thickness(edge, 0), 1, 1e-15);
  const SimplicialMesh flat{2, 2, {0, 0, 1, 1, 2, 2}, {0, 1, 2}};
  EXPECT_EQ(thickness(flat, 0), 0);
}

TEST(ComplexQuality, TangentAngle) {
  const double frame[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (const double angle : {0.0, 1e-9, 0.3, kPi / 2 - 1e-9}) {
    const SimplicialMesh tilted{3, 2, {0, 0, 0, 1, 0, 0, 0.4, std::cos(angle), std::sin(angle)}, {0, 1, 2}};
    EXPECT_NEAR(tangent_angle(tilted, 0, frame), angle, 1e-15);
  }
  const SimplicialMesh flat{3, 2, {0, 0, 0, 1, 1, 0, 2, 2, 0}, {0, 1, 2}};
  EXPECT_EQ(tangent_angle(flat, 0, frame), kPi / 2);
}

TEST(ComplexQuality, OctahedronInTheSphere) {
  // Each face is normal to (1,1,1)/sqrt(3) and its barycentre stands above that foot: no angle at all.
  const SimplicialMesh mesh{
      3, 2, {1, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0, 0, -1, 0, 0, 0, -1, 9, 9, 9}, {0, 1, 2, 1, 3, 2, 3, 4, 2, 4, 0, 2,
                                                                                 1, 0, 5, 3, 1, 5, 4, 3, 5, 0, 4, 5}};
  const ComplexQuality q = complex_quality(mesh, named_submanifold("sphere"));
  EXPECT_NEAR(q.thickness_min, std::sqrt(0.75), 1e-14);
  EXPECT_NEAR(q.thickness_median, std::sqrt(0.75), 1e-14);
  EXPECT_NEAR(q.angle_max, 0, 1e-14);
  EXPECT_NEAR(q.shortest_edge, std::sqrt(2), 1e-15);
  EXPECT_NEAR(q.longest_edge, std::sqrt(2), 1e-15);
  EXPECT_NEAR(q.vertex_distance_max, 0, 1e-15);  // the point that no triangle uses does not count
  EXPECT_EQ(q.feet_missing, 0u);
}

TEST(ComplexQuality, OfWhitneysComplex) {
  double previous = 1;
  for (const double edge_length : {0.4, 0.2, 0.1}) {
    const WhitneyCase c = whitney_case("sphere", edge_length);
    const ComplexQuality q = complex_quality(barycentric_subdivision(c.result.complex), c.manifold);
    EXPECT_GT(q.thickness_min, 0);
    EXPECT_LE(q.thickness_min, q.thickness_median);
    EXPECT_LE(q.longest_edge, edge_length * 2);
    EXPECT_LE(q.vertex_distance_max, *c.result.hausdorff_bound);
    // The typical angle falls with the edge length.
    EXPECT_LT(q.angle_median, 0.7 * previous);
    previous = q.angle_median;
  }
}

TEST(ComplexQuality, SamplesWhenThereAreTooMany) {
  const WhitneyCase c = whitney_case("sphere", 0.4);
  const SimplicialMesh mesh = barycentric_subdivision(c.result.complex);
  const ComplexQuality all = complex_quality(mesh, c.manifold), some = complex_quality(mesh, c.manifold, 100);
  EXPECT_EQ(all.feet, mesh.num_simplices() + mesh.num_points());
  EXPECT_LE(some.feet, 200u);
  EXPECT_GT(some.feet, 100u);
  EXPECT_EQ(some.thickness_min, all.thickness_min);
  EXPECT_LE(some.angle_max, all.angle_max);
  EXPECT_GT(some.angle_median, all.angle_median / 2);
  EXPECT_THROW(complex_quality(mesh, c.manifold, 0), InvalidInput);
}

TEST(ComplexQuality, MissingFeetAreCounted) {
  const SimplicialMesh mesh{3, 2, {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}};
  EXPECT_EQ(complex_quality(mesh, named_submanifold("sphere")).feet_missing, 1u);
  EXPECT_EQ(complex_quality(SimplicialMesh{3, 2, {}, {}}, named_submanifold("sphere")).thickness_min, 0);
  EXPECT_THROW(complex_quality(SimplicialMesh{4, 2, {}, {}}, named_submanifold("sphere")), InvalidInput);
}

}  // namespace
}  // namespace whitney
