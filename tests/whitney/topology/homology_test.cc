// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/homology.h>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include "test_complexes.h"
#include "topology/betti_by_elimination.h"

namespace whitney {
namespace {

using testing::circle;
using testing::Complex;
using testing::product;
using testing::Side;

std::string groups_of(const Homology& result) {
  std::string text;
  for (const HomologyGroup& group : result.groups) text += (text.empty() ? "" : ", ") + to_string(group);
  return text;
}

/// Integral homology; Z/2 by elimination and the critical cells must fit it.
std::string homology_text(const Complex& facets) {
  const Homology result = homology(facets);
  EXPECT_EQ(betti_z2(result.groups), betti_z2_by_elimination(facets));
  std::int64_t chi = 0, critical_chi = 0;
  for (std::size_t j = 0; j < facets.size(); ++j) {
    chi += (j % 2 ? -1 : 1) * std::int64_t(facets[j].size());
    critical_chi += (j % 2 ? -1 : 1) * std::int64_t(result.critical_cells[j]);
    EXPECT_GE(result.critical_cells[j], result.groups[j].rank);
  }
  EXPECT_EQ(chi, critical_chi);
  return groups_of(result);
}

std::string homology_text(const SimplicialMesh& mesh) {
  const FaceLattice lattice = face_lattice(mesh);
  const std::string text = homology_text(lattice.facets);
  EXPECT_EQ(text, groups_of(homology(lattice.facets, simplicial_signs(lattice.facets))));
  return text;
}

TEST(Homology, PrintsGroups) {
  EXPECT_EQ(to_string(HomologyGroup{}), "0");
  EXPECT_EQ(to_string(HomologyGroup{1, {}}), "Z");
  EXPECT_EQ(to_string(HomologyGroup{2, {"2", "4"}}), "Z^2 + Z/2 + Z/4");
  EXPECT_EQ(to_string(HomologyGroup{0, {"2", "4"}}), "Z/2 + Z/4");
}

TEST(Homology, Spheres) {
  EXPECT_EQ(homology_text(testing::simplex_sphere(0)), "Z^2");
  EXPECT_EQ(homology_text(testing::cross_polytope(0)), "Z^2");
  std::string expected = "Z";
  for (int n = 1; n <= 6; ++n) {
    EXPECT_EQ(homology_text(testing::simplex_sphere(n)), expected + ", Z");
    EXPECT_EQ(homology_text(testing::cross_polytope(n)), expected + ", Z");
    EXPECT_EQ(homology_text(testing::cone(testing::cross_polytope(n - 1))), expected + ", 0");
    expected += ", 0";
  }
}

TEST(Homology, Surfaces) {
  EXPECT_EQ(homology_text(testing::torus7()), "Z, Z^2, Z");
  EXPECT_EQ(homology_text(testing::projective_plane6()), "Z, Z/2, 0");
  EXPECT_EQ(homology_text(testing::grid_surface(6, 5, Side::kFlipped, Side::kGlued)), "Z, Z + Z/2, 0");
  EXPECT_EQ(homology_text(testing::grid_surface(6, 5, Side::kFlipped, Side::kOpen)), "Z, Z, 0");
  EXPECT_EQ(homology_text(testing::grid_surface(6, 5, Side::kGlued, Side::kOpen)), "Z, Z, 0");
  EXPECT_EQ(homology_text(testing::grid_surface(6, 5, Side::kOpen, Side::kOpen)), "Z, 0, 0");
  for (int genus = 0; genus <= 12; genus += 3) {
    const std::string h1 = genus == 0 ? "0" : "Z^" + std::to_string(2 * genus);
    EXPECT_EQ(homology_text(testing::genus_surface(genus)), "Z, " + h1 + ", Z");
  }
  // Three projective planes: H_1 = Z^2 + Z/2.
  const SimplicialMesh plane = testing::projective_plane6();
  const SimplicialMesh three = testing::connected_sum(plane, testing::connected_sum(plane, plane));
  EXPECT_EQ(homology_text(three), "Z, Z^2 + Z/2, 0");
}

TEST(Homology, DisjointUnions) {
  const SimplicialMesh two = testing::disjoint_union(testing::torus7(), testing::projective_plane6());
  EXPECT_EQ(homology_text(two), "Z^2, Z^2 + Z/2, Z");
  EXPECT_EQ(homology_text(testing::disjoint_union(two, two)), "Z^4, Z^4 + Z/2 + Z/2, Z^2");
}

TEST(Homology, ProjectiveSpaces) {
  EXPECT_EQ(homology_text(testing::projective_space(1)), "Z, Z");
  EXPECT_EQ(homology_text(testing::projective_space(2)), "Z, Z/2, 0");
  EXPECT_EQ(homology_text(testing::projective_space(3)), "Z, Z/2, 0, Z");
  EXPECT_EQ(homology_text(testing::projective_space(4)), "Z, Z/2, 0, Z/2, 0");
  EXPECT_EQ(homology_text(testing::projective_space(5)), "Z, Z/2, 0, Z/2, 0, Z");
  EXPECT_EQ(homology_text(testing::flags(testing::projective_space(3))), "Z, Z/2, 0, Z");
}

TEST(Homology, LensSpaces) {
  EXPECT_EQ(homology_text(testing::lens_space(1, 1)), "Z, 0, 0, Z");
  EXPECT_EQ(homology_text(testing::lens_space(3, 1)), "Z, Z/3, 0, Z");
  EXPECT_EQ(homology_text(testing::lens_space(4, 1)), "Z, Z/4, 0, Z");
  EXPECT_EQ(homology_text(testing::lens_space(12, 5)), "Z, Z/12, 0, Z");
  EXPECT_EQ(homology_text(testing::flags(testing::lens_space(5, 2))), "Z, Z/5, 0, Z");
}

TEST(Homology, PoincareSphereCannotBeToldFromASphere) {
  EXPECT_EQ(homology_text(testing::poincare_sphere()), "Z, 0, 0, Z");
}

TEST(Homology, Products) {
  const Complex sphere = face_lattice(testing::simplex_sphere(2)).facets;
  const Complex klein = face_lattice(testing::grid_surface(5, 5, Side::kFlipped, Side::kGlued)).facets;
  const Complex plane = face_lattice(testing::projective_plane6()).facets;
  EXPECT_EQ(homology_text(product(product(circle(3), circle(4)), circle(2))), "Z, Z^3, Z^3, Z");
  EXPECT_EQ(homology_text(product(circle(5), sphere)), "Z, Z, Z, Z");
  EXPECT_EQ(homology_text(product(klein, circle(4))), "Z, Z^2 + Z/2, Z + Z/2, 0");
  // Kuenneth: H_3(RP^2 x RP^2) = Tor(Z/2, Z/2).
  EXPECT_EQ(homology_text(product(plane, plane)), "Z, Z/2 + Z/2, Z/2, Z/2, 0");
  EXPECT_EQ(homology_text(product(testing::lens_space(2, 1), testing::lens_space(4, 1))),
            "Z, Z/2 + Z/4, Z/2, Z^2 + Z/2, Z/2 + Z/4, 0, Z");
}

TEST(Homology, Torsion) {
  EXPECT_EQ(homology_text(testing::telescope({2})), "Z, Z/2, 0");
  EXPECT_EQ(homology_text(testing::telescope({6})), "Z, Z/6, 0");
  EXPECT_EQ(homology_text(testing::telescope({2, 3, 10})), "Z, Z/60, 0");
  EXPECT_EQ(homology_text(testing::suspension(testing::telescope({9}))), "Z, 0, Z/9, 0");
  // Invariant factors, not prime powers: Z/4 + Z/6 + Z/9 = Z/6 + Z/36.
  const SimplicialMesh three = testing::disjoint_union(
      testing::disjoint_union(testing::telescope({4}), testing::telescope({6})), testing::telescope({9}));
  EXPECT_EQ(homology_text(three), "Z^3, Z/6 + Z/36, 0");
}

TEST(Homology, CoefficientsLargerThanMachineIntegers) {
  const SimplicialMesh mesh = testing::telescope(std::vector<int>(70, 2));
  EXPECT_EQ(homology_text(mesh), "Z, Z/1180591620717411303424, 0");
  // Read from the other end everything collapses onto the last circle, and the disc at the first one is left: its
  // boundary runs 2^70 times around, more than 64 bits count.
  std::vector<std::uint32_t> backwards(mesh.num_points());
  for (std::uint32_t v = 0; v < backwards.size(); ++v) backwards[v] = backwards.size() - 1 - v;
  testing::Simplices simplices = testing::simplices_of(testing::relabelled(mesh, backwards));
  std::reverse(simplices.begin(), simplices.end());
  const SimplicialMesh turned = testing::mesh_of(2, simplices);
  EXPECT_EQ(homology_text(turned), "Z, Z/1180591620717411303424, 0");
  EXPECT_EQ(homology(face_lattice(turned).facets).critical_cells, (std::vector<std::size_t>{1, 1, 1}));
}

TEST(Homology, SubdivisionChangesNothing) {
  for (std::uint64_t rng_seed = 0; rng_seed < 12; ++rng_seed) {
    EXPECT_EQ(homology_text(testing::randomly_subdivided(testing::flags(testing::projective_space(3)), 60, rng_seed)),
              "Z, Z/2, 0, Z");
    EXPECT_EQ(homology_text(testing::randomly_subdivided(testing::telescope({4, 3}), 100, rng_seed)), "Z, Z/12, 0");
    EXPECT_EQ(homology_text(testing::randomly_subdivided(testing::genus_surface(2), 200, rng_seed)), "Z, Z^4, Z");
    EXPECT_EQ(homology_text(testing::randomly_subdivided(testing::suspension(testing::torus7()), 50, rng_seed)),
              "Z, 0, Z^2, Z");
  }
}

TEST(Homology, RandomComplexesAgreeWithElimination) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 60; ++trial) {
    const int dim = 2 + trial % 3;
    std::set<std::vector<std::uint32_t>> simplices;
    for (int i = 0; i < 20 + trial; ++i) {
      std::set<std::uint32_t> simplex;
      while (int(simplex.size()) <= dim) simplex.insert(random() % 10);
      simplices.emplace(simplex.begin(), simplex.end());
    }
    homology_text(testing::mesh_of(dim, {simplices.begin(), simplices.end()}));
  }
}

TEST(Homology, OfNothing) {
  EXPECT_TRUE(homology(Complex{}).groups.empty());
  EXPECT_EQ(groups_of(homology(Complex(3))), "0, 0, 0");
  EXPECT_EQ(betti_z2_by_elimination(Complex(3)), (std::vector<std::size_t>{0, 0, 0}));
}

TEST(Homology, RejectsSignsOfAnotherComplex) {
  const Complex torus = product(circle(3), circle(3));
  EXPECT_THROW(homology(torus, regular_cell_signs(circle(3))), InvalidInput);
  EXPECT_THROW(homology(torus, regular_cell_signs(product(circle(3), circle(4)))), InvalidInput);
}

}  // namespace
}  // namespace whitney
