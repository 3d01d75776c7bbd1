// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/tables/vertex_table.h>

#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <coxeter/tables/simplex_table.h>

namespace whitney::coxeter {
namespace {

TEST(VertexTable, FormIsAdditiveAlsoAlongTheLastDirection) {
  const VertexTable table(5);
  std::vector<std::int32_t> z{3, -7, 0, 1 << 20, -1};
  std::uint64_t form = table.form_of(z.data());
  ++z[2];
  EXPECT_EQ(table.form_of(z.data()), form + table.weights()[2]);
  form = table.form_of(z.data());
  for (auto& c : z) --c;  // + e_5
  EXPECT_EQ(table.form_of(z.data()), form + table.weights()[5]);
}

TEST(VertexTable, EachVertexOnceThroughManyGrowths) {
  VertexTable table(3);
  std::mt19937 rng(1);
  std::set<std::vector<std::int32_t>> known;
  for (int i = 0; i < 50000; ++i) {
    std::vector<std::int32_t> z{int(rng() % 40) - 20, int(rng() % 40) - 20, int(rng() % 40) - 20};
    const std::size_t before = table.size();
    const std::uint32_t index = table.intern(z.data(), table.form_of(z.data()));
    EXPECT_EQ(table.size() > before, known.insert(z).second);
    EXPECT_TRUE(std::equal(z.begin(), z.end(), table.coordinates(index)));
    EXPECT_EQ(table.find(z.data(), table.form_of(z.data())), index);
  }
  EXPECT_EQ(table.size(), known.size());
  const std::int32_t absent[] = {100, 0, 0};
  EXPECT_EQ(table.find(absent, table.form_of(absent)), HashSlots::kNone);
}

TEST(VertexTable, CoordinatesThatRunOutAreAnError) {
  VertexTable table(2);
  const std::int32_t far[] = {0, std::numeric_limits<std::int32_t>::max() - 1};
  EXPECT_THROW(table.intern(far, table.form_of(far)), LatticeOverflow);
}

template <class Index>
class SimplexTables : public testing::Test {};
using Widths = testing::Types<std::uint8_t, std::uint16_t>;
TYPED_TEST_SUITE(SimplexTables, Widths);

TYPED_TEST(SimplexTables, WholeKeysAreComparedEvenWhenHashesCollide) {
  SimplexTable<TypeParam> table(7, 2);
  std::vector<std::uint64_t> key(table.key_words(), 0);
  for (int i = 0; i < 3000; ++i) {
    table.set_base(key.data(), i / 10);
    table.parts_of(key.data())[6] = static_cast<TypeParam>(i % 10);
    EXPECT_EQ(table.intern(key.data(), std::uint64_t(i % 3) << 40), std::uint32_t(i));
  }
  EXPECT_EQ(table.size(), 3000u);
  EXPECT_EQ(table.base(1234), 123u);
  EXPECT_EQ(table.parts(1234)[6], 4);
  EXPECT_FALSE(table.flag(1234, 100));
  table.set_flag(1234, 100);
  EXPECT_TRUE(table.flag(1234, 100));
  EXPECT_FALSE(table.flag(1235, 100));
}

}  // namespace
}  // namespace whitney::coxeter
