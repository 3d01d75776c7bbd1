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

TEST(KnownManifolds, HoldBothRegistries) {
  std::vector<std::string> names, with_function, with_submanifold;
  for (const KnownName& known : known_manifolds()) {
    names.push_back(known.name);
    if (known.has_function) with_function.push_back(known.name);
    if (known.has_submanifold) with_submanifold.push_back(known.name);
    EXPECT_FALSE(known.description.empty());
  }
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_EQ(with_function, manifold_names());
  EXPECT_EQ(with_submanifold, submanifold_names());
  EXPECT_THROW(known_manifold("klein"), InvalidInput);
  EXPECT_THROW(known_manifold("trefoil", {{"r", 1}}), InvalidInput);
}

// Euler characteristic, homology and orientability, filled in by hand, must agree with each other and with duality.
TEST(KnownManifolds, ExpectedTopologyIsConsistent) {
  for (const KnownName& known : known_manifolds()) {
    SCOPED_TRACE(known.name);
    const KnownManifold M = known_manifold(known.name);
    ASSERT_EQ(M.function.has_value(), known.has_function);
    ASSERT_EQ(M.submanifold.has_value(), known.has_submanifold);
    const int d = M.function ? M.function->ambient_dim() : M.submanifold->ambient_dim();
    const int n = d - (M.function ? M.function->codim() : M.submanifold->codim());
    EXPECT_EQ(M.point.size(), static_cast<std::size_t>(d));
    EXPECT_EQ(M.box.size(), known.has_function ? M.point.size() : 0);
    if (!M.topology) continue;
    if (n % 2 == 1) {
      EXPECT_EQ(M.topology->euler_characteristic, 0);
    }
    if (M.topology->homology.empty()) continue;
    ASSERT_EQ(M.topology->homology.size(), static_cast<std::size_t>(n + 1));
    const auto rank = [](const std::string& group) {
      if (group.substr(0, 2) == "Z^") return std::stoi(group.substr(2));
      return group[0] == 'Z' && group.substr(0, 2) != "Z/" ? 1 : 0;
    };
    std::int64_t chi = 0;
    for (int i = 0; i <= n; ++i) {
      chi += (i % 2 == 0 ? 1 : -1) * rank(M.topology->homology[i]);
      if (M.topology->orientable) {
        EXPECT_EQ(rank(M.topology->homology[i]), rank(M.topology->homology[n - i])) << i;
      }
    }
    EXPECT_EQ(chi, M.topology->euler_characteristic);
    EXPECT_EQ(rank(M.topology->homology[0]), static_cast<int>(M.topology->components));
    EXPECT_EQ(rank(M.topology->homology[n]), M.topology->orientable ? static_cast<int>(M.topology->components) : 0);
  }
}

TEST(KnownManifolds, ParametersChangeTheTopology) {
  EXPECT_EQ(known_manifold("sphere", {{"intrinsic_dim", 3}}).topology->euler_characteristic, 0);
  EXPECT_EQ(known_manifold("grassmann", {{"p", 1}, {"q", 5}}).topology->homology,
            (std::vector<std::string>{"Z", "Z/2", "0", "Z/2", "0"}));
  EXPECT_EQ(known_manifold("grassmann", {{"p", 2}, {"q", 5}}).topology->euler_characteristic, 2);
  EXPECT_FALSE(known_manifold("grassmann", {{"p", 2}, {"q", 5}}).topology->orientable);
  EXPECT_EQ(known_manifold("stiefel", {{"p", 1}, {"q", 3}}).topology->euler_characteristic, 2);
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
