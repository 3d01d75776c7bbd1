// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/disjoint_sets.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace whitney {
namespace {

// Against labels that are rewritten as a whole.
TEST(DisjointSets, AgreesWithLabels) {
  std::mt19937 generator(1);
  for (std::uint32_t size : {1u, 2u, 10u, 100u}) {
    DisjointSets sets(size);
    std::vector<std::uint32_t> label(size);
    for (std::uint32_t i = 0; i < size; ++i) label[i] = i;
    for (std::uint32_t step = 0; step < size; ++step) {
      const std::uint32_t a = generator() % size, b = generator() % size;
      EXPECT_EQ(sets.unite(a, b), label[a] != label[b]);
      const std::uint32_t low = std::min(label[a], label[b]), high = std::max(label[a], label[b]);
      for (std::uint32_t& l : label)
        if (l == high) l = low;
      for (std::uint32_t i = 0; i < size; ++i) ASSERT_EQ(sets.find(i), label[i]);
    }
  }
}

TEST(DisjointSets, BeginsAnew) {
  DisjointSets sets;
  EXPECT_EQ(sets.size(), 0u);
  sets.reset(3);
  EXPECT_TRUE(sets.unite(1, 2));
  EXPECT_FALSE(sets.unite(2, 1));
  sets.reset(4);
  EXPECT_EQ(sets.size(), 4u);
  EXPECT_EQ(sets.find(2), 2u);
}

}  // namespace
}  // namespace whitney
