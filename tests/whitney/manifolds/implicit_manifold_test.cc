// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/implicit_manifold.h>

#include <cmath>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/functions/combinators.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/manifolds/closed_form_manifolds.h>
#include <whitney/manifolds/matrix_manifolds.h>
#include "submanifold_checks.h"

namespace whitney {
namespace {

Submanifold implicit(const NamedManifold& M) { return implicit_manifold(M.function, M.point); }

void expect_agreement(const Submanifold& M, const Submanifold& exact, double reach, double tolerance) {
  const std::size_t d = exact.ambient_dim(), n = exact.intrinsic_dim();
  const Feet feet = random_feet(exact, 0.5 * reach, 100);
  std::vector<double> point(d), frame(d * d);
  FootErrors errors;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    if (distance(&feet.sources[i * d], &feet.points[i * d], d) > 0.7 * reach) continue;
    ASSERT_TRUE(M.project(std::span(feet.sources).subspan(i * d, d), point, frame, errors));
    EXPECT_LT(distance(point.data(), &feet.points[i * d], d), tolerance);
    // The same tangent space: orthogonal to the other's normals.
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = n; b < d; ++b) {
        double dot = 0;
        for (std::size_t c = 0; c < d; ++c) dot += frame[a * d + c] * feet.frames[i * d * d + b * d + c];
        EXPECT_NEAR(dot, 0, 10 * tolerance / reach);
      }
    }
    EXPECT_LT(errors.point, tolerance);
    EXPECT_GT(errors.point, 0);
  }
}

TEST(ImplicitManifold, Feet) {
  check_feet(implicit(sphere(2, 3)), 1, 1);
  check_feet(implicit(flat_torus(5)), 1, 1);
  check_feet(implicit(torus_of_revolution(2, 1)), 3, 1);
  check_feet(implicit(so3_vectors()), 1, 1);
  check_bad_points(implicit(sphere(2, 3)));
}

TEST(ImplicitManifold, AgreesWithClosedForms) {
  expect_agreement(implicit(sphere(2, 4, 1.5)), closed_form::sphere(2, 4, 1.5), 1.5, 1e-12);
  expect_agreement(implicit(torus_of_revolution(2, 0.5)), closed_form::torus_of_revolution(2, 0.5), 0.5, 1e-12);
  expect_agreement(implicit(so3_vectors()), stiefel(2, 3), 1, 1e-12);
}

TEST(ImplicitManifold, DerivativesByDifferences) {
  const Function f = make_function(3, 1, [](std::span<const double> x, std::span<double> value) {
    value[0] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 1;
  });
  expect_agreement(implicit_manifold(f, {1, 0, 0}), closed_form::sphere(2, 3), 1, 1e-8);
}

TEST(ImplicitManifold, AnySize) {
  for (const double s : {1e-9, 1e9}) {
    ImplicitManifoldOptions options;
    options.length_scale = s;
    const NamedManifold torus = torus_of_revolution(2, 1);
    std::vector<double> seed = torus.point;
    for (double& c : seed) c *= s;
    check_feet(implicit_manifold(scale(torus.function, s), seed, options), 3 * s, s);
  }
}

/// Equation i of f times factors[i].
class OtherUnits : public Function::Model {
 public:
  OtherUnits(Function f, std::vector<double> factors) : f_(std::move(f)), factors_(std::move(factors)) {}
  int ambient_dim() const override { return f_.ambient_dim(); }
  int codim() const override { return f_.codim(); }
  void evaluate(std::span<const double> points, std::span<double> values) const override {
    f_.evaluate(points, values);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] *= factors_[i % factors_.size()];
  }
  void jacobian(std::span<const double> x, std::span<double> rows, double length_scale) const override {
    f_.jacobian(x, rows, length_scale);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] *= factors_[i / x.size()];
  }

 private:
  Function f_;
  std::vector<double> factors_;
};

Submanifold in_units(const NamedManifold& M, std::vector<double> factors) {
  return implicit_manifold(Function(std::make_shared<OtherUnits>(M.function, std::move(factors))), M.point);
}

TEST(ImplicitManifold, UnitsOfTheEquationsDoNotMatter) {
  for (const double factor : {1e-200, 1e200, 1e-250, 1e-9}) {
    expect_agreement(in_units(torus_of_revolution(2, 1), {factor}), closed_form::torus_of_revolution(2, 1), 1, 1e-12);
    check_feet(in_units(torus_of_revolution(2, 1), {factor}), 3, 1);
    check_feet(in_units(flat_torus(4), {factor, 1 / factor}), 1, 1);
  }
  expect_agreement(in_units(so3_vectors(), {1e200, 1e-200, 1}), stiefel(2, 3), 1, 1e-12);
}

