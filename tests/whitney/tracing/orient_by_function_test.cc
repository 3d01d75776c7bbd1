// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/orient_by_function.h>

#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/tracing/trace.h>

namespace whitney {
namespace {

SimplicialMesh sphere_mesh(const Function& f) {
  const TraceResult traced = trace(f, coxeter::coxeter_a(3, 0.4), std::vector<double>{1, 0, 0});
  return pulled_subdivision(cell_complex(traced));
}

/// Six times the volume that the triangles enclose, seen from outside.
double enclosed(const SimplicialMesh& mesh) {
  double sum = 0;
  for (std::size_t s = 0; s < mesh.num_simplices(); ++s) {
    const double* p[3];
    for (int i = 0; i < 3; ++i) p[i] = &mesh.points[std::size_t{3} * mesh.simplices[3 * s + i]];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      sum += p[0][i] * (p[1][j] * p[2][k] - p[1][k] * p[2][j]);
    }
  }
  return sum;
}

TEST(OrientByFunction, FacesLookTowardsPositiveValues) {
  const Function f = sphere(2, 3, 1).function;
  const Function minus = make_function(3, 1, [](std::span<const double> x, std::span<double> value) {
    value[0] = 1 - x[0] * x[0] - x[1] * x[1] - x[2] * x[2];
  });
  const OrientedMesh outward = orient_by_function(sphere_mesh(f), f);
  EXPECT_TRUE(outward.all_orientable());
  // 8 pi = 25.1 for the sphere itself; its mesh at this edge length holds a little less.
  EXPECT_NEAR(enclosed(outward.mesh), 25.1, 2.5);
  EXPECT_NEAR(enclosed(orient_by_function(sphere_mesh(f), minus).mesh), -enclosed(outward.mesh), 1e-9);
  // However the mesh came.
  SimplicialMesh turned = outward.mesh;
  for (std::size_t s = 0; s < turned.num_simplices(); s += 2)
    std::swap(turned.simplices[3 * s], turned.simplices[3 * s + 1]);
  EXPECT_DOUBLE_EQ(enclosed(orient_by_function(turned, f).mesh), enclosed(outward.mesh));
}

TEST(OrientByFunction, DimensionsMustFit) {
  const Function f = sphere(2, 3, 1).function;
  SimplicialMesh edges{.ambient_dim = 3, .dim = 1, .points = {0, 0, 0, 1, 0, 0}, .simplices = {0, 1}};
  EXPECT_THROW(orient_by_function(edges, f), InvalidInput);
}

}  // namespace
}  // namespace whitney
