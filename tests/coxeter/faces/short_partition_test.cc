// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cofacets and steps over them in one register, beside the form for every dimension.
#include <coxeter/faces/short_partition.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tests/coxeter/brute_force.h>

#include <coxeter/faces/cofacet_step.h>

namespace whitney::coxeter {
namespace {

using PartNumbers = std::array<std::uint8_t, 16>;

PartNumbers part_numbers(const Simplex& simplex) {
  PartNumbers numbers{};
  const IndexArray indices = simplex.partition().part_indices();
  for (int c = 0; c < simplex.ambient_dim(); ++c)
    numbers[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(indices[static_cast<std::size_t>(c)]);
  return numbers;
}

struct Lists {
  Lists(const PartNumbers& parts, int d, int k) { list_parts(parts.data(), d, k, lists); }

  std::array<std::uint16_t, 17> elements{}, starts{};
  std::array<std::uint32_t, 17> numbers{};
  PartLists lists{elements.data(), starts.data(), numbers.data()};
};

/// The part and the set A of a cofacet, from its number in the long form.
std::pair<int, std::uint32_t> split_of(const PartLists& lists, std::uint32_t number) {
  int q = 0;
  while (number >= lists.numbers[q + 1]) ++q;
  return {q, number - lists.numbers[q] + 1};
}

/// The number that the short form gives to a cofacet.
int short_number(const PartLists& lists, int q, std::uint32_t split) {
  const int before = lists.starts[q] - q;
  return static_cast<int>((2u << before) - 2 + split - 1);
}

template <int kDim, int kCodim>
void compare(int d, int k, std::mt19937& gen, int num_simplices) {
  for (int i = 0; i < num_simplices; ++i) {
    const PartNumbers parts = part_numbers(testing::random_simplex(d, k, gen));
    const Lists sigma(parts, d, k);
    ShortPartition<kDim, kCodim> short_sigma(parts.data(), d, k);
    const std::uint64_t cofacets = short_sigma.cofacets();

    std::uint64_t expected_cofacets = 0;
    for (std::uint32_t number = 0; number < sigma.numbers[static_cast<std::size_t>(k) + 1]; ++number) {
      const auto [q, split] = split_of(sigma.lists, number);
      const int own = short_number(sigma.lists, q, split);
      ASSERT_LT(own, 64);
      ASSERT_FALSE(expected_cofacets >> own & 1) << "two cofacets have one number";
      expected_cofacets |= std::uint64_t{1} << own;

      const auto short_split = short_sigma.split(own);
      ASSERT_EQ(short_split.part, q);
      const bool new_base = q == k && (split >> (sigma.lists.size(q) - 1) & 1) != 0;
      ASSERT_EQ(short_split.new_base, new_base);
      for (int leaving = 0; leaving <= k; ++leaving) {
        PartNumbers expected_parts{};
        const CofacetStep expected =
            step_over_cofacet(parts.data(), sigma.lists, d, k, q, split, leaving, expected_parts.data());
        const auto step = short_sigma.step(short_split, leaving);
        PartNumbers own_parts;
        std::memcpy(own_parts.data(), &step.parts, sizeof own_parts);
        ASSERT_EQ(own_parts, expected_parts);
        ASSERT_EQ(step.inserted, expected.inserted);
        ASSERT_EQ(step.removed, expected.removed);
        const Lists result(expected_parts, d, k);
        const auto [result_part, result_split] = split_of(result.lists, expected.number);
        ASSERT_EQ(step.number, short_number(result.lists, result_part, result_split));
      }
    }
    ASSERT_EQ(cofacets, expected_cofacets);
  }
}

TEST(ShortPartition, AgreesWithTheLongForm) {
  std::mt19937 gen(1);
  for (int d = 1; d <= kMaxShortDim; ++d)
    for (int codim = 1; codim <= std::min(d, kMaxShortExcess); ++codim) compare<0, 0>(d, d - codim, gen, 60);
}

TEST(ShortPartition, AgreesWithTheLongFormAtDimensionsFixedAtCompileTime) {
  std::mt19937 gen(2);
  compare<4, 2>(4, 2, gen, 200);
  compare<10, 7>(10, 7, gen, 200);
  compare<15, 10>(15, 10, gen, 100);
}

}  // namespace
}  // namespace whitney::coxeter
