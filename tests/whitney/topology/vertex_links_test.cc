// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/vertex_links.h>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/topology/chain_complex.h>
#include <whitney/topology/homology.h>
#include "test_complexes.h"

namespace whitney {
namespace {

using testing::mesh_of;
using testing::Side;
using testing::Simplices;

void expect_manifold(const SimplicialMesh& mesh, bool proved = true) {
  const LinkReport report = check_vertex_links(mesh);
  EXPECT_EQ(report.singular_vertices, 0u);
  EXPECT_FALSE(report.first.has_value()) << report.first->reason;
  EXPECT_EQ(report.proved, proved);
}

void expect_defect(const SimplicialMesh& mesh, std::size_t singular, const std::vector<std::uint32_t>& face,
                   const std::string& words) {
  const LinkReport report = check_vertex_links(mesh);
  EXPECT_EQ(report.singular_vertices, singular);
  ASSERT_TRUE(report.first.has_value());
  EXPECT_EQ(report.first->face, face) << report.first->reason;
  EXPECT_NE(report.first->reason.find(words), std::string::npos) << report.first->reason;
}

TEST(VertexLinks, OfManifolds) {
  for (int n = 0; n <= 5; ++n) {
    expect_manifold(testing::simplex_sphere(n));
    expect_manifold(testing::cross_polytope(n));
    expect_manifold(testing::cone(testing::cross_polytope(n)));
  }
  expect_manifold(mesh_of(0, {{0}, {1}, {2}}));
  expect_manifold(mesh_of(1, {{3, 1}, {1, 2}, {5, 6}}));
  expect_manifold(testing::torus7());
  expect_manifold(testing::projective_plane6());
  expect_manifold(testing::grid_surface(6, 5, Side::kFlipped, Side::kOpen));
  expect_manifold(testing::flags(testing::projective_space(4)));
  expect_manifold(testing::flags(testing::lens_space(3, 1)));
  expect_manifold(testing::flags(testing::product(testing::lens_space(2, 1), testing::interval(1))));
  expect_manifold(testing::poincare_sphere());
}

TEST(VertexLinks, OfCurves) { expect_defect(mesh_of(1, {{4, 2}, {2, 3}, {2, 0}}), 1, {2}, "lies in 3 edges"); }

TEST(VertexLinks, OfSurfaces) {
  expect_defect(testing::wedge(testing::simplex_sphere(2), testing::torus7()), 1, {0}, "2 components");
  expect_defect(mesh_of(2, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}), 2, {0, 1}, "lies in 3 simplices of dimension 2");
  expect_defect(mesh_of(2, {{3, 4, 2}, {3, 4, 1}, {3, 4, 0}}), 2, {3, 4}, "lies in 3 simplices");
  expect_defect(mesh_of(2, {{0, 1, 2}, {2, 3, 4}}), 1, {2}, "2 components");
}

TEST(VertexLinks, OfThreeDimensionalMeshes) {
  expect_defect(testing::suspension(testing::torus7()), 2, {7}, "without boundary of Euler characteristic 0");
  expect_defect(testing::cone(testing::projective_plane6()), 1, {6}, "without boundary of Euler characteristic 1");
  expect_defect(testing::cone(testing::grid_surface(4, 3, Side::kGlued, Side::kOpen)), 1, {16},
                "with boundary of Euler characteristic 0");
  expect_defect(mesh_of(3, {{0, 1, 2, 3}, {0, 1, 4, 5}}), 2, {0, 1}, "2 components");
  expect_defect(mesh_of(3, {{0, 1, 2, 3}, {3, 4, 5, 6}}), 1, {3}, "2 components");
  expect_defect(mesh_of(3, {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 2, 5}}), 3, {0, 1, 2}, "more than two");
}

