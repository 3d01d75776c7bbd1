// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/face_lattice.h>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include "test_complexes.h"

namespace whitney {
namespace {

using testing::mesh_of;
using testing::Simplices;

std::size_t binomial(int n, int k) {
  std::size_t result = 1;
  for (int i = 0; i < k; ++i) result = result * (n - i) / (i + 1);
  return result;
}

TEST(FaceLattice, CountsOfTheBoundaryOfASimplexAreBinomials) {
  for (int n = 0; n <= 7; ++n) {
    const FaceLattice lattice = face_lattice(testing::simplex_sphere(n));
    for (int j = 0; j <= n; ++j) EXPECT_EQ(lattice.num_faces(j), binomial(n + 2, j + 1)) << n << " " << j;
  }
}

TEST(FaceLattice, AgreesWithSetsOfSubsets) {
  std::mt19937 random(7);
  for (int dim = 1; dim <= 5; ++dim) {
    std::set<std::vector<std::uint32_t>> chosen;
    while (chosen.size() < 60) {
      std::set<std::uint32_t> simplex;
      while (int(simplex.size()) <= dim) simplex.insert(random() % 14);
      chosen.emplace(simplex.begin(), simplex.end());
    }
    Simplices simplices(chosen.begin(), chosen.end());
    for (auto& simplex : simplices) std::shuffle(simplex.begin(), simplex.end(), random);
    std::shuffle(simplices.begin(), simplices.end(), random);
    const SimplicialMesh mesh = mesh_of(dim, simplices);
    const FaceLattice lattice = face_lattice(mesh);

    std::vector<std::set<std::vector<std::uint32_t>>> faces(dim + 1);
    for (const auto& simplex : chosen) {
      for (int bits = 1; bits < 1 << (dim + 1); ++bits) {
        std::vector<std::uint32_t> face;
        for (int k = 0; k <= dim; ++k) {
          if (bits >> k & 1) face.push_back(simplex[k]);
        }
        faces[face.size() - 1].insert(face);
      }
    }
    for (int j = 0; j <= dim; ++j) {
      const auto face = [&](int i, std::size_t f) {
        const auto begin = lattice.vertices[i].begin() + f * (i + 1);
        return std::vector<std::uint32_t>(begin, begin + i + 1);
      };
      std::set<std::vector<std::uint32_t>> found;
      for (std::size_t f = 0; f < lattice.num_faces(j); ++f) {
        found.insert(face(j, f));
        ASSERT_EQ(lattice.facets[j][f].size(), j == 0 ? 0u : j + 1u);
        for (int k = 0; k <= j && j > 0; ++k) {
          auto expected = face(j, f);
          expected.erase(expected.begin() + k);
          EXPECT_EQ(face(j - 1, lattice.facets[j][f][k]), expected);
        }
      }
      EXPECT_EQ(found, faces[j]);
      EXPECT_EQ(lattice.num_faces(j), faces[j].size());
    }
    for (std::size_t i = 0; i < simplices.size(); ++i) {
      std::sort(simplices[i].begin(), simplices[i].end());
      EXPECT_TRUE(std::equal(simplices[i].begin(), simplices[i].end(), lattice.vertices[dim].begin() + i * (dim + 1)));
    }
    EXPECT_TRUE(std::is_sorted(lattice.vertices[0].begin(), lattice.vertices[0].end()));
  }
}

TEST(FaceLattice, LeavesOutUnusedPoints) {
  SimplicialMesh mesh = mesh_of(1, {{1, 4}, {4, 2}});
  mesh.points.resize(9);
  const FaceLattice lattice = face_lattice(mesh);
  EXPECT_EQ(lattice.vertices[0], (std::vector<std::uint32_t>{1, 2, 4}));
  EXPECT_EQ(lattice.num_faces(0), 3u);
}

TEST(FaceLattice, StopsAtTheLowestDimensionAsked) {
  const FaceLattice all = face_lattice(testing::cross_polytope(4));
  const FaceLattice some = face_lattice(testing::cross_polytope(4), 2);
  for (int j = 2; j <= 4; ++j) EXPECT_EQ(some.vertices[j], all.vertices[j]);
  for (int j = 3; j <= 4; ++j) EXPECT_EQ(some.facets[j].index, all.facets[j].index);
  EXPECT_EQ(some.num_faces(2), all.num_faces(2));
  EXPECT_TRUE(some.facets[2].index.empty());
  EXPECT_EQ(some.num_faces(1), 0u);
}

TEST(FaceLattice, OfNothing) {
  const FaceLattice lattice = face_lattice(SimplicialMesh{.ambient_dim = 3, .dim = 2, .points = {}, .simplices = {}});
  for (int j = 0; j <= 2; ++j) EXPECT_EQ(lattice.num_faces(j), 0u);
}

std::string message_of(const SimplicialMesh& mesh) {
  try {
    face_lattice(mesh);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(FaceLattice, RejectsWhatIsNoSimplicialComplex) {
  SimplicialMesh mesh = mesh_of(2, {{0, 1, 2}, {1, 2, 3}, {2, 0, 1}});
  EXPECT_NE(message_of(mesh).find("simplices 0 and 2 have the same vertices"), std::string::npos) << message_of(mesh);
  mesh = mesh_of(2, {{0, 1, 2}, {3, 2, 3}});
  EXPECT_NE(message_of(mesh).find("simplex 1 has vertex 3 twice"), std::string::npos) << message_of(mesh);
  mesh = mesh_of(2, {{0, 1, 2}, {1, 2, 3}});
  mesh.points.pop_back();
  EXPECT_NE(message_of(mesh).find("simplex 1 has vertex 3, but"), std::string::npos) << message_of(mesh);
  mesh = mesh_of(2, {{0, 1, 2}, {1, 2}});
  EXPECT_NE(message_of(mesh).find("not a multiple of dim + 1"), std::string::npos) << message_of(mesh);
  mesh = mesh_of(2, {{0, 1, 2}});
  mesh.ambient_dim = 2;
  EXPECT_NE(message_of(mesh).find("ambient_dim"), std::string::npos) << message_of(mesh);
  mesh.dim = -1;
  mesh.ambient_dim = 1;
  EXPECT_NE(message_of(mesh).find("negative"), std::string::npos) << message_of(mesh);
}

}  // namespace
}  // namespace whitney
