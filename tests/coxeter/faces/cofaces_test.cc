// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/faces/cofaces.h>

#include <limits>
#include <random>
#include <unordered_set>

#include <gtest/gtest.h>
#include <tests/coxeter/brute_force.h>

#include <coxeter/base/error.h>
#include <coxeter/counts.h>
#include <coxeter/faces/faces.h>

namespace whitney::coxeter {
namespace {

using testing::is_canonical;
using testing::random_simplex;
using testing::vertex_set;

TEST(Cofaces, AreTheCliquesAroundTheSimplex) {
  std::mt19937 gen(1);
  for (int d = 1; d <= 5; ++d)
    for (int m = 0; m <= d; ++m)
      for (int l = m; l <= d; ++l)
        for (int i = 0; i < (d < 5 ? 4 : 1); ++i) {
          const Simplex s = random_simplex(d, m, gen);
          std::set<testing::VertexSet> cofaces;
          int count = 0;
          for_each_coface(s, l, [&](const Simplex& coface) {
            ASSERT_TRUE(is_canonical(coface));
            ASSERT_EQ(coface.dim(), l);
            cofaces.insert(vertex_set(coface));
            ++count;
          });
          EXPECT_EQ(static_cast<std::size_t>(count), cofaces.size()) << "a coface was visited twice";
          EXPECT_EQ(cofaces, testing::brute_force_cofaces(vertex_set(s), l)) << d << ' ' << m << ' ' << l;
          EXPECT_EQ(double(count), num_cofaces(s, l));
        }
}

TEST(Cofaces, HighDimension) {
  std::mt19937 gen(2);
  for (const int d : {30, 100, 400})
    for (const int codim : {1, 3, 6}) {
      const Simplex s = random_simplex(d, d - codim, gen);
      for (int l = d - codim; l <= d; ++l) {
        std::unordered_set<Simplex> cofaces;
        bool good = true;
        for_each_coface(s, l, [&](const Simplex& coface) {
          good = good && is_canonical(coface) && coface.dim() == l && s.is_face_of(coface);
          cofaces.insert(coface);
        });
        EXPECT_TRUE(good);
        EXPECT_EQ(double(cofaces.size()), num_cofaces(s, l));
      }
    }
}

TEST(Cofaces, EveryFacetOfACofacetIsDual) {
  std::mt19937 gen(3);
  for (int d = 1; d <= 5; ++d)
    for (int m = 0; m < d; ++m) {
      const Simplex s = random_simplex(d, m, gen);
      for_each_cofacet(s, [&](const Simplex& cofacet) {
        int found = 0;
        for_each_facet(cofacet, [&](const Simplex& facet) { found += facet == s; });
        EXPECT_EQ(found, 1);
      });
    }
}

TEST(Cofaces, VisitorMayStop) {
  std::mt19937 gen(4);
  const Simplex s = random_simplex(6, 2, gen);
  int seen = 0;
  EXPECT_FALSE(for_each_coface(s, 6, [&](const Simplex&) { return ++seen < 7; }));
  EXPECT_EQ(seen, 7);
}

TEST(Cofaces, OverflowIsAnError) {
  constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
  const Simplex s({kMin, 0}, OrderedPartition::from_parts({{0, 1, 2}}));
  EXPECT_THROW(for_each_cofacet(s, [](const Simplex&) {}), LatticeOverflow);
}

TEST(Cofaces, RejectsBadDimensions) {
  std::mt19937 gen(5);
  const Simplex s = random_simplex(4, 2, gen);
  auto ignore = [](const Simplex&) {};
  EXPECT_THROW(for_each_coface(s, 1, ignore), InvalidInput);
  EXPECT_THROW(for_each_coface(s, 5, ignore), InvalidInput);
  EXPECT_THROW(for_each_cofacet(random_simplex(4, 4, gen), ignore), InvalidInput);
}

}  // namespace
}  // namespace whitney::coxeter
