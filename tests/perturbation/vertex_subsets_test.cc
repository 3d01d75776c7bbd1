// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/vertex_subsets.h>

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>

namespace whitney::perturbation {
namespace {

TEST(VertexSubsets, AreAllFacesOnceInLexicographicOrder) {
  for (int d = 1; d <= 7; ++d) {
    std::size_t total = 0;
    for (int m = 0; m <= d; ++m) {
      const VertexSubsets faces(d, m);
      ASSERT_EQ(faces.size, m + 1);
      std::vector<std::vector<int>> seen;
      for (std::size_t f = 0; f < faces.num(); ++f) {
        seen.emplace_back(faces[f], faces[f] + faces.size);
        EXPECT_TRUE(std::is_sorted(seen.back().begin(), seen.back().end()));
        EXPECT_LE(seen.back().back(), d);
      }
      EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
      EXPECT_EQ(std::set(seen.begin(), seen.end()).size(), seen.size());
      total += seen.size();
    }
    EXPECT_EQ(total, (std::size_t{2} << d) - 1) << d;  // all subsets of d + 1 vertices but the empty one
  }
}

TEST(VertexSubsets, RefuseWhatTheyCannotHold) {
  EXPECT_THROW(VertexSubsets(3, 4), InvalidInput);
  EXPECT_THROW(VertexSubsets(3, -1), InvalidInput);
  EXPECT_THROW(VertexSubsets(32, 1), InvalidInput);
  EXPECT_THROW(VertexSubsets(31, 15), InvalidInput);  // 6e8 faces
  EXPECT_EQ(VertexSubsets(31, 3).num(), 35960u);
}

}  // namespace
}  // namespace whitney::perturbation
