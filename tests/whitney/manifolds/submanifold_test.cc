// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/submanifold.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <whitney/functions/function.h>
#include <whitney/manifolds/closed_form_manifolds.h>
#include <whitney/manifolds/implicit_manifold.h>
#include <whitney/manifolds/matrix_manifolds.h>
#include <whitney/manifolds/submanifold_combinators.h>

namespace whitney {
namespace {

constexpr FootPromise kGlobal{FootPromise::Place::kGlobal, FootPromise::Errors::kProven};
constexpr FootPromise kLocal{FootPromise::Place::kLocal, FootPromise::Errors::kModelled};

Submanifold implicit_circle() {
  return implicit_manifold(
      make_function(2, 1, [](std::span<const double> x, std::span<double> f) { f[0] = x[0] * x[0] + x[1] * x[1] - 1; }),
      {1, 0});
}

TEST(Submanifold, WrittenOutFeetAreProvedToBeTheClosest) {
  EXPECT_EQ(closed_form::sphere(2, 3, 1).promise(), kGlobal);
  EXPECT_EQ(closed_form::torus_of_revolution(2, 1).promise(), kGlobal);
  EXPECT_EQ(closed_form::flat_torus(4, 1, 1).promise(), kGlobal);
  EXPECT_EQ(grassmann(1, 3).promise(), kGlobal);
  EXPECT_EQ(special_orthogonal(3).promise(), kGlobal);
}

TEST(Submanifold, SearchedFeetAreNot) { EXPECT_EQ(implicit_circle().promise(), kLocal); }

TEST(Submanifold, CombinationsPromiseWhatTheirPartsDo) {
  const Submanifold proved = closed_form::sphere(1, 2, 1);
  const Submanifold searched = implicit_circle();
  EXPECT_EQ(scale(translate(proved, std::vector<double>{1, 2}), 3).promise(), kGlobal);
  EXPECT_EQ(embed(proved, 3).promise(), kGlobal);
  EXPECT_EQ(product(proved, proved).promise(), kGlobal);
  EXPECT_EQ(product(proved, searched).promise(), kLocal);
  EXPECT_EQ(product(searched, proved).promise(), kLocal);
  EXPECT_EQ(with_bending(searched, {0.5, 0.5, Bending::Source::kCaller}).promise(), kLocal);
  EXPECT_EQ(with_bending(proved, {0.5, 0.5, Bending::Source::kCaller}).promise(), kGlobal);
}

TEST(Submanifold, AModelThatSaysNothingPromisesNothing) {
  struct Silent : Submanifold::Model {
    int ambient_dim() const override { return 2; }
    int intrinsic_dim() const override { return 1; }
    bool project(std::span<const double>, std::span<double>, std::span<double>, FootErrors&) const override {
      return false;
    }
    std::optional<Bending> bending() const override { return std::nullopt; }
    std::vector<double> seed_points() const override { return {}; }
  };
  EXPECT_EQ(Submanifold(std::make_shared<Silent>()).promise(), FootPromise{});
}

}  // namespace
}  // namespace whitney
