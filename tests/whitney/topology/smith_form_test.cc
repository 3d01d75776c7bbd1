// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/smith_form.h>

#include <functional>
#include <random>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

using Dense = std::vector<std::vector<int>>;

SparseIntegerMatrix sparse(const Dense& rows) {
  SparseIntegerMatrix matrix;
  matrix.num_rows = rows.size();
  matrix.columns.resize(rows.empty() ? 0 : rows[0].size());
  for (std::uint32_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      if (rows[r][c] != 0) matrix.columns[c].push_back({r, rows[r][c]});
    }
  }
  return matrix;
}

/// All subsets of {0 .. count-1} of the given size.
void subsets(int count, int size, const std::function<void(const std::vector<int>&)>& action) {
  std::vector<int> chosen;
  const auto extend = [&](auto& self, int from) -> void {
    if (int(chosen.size()) == size) return action(chosen);
    for (int i = from; i < count; ++i) {
      chosen.push_back(i);
      self(self, i + 1);
      chosen.pop_back();
    }
  };
  extend(extend, 0);
}

Integer determinant(const Dense& rows, const std::vector<int>& r, std::vector<int> c) {
  if (r.empty()) return 1;
  Integer sum = 0;
  for (std::size_t k = 0; k < c.size(); ++k) {
    std::vector<int> rest = c;
    rest.erase(rest.begin() + k);
    const Integer minor = rows[r[0]][c[k]] == 0 ? Integer(0) : determinant(rows, {r.begin() + 1, r.end()}, rest);
    sum += (k % 2 ? -1 : 1) * rows[r[0]][c[k]] * minor;
  }
  return sum;
}

/// The definition: the product of the first i factors is the greatest common divisor of the i x i minors.
SmithForm by_minors(const Dense& rows) {
  SmithForm form;
  Integer before = 1;
  const int num_rows = rows.size(), num_columns = rows[0].size();
  for (int i = 1; i <= std::min(num_rows, num_columns); ++i) {
    Integer divisor = 0;
    subsets(num_rows, i, [&](const std::vector<int>& r) {
      subsets(num_columns, i, [&](const std::vector<int>& c) { divisor = gcd(divisor, determinant(rows, r, c)); });
    });
    if (divisor == 0) break;
    ++form.rank;
    if (divisor != before) form.factors.push_back(divisor / before);
    before = divisor;
  }
  return form;
}

TEST(SmithForm, AgreesWithTheGreatestCommonDivisorsOfMinors) {
  std::mt19937 random(3);
  int with_torsion = 0;
  for (int trial = 0; trial < 600; ++trial) {
    Dense rows(1 + random() % 5, std::vector<int>(1 + random() % 5));
    const int scale = trial % 3 == 0 ? 1 : trial % 3 == 1 ? 6 : 30;
    const std::array<int, 6> multiples{1, 2, 3, 4, 6, 10};
    for (auto& row : rows) {
      const int multiple = multiples[random() % 6];
      for (int& x : row) x = random() % 3 == 0 ? 0 : multiple * (int(random() % (2 * scale + 1)) - scale);
    }
    const SmithForm expected = by_minors(rows);
    const SmithForm found = smith_form(sparse(rows));
    EXPECT_EQ(found.rank, expected.rank) << trial;
    EXPECT_EQ(found.factors, expected.factors) << trial;
    with_torsion += !expected.factors.empty();
  }
  EXPECT_GT(with_torsion, 100);
}

TEST(SmithForm, LargerThanAMachineWord) {
  SparseIntegerMatrix matrix;
  matrix.num_rows = 100;
  matrix.columns.resize(100);
  // x_i = 3 x_(i+1): the last generator has order 3^100, though every entry is small.
  for (std::uint32_t i = 0; i < 100; ++i) {
    matrix.columns[i].push_back({i, 1});
    matrix.columns[i].push_back({(i + 1) % 100, i + 1 < 100 ? -3 : 0});
  }
  matrix.columns[99] = {{0, 3}};
  const SmithForm form = smith_form(matrix);
  EXPECT_EQ(form.rank, 100u);
  ASSERT_EQ(form.factors.size(), 1u);
  EXPECT_EQ(form.factors[0], pow(Integer(3), 100));
}

TEST(SmithForm, OfNothing) {
  EXPECT_EQ(smith_form({}).rank, 0u);
  EXPECT_EQ(smith_form(sparse({{0, 0}, {0, 0}})).rank, 0u);
}

TEST(SmithForm, RejectsRowsOutOfRange) {
  SparseIntegerMatrix matrix;
  matrix.num_rows = 2;
  matrix.columns = {{{2, 1}}};
  EXPECT_THROW(smith_form(matrix), InvalidInput);
}

}  // namespace
}  // namespace whitney
