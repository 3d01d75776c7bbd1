// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/tables/lattice_order.h>

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace {

TEST(LatticeOrder, AgreesWithAComparisonSort) {
  std::mt19937 rng(3);
  for (int spread : {3, 1000, 1 << 18, 2000000000}) {
    std::vector<std::vector<std::int32_t>> rows;
    std::vector<std::int32_t> flat;
    for (int i = 0; i < 500; ++i) {
      const auto draw = [&] { return static_cast<std::int32_t>(std::int64_t(rng() % (2u * spread)) - spread); };
      const std::int32_t first = draw(), second = static_cast<std::int32_t>(rng() % 3);
      rows.push_back({first, second, draw()});
      flat.insert(flat.end(), rows.back().begin(), rows.back().end());
    }
    const auto order = whitney::coxeter::lexicographic_order(flat, 3);
    whitney::coxeter::permute_rows(flat.data(), 3, order);
    std::sort(rows.begin(), rows.end());
    for (int i = 0; i < 500; ++i) EXPECT_EQ(std::vector(flat.begin() + 3 * i, flat.begin() + 3 * i + 3), rows[i]);
  }
  EXPECT_TRUE(whitney::coxeter::lexicographic_order({}, 4).empty());
}

}  // namespace
