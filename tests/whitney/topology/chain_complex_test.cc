// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/chain_complex.h>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include "test_complexes.h"

namespace whitney {
namespace {

using testing::circle;
using testing::Complex;
using testing::interval;
using testing::product;
using testing::push;

TEST(ChainComplex, SimplicialSignsSquareToZero) {
  for (const SimplicialMesh& mesh : {testing::cross_polytope(4), testing::projective_plane6(), testing::torus7()}) {
    const FaceLattice lattice = face_lattice(mesh);
    EXPECT_TRUE(boundary_squared_is_zero(lattice.facets, simplicial_signs(lattice.facets)));
  }
}

TEST(ChainComplex, PropagatedSignsSquareToZero) {
  const Complex klein =
      face_lattice(testing::grid_surface(5, 5, testing::Side::kFlipped, testing::Side::kGlued)).facets;
  for (const Complex& complex :
       {klein, product(klein, circle(3)), product(product(circle(2), circle(3)), interval(2)),
        testing::projective_space(4), testing::lens_space(4, 1), product(testing::lens_space(3, 1), interval(1))}) {
    EXPECT_TRUE(boundary_squared_is_zero(complex, regular_cell_signs(complex)));
  }
}

TEST(ChainComplex, PropagatedSignsOfASimplicialComplexAreTheStandardOnesUpToTheOrientationOfCells) {
  const FaceLattice lattice = face_lattice(testing::cross_polytope(3));
  const IncidenceSigns standard = simplicial_signs(lattice.facets);
  const IncidenceSigns propagated = regular_cell_signs(lattice.facets);
  std::vector<std::vector<int>> flip(4);
  flip[0].assign(lattice.num_faces(0), 1);
  for (int j = 1; j <= 3; ++j) {
    flip[j].assign(lattice.num_faces(j), 0);
    for (std::size_t i = 0; i < lattice.num_faces(j); ++i) {
      for (int k = 0; k <= j; ++k) {
        const std::size_t e = i * (j + 1) + k;
        const int ratio = standard[j][e] * propagated[j][e] * flip[j - 1][lattice.facets[j].index[e]];
        if (k == 0) flip[j][i] = ratio;
        EXPECT_EQ(flip[j][i], ratio);
      }
    }
  }
}

TEST(ChainComplex, AWrongSignIsNoticed) {
  const Complex complex = product(product(circle(3), circle(3)), circle(3));
  for (int j = 1; j <= 3; ++j) {
    IncidenceSigns signs = regular_cell_signs(complex);
    signs[j][5] = -signs[j][5];
    EXPECT_FALSE(boundary_squared_is_zero(complex, signs)) << j;
  }
}

std::string message_of(const Complex& complex) {
  try {
    regular_cell_signs(complex);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

/// The complex with one more cell, of one dimension more, that has all top cells as facets.
Complex filled(Complex complex) {
  std::vector<std::uint32_t> all(complex.back().size());
  std::iota(all.begin(), all.end(), 0);
  push(complex.emplace_back(), all);
  return complex;
}

#define EXPECT_REJECTED(complex, words) \
  EXPECT_NE(message_of(complex).find(words), std::string::npos) << message_of(complex)

TEST(ChainComplex, AcceptsBalls) {
  EXPECT_EQ(message_of(filled(circle(7))), "accepted");
  EXPECT_EQ(message_of(filled(circle(2))), "accepted");
  for (int n = 1; n <= 4; ++n)
    EXPECT_EQ(message_of(filled(face_lattice(testing::cross_polytope(n)).facets)), "accepted");
  EXPECT_EQ(message_of({}), "accepted");
}

TEST(ChainComplex, RejectsCellsThatAreNoBalls) {
  EXPECT_REJECTED(filled(interval(2)), "around its ridge");
  EXPECT_REJECTED(filled(face_lattice(testing::torus7()).facets), "not a sphere");
  EXPECT_REJECTED(filled(face_lattice(testing::projective_plane6()).facets), "not a sphere");
  EXPECT_REJECTED(filled(testing::projective_space(4)), "not orientable");
  EXPECT_REJECTED(
      filled(face_lattice(testing::disjoint_union(testing::simplex_sphere(1), testing::simplex_sphere(1))).facets),
      "not connected");
  // Two tetrahedra with a common vertex: not even connected across edges.
  EXPECT_REJECTED(filled(face_lattice(testing::wedge(testing::simplex_sphere(2), testing::simplex_sphere(2))).facets),
                  "not a sphere");
}

TEST(ChainComplex, RejectsListsThatAreNotWellFormed) {
  Complex complex = circle(3);
  push(complex[1], {0, 1, 2});
  EXPECT_REJECTED(complex, "must have two vertices");
  complex = circle(3);
  push(complex[1], {0, 0});
  EXPECT_REJECTED(complex, "facet 0 twice");
  complex = circle(3);
  push(complex[1], {0, 3});
  EXPECT_REJECTED(complex, "does not exist");
  complex = circle(3);
  push(complex.emplace_back(), {});
  EXPECT_REJECTED(complex, "has no facets");
  complex = circle(3);
  complex[1].index.pop_back();
  EXPECT_REJECTED(complex, "offsets");
  complex = circle(3);
  std::swap(complex[1].offset[1], complex[1].offset[2]);
  EXPECT_REJECTED(complex, "decrease");
  complex = circle(3);
  push(complex[0], {1});
  EXPECT_REJECTED(complex, "a 0-cell has facets");
}

TEST(ChainComplex, CofacetsAreTheReverseOfFacets) {
  const Complex complex = product(testing::projective_space(2), circle(3));
  for (std::size_t j = 1; j < complex.size(); ++j) {
    const Incidence cofacets = transposed(complex[j], complex[j - 1].size());
    ASSERT_EQ(cofacets.size(), complex[j - 1].size());
    std::size_t pairs = 0;
    for (std::uint32_t f = 0; f < cofacets.size(); ++f) {
      EXPECT_TRUE(std::is_sorted(cofacets[f].begin(), cofacets[f].end()));
      for (std::uint32_t c : cofacets[f]) {
        const auto facets = complex[j][c];
        pairs += std::count(facets.begin(), facets.end(), f);
      }
    }
    EXPECT_EQ(pairs, complex[j].index.size());
    EXPECT_EQ(cofacets.index.size(), complex[j].index.size());
  }
}

}  // namespace
}  // namespace whitney
