// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/faces/faces.h>

#include <random>
#include <unordered_set>

#include <gtest/gtest.h>
#include <tests/coxeter/brute_force.h>

#include <coxeter/base/error.h>
#include <coxeter/counts.h>
#include <coxeter/faces/cofaces.h>

namespace whitney::coxeter {
namespace {

using testing::is_canonical;
using testing::random_simplex;
using testing::vertex_set;

TEST(Faces, AreTheSubsetsOfTheVertices) {
  std::mt19937 gen(1);
  for (int d = 1; d <= 7; ++d)
    for (int m = 0; m <= d; ++m)
      for (int k = 0; k <= m; ++k)
        for (int i = 0; i < 3; ++i) {
          const Simplex s = random_simplex(d, m, gen);
          std::set<testing::VertexSet> faces;
          int count = 0;
          for_each_face(s, k, [&](const Simplex& face) {
            ASSERT_TRUE(is_canonical(face));
            ASSERT_EQ(face.dim(), k);
            faces.insert(vertex_set(face));
            ++count;
          });
          EXPECT_EQ(static_cast<std::size_t>(count), faces.size()) << "a face was visited twice";
          EXPECT_EQ(faces, testing::brute_force_faces(vertex_set(s), k)) << d << ' ' << m << ' ' << k;
        }
}

TEST(Faces, LargePartsInHigherDimension) {
  std::mt19937 gen(2);
  for (const auto& [d, m] : {std::pair{15, 13}, {16, 12}, {30, 11}, {31, 12}, {60, 13}, {400, 9}})
    for (int k = 0; k <= m; ++k) {
      const Simplex s = random_simplex(d, m, gen);
      std::unordered_set<Simplex> faces;
      bool good = true;
      for_each_face(s, k, [&](const Simplex& face) {
        good = good && is_canonical(face) && face.is_face_of(s) && face.dim() == k;
        // The canonical arrays must be those that the constructor makes of the same vertices.
        good = good && Simplex::from_vertices(face.vertices()) == face;
        faces.insert(face);
      });
      EXPECT_TRUE(good);
      EXPECT_EQ(double(faces.size()), num_faces(m, k));
    }
}

TEST(Faces, FacetsAtDimension400) {
  std::mt19937 gen(3);
  for (const int codim : {0, 1, 3, 7}) {
    const Simplex s = random_simplex(400, 400 - codim, gen);
    std::unordered_set<Simplex> facets;
    for_each_facet(s, [&](const Simplex& facet) {
      EXPECT_TRUE(is_canonical(facet) && facet.is_face_of(s));
      facets.insert(facet);
    });
    EXPECT_EQ(facets.size(), static_cast<std::size_t>(401 - codim));
  }
}

TEST(Faces, FacetLeavesOutTheVertexTheDocumentationNames) {
  std::mt19937 gen(4);
  const Simplex s = random_simplex(6, 4, gen);
  int i = 1;
  for_each_facet(s, [&](const Simplex& facet) {
    auto expected = vertex_set(s);
    expected.erase(s.vertex(i++ % 5));
    EXPECT_EQ(vertex_set(facet), expected);
  });
}

TEST(Faces, EveryCofacetOfAFacetIsDual) {
  std::mt19937 gen(5);
  for (int d = 1; d <= 5; ++d)
    for (int m = 1; m <= d; ++m) {
      const Simplex s = random_simplex(d, m, gen);
      for_each_facet(s, [&](const Simplex& facet) {
        int found = 0;
        for_each_cofacet(facet, [&](const Simplex& cofacet) { found += cofacet == s; });
        EXPECT_EQ(found, 1);
      });
    }
}

TEST(Faces, VisitorMayStop) {
  std::mt19937 gen(6);
  const Simplex s = random_simplex(8, 8, gen);
  for (int k = 0; k <= 8; ++k) {
    int seen = 0;
    const bool all = for_each_face(s, k, [&](const Simplex&) { return ++seen < 5; });
    EXPECT_EQ(all, num_faces(8, k) < 5);
    EXPECT_EQ(seen, std::min(5, static_cast<int>(num_faces(8, k))));
  }
}

TEST(Faces, RejectsBadDimensions) {
  std::mt19937 gen(7);
  const Simplex s = random_simplex(4, 2, gen);
  auto ignore = [](const Simplex&) {};
  EXPECT_THROW(for_each_face(s, -1, ignore), InvalidInput);
  EXPECT_THROW(for_each_face(s, 3, ignore), InvalidInput);
  EXPECT_THROW(for_each_facet(random_simplex(4, 0, gen), ignore), InvalidInput);
}

}  // namespace
}  // namespace whitney::coxeter
