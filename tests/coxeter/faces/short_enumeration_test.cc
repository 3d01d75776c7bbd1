// SPDX-License-Identifier: GPL-3.0-or-later
//
// The enumerations for d <= 15 beside those for every d.
#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <tests/coxeter/brute_force.h>

#include <coxeter/base/error.h>
#include <coxeter/counts.h>
#include <coxeter/faces/cofaces.h>
#include <coxeter/faces/faces.h>

namespace whitney::coxeter {
namespace {

using testing::is_canonical;
using testing::random_simplex;

constexpr int kMaxDim = kMaxShortElements - 1;

template <class Enumeration>
std::vector<Simplex> sorted(const Simplex& simplex, int dim) {
  std::vector<Simplex> result;
  auto visit = [&](const Simplex& s) { result.push_back(s); };
  EXPECT_TRUE(Enumeration(simplex, dim).run(visit));
  std::ranges::sort(result);
  return result;
}

TEST(ShortFaces, AreThoseOfTheGeneralForm) {
  std::mt19937 gen(1);
  for (int d = 0; d <= kMaxDim; ++d)
    for (int m = 0; m <= d; ++m) {
      const Simplex s = random_simplex(d, m, gen);
      for (int k = 0; k <= m; ++k) {
        const auto faces = sorted<detail::ShortFaces>(s, k);
        ASSERT_EQ(double(faces.size()), num_faces(m, k));
        ASSERT_EQ(faces, sorted<detail::FaceEnumeration>(s, k)) << d << ' ' << m << ' ' << k;
      }
    }
}

TEST(ShortFaces, FacetsComeInTheOrderOfTheGeneralForm) {
  std::mt19937 gen(2);
  for (int d = 1; d <= kMaxDim; ++d)
    for (int m = 1; m <= d; ++m) {
      const Simplex s = random_simplex(d, m, gen);
      std::vector<Simplex> facets, expected;
      auto visit = [&](const Simplex& facet) { expected.push_back(facet); };
      detail::visit_facets(s, visit);
      for_each_facet(s, [&](const Simplex& facet) { facets.push_back(facet); });
      EXPECT_EQ(facets, expected);
    }
}

TEST(ShortCofaces, AreThoseOfTheGeneralForm) {
  constexpr double kMost = 4000;
  std::mt19937 gen(3);
  for (int d = 0; d <= kMaxDim; ++d)
    for (int m = 0; m <= d; ++m)
      for (int repeat = 0; repeat < (d <= 10 ? 3 : 1); ++repeat) {
        const Simplex s = random_simplex(d, m, gen);
        for (int l = m; l <= d && num_cofaces(s, l) <= kMost; ++l) {
          const auto cofaces = sorted<detail::ShortCofaces>(s, l);
          ASSERT_EQ(double(cofaces.size()), num_cofaces(s, l));
          ASSERT_EQ(cofaces, sorted<detail::CofaceEnumeration>(s, l)) << d << ' ' << m << ' ' << l;
          ASSERT_TRUE(std::ranges::all_of(cofaces, is_canonical));
        }
      }
}

TEST(ShortCofaces, AreDualToFaces) {
  std::mt19937 gen(4);
  for (int d = 2; d <= kMaxDim; ++d)
    for (const int codim : {1, 2}) {
      const Simplex s = random_simplex(d, d - codim, gen);
      for_each_coface(s, d, [&](const Simplex& coface) {
        int found = 0;
        for_each_face(coface, d - codim, [&](const Simplex& face) { found += face == s; });
        ASSERT_EQ(found, 1);
      });
    }
}

TEST(ShortEnumeration, VisitorMayStopAnywhere) {
  std::mt19937 gen(5);
  const Simplex s = random_simplex(7, 4, gen);
  auto stops = [&]<class Enumeration>(int dim, std::size_t total) {
    for (std::size_t most = 1; most <= total; ++most) {
      std::size_t seen = 0;
      auto visit = [&](const Simplex&) { return ++seen < most; };
      EXPECT_FALSE(Enumeration(s, dim).run(visit));
      EXPECT_EQ(seen, most);
    }
  };
  for (int k = 0; k <= 4; ++k) stops.operator()<detail::ShortFaces>(k, sorted<detail::ShortFaces>(s, k).size());
  for (int l = 4; l <= 7; ++l) stops.operator()<detail::ShortCofaces>(l, sorted<detail::ShortCofaces>(s, l).size());
}

TEST(ShortEnumeration, WorksAtTheEndsOfTheRange) {
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  const auto parts = OrderedPartition::from_parts({{1}, {0, 2}});
  // Coordinate 1 goes up, coordinate 0 goes down in the cofacets.
  const Simplex top({kLeast + 1, kMost - 1}, parts);
  EXPECT_EQ(sorted<detail::ShortCofaces>(top, 2).size(), 2u);
  EXPECT_EQ(sorted<detail::ShortFaces>(top, 0).back().base(), (LatticeVertex{kLeast + 1, kMost}));
  const Simplex bottom({kLeast, 0}, parts);
  EXPECT_THROW(sorted<detail::ShortCofaces>(bottom, 2), LatticeOverflow);
  // What is not raised or lowered may have any value.
  EXPECT_EQ(sorted<detail::ShortCofaces>(Simplex({0, kLeast}, parts), 2).size(), 2u);
}

TEST(ShortEnumeration, CopiesOfWhatIsVisitedAreIndependent) {
  std::mt19937 gen(6);
  const Simplex s = random_simplex(15, 15, gen);
  std::vector<Simplex> kept;
  Simplex assigned = random_simplex(400, 3, gen);  // owns memory, and keeps it
  for_each_face(s, 13, [&](const Simplex& face) {
    kept.push_back(face);
    assigned = face;
    ASSERT_EQ(assigned, kept.back());
  });
  for (const Simplex& face : kept) EXPECT_EQ(Simplex::from_vertices(face.vertices()), face);
}

TEST(ShortEnumeration, TakesASimplexThatOwnsMemory) {
  std::mt19937 gen(7);
  const Simplex s = random_simplex(9, 6, gen);
  Simplex owner = random_simplex(400, 300, gen);
  owner = s;
  EXPECT_EQ(sorted<detail::ShortFaces>(owner, 3), sorted<detail::ShortFaces>(s, 3));
  EXPECT_EQ(sorted<detail::ShortCofaces>(owner, 8), sorted<detail::ShortCofaces>(s, 8));
}

// The ways to cut parts of up to 5 elements are listed, unless there are too many of them.
TEST(ShortCofaces, ListsTheWaysToCutSmallPartsOnly) {
  std::mt19937 gen(8);
  for (const auto& sizes : std::vector<std::vector<int>>{{5, 1},
                                                         {5, 3, 1},
                                                         {1, 5, 4},
                                                         {4, 4, 4},
                                                         {5, 5},
                                                         {2, 6, 1},
                                                         {6, 2},
                                                         {3, 3, 3, 3},
                                                         {2, 2, 2, 2, 2},
                                                         {3, 2, 6}}) {
    std::vector<int> order;
    for (const int size : sizes)
      for (int i = 0; i < size; ++i) order.push_back(static_cast<int>(order.size()));
    std::shuffle(order.begin(), order.end(), gen);
    std::vector<std::vector<int>> parts;
    auto next = order.begin();
    for (const int size : sizes) parts.emplace_back(next, next + size), next += size;
    const Simplex s(LatticeVertex(static_cast<int>(order.size()) - 1), OrderedPartition::from_parts(parts));
    for (int l = s.dim() + 1; l <= std::min(s.dim() + 4, s.ambient_dim()); ++l) {
      if (num_cofaces(s, l) > 40000) break;
      const auto cofaces = sorted<detail::ShortCofaces>(s, l);
      ASSERT_EQ(double(cofaces.size()), num_cofaces(s, l));
      ASSERT_EQ(cofaces, sorted<detail::CofaceEnumeration>(s, l)) << ::testing::PrintToString(sizes) << l;
    }
  }
}

}  // namespace
}  // namespace whitney::coxeter
