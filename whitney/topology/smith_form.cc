// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/smith_form.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>
#include <string>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

using Entry = SparseIntegerMatrix::Entry;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

bool is_unit(const Integer& a) { return a == 1 || a == -1; }

/// Column operations that clear, from every column, the rows of unit pivots. Afterwards row operations could clear the
/// rest of the pivot columns, so the form is ones for the pivots beside the form of the other columns.
class UnitElimination {
 public:
  UnitElimination(SparseIntegerMatrix& matrix, RunWatch* watch)
      : matrix_(matrix),
        watch_(watch),
        pivot_of_row_(matrix.num_rows, kNone),
        row_size_(matrix.num_rows, 0),
        sum_(matrix.num_rows),
        touched_(matrix.num_rows, 0) {}

  /// Returns the number of pivots; their columns are emptied.
  std::size_t run() {
    for (const auto& column : matrix_.columns) {
      for (const Entry& entry : column) ++row_size_[entry.row];
    }
    std::vector<std::uint32_t> rest(matrix_.columns.size());
    std::iota(rest.begin(), rest.end(), 0);
    std::stable_sort(rest.begin(), rest.end(), [&](std::uint32_t a, std::uint32_t b) {
      return matrix_.columns[a].size() < matrix_.columns[b].size();
    });
    for (bool found = true; found;) {
      found = false;
      std::vector<std::uint32_t> without_unit;
      for (std::uint32_t c : rest) {
        reduce(matrix_.columns[c]);
        if (!take_pivot(c)) {
          if (!matrix_.columns[c].empty()) without_unit.push_back(c);
        } else {
          found = true;
        }
      }
      rest = std::move(without_unit);
    }
    for (std::uint32_t c : pivot_columns_) matrix_.columns[c].clear();
    return pivot_columns_.size();
  }

 private:
  /// A pivot column has zeros in the rows of earlier pivots only, so pivots are cleared in the order of their making.
  void reduce(std::vector<Entry>& column) {
    std::vector<std::uint32_t> rows;
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> pivots;
    const auto touch = [&](std::uint32_t row) {
      if (touched_[row]) return;
      touched_[row] = 1;
      rows.push_back(row);
      if (pivot_of_row_[row] != kNone) pivots.push(pivot_of_row_[row]);
    };
    for (Entry& entry : column) {
      touch(entry.row);
      sum_[entry.row] = std::move(entry.value);
    }
    while (!pivots.empty()) {
      if (watch_ != nullptr) watch_->check();
      const std::uint32_t p = pivots.top();
      pivots.pop();
      const Integer factor = sum_[pivot_rows_[p]] * pivot_units_[p];
      if (factor == 0) continue;
      for (const Entry& entry : matrix_.columns[pivot_columns_[p]]) {
        touch(entry.row);
        sum_[entry.row] -= factor * entry.value;
      }
    }
    column.clear();
    for (std::uint32_t row : rows) {
      touched_[row] = 0;
      if (sum_[row] != 0) column.push_back({row, std::move(sum_[row])});
      sum_[row] = 0;
    }
  }

  /// The unit in the emptiest row makes the least fill.
  bool take_pivot(std::uint32_t c) {
    const Entry* best = nullptr;
    for (const Entry& entry : matrix_.columns[c]) {
      if (!is_unit(entry.value)) continue;
      if (best == nullptr || row_size_[entry.row] < row_size_[best->row]) best = &entry;
    }
    if (best == nullptr) return false;
    pivot_of_row_[best->row] = pivot_rows_.size();
    pivot_rows_.push_back(best->row);
    pivot_units_.push_back(best->value > 0 ? 1 : -1);
    pivot_columns_.push_back(c);
    return true;
  }

  SparseIntegerMatrix& matrix_;
  RunWatch* watch_;
  std::vector<std::uint32_t> pivot_of_row_;
  std::vector<std::uint32_t> row_size_;
  std::vector<std::uint32_t> pivot_rows_;
  std::vector<std::uint32_t> pivot_columns_;
  std::vector<int> pivot_units_;
  std::vector<Integer> sum_;
  std::vector<char> touched_;
};

/// The nonzero diagonal, not yet in divisibility order, of a dense matrix given by columns.
std::vector<Integer> diagonalise(std::vector<std::vector<Integer>> columns, RunWatch* watch) {
  std::vector<Integer> diagonal;
  while (true) {
    // The smallest entry as pivot keeps remainders small.
    std::size_t row = 0, col = columns.size();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      for (std::size_t r = 0; r < columns[c].size(); ++r) {
        if (columns[c][r] == 0) continue;
        if (col == columns.size() || abs(columns[c][r]) < abs(columns[col][row])) {
          col = c;
          row = r;
        }
      }
    }
    if (col == columns.size()) return diagonal;

    bool remainder = false;
    const Integer pivot = columns[col][row];
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (watch != nullptr) watch->check();
      if (c == col || columns[c][row] == 0) continue;
      const Integer factor = columns[c][row] / pivot;
      for (std::size_t r = 0; r < columns[c].size(); ++r) {
        if (columns[col][r] != 0) columns[c][r] -= factor * columns[col][r];
      }
      remainder = remainder || columns[c][row] != 0;
    }
    if (remainder) continue;
    // The pivot's row is clear but for the pivot, so row operations change its column only.
    for (std::size_t r = 0; r < columns[col].size(); ++r) {
      if (r == row) continue;
      columns[col][r] %= pivot;
      remainder = remainder || columns[col][r] != 0;
    }
    if (remainder) continue;
    diagonal.push_back(abs(pivot));
    std::swap(columns[col], columns.back());
    columns.pop_back();
    for (auto& column : columns) column.erase(column.begin() + row);
  }
}

}  // namespace

SmithForm smith_form(SparseIntegerMatrix matrix, RunWatch* watch) {
  for (const auto& column : matrix.columns) {
    for (const Entry& entry : column) {
      if (entry.row >= matrix.num_rows)
        throw InvalidInput("matrix: row " + std::to_string(entry.row) + " out of range");
    }
  }
  SmithForm form;
  form.rank = UnitElimination(matrix, watch).run();

  std::vector<std::uint32_t> dense_row(matrix.num_rows, kNone);
  std::uint32_t num_rows = 0;
  for (const auto& column : matrix.columns) {
    for (const Entry& entry : column) {
      if (dense_row[entry.row] == kNone) dense_row[entry.row] = num_rows++;
    }
  }
  std::vector<std::vector<Integer>> rest;
  for (const auto& column : matrix.columns) {
    if (column.empty()) continue;
    rest.emplace_back(num_rows);
    for (const Entry& entry : column) rest.back()[dense_row[entry.row]] = entry.value;
  }
  std::vector<Integer> diagonal = diagonalise(std::move(rest), watch);
  form.rank += diagonal.size();
  // diag(a, b) is equivalent to diag(gcd, lcm).
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    for (std::size_t k = i + 1; k < diagonal.size(); ++k) {
      const Integer divisor = gcd(diagonal[i], diagonal[k]);
      diagonal[k] = diagonal[i] / divisor * diagonal[k];
      diagonal[i] = divisor;
    }
    if (diagonal[i] > 1) form.factors.push_back(diagonal[i]);
  }
  return form;
}

}  // namespace whitney
