// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tape of parsed equations beside the same function written by hand: nanoseconds per evaluation, one point a call
// and in batches, interleaved, medians; the values are compared. Required: at most 3 times the hand-written function.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <coxeter/placement.h>
#include <whitney/functions/expression.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/io/read_problem.h>

namespace {

constexpr double kLargestRatio = 3;
constexpr std::size_t kNumPoints = 4096;
constexpr int kRounds = 41;

struct Case {
  std::string name;
  whitney::Function parsed;
  /// Points m x d -> values m x k in one call, and a call that does one point: the compiler sees both whole.
  std::function<void(const double*, double*, std::size_t)> by_hand;
  void (*one_by_hand)(const double*, double*);
};

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// The inlined loop over a function for one point.
template <int d, int k, void (*f)(const double*, double*)>
void batch(const double* x, double* values, std::size_t m) {
  for (std::size_t i = 0; i < m; ++i) f(x + i * d, values + i * k);
}

void chair(const double* p, double* v) {
  const double x = p[0], y = p[1], z = p[2];
  const double q = x * x + y * y + z * z - 0.8;
  v[0] = q * q - 0.4 * ((z - 1) * (z - 1) - 2 * x * x) * ((z + 1) * (z + 1) - 2 * y * y);
}

double square(double a) { return a * a; }

void pentagon(const double* p, double* v) {
  v[0] = square(p[0] - 1) + square(p[1]) - 1;
  v[1] = square(p[2] - p[0]) + square(p[3] - p[1]) - 1;
  v[2] = square(p[4] - p[2]) + square(p[5] - p[3]) - 1;
  v[3] = square(p[4]) + square(p[5]) - 1;
}

void transcendental(const double* p, double* v) {
  const double x = p[0], y = p[1], z = p[2];
  v[0] = std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
  v[1] = std::exp(-x * x - y * y) - z * std::sqrt(1 + x * x);
}

constexpr int kTorusDim = 10;
double rotation[kTorusDim][kTorusDim];

void rotated_torus(const double* x, double* v) {
  double y[kTorusDim] = {};
  for (int i = 0; i < kTorusDim; ++i) {
    for (int j = 0; j < kTorusDim; ++j) y[j] += x[i] * rotation[i][j];
  }
  v[0] = y[0] * y[0] + y[1] * y[1] - 1;
  v[1] = y[2] * y[2] + y[3] * y[3] - 1;
  for (int j = 4; j < kTorusDim; ++j) v[j - 2] = y[j];
}

whitney::Function parsed_rotated_torus() {
  const whitney::Matrix Q = whitney::coxeter::random_rotation(kTorusDim, 7);
  std::vector<std::string> variables, y;
  for (int i = 0; i < kTorusDim; ++i) variables.emplace_back("x").append(std::to_string(i + 1));
  for (int j = 0; j < kTorusDim; ++j) {
    std::string text = "(0";
    for (int i = 0; i < kTorusDim; ++i) {
      rotation[i][j] = Q(i, j);
      char number[40];
      std::snprintf(number, sizeof number, "%+.17g*", Q(i, j));
      text += number + variables[i];
    }
    y.push_back(text + ")");
  }
  std::vector<std::string> equations{y[0] + "^2+" + y[1] + "^2-1", y[2] + "^2+" + y[3] + "^2-1"};
  for (int j = 4; j < kTorusDim; ++j) equations.push_back(y[j]);
  return whitney::parse_equations(variables, equations);
}

/// Returns whether the ratio for batches is within the requirement.
bool run(const Case& c) {
  const std::size_t d = c.parsed.ambient_dim(), k = c.parsed.codim();
  std::mt19937_64 generator(1);
  std::vector<double> points(kNumPoints * d), parsed(kNumPoints * k), expected(kNumPoints * k);
  for (double& x : points) x = static_cast<double>(generator() >> 11) * 0x1p-52 - 1;

  const auto check = [&](const char* mode) {
    for (std::size_t i = 0; i < parsed.size(); ++i) {
      if (std::abs(parsed[i] - expected[i]) <= 1e-13 * (1 + std::abs(expected[i]))) continue;
      std::printf("%s, %s: value %zu is %.17g, by hand %.17g\n", c.name.c_str(), mode, i, parsed[i], expected[i]);
      std::exit(1);
    }
    std::fill(parsed.begin(), parsed.end(), NAN);
    std::fill(expected.begin(), expected.end(), NAN);
  };
  const auto measure = [&](const char* mode, const std::function<void()>& tape, const std::function<void()>& by_hand) {
    std::vector<double> tape_times, hand_times;
    for (int round = 0; round < kRounds; ++round) {
      tape_times.push_back(seconds(tape));
      hand_times.push_back(seconds(by_hand));
    }
    check(mode);
    const double tape_ns = median(tape_times) / kNumPoints * 1e9, hand_ns = median(hand_times) / kNumPoints * 1e9;
    std::printf("%-24s %-8s %9.2f %9.2f %7.2f\n", c.name.c_str(), mode, tape_ns, hand_ns, tape_ns / hand_ns);
    return tape_ns <= kLargestRatio * hand_ns;
  };
  const bool batch_ok = measure(
      "batch", [&] { c.parsed.evaluate(points, parsed); },
      [&] { c.by_hand(points.data(), expected.data(), kNumPoints); });
  measure(
      "one",
      [&] {
        for (std::size_t i = 0; i < kNumPoints; ++i) {
          c.parsed.evaluate({points.data() + i * d, d}, {parsed.data() + i * k, k});
        }
      },
      [&] {
        for (std::size_t i = 0; i < kNumPoints; ++i) c.one_by_hand(points.data() + i * d, expected.data() + i * k);
      });
  return batch_ok;
}

}  // namespace

int main() {
  using Strings = std::vector<std::string>;
  const std::vector<Case> cases{
      {"chair, d=3", whitney::chair(3).function, batch<3, 1, chair>, chair},
      {"pentagon linkage, d=6", whitney::pentagon_linkage().function, batch<6, 4, pentagon>, pentagon},
      {"rotated torus, d=10", parsed_rotated_torus(), batch<kTorusDim, kTorusDim - 2, rotated_torus>, rotated_torus},
      {"transcendental, d=3",
       whitney::parse_equations(Strings{"x", "y", "z"},
                                Strings{"sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)", "exp(-x^2-y^2)-z*sqrt(1+x^2)"}),
       batch<3, 2, transcendental>, transcendental},
  };
  std::printf("ns per evaluation                  tape   by hand   ratio\n");
  bool ok = true;
  for (const Case& c : cases) ok = run(c) && ok;
  std::printf(ok ? "batches: all within a factor %g\n" : "batches: NOT all within a factor %g\n", kLargestRatio);
  return ok ? 0 : 1;
}
