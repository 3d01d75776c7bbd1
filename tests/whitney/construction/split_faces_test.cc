// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/split_faces.h>

#include <algorithm>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>
#include <whitney/construction/ambient_mesh.h>
#include "trace_cases.h"
#include "whitney_cases.h"

namespace whitney {
namespace {

using coxeter::LatticeVertex;

/// The d-simplex of T with its base moved by the same step in every coordinate.
std::vector<LatticeVertex> moved(std::vector<LatticeVertex> vertices, int step) {
  for (LatticeVertex& v : vertices)
    for (int c = 0; c < v.ambient_dim(); ++c) v[c] += step;
  return vertices;
}

TEST(SplitFaces, WhatIsFarFromKStaysWhole) {
  const WhitneyCase c = whitney_case("sphere", 0.5);
  const std::vector<LatticeVertex> cut = c.result.complex.simplex(2, 0).vertices();
  SplitFaces faces(c.result.complex, c.triangulation, c.result.displacements);
  faces.subdivide(moved(cut, 100), 0);
  SimplicialMesh mesh = faces.take_mesh();
  EXPECT_EQ(mesh.num_simplices(), 1u);
  EXPECT_EQ(count_not_positive(mesh), 0u);
  for (const std::uint32_t v : mesh.simplices) EXPECT_EQ(mesh.point_data[1].values[v], 0);  // vertices of T~
}

TEST(SplitFaces, ACutSimplexIsItsChainsAndSidesShareThem) {
  const WhitneyCase c = whitney_case("sphere", 0.5);
  const std::vector<LatticeVertex> cut = c.result.complex.simplex(2, 0).vertices();
  const auto count = [&](std::uint32_t outside) {
    SplitFaces faces(c.result.complex, c.triangulation, c.result.displacements);
    faces.subdivide(cut, outside);
    return faces.take_mesh().num_simplices();
  };
  EXPECT_EQ(count(0), 24u);
  EXPECT_EQ(count(0b0001), 18u);  // six chains begin at each vertex
  EXPECT_EQ(count(0b0101), 12u);
  EXPECT_EQ(count(0b1111), 0u);
}

TEST(SplitFaces, MirrorImagesArePositiveToo) {
  for (const bool mirrored : {false, true}) {
    const Submanifold manifold = named_submanifold("sphere");
    Matrix matrix = Matrix::identity(3);
    if (mirrored) matrix(1, 1) = -1;
    const auto triangulation = coxeter::coxeter_a(3, 0.5).transformed(matrix, std::vector<double>(3, 0.0123));
    const TriangulateResult result = triangulate(manifold, *manifold.bending(), triangulation, manifold.seed_points());
    const AmbientMesh ambient = ambient_mesh(result.complex, triangulation, result.displacements);
    EXPECT_GT(ambient.mesh.num_simplices(), 0u);
    EXPECT_EQ(ambient.not_positive, 0u);
  }
}

TEST(SplitFaces, CrossedEdgesAreThoseOfTheComplex) {
  const WhitneyCase c = whitney_case("sphere", 0.5);
  const CellComplex& complex = c.result.complex;
  const SplitFaces faces(complex, c.triangulation, c.result.displacements);
  std::size_t ends = 0;
  for (std::size_t i = 0; i < complex.num_cells(2); ++i) {
    const auto v = complex.simplex(2, i).vertices();
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < a; ++b) {
        const bool crossed = faces.is_crossed(v[a], v[b]);
        EXPECT_EQ(crossed, faces.is_crossed(v[b], v[a]));
        ends += crossed;
      }
  }
  // Every 0-cell is on one edge, counted once by each 2-cell that it is a corner of.
  EXPECT_EQ(ends, polygon_mesh(complex).corners.size());
}

TEST(SplitFaces, TakesTheComplexOfATraceWithoutDisplacements) {
  const NamedManifold m = sphere(2, 3, 1.0);
  const auto triangulation =
      coxeter::coxeter_a(3, 0.3).transformed(Matrix::identity(3), std::vector<double>(3, 0.0123));
  const CellComplex complex = cell_complex(trace(m.function, triangulation, m.point));
  const AmbientMesh ambient = ambient_mesh(complex, triangulation, perturbation::DisplacementMap(3));
  EXPECT_EQ(ambient.mesh.num_simplices(), 24 * complex.num_cells(2));
  EXPECT_EQ(ambient.not_positive, 0u);
  EXPECT_TRUE(is_subcomplex(barycentric_subdivision(complex), ambient.mesh));
}

}  // namespace
}  // namespace whitney