TEST(ImplicitManifold, PowersOfTwoChangeNoBit) {
  const NamedManifold M = so3_vectors();
  const Submanifold plain = implicit(M), other = in_units(M, {std::ldexp(1, 600), std::ldexp(1, -700), 2});
  const Feet feet = random_feet(stiefel(2, 3), 0.5, 50);
  std::vector<double> p(6), q(6), frame(36), other_frame(36);
  FootErrors errors, other_errors;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const std::span<const double> x(&feet.sources[i * 6], 6);
    ASSERT_TRUE(plain.project(x, p, frame, errors));
    ASSERT_TRUE(other.project(x, q, other_frame, other_errors));
    EXPECT_EQ(p, q);
    EXPECT_EQ(frame, other_frame);
    EXPECT_EQ(errors.point, other_errors.point);
    EXPECT_EQ(errors.angle, other_errors.angle);
  }
}

TEST(ImplicitManifold, NanometresWithoutALengthScale) {
  const double s = 1e-9;
  const NamedManifold torus = torus_of_revolution(2, 1);
  std::vector<double> seed = torus.point;
  for (double& c : seed) c *= s;
  check_feet(implicit_manifold(scale(torus.function, s), seed), 3 * s, s);
}

TEST(ImplicitManifold, FarFromTheOrigin) {
  const double far = 1e6;
  const Function f = make_function(3, 1, [](std::span<const double> x, std::span<double> v) {
    v[0] = 1e-200 * ((x[0] - 1e6) * (x[0] - 1e6) + x[1] * x[1] + x[2] * x[2] - 100);
  });
  const Submanifold M = implicit_manifold(f, {far + 10, 0, 0});
  const Submanifold exact = closed_form::sphere(2, 3, 10);
  std::vector<double> point(3), frame(9), expected(3), expected_frame(9);
  FootErrors errors;
  for (int i = 0; i < 100; ++i) {
    const double x[3] = {7 * std::cos(i), 8 * std::sin(i), 5 * std::cos(3 * i)}, y[3] = {x[0] + far, x[1], x[2]};
    ASSERT_TRUE(exact.project(x, expected, expected_frame, errors));
    ASSERT_TRUE(M.project(y, point, frame, errors));
    expected[0] += far;
    EXPECT_LT(distance(point.data(), expected.data(), 3), 1e-7);
    // The tangents against the exact normal.
    for (int a = 0; a < 2; ++a) {
      double dot = 0;
      for (int c = 0; c < 3; ++c) dot += frame[a * 3 + c] * expected_frame[6 + c];
      EXPECT_NEAR(dot, 0, 1e-7);
    }
  }
}

TEST(ImplicitManifold, NoFootWhereThereIsNone) {
  std::vector<double> point(3), frame(9);
  FootErrors errors;
  EXPECT_FALSE(implicit(sphere(2, 3)).project(std::vector<double>{0, 0, 0}, point, frame, errors));
  // A cone's apex is not regular: nothing near it leads there with success.
  const Function cone = make_function(3, 1, [](std::span<const double> x, std::span<double> value) {
    value[0] = x[0] * x[0] + x[1] * x[1] - x[2] * x[2];
  });
  EXPECT_FALSE(implicit_manifold(cone, {0, 0, 0}).project(std::vector<double>{0, 0, 0}, point, frame, errors));
  // Nothing is zero here.
  const Function empty =
      make_function(3, 1, [](std::span<const double> x, std::span<double> value) { value[0] = x[0] * x[0] + 1; });
  EXPECT_FALSE(implicit_manifold(empty, {}).project(std::vector<double>{0.3, 0, 0}, point, frame, errors));
}

TEST(ImplicitManifold, RejectsBadInput) {
  const Function f = sphere(2, 3).function;
  EXPECT_FALSE(implicit_manifold(f, {}).bending());
  EXPECT_THROW(implicit_manifold(f, {1, 0}), InvalidInput);
  EXPECT_THROW(implicit_manifold(f, {1, 0, NAN}), InvalidInput);
  EXPECT_THROW(implicit_manifold(f, {}, {.length_scale = 0}), InvalidInput);
  EXPECT_THROW(
      implicit_manifold(make_function(1, 1, [](std::span<const double>, std::span<double> v) { v[0] = 0; }), {}),
      InvalidInput);
}

}  // namespace
}  // namespace whitney
