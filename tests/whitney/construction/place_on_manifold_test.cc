// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/place_on_manifold.h>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>
#include <whitney/construction/ambient_mesh.h>
#include <whitney/construction/complex_quality.h>
#include <whitney/construction/correspondence.h>
#include <whitney/construction/inside_mesh.h>
#include "whitney_cases.h"

namespace whitney {
namespace {

struct Shape {
  const char* name;
  double edge_length;
  std::map<std::string, double> parameters;
};

/// Whitney's complex before its 0-cells are placed.
WhitneyCase not_placed(const std::string& name, double edge_length,
                       const std::map<std::string, double>& parameters = {}) {
  TriangulateOptions options;
  options.place_on_manifold = false;
  return whitney_case(name, edge_length, parameters, options);
}

TEST(PlaceOnManifold, PointsAreOnMAndInTheirSimplices) {
  for (const Shape& shape :
       {Shape{"sphere", 0.4, {{"intrinsic_dim", 1}}}, Shape{"sphere", 0.5, {}}, Shape{"torus_of_revolution", 0.4, {}},
        Shape{"flat_torus", 0.3, {}}, Shape{"klein_bottle", 0.45, {}}}) {
    SCOPED_TRACE(shape.name);
    const WhitneyCase c = not_placed(shape.name, shape.edge_length, shape.parameters);
    const Bending bending = *c.manifold.bending();
    const PlacedComplex placed =
        place_on_manifold(c.result.complex, c.triangulation, c.result.displacements, c.manifold, bending);
    const CellComplex& complex = placed.complex;
    EXPECT_EQ(placed.kept, 0u);
    EXPECT_EQ(placed.placed, complex.num_cells(0));
    EXPECT_LT(*placed.distance_bound, 1.5 * *c.result.hausdorff_bound);
    const int d = complex.ambient_dim;
    std::vector<double> point(d), frame(static_cast<std::size_t>(d) * d);
    FootErrors errors;
    const SimplicialMesh before = barycentric_subdivision(c.result.complex), mesh = barycentric_subdivision(complex);
    EXPECT_EQ(mesh.simplices, before.simplices);
    for (std::size_t v = 0; v < mesh.num_points(); ++v) {
      const std::span<const double> x(&mesh.points[v * d], std::size_t(d));
      ASSERT_TRUE(c.manifold.project(x, point, frame, errors));
      double squares = 0;
      for (int a = 0; a < d; ++a) squares += (x[a] - point[a]) * (x[a] - point[a]);
      EXPECT_LT(std::sqrt(squares), v < complex.num_cells(0) ? 1e-12 : *placed.distance_bound);
    }
    // The vertices of K still lie inside their simplices: the ambient mesh is positive.
    if (d <= 4) {
      const AmbientMesh ambient = ambient_mesh(complex, c.triangulation, c.result.displacements);
      EXPECT_EQ(ambient.not_positive, 0u);
      EXPECT_TRUE(is_subcomplex(mesh, ambient.mesh));
    }
    EXPECT_TRUE(check_correspondence(Correspondence(mesh, c.manifold, *placed.distance_bound), bending).homeomorphism);
    EXPECT_LT(complex_quality(mesh, c.manifold).angle_max, 0.5 * complex_quality(before, c.manifold).angle_max);
  }
}

TEST(PlaceOnManifold, UnfoldsTheProjection) {
  // Certified, and yet the closest-point projection of the complex as traced folds at a few steep facets.
  const WhitneyCase c = not_placed("sphere", 0.1);
  ASSERT_EQ(c.result.certificate.verdict, perturbation::Verdict::kCertified);
  const Bending bending = *c.manifold.bending();
  const PlacedComplex placed =
      place_on_manifold(c.result.complex, c.triangulation, c.result.displacements, c.manifold, bending);
  const SimplicialMesh mesh = barycentric_subdivision(placed.complex);
  const CorrespondenceCheck after =
      check_correspondence(Correspondence(mesh, c.manifold, *placed.distance_bound), bending);
  EXPECT_TRUE(after.homeomorphism) << after.reason;
  EXPECT_LT(after.angle_max, 10 * std::numbers::pi / 180);
  // The volume inside comes closer too: all 0-cells are on the sphere, so the solid is smaller than the ball, barely.
  const double ball = 4 * std::numbers::pi / 3;
  const double inside = volume(inside_mesh(placed.complex, c.triangulation, c.result.displacements).mesh);
  EXPECT_LT(inside, ball);
  EXPECT_GT(inside, ball * (1 - 0.002));
}

TEST(PlaceOnManifold, KeepsWhatItCannotPlace) {
  const WhitneyCase c = whitney_case("sphere", 0.4);
  // Another sphere, that the simplices do not meet.
  const Submanifold large = named_submanifold("sphere", {{"radius", 3}});
  const PlacedComplex placed =
      place_on_manifold(c.result.complex, c.triangulation, c.result.displacements, large, *large.bending());
  EXPECT_EQ(placed.placed, 0u);
  EXPECT_EQ(placed.complex.points, c.result.complex.points);
  EXPECT_GT(*placed.distance_bound, 1.9);
  EXPECT_THROW(place_on_manifold(c.result.complex, c.triangulation, c.result.displacements,
                                 named_submanifold("flat_torus"), *large.bending()),
               InvalidInput);
  EXPECT_THROW(place_on_manifold(c.result.complex, c.triangulation, c.result.displacements, c.manifold, Bending{}),
               InvalidInput);
}

}  // namespace
}  // namespace whitney
