// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/lattice_vertex.h>

#include <unordered_set>

#include <gtest/gtest.h>

namespace whitney::coxeter {
namespace {

TEST(LatticeVertex, ComparesLexicographically) {
  EXPECT_EQ((LatticeVertex{1, 2}), (LatticeVertex{1, 2}));
  EXPECT_LT((LatticeVertex{-1, 5}), (LatticeVertex{0, -5}));
  EXPECT_LT((LatticeVertex{1, 2}), (LatticeVertex{1, 3}));
  EXPECT_NE((LatticeVertex{0}), (LatticeVertex{0, 0}));
}

TEST(LatticeVertex, IntegerIsTheDimensionInParentheses) {
  EXPECT_EQ(LatticeVertex(3), (LatticeVertex{0, 0, 0}));
  EXPECT_EQ(LatticeVertex{3}.ambient_dim(), 1);
}

TEST(LatticeVertex, LongOnesSurviveCopyAndMove) {
  LatticeVertex a(400);
  for (int i = 0; i < 400; ++i) a[i] = i - 200;
  LatticeVertex b = a;
  const LatticeVertex c = std::move(b);
  EXPECT_EQ(a, c);
  EXPECT_EQ(a.hash(), c.hash());
}

TEST(LatticeVertex, HashSeparatesAGrid) {
  std::unordered_set<std::uint64_t> hashes;
  for (int i = -20; i < 20; ++i)
    for (int j = -20; j < 20; ++j)
      for (int k = -20; k < 20; ++k) hashes.insert(LatticeVertex{i, j, k}.hash());
  EXPECT_EQ(hashes.size(), 64000u);  // 64 bits: a collision has probability 1e-10
}

}  // namespace
}  // namespace whitney::coxeter