TEST(VertexLinks, OfHigherDimensionalMeshes) {
  expect_defect(testing::suspension(testing::suspension(testing::torus7())), 4, {7, 9}, "Euler characteristic 0");
  expect_defect(testing::cone(testing::flags(testing::projective_space(3))), 1, {40}, "homology Z, Z/2, 0, Z, not");
  // The cone over S^1 x D^2, and over S^1 x D^3.
  for (int dim = 2; dim <= 3; ++dim) {
    const SimplicialMesh ball = testing::cone(testing::simplex_sphere(dim - 1));
    const SimplicialMesh thick = testing::flags(testing::product(testing::circle(3), face_lattice(ball).facets));
    expect_defect(testing::cone(thick), 1, {std::uint32_t(thick.num_points())},
                  dim == 2 ? "homology Z, Z, 0, 0, not that of a ball" : "homology Z, Z, 0, 0, 0, not that of a ball");
  }
}

TEST(VertexLinks, AHomologySphereIsNotTakenForASphere) {
  // The suspension is a homology manifold, and no manifold; all the check promises is that it does not claim a proof.
  expect_manifold(testing::suspension(testing::poincare_sphere()), false);
}

/// By the definition: the vertices on a face whose link has not the homology of a sphere (if closed) or of a point.
std::size_t singular_by_definition(const SimplicialMesh& mesh) {
  const FaceLattice lattice = face_lattice(mesh);
  const Simplices simplices = testing::simplices_of(mesh);
  std::set<std::uint32_t> singular;
  for (int j = 0; j < mesh.dim; ++j) {
    const int m = mesh.dim - j - 1;
    for (std::size_t i = 0; i < lattice.num_faces(j); ++i) {
      const std::set<std::uint32_t> face(lattice.vertices[j].begin() + i * (j + 1),
                                         lattice.vertices[j].begin() + (i + 1) * (j + 1));
      Simplices link;
      for (const auto& simplex : simplices) {
        std::vector<std::uint32_t> rest;
        for (std::uint32_t v : simplex) {
          if (!face.contains(v)) rest.push_back(v);
        }
        if (int(rest.size()) == m + 1) link.push_back(rest);
      }
      const FaceLattice faces = face_lattice(mesh_of(m, link));
      std::vector<HomologyGroup> wanted(m + 1);
      bool closed = m > 0 || link.size() == 2;
      if (m > 0) {
        const Incidence cofacets = transposed(faces.facets[m], faces.num_faces(m - 1));
        for (std::size_t f = 0; f < cofacets.size(); ++f) closed = closed && cofacets[f].size() != 1;
      }
      wanted[0].rank = 1;
      if (closed) ++wanted[m].rank;
      if (homology(faces.facets).groups != wanted) singular.insert(face.begin(), face.end());
    }
  }
  return singular.size();
}

TEST(VertexLinks, AgreesWithTheDefinitionOnDamagedManifolds) {
  std::mt19937_64 random(5);
  std::set<std::size_t> seen;
  for (int trial = 0; trial < 120; ++trial) {
    const int dim = 1 + trial % 4;
    SimplicialMesh mesh = testing::randomly_subdivided(testing::cross_polytope(dim), 8, random());
    Simplices simplices = testing::simplices_of(mesh);
    simplices.resize(simplices.size() - random() % 4);
    // Two vertices become one, where that leaves a simplicial complex.
    const std::uint32_t a = random() % mesh.num_points(), b = random() % mesh.num_points();
    std::set<std::vector<std::uint32_t>> kept;
    for (auto simplex : simplices) {
      for (std::uint32_t& v : simplex) v = v == a ? b : v;
      std::sort(simplex.begin(), simplex.end());
      if (std::adjacent_find(simplex.begin(), simplex.end()) == simplex.end()) kept.insert(simplex);
    }
    mesh = mesh_of(dim, {kept.begin(), kept.end()});
    const LinkReport report = check_vertex_links(mesh);
    EXPECT_EQ(report.singular_vertices, singular_by_definition(mesh)) << trial;
    EXPECT_EQ(report.first.has_value(), report.singular_vertices > 0);
    seen.insert(report.singular_vertices);
  }
  EXPECT_TRUE(seen.contains(0));
  EXPECT_GT(seen.size(), 5u);
}

TEST(VertexLinks, RejectsBadInput) { EXPECT_THROW(check_vertex_links(mesh_of(2, {{0, 1, 1}})), InvalidInput); }

}  // namespace
}  // namespace whitney
