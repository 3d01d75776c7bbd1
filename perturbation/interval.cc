// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/interval.h>

#include <limits>
#include <vector>

#include <coxeter/base/error.h>

namespace whitney::perturbation {
std::string rounding_defect() {
  // Each sample has an exact result strictly between two neighbouring doubles, which the interval must be. volatile:
  // the compiler must not know them.
  constexpr double eps = std::numeric_limits<double>::epsilon();
  volatile double one = 1, three = 3, two = 2, tiny = eps / 1024, next = 1 + eps;
  const auto neighbours = [](const Interval& x, double low, double high) { return x.inf() == low && x.sup() == high; };
  if (!neighbours(Interval(one) + Interval(tiny), 1, 1 + eps)) return "sums are not rounded outward";
  if (!neighbours(Interval(one) - Interval(tiny), 1 - eps / 2, 1)) return "differences are not rounded outward";
  if (!neighbours(Interval(next) * Interval(next), 1 + 2 * eps, 1 + 3 * eps)) return "products are not rounded outward";
  if (!neighbours(Interval(-next) * Interval(next), -1 - 3 * eps, -1 - 2 * eps))
    return "negative products are not rounded outward";
  const auto encloses = [](double low, double high, auto excess) {
    return low < high && high <= low * (1 + 2 * eps) && excess(low) < 0 && excess(high) > 0;
  };
  const Interval third = Interval(one) / Interval(three), root = sqrt(Interval(two));
  if (!encloses(third.inf(), third.sup(), [&](double x) { return std::fma(x, double{three}, -1.0); }))
    return "quotients are not rounded outward";
  if (!encloses(root.inf(), root.sup(), [](double x) { return std::fma(x, x, -2.0); }))
    return "square roots are not rounded outward";
  return {};
}

void require_directed_rounding() {
  // An exception leaves the variable uninitialised: the next call looks again, and throws again.
  [[maybe_unused]] static const bool checked = [] {
    const Interval::Protector upward;
    const std::string defect = rounding_defect();
    if (!defect.empty())
      throw Error("interval arithmetic does not work here, so nothing can be proved: " + defect +
                  " (directed rounding of doubles is needed; emulators and some compiler options break it)");
    return true;
  }();
}

namespace {

Interval squared_distance(std::span<const double> x, std::span<const double> y) {
  Interval sum(0);
  for (std::size_t c = 0; c < x.size(); ++c) sum += CGAL::square(Interval(x[c]) - Interval(y[c]));
  return sum;
}

}  // namespace

double distance_above(std::span<const double> x, std::span<const double> y) {
  return sqrt(squared_distance(x, y)).sup();
}

double distance_below(std::span<const double> x, std::span<const double> y) {
  return std::max(0.0, sqrt(squared_distance(x, y)).inf());
}

double norm_above(std::span<const Interval> A, int rows, int cols) {
  const int m = std::min(rows, cols);
  std::vector<Interval> gram(static_cast<std::size_t>(m) * m);
  for (int a = 0; a < m; ++a)
    for (int b = 0; b < m; ++b) {
      Interval sum(0);
      if (rows <= cols)
        for (int c = 0; c < cols; ++c) sum += A[a * cols + c] * A[b * cols + c];
      else
        for (int r = 0; r < rows; ++r) sum += A[r * cols + a] * A[r * cols + b];
      gram[a * m + b] = sum;
    }
  for (const Interval& entry : gram)
    if (!(above(entry) < 1e150)) return std::numeric_limits<double>::infinity();
  if (m == 1) return above(sqrt(Interval(above(gram[0]))));
  if (m == 2) {
    const Interval half = (gram[0] - gram[3]) / Interval(2);
    const Interval root = sqrt(Interval(above(half * half)) + Interval(above(gram[1] * gram[1])));
    return above(sqrt(Interval(above((gram[0] + gram[3]) / Interval(2) + root))));
  }
  // norm(A)^2 = norm(gram) <= norm(gram^16)_F^(1/16); gram is scaled to keep the powers in range.
  double scale = 0;
  for (const Interval& entry : gram) scale = std::max(scale, above(entry));
  if (!(scale > 0)) return 0;
  const Interval inverse = Interval(1) / Interval(scale);
  for (Interval& entry : gram) entry *= inverse;
  std::vector<Interval> square(gram.size());
  constexpr int kSquarings = 4;
  for (int s = 0; s < kSquarings; ++s) {
    for (int a = 0; a < m; ++a)
      for (int b = 0; b < m; ++b) {
        Interval sum(0);
        for (int c = 0; c < m; ++c) sum += gram[a * m + c] * gram[c * m + b];
        square[a * m + b] = sum;
      }
    gram.swap(square);
  }
  Interval sum(0);
  for (const Interval& entry : gram) sum += Interval(above(entry)) * Interval(above(entry));
  Interval root = sqrt(sum);
  for (int s = 0; s < kSquarings; ++s) root = sqrt(root);
  return above(sqrt(Interval(above(root * Interval(scale)))));
}

}  // namespace whitney::perturbation
