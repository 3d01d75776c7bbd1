// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/simplex.h>

#include <limits>
#include <random>
#include <unordered_set>

#include <gtest/gtest.h>
#include <tests/coxeter/brute_force.h>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <coxeter/triangulation.h>

namespace whitney::coxeter {
namespace {

using testing::adjacent;
using testing::is_canonical;
using testing::random_simplex;
using testing::vertex_set;

constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();

TEST(Simplex, VerticesOfATriangle) {
  const Simplex s({5, 7}, OrderedPartition::from_parts({{1}, {0}, {2}}));
  EXPECT_EQ(s.vertices(), (std::vector<LatticeVertex>{{5, 7}, {5, 8}, {6, 8}}));
  EXPECT_EQ(s.dim(), 2);
  EXPECT_EQ(s.codim(), 0);
  EXPECT_EQ(s.vertex(2), (LatticeVertex{6, 8}));
}

TEST(Simplex, ConstructorMakesTheFormCanonical) {
  // The same triangle from its second vertex.
  const Simplex s({5, 8}, OrderedPartition::from_parts({{0}, {2}, {1}}));
  EXPECT_EQ(s, Simplex({5, 7}, OrderedPartition::from_parts({{1}, {0}, {2}})));
}

TEST(Simplex, CyclicShiftsAreTheSameSimplex) {
  std::mt19937 gen(1);
  for (const int d : {1, 2, 3, 5, 9, 40})
    for (int m = 0; m <= d; m += 1 + d / 10) {
      const Simplex s = random_simplex(d, m, gen);
      ASSERT_TRUE(is_canonical(s));
      for (int q = 0; q <= m; ++q) {
        const Representation r = s.cyclic_shift(q);
        EXPECT_EQ(r.vertex, s.vertex(q));
        EXPECT_EQ(Simplex(r), s);
        EXPECT_EQ(Simplex(r).hash(), s.hash());
      }
      EXPECT_EQ(s.cyclic_shift(0).vertex, s.base());
      EXPECT_EQ(s.cyclic_shift(0).partition, s.partition());
    }
}

TEST(Simplex, VerticesFormAClique) {
  std::mt19937 gen(2);
  for (int i = 0; i < 50; ++i) {
    const auto v = random_simplex(6, 4, gen).vertices();
    for (std::size_t a = 0; a < v.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) EXPECT_TRUE(adjacent(v[a], v[b]));
  }
}

TEST(Simplex, FromVerticesInAnyOrder) {
  std::mt19937 gen(3);
  for (const int d : {1, 2, 4, 7, 30, 400})
    for (int m = 0; m <= d; m += 1 + d / 5) {
      const Simplex s = random_simplex(d, m, gen);
      auto v = s.vertices();
      std::shuffle(v.begin(), v.end(), gen);
      EXPECT_EQ(Simplex::from_vertices(v), s);
    }
}

TEST(Simplex, FromVerticesAgreesWithTheDefinition) {
  // All sets of three points of {-1,0,1}^2.
  std::vector<LatticeVertex> points;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) points.push_back({i, j});
  int triangles = 0;
  for (const auto& a : points)
    for (const auto& b : points)
      for (const auto& c : points) {
        const std::vector<LatticeVertex> v{a, b, c};
        if (adjacent(a, b) && adjacent(b, c) && adjacent(a, c)) {
          EXPECT_EQ(vertex_set(Simplex::from_vertices(v)), (testing::VertexSet{a, b, c}));
          ++triangles;
        } else {
          EXPECT_THROW(Simplex::from_vertices(v), InvalidInput);
        }
      }
  EXPECT_EQ(triangles, 6 * 8);  // four squares, two triangles each, in all orders
}

TEST(Simplex, IsFaceOfAgreesWithInclusionOfVertices) {
  std::mt19937 gen(4);
  int faces = 0;
  for (int i = 0; i < 20000; ++i) {
    const int d = 1 + static_cast<int>(gen() % 4);
    const Simplex a = random_simplex(d, static_cast<int>(gen() % static_cast<unsigned>(d + 1)), gen, 1);
    const Simplex b = random_simplex(d, static_cast<int>(gen() % static_cast<unsigned>(d + 1)), gen, 1);
    const auto va = vertex_set(a), vb = vertex_set(b);
    const bool expected = std::ranges::includes(vb, va);
    EXPECT_EQ(a.is_face_of(b), expected);
    faces += expected;
  }
  EXPECT_GT(faces, 500);
}

TEST(Simplex, OrderIsByBaseThenPartIndices) {
  const Simplex a({0, 0}, OrderedPartition::from_parts({{0}, {1, 2}})),
      b({0, 0}, OrderedPartition::from_parts({{1}, {0, 2}}));
  EXPECT_LT(a, b);  // (0, 1) < (1, 0)
  EXPECT_LT(b, Simplex({0, 1}, OrderedPartition::from_parts({{0}, {1, 2}})));
  // Equal part indices of the coordinates: the lower dimension first.
  EXPECT_LT(Simplex({0}, OrderedPartition::from_parts({{0, 1}})),
            Simplex({0}, OrderedPartition::from_parts({{0}, {1}})));
  std::mt19937 gen(5);
  for (int i = 0; i < 2000; ++i) {
    const Simplex x = random_simplex(2, static_cast<int>(gen() % 3), gen, 1);
    const Simplex y = random_simplex(2, static_cast<int>(gen() % 3), gen, 1);
    EXPECT_EQ((x <=> y) == 0, x == y);
    EXPECT_EQ(x<y, y> x);
  }
}

TEST(Simplex, HashSeparatesTheStarOfAVertex) {
  std::unordered_set<std::uint64_t> hashes;
  std::size_t count = 0;
  for (int m = 0; m <= 4; ++m)
    for (const auto& v : testing::brute_force_cofaces({LatticeVertex(4)}, m)) {
      hashes.insert(Simplex::from_vertices(std::vector<LatticeVertex>(v.begin(), v.end())).hash());
      ++count;
    }
  EXPECT_EQ(hashes.size(), count);
}

TEST(Simplex, BarycentreIsTheMeanOfTheVertices) {
  std::mt19937 gen(6);
  for (const int d : {1, 3, 8}) {
    Triangulation t = coxeter_a(d, 0.7).transformed(Matrix::identity(d), std::vector<double>(d, 2.5));
    for (int m = 0; m <= d; ++m) {
      const Simplex s = random_simplex(d, m, gen, 10);
      Eigen::VectorXd mean = Eigen::VectorXd::Zero(d), x(d);
      for (const auto& v : s.vertices()) {
        t.cartesian(v, {x.data(), static_cast<std::size_t>(d)});
        mean += x / (m + 1);
      }
      EXPECT_LT((as_eigen(barycentre(s, t)) - mean).norm(), 1e-12);
    }
  }
  EXPECT_THROW(barycentre(random_simplex(3, 1, gen), coxeter_a(4, 1)), InvalidInput);
}

TEST(Simplex, RejectsBadInput) {
  EXPECT_THROW(Simplex({0, 0}, OrderedPartition::from_parts({{0}, {1}})), InvalidInput);
  EXPECT_THROW(Simplex({0}, OrderedPartition::from_parts({{0}, {1}})).vertex(2), InvalidInput);
  EXPECT_THROW(Simplex({0}, OrderedPartition::from_parts({{0}, {1}})).vertex(-1), InvalidInput);
  EXPECT_THROW(Simplex::from_vertices({}), InvalidInput);
  EXPECT_THROW(Simplex::from_vertices(std::vector<LatticeVertex>{{0}, {0}}), InvalidInput);
  EXPECT_THROW(Simplex::from_vertices(std::vector<LatticeVertex>{{0}, {0, 1}}), InvalidInput);
  EXPECT_THROW(Simplex::from_vertices(std::vector<LatticeVertex>{{0, 1}, {1, 0}}), InvalidInput);
  EXPECT_THROW(Simplex::from_vertices(std::vector<LatticeVertex>{{kMin}, {kMax}}), InvalidInput);
}

TEST(Simplex, OverflowIsAnError) {
  EXPECT_THROW(Simplex({kMax}, OrderedPartition::from_parts({{0}, {1}})), LatticeOverflow);
  EXPECT_NO_THROW(Simplex({kMax}, OrderedPartition::from_parts({{0, 1}})));
  // From its upper vertex: the canonical base is one less.
  EXPECT_NO_THROW(Simplex({kMax}, OrderedPartition::from_parts({{1}, {0}})));
  EXPECT_THROW(Simplex({kMin}, OrderedPartition::from_parts({{1}, {0}})), LatticeOverflow);
}

TEST(Simplex, AssignsBetweenSimplicesThatOwnMemoryAndOthers) {
  std::mt19937 gen(11);
  // d = 17: the vertex alone owns memory; d = 30 with many parts: the partition too.
  for (const auto& [d, m] : {std::pair{3, 2}, {16, 16}, {17, 1}, {30, 25}, {400, 7}}) {
    const Simplex from = testing::random_simplex(d, m, gen);
    for (const auto& [e, k] : {std::pair{0, 0}, {16, 3}, {17, 0}, {30, 29}, {500, 5}}) {
      Simplex to = testing::random_simplex(e, k, gen);
      to = from;
      EXPECT_EQ(to, from);
      const Simplex copy(to), small = testing::random_simplex(5, 5, gen);
      EXPECT_EQ(copy, from);
      to = small;  // keeps the memory it owns
      EXPECT_EQ(to, small);
      EXPECT_EQ(copy, from);
      EXPECT_EQ(Simplex(to), small);
      const Simplex& self = to;
      to = self;
      EXPECT_EQ(to, small);
    }
  }
}

}  // namespace
}  // namespace whitney::coxeter
