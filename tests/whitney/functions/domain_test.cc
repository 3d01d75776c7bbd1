// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/domain.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

/// x + y >= 0 and 1 - x^2 >= 0 in the box [-2, 2] x [-1, 3].
Domain example() {
  return Domain(2,
                make_function(2, 2,
                              [](std::span<const double> x, std::span<double> v) {
                                v[0] = x[0] + x[1];
                                v[1] = 1 - x[0] * x[0];
                              }),
                Box{{-2, -1}, {2, 3}});
}

TEST(Domain, NumbersTheCallersInequalitiesBeforeTheSidesOfTheBox) {
  const Domain domain = example();
  EXPECT_EQ(domain.num_given(), 2);
  EXPECT_EQ(domain.num_inequalities(), 6);
  EXPECT_FALSE(domain.is_box_side(1));
  EXPECT_TRUE(domain.is_box_side(2));
  EXPECT_EQ(domain.values(std::vector<double>{0.5, 1}), (std::vector<double>{1.5, 0.75, 2.5, 1.5, 2, 2}));
  EXPECT_EQ(domain.name(0), "inequality 0");
  EXPECT_EQ(domain.name(5), "box: upper side of coordinate 2");
  EXPECT_TRUE(Domain().empty());
}

TEST(Domain, MasksAndMembership) {
  const Domain domain = example();
  const double x[2] = {1.5, -2};  // x + y < 0, 1 - x^2 < 0, y below the box
  const double given[2] = {-0.5, -1.25};
  std::uint64_t mask = 0;
  domain.set_mask(x, given, &mask);
  EXPECT_EQ(mask, 0b010011u);
  EXPECT_TRUE(domain.contains(std::vector<double>{0.5, 1}));
  EXPECT_TRUE(domain.contains(std::vector<double>{1, -1}));  // on three of them
  EXPECT_FALSE(domain.contains(x));
  EXPECT_TRUE(domain.contains(x, std::vector<double>{0.5, 1.25, 0, 0, 1, 0}));
  EXPECT_FALSE(domain.contains(std::vector<double>{std::numeric_limits<double>::quiet_NaN(), 0}));
}

TEST(Domain, GradientsAndStrata) {
  const Domain domain = example();
  const std::vector<double> at{0.5, 1};
  EXPECT_EQ(domain.gradient(2, at, 1), (std::vector<double>{1, 0}));
  EXPECT_EQ(domain.gradient(5, at, 1), (std::vector<double>{0, -1}));
  EXPECT_NEAR(domain.gradient(1, at, 1)[0], -1, 1e-8);
  const Function f = make_function(2, 1, [](std::span<const double> x, std::span<double> v) { v[0] = x[0] - x[1]; });
  const Function on_side = domain.with_equations(f, {4});
  EXPECT_EQ(on_side.codim(), 2);
  std::vector<double> values(2);
  on_side.evaluate(at, values);
  EXPECT_EQ(values, (std::vector<double>{-0.5, 2}));
}

TEST(Domain, RejectsWhatDoesNotFit) {
  EXPECT_THROW(Domain(3, example().given(), std::nullopt), InvalidInput);
  EXPECT_THROW(Domain(2, std::nullopt, Box{{0}, {1}}), InvalidInput);
  EXPECT_THROW(Domain(1, std::nullopt, Box{{1}, {1}}), InvalidInput);
  EXPECT_THROW(Domain(1, std::nullopt, Box{{0}, {std::numeric_limits<double>::quiet_NaN()}}), InvalidInput);
  EXPECT_NO_THROW(Domain(1, std::nullopt, Box{{0}, {std::numeric_limits<double>::infinity()}}));
}

}  // namespace
}  // namespace whitney
