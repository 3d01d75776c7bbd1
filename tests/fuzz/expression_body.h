// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include <coxeter/base/error.h>
#include <whitney/functions/expression.h>
#include "bytes.h"

namespace whitney::fuzz {

/// A number and a bound of what rounding may have added to it, in either evaluation of the same expression.
struct Rounded {
  double value = 0, error = 0;
};

/// A random expression as text, and its value at one point, computed while it is written: the second route.
class RandomExpression {
 public:
  RandomExpression(Choices& choices, std::vector<double> point) : choices_(choices), point_(std::move(point)) {}

  Rounded write(std::string& text, int depth = 0) {
    const int kind = depth > 5 || choices_.empty() ? choices_.below(2) : choices_.below(9);
    Rounded a, b;
    switch (kind) {
      case 0: {
        const int i = choices_.below(static_cast<int>(point_.size()));
        text += "x" + std::to_string(i);
        return {point_[static_cast<std::size_t>(i)], 0};
      }
      case 1: {
        const int number = choices_.below(16);
        text += std::to_string(number) + (number % 3 == 0 ? "" : ".25");
        return {number + (number % 3 == 0 ? 0 : 0.25), 0};
      }
      case 2:
      case 3: {
        const char* sign = kind == 2 ? "+" : "-";
        open(text, a, sign, b, depth);
        return rounded(kind == 2 ? a.value + b.value : a.value - b.value,
                       a.error + b.error + kUnit * (std::abs(a.value) + std::abs(b.value)));
      }
      case 4:
        open(text, a, "*", b, depth);
        return rounded(a.value * b.value,
                       std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error);
      case 5:
        open(text, a, "/", b, depth);
        return rounded(a.value / b.value,
                       (a.error + std::abs(a.value / b.value) * b.error) / (std::abs(b.value) - b.error));
      case 6: {
        a = call(text, "sin", depth);
        return rounded(std::sin(a.value), a.error + kUnit);
      }
      case 7: {
        a = call(text, "exp", depth);
        return rounded(std::exp(a.value), std::exp(a.value) * std::expm1(a.error));
      }
      default: {
        text += "(";
        a = write(text, depth + 1);
        const int n = 2 + choices_.below(3);
        text += ")^" + std::to_string(n);
        return rounded(std::pow(a.value, n), n * std::pow(std::abs(a.value) + a.error, n - 1) * a.error);
      }
    }
  }

 private:
  static constexpr double kUnit = std::numeric_limits<double>::epsilon();
  static Rounded rounded(double value, double error) {
    // A bound that came out negative or as NaN (a division by almost nothing) says nothing.
    if (!(error >= 0)) error = std::numeric_limits<double>::infinity();
    return {value, error + 4 * kUnit * std::abs(value)};
  }
  void open(std::string& text, Rounded& a, const char* sign, Rounded& b, int depth) {
    text += "(";
    a = write(text, depth + 1);
    text += sign;
    b = write(text, depth + 1);
    text += ")";
  }
  Rounded call(std::string& text, const char* name, int depth) {
    text += std::string(name) + "(";
    const Rounded a = write(text, depth + 1);
    text += ")";
    return a;
  }

  Choices& choices_;
  std::vector<double> point_;
};

/// An expression made of the bytes: the tape's value against the one computed beside it, the same bits in every batch.
inline void expression_body(Bytes bytes) {
  Choices choices(bytes);
  const int d = 1 + choices.below(3);
  std::vector<std::string> variables;
  std::vector<double> point;
  for (int i = 0; i < d; ++i) {
    variables.push_back("x" + std::to_string(i));
    point.push_back((choices.below(64) - 31.5) / 8);
  }
  std::string text;
  const Rounded expected = RandomExpression(choices, point).write(text);
  CompiledMap map;
  try {
    map = compile(variables, std::vector{text});
  } catch (const InvalidInput&) {
    return;  // a constant that is not finite
  }
  std::vector<double> one(1), workspace;
  map.values.run<double>(point, one, workspace);
  // Simplification may cancel what was not finite, and regroup a sum: hence a factor, and finite bounds only.
  if (std::isfinite(expected.value) && expected.error < 1e-3 * (1 + std::abs(expected.value)))
    demand(std::abs(one[0] - expected.value) <= 1e3 * expected.error + 1e-300,
           text + " is " + std::to_string(one[0]) + ", not " + std::to_string(expected.value));
  std::vector<double> points, values(19), alone(1);
  for (int i = 0; i < 19; ++i)
    for (const double x : point) points.push_back(x + i);
  map.values.run_batch(points, values);
  for (std::size_t i = 0; i < 19; ++i) {
    map.values.run_batch(std::span(points).subspan(i * static_cast<std::size_t>(d), static_cast<std::size_t>(d)),
                         alone);
    demand(std::bit_cast<std::uint64_t>(alone[0]) == std::bit_cast<std::uint64_t>(values[i]) ||
               (std::isnan(alone[0]) && std::isnan(values[i])),
           text + ": a value depends on its batch");
  }
}

}  // namespace whitney::fuzz
