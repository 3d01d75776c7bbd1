// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/enclosure.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/functions/expression.h>

namespace whitney {
namespace {

Enclosure::Jets jets_over(const Enclosure& f, const std::vector<Range>& box, int order = 2) {
  Enclosure::Workspace workspace;
  Enclosure::Jets jets;
  f.evaluate(box, order, jets, workspace);
  return jets;
}

std::string any_expression(std::mt19937_64& rng, int depth) {
  const auto sub = [&] { return any_expression(rng, depth - 1); };
  if (depth == 0) {
    const char* leaves[] = {"x", "y", "z", "x", "y", "0.7", "2", "pi", "1e-3", "(1/3)"};
    return leaves[rng() % 10];
  }
  switch (rng() % 9) {
    case 0:
      return "(" + sub() + "+" + sub() + ")";
    case 1:
      return "(" + sub() + "-" + sub() + ")";
    case 2:
    case 3:
      return sub() + "*" + sub();
    case 4:
      return sub() + "/(1.5+" + sub() + ")";
    case 5:
      return "(" + sub() + ")^" + std::to_string(int(rng() % 6));
    case 6:
      return "(" + sub() + ")^(" + (rng() % 2 ? "1/2" : "-0.3") + ")";
    default: {
      const char* names[] = {"sqrt", "sin",  "cos",  "tan", "asin", "acos", "atan",
                             "sinh", "cosh", "tanh", "exp", "log",  "abs"};
      return std::string(names[rng() % 13]) + "(" + sub() + ")";
    }
  }
}

/// f and its derivatives at a point in extended precision, by running the tapes of GiNaC's derivatives.
TEST(Enclosure, HoldsRandomExpressionsAndTheirDerivatives) {
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const std::vector<std::string> variables{"x", "y", "z"};
  int num_bounded = 0, num_tested = 0;
  for (int i = 0; i < 400; ++i) {
    const std::string text = any_expression(rng, 3);
    CompiledMap map;
    try {
      map = compile(variables, std::vector<std::string>{text});
    } catch (const InvalidInput&) {
      continue;  // a constant part without value
    }
    const Enclosure of_text = Enclosure::of_expressions(variables, std::vector<std::string>{text});
    const Enclosure of_tape = Enclosure::of_tape(map.values);
    const Enclosure of_jacobian = Enclosure::of_tape(map.jacobian);
    for (int b = 0; b < 5; ++b) {
      const double width = std::pow(10.0, -int(rng() % 6));
      std::vector<Range> box, point;
      for (int c = 0; c < 3; ++c) {
        const double m = 1.5 * uniform(rng), lo = m - width, hi = m + width;
        box.emplace_back(lo, hi);
        const double t = std::abs(uniform(rng));
        point.emplace_back(std::clamp(lo + t * (hi - lo), lo, hi));
      }
      const auto text_jets = jets_over(of_text, box), tape_jets = jets_over(of_tape, box);
      // Enclosures at a point, and GiNaC's derivatives there, are independent routes to what the box must hold: they
      // must meet the enclosure over the box.
      const auto at_point = jets_over(of_tape, point), gradient_at_point = jets_over(of_jacobian, point);
      const auto meets = [&](const Range& over_box, const Range& at, const char* what) {
        ++num_tested;
        num_bounded += over_box.is_bounded() && at.is_bounded();
        EXPECT_TRUE(over_box.lo <= at.hi && at.lo <= over_box.hi)
            << text << " " << what << ": [" << over_box.lo << "," << over_box.hi << "] and [" << at.lo << "," << at.hi
            << "]";
      };
      for (const auto* jets : {&text_jets, &tape_jets}) {
        meets(jets->values[0], at_point.values[0], "value");
        for (int c = 0; c < 3; ++c) {
          meets(jets->gradients[c], at_point.gradients[c], "gradient");
          meets(jets->gradients[c], gradient_at_point.values[c], "gradient by GiNaC");
        }
        for (int c = 0, p = 0; c < 3; ++c) {
          for (int e = c; e < 3; ++e, ++p) {
            meets(jets->hessians[p], at_point.hessians[p], "Hessian");
            meets(jets->hessians[p], gradient_at_point.gradients[3 * c + e], "Hessian by GiNaC");
            meets(jets->hessians[p], gradient_at_point.gradients[3 * e + c], "Hessian by GiNaC, transposed");
          }
        }
      }
    }
  }
  EXPECT_GT(num_bounded, num_tested / 4);
}

TEST(Enclosure, HoldsSampledValues) {
  std::mt19937_64 rng(8);
  const std::vector<std::string> variables{"x", "y"};
  const std::vector<std::string> texts{"x^2*y-3*x/y+sin(x*y)", "exp(x)-log(y)+tanh(x-y)*sqrt(y)"};
  const Enclosure f = Enclosure::of_expressions(variables, texts);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const double x = 4 * uniform(rng) - 2, y = 0.1 + uniform(rng), w = 0.09 * uniform(rng);
    const auto jets = jets_over(f, {Range(x - w, x + w), Range(y - w, y + w)});
    const long double s = x + w * (2 * uniform(rng) - 1), t = y + w * (2 * uniform(rng) - 1);
    const long double values[] = {s * s * t - 3 * s / t + std::sin(s * t),
                                  std::exp(s) - std::log(t) + std::tanh(s - t) * std::sqrt(t)};
    const long double c = std::cosh(s - t), slope = 1 / (c * c), bent = -2 * std::tanh(s - t) * slope;
    const long double xx = -t * t * std::sin(s * t) + 2 * t;
    const long double xy = bent * -std::sqrt(t) + slope / (2 * std::sqrt(t));
    EXPECT_TRUE(jets.values[0].lo <= values[0] && values[0] <= jets.values[0].hi);
    EXPECT_TRUE(jets.values[1].lo <= values[1] && values[1] <= jets.values[1].hi);
    EXPECT_TRUE(jets.hessians[0].lo <= xx && xx <= jets.hessians[0].hi);
    EXPECT_TRUE(jets.hessians[4].lo <= xy && xy <= jets.hessians[4].hi);
  }
}

TEST(Enclosure, ConstantsAreEnclosedNotRounded) {
  const std::vector<std::string> variables{"x"};
  const std::vector<std::string> texts{"exp(1)*exp(39)-exp(40)+0*x",
                                       "0.1+0*x",
                                       "0.5+0*x",
                                       "1/3+0*x",
                                       "pi+0*x",
                                       "9007199254740993+0*x",
                                       "9007199254740993-9007199254740992+0*x",
                                       "321*28059810762433-9007199254740992+0*x"};
  const Enclosure f = Enclosure::of_expressions(variables, texts);
  EXPECT_TRUE(f.has_exact_constants());
  const auto values = jets_over(f, {Range(0)}, 0).values;
  EXPECT_TRUE(values[0].contains(0));
  EXPECT_GT(values[0].hi - values[0].lo, 1);  // honest: exp(40) has units of 32
  EXPECT_LT(values[0].hi - values[0].lo, 1e5);
  EXPECT_TRUE(values[1].lo < 0.1 && 0.1 < values[1].hi);
  EXPECT_LT(values[2].hi - values[2].lo, 1e-15);
  EXPECT_TRUE(values[3].lo < 1 / 3.0 && 1 / 3.0 < values[3].hi);
  EXPECT_TRUE(values[5].lo < 9007199254740993.0L && values[5].hi > 9007199254740993.0L);
  EXPECT_TRUE(values[6].contains(1));  // 2^53 + 1 is no double
  EXPECT_TRUE(values[7].contains(1));
}

TEST(Enclosure, UndefinedIsUnbounded) {
  const std::vector<std::string> variables{"x", "y"};
  const std::vector<std::string> texts{"atan(1/x)", "tanh(log(x))",   "sqrt(x)",     "abs(x)",  "x*(1/x)", "sin(1/x)",
                                       "x/x",       "0*(1/x)",        "exp(-1/x^2)", "x^(1/2)", "tan(y)",  "asin(y)",
                                       "acos(y)",   "1/(1+exp(1/x))", "abs(x)*y",    "log(x^2)"};
  const Enclosure f = Enclosure::of_expressions(variables, texts);
  const auto jets = jets_over(f, {Range(-0.5, 0.5), Range(0.9, 1.6)});
  for (std::size_t a = 0; a < texts.size(); ++a) {
    bool is_bounded = true;
    for (int p = 0; p < 3; ++p) is_bounded = is_bounded && jets.hessians[3 * a + p].is_bounded();
    EXPECT_FALSE(is_bounded) << texts[a];
  }
}

TEST(Enclosure, QuadraticsAreKnownByTheirDegree) {
  const std::vector<std::string> variables{"x", "y"};
  const std::vector<std::string> texts{"x+2*y-1", "(x+y)^2-x*(3-y)", "x^2*y", "x**2/3", "-x^2", "2^-1*x", "x^2.0"};
  const Enclosure f = Enclosure::of_expressions(variables, texts);
  const int degrees[] = {1, 2, 3, 2, 2, 1, 2};
  for (int a = 0; a < 7; ++a) EXPECT_EQ(f.degree(a), degrees[a]) << texts[a];
  const auto jets = jets_over(f, {Range(-1e3, 1e3), Range(-5, 7)});
  EXPECT_NEAR(jets.hessians[3].mid(), 2, 1e-12);
  EXPECT_NEAR(jets.hessians[3].hi, 2, 1e-12);
  EXPECT_NEAR(jets.hessians[4].lo, 3, 1e-12);
  EXPECT_NEAR(jets.hessians[12].lo, -2, 1e-12);
}

TEST(Enclosure, BadTextIsAnError) {
  const std::vector<std::string> variables{"x"};
  for (const char* text : {"", "x+", "(x", "y", "2x", "sin x", "x)", "1e999", "#"}) {
    EXPECT_THROW(Enclosure::of_expressions(variables, std::vector<std::string>{text}), InvalidInput) << text;
  }
}

}  // namespace
}  // namespace whitney
