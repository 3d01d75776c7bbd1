// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/catalogue.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/functions/zero_sets.h>
#include "submanifold_checks.h"

namespace whitney {
namespace {

TEST(NamedSubmanifolds, EveryNameIsMade) {
  const std::vector<std::string> names = submanifold_names(), functions = manifold_names();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const Submanifold M = named_submanifold(name);
    check_feet(M, 3, 0.5);
    if (std::find(functions.begin(), functions.end(), name) == functions.end()) continue;
    // The same set as the zero set of that name.
    const Function f = named_manifold(name).function;
    ASSERT_EQ(f.ambient_dim(), M.ambient_dim());
    ASSERT_EQ(f.codim(), M.codim());
    const Feet feet = random_feet(M, 0.3, 50);
    std::vector<double> values(50 * f.codim());
    f.evaluate(feet.points, values);
    for (const double value : values) EXPECT_NEAR(value, 0, 1e-13);
  }
}

TEST(NamedSubmanifolds, Parameters) {
  EXPECT_EQ(named_submanifold("sphere", {{"intrinsic_dim", 3}}).ambient_dim(), 4);
  EXPECT_EQ(named_submanifold("sphere", {{"ambient_dim", 6}}).codim(), 4);
  EXPECT_EQ(named_submanifold("flat_torus", {{"r1", 3}, {"r2", 0.25}}).bending()->reach, 0.25);
  EXPECT_EQ(named_submanifold("grassmann", {{"p", 1}, {"q", 4}}).intrinsic_dim(), 3);
  EXPECT_EQ(named_submanifold("stiefel", {{"p", 1}, {"q", 4}}).intrinsic_dim(), 3);
  EXPECT_EQ(named_submanifold("special_orthogonal", {{"q", 2}}).intrinsic_dim(), 1);
}

TEST(NamedSubmanifolds, Errors) {
  const auto message = [](const std::string& name, const std::map<std::string, double>& parameters = {}) {
    try {
      named_submanifold(name, parameters);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  using testing::HasSubstr;
  EXPECT_THAT(message("klein"), HasSubstr("klein_bottle"));
  EXPECT_THAT(message("klein_bottle", {{"r", 1}}), HasSubstr("none"));
  EXPECT_THAT(message("sphere", {{"raduis", 1}}), HasSubstr("radius"));
  EXPECT_THAT(message("sphere", {{"intrinsic_dim", 1.5}}), HasSubstr("integer"));
  EXPECT_THAT(message("sphere", {{"radius", NAN}}), HasSubstr("radius"));
  EXPECT_THAT(message("grassmann", {{"p", NAN}}), HasSubstr("integer"));
}

}  // namespace
}  // namespace whitney
