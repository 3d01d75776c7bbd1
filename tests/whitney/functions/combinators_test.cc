// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/combinators.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <coxeter/placement.h>
#include <whitney/functions/expression.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/io/read_problem.h>

namespace whitney {
namespace {

using Strings = std::vector<std::string>;

std::vector<double> values(const Function& f, const std::vector<double>& x) {
  std::vector<double> v(x.size() / f.ambient_dim() * f.codim());
  f.evaluate(x, v);
  return v;
}

/// The exact Jacobian must agree with differences of the combined function, and values must not depend on the batch.
void check(const Function& f) {
  const int d = f.ambient_dim(), k = f.codim();
  std::vector<double> point, J(k * d), differences(k * d);
  for (int i = 0; i < d; ++i) point.push_back(std::sin(1.0 + 2 * i));
  f.jacobian(point, J);
  make_function(d, k, [&](auto x, auto v) { f.evaluate(x, v); }).jacobian(point, differences);
  for (int i = 0; i < k * d; ++i) EXPECT_NEAR(J[i], differences[i], 1e-7 * (1 + std::abs(J[i]))) << i;

  for (int m = 1; m <= 17; ++m) {
    std::vector<double> batch;
    for (int i = 0; i < m * d; ++i) batch.push_back(std::cos(1.0 + i));
    const std::vector<double> all = values(f, batch);
    for (int i = 0; i < m; ++i) {
      const std::vector<double> one = values(f, {batch.begin() + i * d, batch.begin() + (i + 1) * d});
      for (int r = 0; r < k; ++r) ASSERT_EQ(all[i * k + r], one[r]) << "batch of " << m;
    }
  }
}

Function circle() { return parse_equations(Strings{"x", "y"}, Strings{"x^2+y^2-1"}); }
Function skew() { return parse_equations(Strings{"x", "y", "z"}, Strings{"x^3-y*z+1", "sin(x)+y^2-z"}); }

TEST(Combinators, Product) {
  const Function f = product(circle(), skew());
  EXPECT_EQ(f.ambient_dim(), 5);
  EXPECT_EQ(f.codim(), 3);
  const std::vector<double> v = values(f, {1, 2, 0, 3, 5}), w = values(skew(), {0, 3, 5});
  EXPECT_EQ(v, (std::vector<double>{4, w[0], w[1]}));
  check(f);
}

TEST(Combinators, Embed) {
  const Function f = embed(circle(), 4);
  EXPECT_EQ(f.ambient_dim(), 4);
  EXPECT_EQ(values(f, {1, 2, 3, 4}), (std::vector<double>{4, 3, 4}));
  EXPECT_EQ(embed(circle(), 2).codim(), 1);
  check(f);
}

TEST(Combinators, RotateMovesPoints) {
  const Eigen::MatrixXd Q = as_eigen(coxeter::random_rotation(3, 5));
  const Function f = skew(), g = rotate(f, Q);
  const Eigen::Vector3d p(0.3, -0.7, 1.1), q = Q * p;
  const std::vector<double> expected = values(f, {p.data(), p.data() + 3}), got = values(g, {q.data(), q.data() + 3});
  for (int r = 0; r < 2; ++r) EXPECT_NEAR(got[r], expected[r], 1e-14);
  check(g);
  // A quarter turn takes (1, 0) to (0, 1), not to (0, -1).
  const Function h = rotate(parse_equations(Strings{"x", "y"}, Strings{"x-1"}), Eigen::Matrix2d{{0, -1}, {1, 0}});
  EXPECT_EQ(values(h, {0, 1})[0], 0);
  EXPECT_EQ(values(h, {0, -1})[0], -2);
}

TEST(Combinators, TranslateScalePermuteMovePoints) {
  const Function f = skew();
  const std::vector<double> p{0.5, -0.75, 1.25}, expected = values(f, p);
  EXPECT_EQ(values(translate(f, std::vector<double>{1, 2, 4}), {1.5, 1.25, 5.25}), expected);
  EXPECT_EQ(values(scale(f, 4), {2, -3, 5}), expected);
  const std::vector<int> permutation{2, 0, 1};  // coordinate 0 becomes coordinate 2, ..
  EXPECT_EQ(values(permute_variables(f, permutation), {-0.75, 1.25, 0.5}), expected);
  check(translate(f, std::vector<double>{1, 2, 4}));
  check(scale(f, 4));
  check(permute_variables(f, permutation));
}

TEST(Combinators, MultiplyValues) {
  const Function f = multiply_values(skew(), std::vector<double>{1e12, -0.5});
  const std::vector<double> p{0.5, -0.75, 1.25}, v = values(skew(), p);
  EXPECT_EQ(values(f, p), (std::vector<double>{1e12 * v[0], -0.5 * v[1]}));
  check(f);
}

TEST(Combinators, Chain) {
  const int d = 10;
  Function f = scale(
      translate(rotate(embed(flat_torus().function, d), coxeter::random_rotation(d, 3)), std::vector<double>(d, 1.0)),
      2);
  check(f);
  // The image of a point of the torus.
  Eigen::VectorXd p = Eigen::VectorXd::Zero(d);
  p[0] = 0.6, p[1] = -0.8, p[3] = 1;
  const Eigen::VectorXd image = 2 * (as_eigen(coxeter::random_rotation(d, 3)) * p + Eigen::VectorXd::Ones(d));
  for (double v : values(f, {image.data(), image.data() + d})) EXPECT_NEAR(v, 0, 1e-14);
}

TEST(Combinators, LengthScaleFollows) {
  // A manifold that was made tiny: the inner function must be asked for differences at its own size, as steps of 1e-14
  // would drown in the rounding of 1 + ..
  const Function f = scale(make_function(1, 1, [](auto x, auto v) { v[0] = 1 + std::sin(x[0]); }), 1e-9);
  std::vector<double> J(1);
  f.jacobian(std::vector<double>{0}, J, 1e-9);
  EXPECT_NEAR(J[0] * 1e-9, 1, 1e-9);
}

TEST(Combinators, RejectBadInput) {
  const Function f = skew();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(embed(f, 2), InvalidInput);
  EXPECT_THROW(rotate(f, Eigen::Matrix2d::Identity()), InvalidInput);
  EXPECT_THROW(rotate(f, 2 * Eigen::Matrix3d::Identity()), InvalidInput);
  EXPECT_THROW(rotate(f, nan * Eigen::Matrix3d::Identity()), InvalidInput);
  EXPECT_NO_THROW(rotate(f, -Eigen::Matrix3d::Identity()));
  EXPECT_THROW(translate(f, std::vector<double>{1, 2}), InvalidInput);
  EXPECT_THROW(translate(f, std::vector<double>{1, 2, nan}), InvalidInput);
  EXPECT_THROW(scale(f, 0), InvalidInput);
  EXPECT_THROW(scale(f, -1), InvalidInput);
  EXPECT_THROW(scale(f, nan), InvalidInput);
  EXPECT_THROW(multiply_values(f, std::vector<double>{1, 0}), InvalidInput);
  EXPECT_THROW(multiply_values(f, std::vector<double>{1, 1, 1}), InvalidInput);
  EXPECT_THROW(permute_variables(f, std::vector<int>{0, 1}), InvalidInput);
  EXPECT_THROW(permute_variables(f, std::vector<int>{0, 1, 1}), InvalidInput);
  EXPECT_THROW(permute_variables(f, std::vector<int>{1, 2, 3}), InvalidInput);
}

}  // namespace
}  // namespace whitney
