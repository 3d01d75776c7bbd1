// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/homogeneous_equations.h>

#include <cmath>
#include <complex>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Strings = std::vector<std::string>;
using Complex = std::complex<double>;

const Strings kVariables{"z1", "z2", "z3"};

std::string error_of(const Strings& equations, Field field = Field::kComplex, const Strings& variables = kVariables) {
  try {
    compile_affine_charts(variables, equations, field);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "no error";
}

std::vector<double> values(const CompiledMap& map, const std::vector<double>& point) {
  std::vector<double> result(map.values.num_outputs());
  map.values.run_batch(point, result);
  return result;
}

/// Compares the charts of one equation with what `f` computes from z, in which z_c is 1.
void expect_charts(const std::string& equation, const std::function<Complex(std::vector<Complex>)>& f,
                   bool has_re = true, bool has_im = true) {
  SCOPED_TRACE(equation);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  const std::vector<CompiledMap> charts = compile_affine_charts(kVariables, Strings{equation}, Field::kComplex);
  ASSERT_EQ(charts.size(), 3);
  for (std::size_t c = 0; c < 3; ++c) {
    ASSERT_EQ(charts[c].values.num_inputs(), 4);
    ASSERT_EQ(charts[c].values.num_outputs(), has_re + has_im);
    for (int run = 0; run < 5; ++run) {
      std::vector<double> point(4);
      for (double& x : point) x = uniform(random);
      std::vector<Complex> z{Complex(point[0], point[1]), Complex(point[2], point[3])};
      z.insert(z.begin() + c, 1);
      const Complex expected = f(z);
      const std::vector<double> found = values(charts[c], point);
      if (has_re) {
        EXPECT_NEAR(found[0], expected.real(), 1e-12 * (1 + std::abs(expected)));
      }
      if (has_im) {
        EXPECT_NEAR(found.back(), expected.imag(), 1e-12 * (1 + std::abs(expected)));
      }
      if (!has_re) {
        EXPECT_NEAR(expected.real(), 0, 1e-13);
      }
      if (!has_im) {
        EXPECT_NEAR(expected.imag(), 0, 1e-13);
      }
      // The derivatives are those of the values.
      std::vector<double> jacobian(4 * found.size());
      charts[c].jacobian.run_batch(point, jacobian);
      for (std::size_t i = 0; i < 4; ++i) {
        const double step = 1e-6;
        std::vector<double> above = point, below = point;
        above[i] += step;
        below[i] -= step;
        for (std::size_t j = 0; j < found.size(); ++j) {
          const double slope = (values(charts[c], above)[j] - values(charts[c], below)[j]) / (2 * step);
          EXPECT_NEAR(jacobian[4 * j + i], slope, 1e-6 * (1 + std::abs(slope)));
        }
      }
    }
  }
}

TEST(HomogeneousEquations, Values) {
  const Complex i(0, 1);
  expect_charts("z1^3*z2 + z2^3*z3 + z3^3*z1", [](auto z) {
    return z[0] * z[0] * z[0] * z[1] + z[1] * z[1] * z[1] * z[2] + z[2] * z[2] * z[2] * z[0];
  });
  expect_charts("z1^2*conj(z2) + z2^2*conj(z3) + z3^2*conj(z1)", [](auto z) {
    return z[0] * z[0] * std::conj(z[1]) + z[1] * z[1] * std::conj(z[2]) + z[2] * z[2] * std::conj(z[0]);
  });
  expect_charts("z1^7 + z2^7 - z3^7", [](auto z) { return std::pow(z[0], 7) + std::pow(z[1], 7) - std::pow(z[2], 7); });
  expect_charts("(z1 + i*z2)^3*(z1 - 2*z3)/(1 + i) - (0.25 - i/3)*z1*z2*z3^2", [&](auto z) {
    return std::pow(z[0] + i * z[1], 3) * (z[0] - 2.0 * z[2]) / (1.0 + i) -
           (0.25 - i / 3.0) * z[0] * z[1] * z[2] * z[2];
  });
  expect_charts("sqrt(2)*z1 + pi*z2 - 2^(1/3)*exp(i*conj(i))*z3", [&](auto z) {
    return std::sqrt(2.0) * z[0] + std::acos(-1.0) * z[1] - std::cbrt(2.0) * std::exp(1.0) * z[2];
  });
  expect_charts("conj(z1 - i*z2)*z3*conj(z2)*z1",
                [&](auto z) { return std::conj(z[0] - i * z[1]) * z[2] * std::conj(z[1]) * z[0]; });
}

TEST(HomogeneousEquations, RealAndImaginaryEquations) {
  expect_charts(
      "z1*conj(z1) - 2*z2*conj(z2)", [](auto z) { return std::norm(z[0]) - 2 * std::norm(z[1]); }, true, false);
  expect_charts(
      "abs2(z1 + 0.5*z3) - 2*abs2(z2)", [](auto z) { return std::norm(z[0] + 0.5 * z[2]) - 2 * std::norm(z[1]); }, true,
      false);
  expect_charts(
      "real(z1*conj(z2)) - abs2(z3)", [](auto z) { return (z[0] * std::conj(z[1])).real() - std::norm(z[2]); }, true,
      false);
  expect_charts(
      "imag(z1*conj(z2))", [](auto z) { return (z[0] * std::conj(z[1])).imag(); }, true, false);
  expect_charts(
      "z1*conj(z2) - conj(z1)*z2", [](auto z) { return z[0] * std::conj(z[1]) - std::conj(z[0]) * z[1]; }, false, true);
  // One complex and one real equation leave a curve in CP^2; another complex one is too many.
  EXPECT_EQ(compile_affine_charts(kVariables, Strings{"z1^2+z2^2+z3^2", "abs2(z1)-abs2(z2)"}, Field::kComplex)[0]
                .values.num_outputs(),
            3);
  EXPECT_THAT(error_of({"z1^2+z2^2+z3^2", "abs2(z1)-abs2(z2)", "z1+z2"}), HasSubstr("5 real equations"));
}

TEST(HomogeneousEquations, RealField) {
  const auto charts =
      compile_affine_charts(Strings{"x", "y", "z"}, Strings{"x^2*y + sqrt(2)*y^3 - 0.5*z^3"}, Field::kReal);
  ASSERT_EQ(charts.size(), 3);
  EXPECT_EQ(charts[0].values.num_inputs(), 2);
  EXPECT_NEAR(values(charts[0], {2, 3})[0], 2 + std::sqrt(2.0) * 8 - 13.5, 1e-14);
  EXPECT_NEAR(values(charts[1], {2, 3})[0], 4 + std::sqrt(2.0) - 13.5, 1e-14);
  EXPECT_NEAR(values(charts[2], {2, 3})[0], 12 + std::sqrt(2.0) * 27 - 0.5, 1e-14);
  EXPECT_THAT(error_of({"x^2*y + z^2"}, Field::kReal, {"x", "y", "z"}),
              AllOf(HasSubstr("not homogeneous"), HasSubstr("x^2*y has degree 3"), HasSubstr("z^2 has degree 2")));
  EXPECT_THAT(error_of({"conj(x)"}, Field::kReal, {"x", "y"}), HasSubstr("unknown name 'conj'"));
  // Over R, the complex names are free.
  EXPECT_EQ(error_of({"i^2 - conj*i"}, Field::kReal, {"i", "conj"}), "no error");
}

TEST(HomogeneousEquations, Errors) {
  EXPECT_THAT(error_of({"z1^2*conj(z2) + z3^3"}),
              AllOf(HasSubstr("\"z1^2*conj(z2) + z3^3\""), HasSubstr("not bihomogeneous"),
                    HasSubstr("z1^2*conj(z2) has degree 2 in the variables and 1 in their conjugates"),
                    HasSubstr("z3^3 has degree 3 in the variables and 0")));
  EXPECT_THAT(error_of({"z1 + z2", "z1 - 1"}), AllOf(HasSubstr("\"z1 - 1\""), HasSubstr("1 has degree 0")));
  EXPECT_THAT(error_of({"z1 - z1"}), HasSubstr("0 identically"));
  EXPECT_THAT(error_of({"2 + i"}), HasSubstr("constant"));
  EXPECT_THAT(error_of({"sin(z1)"}), AllOf(HasSubstr("'sin'"), HasSubstr("no polynomial")));
  EXPECT_THAT(error_of({"z1/z2"}), HasSubstr("quotient"));
  EXPECT_THAT(error_of({"z1^0.5"}), HasSubstr("no polynomial"));
  EXPECT_THAT(error_of({"z1^(-1)"}), HasSubstr("no polynomial"));
  EXPECT_THAT(error_of({"2^z1"}), HasSubstr("no polynomial"));
  EXPECT_THAT(error_of({"2^i*z1"}), HasSubstr("exponent"));
  EXPECT_THAT(error_of({"sqrt(i)*z1"}), HasSubstr("complex"));
  EXPECT_THAT(error_of({"i^0.5*z1"}), HasSubstr("integer"));
  EXPECT_THAT(error_of({"conj z1"}), HasSubstr("expected '('"));
  EXPECT_THAT(error_of({"z4"}), HasSubstr("unknown name 'z4'"));
  EXPECT_THAT(error_of({"z1"}, Field::kComplex, {"z1", "i"}), HasSubstr("reserved"));
  EXPECT_THAT(error_of({"z1"}, Field::kComplex, {"z1"}), HasSubstr("two variables"));
  EXPECT_THAT(error_of({}), HasSubstr("no equations"));
}

TEST(HomogeneousEquations, SameTape) {
  const Strings equations{"(z1 - i*z2)^3*(z2 - z3)*(z3 + 2*z1)*(z1 - 0.3*z2)"};
  const auto a = compile_affine_charts(kVariables, equations, Field::kComplex);
  const auto b = compile_affine_charts(kVariables, equations, Field::kComplex);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(a[c].values, b[c].values);
    EXPECT_EQ(a[c].jacobian, b[c].jacobian);
  }
}

}  // namespace
}  // namespace whitney
