// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/exact_pivot.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <gmpxx.h>

namespace whitney {
namespace {

using Integer = mpz_class;

// The system B X = Y in integers: each row is multiplied by a power of two that makes it integral (rows of B and Y
// alike, so X does not change), then solved by Jordan's elimination with exact divisions (Bareiss).
class ExactSystem {
 public:
  enum class RightSide { kUnit, kUnitAndVertex, kInverse, kInverseAndVertex };

  ExactSystem(std::span<const double* const> columns, RightSide side, const double* w)
      : size_(static_cast<int>(columns.size())),
        num_units_(side == RightSide::kUnit || side == RightSide::kUnitAndVertex ? 1 : size_),
        width_(size_ + num_units_ + (w != nullptr)),
        entries_(size_ * width_) {
    for (int j = 0; j < size_; ++j) at(0, j) = 1;
    if (w != nullptr) at(0, width_ - 1) = 1;
    for (int r = 1; r < size_; ++r) {
      int lowest = std::numeric_limits<int>::max();
      for (int j = 0; j < size_; ++j) lowest = std::min(lowest, lowest_exponent(columns[j][r - 1]));
      if (w != nullptr) lowest = std::min(lowest, lowest_exponent(w[r - 1]));
      if (lowest == std::numeric_limits<int>::max()) lowest = 0;
      for (int j = 0; j < size_; ++j) at(r, j) = scaled(columns[j][r - 1], lowest);
      if (w != nullptr) at(r, width_ - 1) = scaled(w[r - 1], lowest);
    }
    // The unit columns keep their ones: that multiplies column l of the solution by a positive power of two, which the
    // lexicographic order does not see. Column 0 is not scaled.
    for (int l = 0; l < num_units_; ++l) at(l, size_ + l) = 1;
    solve();
  }

  bool singular() const { return singular_; }
  /// M_rl times determinant().
  const Integer& inverse(int r, int l) const { return entries_[r * width_ + size_ + l]; }
  /// y_r times determinant().
  const Integer& vertex(int r) const { return entries_[r * width_ + width_ - 1]; }
  const Integer& determinant() const { return determinant_; }

  /// The exponent of the last bit set of x; the largest int for 0.
  static int lowest_exponent(double x) {
    if (x == 0) return std::numeric_limits<int>::max();
    int exponent;
    auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    return exponent - 53 + __builtin_ctzll(static_cast<std::uint64_t>(mantissa));
  }
  /// x / 2^lowest, an integer for lowest <= lowest_exponent(x).
  static Integer scaled(double x, int lowest) {
    if (x == 0) return 0;
    int exponent;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    const int shift = exponent - 53 - lowest;
    if (shift < 0) return Integer(static_cast<long>(mantissa >> -shift));  // exact: those bits are zero
    return Integer(static_cast<long>(mantissa)) << shift;
  }

 private:
  Integer& at(int r, int c) { return entries_[r * width_ + c]; }

  void solve() {
    Integer previous = 1;
    for (int c = 0; c < size_; ++c) {
      int pivot = c;
      while (pivot < size_ && at(pivot, c) == 0) ++pivot;
      if (pivot == size_) {
        singular_ = true;
        return;
      }
      if (pivot != c)
        for (int j = 0; j < width_; ++j) std::swap(at(pivot, j), at(c, j));
      for (int r = 0; r < size_; ++r) {
        if (r == c) continue;
        const Integer factor = at(r, c);
        // Columns before c are those of a multiple of the identity: only the diagonal needs its new value.
        if (r < c) at(r, r) = at(c, c);
        for (int j = c + 1; j < width_; ++j) {
          Integer value = at(c, c) * at(r, j);
          if (factor != 0 && at(c, j) != 0) value -= factor * at(c, j);
          if (value != 0) mpz_divexact(value.get_mpz_t(), value.get_mpz_t(), previous.get_mpz_t());
          at(r, j) = std::move(value);
        }
        at(r, c) = 0;
      }
      previous = at(c, c);
    }
    determinant_ = previous;
  }

  int size_, num_units_, width_;
  std::vector<Integer> entries_;
  Integer determinant_ = 0;
  bool singular_ = false;
};

int sign(const Integer& x) { return sgn(x); }

// Which of the candidates minimises (M_r0, .., M_rk) / y_r over y_r > 0, using the columns of M the system holds.
// -1: those columns leave a tie.
int smallest_ratio(const ExactSystem& system, int size, int columns) {
  const int orientation = sign(system.determinant());
  int best = -1;
  bool tie = false;
  for (int r = 0; r < size; ++r) {
    if (sign(system.vertex(r)) != orientation) continue;
    if (best < 0) {
      best = r;
      continue;
    }
    int order = 0;
    for (int l = 0; l < columns && order == 0; ++l) {
      const Integer left = system.inverse(r, l) * system.vertex(best);
      const Integer right = system.inverse(best, l) * system.vertex(r);
      order = cmp(left, right);
    }
    if (order < 0) {
      best = r;
      tie = false;
    } else if (order == 0) {
      tie = true;
    }
  }
  return tie ? -1 : best;
}

}  // namespace

bool exactly_hit(std::span<const double* const> columns) {
  const int size = static_cast<int>(columns.size());
  const ExactSystem system(columns, ExactSystem::RightSide::kInverse, nullptr);
  if (system.singular()) return false;
  const int orientation = sign(system.determinant());
  for (int r = 0; r < size; ++r) {
    int l = 0;
    while (system.inverse(r, l) == 0) ++l;  // a row of an inverse is not zero
    if (sign(system.inverse(r, l)) != orientation) return false;
  }
  return true;
}

int exactly_leaving(std::span<const double* const> columns, const double* w) {
  const int size = static_cast<int>(columns.size());
  const ExactSystem first(columns, ExactSystem::RightSide::kUnitAndVertex, w);
  const int leaving = smallest_ratio(first, size, 1);
  if (leaving >= 0) return leaving;
  const ExactSystem full(columns, ExactSystem::RightSide::kInverseAndVertex, w);
  return smallest_ratio(full, size, size);
}

bool exactly_below(std::span<const double* const> columns, std::span<const double> component, int position) {
  const int size = static_cast<int>(columns.size());
  const ExactSystem system(columns, ExactSystem::RightSide::kInverse, nullptr);
  int lowest = std::numeric_limits<int>::max();
  for (double value : component) lowest = std::min(lowest, ExactSystem::lowest_exponent(value));
  // The interpolant at the point minus the target, a polynomial in eps: sum_l eps^(p_l) sum_r g(v_r) M_rl - eps^(p).
  for (int l = 0; l <= position; ++l) {
    Integer coefficient = 0;
    for (int r = 0; r < size; ++r) coefficient += ExactSystem::scaled(component[r], lowest) * system.inverse(r, l);
    if (coefficient != 0) return sign(coefficient) != sign(system.determinant());
  }
  return true;
}

std::vector<double> exact_weights(std::span<const double* const> columns) {
  const int size = static_cast<int>(columns.size());
  const ExactSystem system(columns, ExactSystem::RightSide::kUnit, nullptr);
  std::vector<double> weights(size);
  for (int r = 0; r < size; ++r) {
    // A quotient with 64 bits after the binary point.
    const Integer quotient = (system.inverse(r, 0) * (Integer(1) << 64)) / system.determinant();
    weights[r] = std::ldexp(quotient.get_d(), -64);
  }
  return weights;
}

}  // namespace whitney
