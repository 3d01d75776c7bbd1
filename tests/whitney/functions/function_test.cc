// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/function.h>

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

Function example() {
  return make_function(3, 2, [](std::span<const double> x, std::span<double> v) {
    v[0] = std::sin(x[0]) * x[1];
    v[1] = x[2] * x[2] * x[2] - x[0];
  });
}

TEST(Function, EvaluatesBatches) {
  const Function f = example();
  const std::vector<double> points{0.1, 2, 3, -1, 0.5, 2};
  std::vector<double> values(4);
  f.evaluate(points, values);
  EXPECT_EQ(values, (std::vector<double>{std::sin(0.1) * 2, 27 - 0.1, std::sin(-1.0) * 0.5, 9}));
  f.evaluate({}, {});
}

TEST(Function, DifferencesAreDerivatives) {
  const Function f = example();
  const std::vector<double> point{0.7, -2, 1.5};
  std::vector<double> J(6);
  f.jacobian(point, J);
  const std::vector<double> expected{std::cos(0.7) * -2, std::sin(0.7), 0, -1, 0, 3 * 1.5 * 1.5};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(J[i], expected[i], 1e-8) << i;
}

TEST(Function, DifferencesFollowTheLengthScale) {
  // A sphere of radius 1e-9: steps of the default size would leave it far behind.
  const Function f = make_function(
      2, 1, [](std::span<const double> x, std::span<double> v) { v[0] = std::sin(x[0] * 1e9) + x[1] * 1e9; });
  std::vector<double> J(2);
  f.jacobian(std::vector<double>{1e-9, 0}, J, 1e-9);
  EXPECT_NEAR(J[0] / 1e9, std::cos(1.0), 1e-8);
  EXPECT_NEAR(J[1] / 1e9, 1, 1e-8);
}

TEST(Function, PassesNonFiniteValuesOn) {
  const Function f =
      make_function(1, 1, [](std::span<const double> x, std::span<double> v) { v[0] = std::sqrt(x[0]); });
  std::vector<double> value(1);
  f.evaluate(std::vector<double>{-1}, value);
  EXPECT_TRUE(std::isnan(value[0]));
}

TEST(Function, RejectsWrongSizes) {
  const Function f = example();
  std::vector<double> x(3), v(2), J(6);
  EXPECT_THROW(f.evaluate(std::vector<double>(4), v), InvalidInput);
  EXPECT_THROW(f.evaluate(x, J), InvalidInput);
  EXPECT_THROW(f.evaluate(J, v), InvalidInput);
  EXPECT_THROW(f.jacobian(J, J), InvalidInput);
  EXPECT_THROW(f.jacobian(x, v), InvalidInput);
  EXPECT_THROW(f.jacobian(x, J, 0), InvalidInput);
  EXPECT_THROW(f.jacobian(x, J, -1), InvalidInput);
  EXPECT_THROW(f.jacobian(x, J, std::numeric_limits<double>::quiet_NaN()), InvalidInput);
}

TEST(Function, RejectsImpossibleDimensions) {
  const auto f = [](std::span<const double>, std::span<double>) {};
  EXPECT_THROW(make_function(0, 1, f), InvalidInput);
  EXPECT_THROW(make_function(3, 0, f), InvalidInput);
  EXPECT_THROW(make_function(3, 1, nullptr), InvalidInput);
  EXPECT_NO_THROW(make_function(3, 4, f));  // inequalities may be many
}

}  // namespace
}  // namespace whitney
