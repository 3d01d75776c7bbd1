// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/orientation.h>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/topology/chain_complex.h>
#include "test_complexes.h"

namespace whitney {
namespace {

using testing::Complex;
using testing::Side;

/// +1 or -1 from swapping neighbours until sorted.
int parity(std::vector<std::uint32_t> list) {
  int sign = 1;
  for (std::size_t pass = 0; pass < list.size(); ++pass) {
    for (std::size_t i = 0; i + 1 < list.size(); ++i) {
      if (list[i] > list[i + 1]) {
        std::swap(list[i], list[i + 1]);
        sign = -sign;
      }
    }
  }
  return sign;
}

/// The number of facets in two simplices that induce the same orientation on it.
int clashes(const SimplicialMesh& mesh) {
  std::map<std::vector<std::uint32_t>, std::vector<int>> induced;
  for (const auto& simplex : testing::simplices_of(mesh)) {
    for (std::size_t k = 0; k < simplex.size(); ++k) {
      auto facet = simplex;
      facet.erase(facet.begin() + k);
      const int sign = (k % 2 ? -1 : 1) * parity(facet);
      std::sort(facet.begin(), facet.end());
      induced[facet].push_back(sign);
    }
  }
  int count = 0;
  for (const auto& [facet, signs] : induced) count += signs.size() == 2 && signs[0] == signs[1];
  return count;
}

/// Random orders of the vertices in the simplices.
SimplicialMesh scrambled(const SimplicialMesh& mesh, std::uint64_t rng_seed) {
  return testing::randomly_subdivided(mesh, 30, rng_seed);
}

TEST(Orientation, OrientsOrientableMeshes) {
  std::uint64_t rng_seed = 0;
  for (const SimplicialMesh& mesh :
       {testing::simplex_sphere(1), testing::cross_polytope(1), testing::torus7(), testing::genus_surface(3),
        testing::grid_surface(5, 3, Side::kGlued, Side::kOpen), testing::cross_polytope(3), testing::cross_polytope(4),
        testing::flags(testing::projective_space(3)), testing::cone(testing::torus7()), testing::poincare_sphere()}) {
    const SimplicialMesh input = scrambled(mesh, ++rng_seed);
    EXPECT_GT(clashes(input), 0);
    const OrientedMesh result = orient(input);
    EXPECT_TRUE(result.all_orientable());
    EXPECT_EQ(result.orientable.size(), 1u);
    EXPECT_EQ(clashes(result.mesh), 0);
    EXPECT_EQ(face_lattice(result.mesh).vertices, face_lattice(input).vertices) << "only orders may change";
    EXPECT_TRUE(
        std::equal(input.simplices.begin(), input.simplices.begin() + mesh.dim + 1, result.mesh.simplices.begin()));
    EXPECT_EQ(orient(result.mesh).mesh.simplices, result.mesh.simplices);
  }
}

TEST(Orientation, LeavesNonOrientableComponentsAsTheyAre) {
  for (const SimplicialMesh& mesh :
       {testing::projective_plane6(), testing::grid_surface(6, 5, Side::kFlipped, Side::kGlued),
        testing::grid_surface(6, 5, Side::kFlipped, Side::kOpen), testing::flags(testing::projective_space(4))}) {
    const SimplicialMesh input = scrambled(mesh, 5);
    const OrientedMesh result = orient(input);
    EXPECT_EQ(result.orientable, std::vector<bool>{false});
    EXPECT_FALSE(result.all_orientable());
    EXPECT_EQ(result.mesh.simplices, input.simplices);
  }
}

TEST(Orientation, ComponentByComponent) {
  const SimplicialMesh mixed = testing::disjoint_union(
      testing::disjoint_union(scrambled(testing::torus7(), 1), scrambled(testing::projective_plane6(), 2)),
      scrambled(testing::simplex_sphere(2), 3));
  const OrientedMesh result = orient(mixed);
  EXPECT_EQ(result.orientable, (std::vector<bool>{true, false, true}));
  EXPECT_TRUE(std::is_sorted(result.component.begin(), result.component.end()));
  EXPECT_EQ(clashes(result.mesh), clashes(scrambled(testing::projective_plane6(), 2)));
}

TEST(Orientation, ABranchingEdgeSeparatesSheets) {
  const OrientedMesh result = orient(testing::mesh_of(2, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 1, 5}}));
  EXPECT_EQ(result.component, (std::vector<std::uint32_t>{0, 1, 2, 0}));
  EXPECT_EQ(clashes(result.mesh), 0);
}

TEST(Orientation, PointsHaveNothingToOrient) {
  const OrientedMesh result = orient(testing::simplex_sphere(0));
  EXPECT_EQ(result.orientable, (std::vector<bool>{true, true}));
  EXPECT_EQ(result.mesh.simplices, testing::simplex_sphere(0).simplices);
  EXPECT_TRUE(orient(SimplicialMesh{.ambient_dim = 3, .dim = 2, .points = {}, .simplices = {}}).orientable.empty());
}

TEST(Orientation, CellsOfAComplex) {
  const auto orientable = [](const Complex& facets) {
    const IncidenceSigns signs = regular_cell_signs(facets);
    const CellOrientation result = orient_cells(facets.back(), signs.back(), facets[facets.size() - 2].size());
    if (result.all_orientable()) {
      // The signed sum of all cells is a cycle.
      std::vector<int> sum(facets[facets.size() - 2].size(), 0);
      for (std::size_t i = 0; i < facets.back().size(); ++i) {
        for (std::uint32_t e = facets.back().offset[i]; e < facets.back().offset[i + 1]; ++e) {
          sum[facets.back().index[e]] += result.sign[i] * signs.back()[e];
        }
      }
      EXPECT_EQ(sum, std::vector<int>(sum.size(), 0));
    }
    return result.all_orientable();
  };
  const Complex klein = face_lattice(testing::grid_surface(5, 5, Side::kFlipped, Side::kGlued)).facets;
  EXPECT_TRUE(orientable(testing::product(testing::circle(3), testing::circle(4))));
  EXPECT_FALSE(orientable(testing::product(klein, testing::circle(4))));
  EXPECT_TRUE(orientable(testing::lens_space(4, 1)));
  EXPECT_TRUE(orientable(testing::projective_space(5)));
  EXPECT_FALSE(orientable(testing::projective_space(4)));
}

TEST(Orientation, RejectsBadInput) {
  EXPECT_THROW(orient(testing::mesh_of(2, {{0, 1, 1}})), InvalidInput);
  const Complex torus = testing::product(testing::circle(3), testing::circle(3));
  const IncidenceSigns signs = regular_cell_signs(torus);
  EXPECT_THROW(orient_cells(torus[2], signs[0], torus[1].size()), InvalidInput);
  EXPECT_THROW(orient_cells(torus[2], signs[2], torus[1].size() - 1), InvalidInput);
}

}  // namespace
}  // namespace whitney
