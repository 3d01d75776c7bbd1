// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/zero_sets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

/// The point lies on the manifold and in the box, and f is regular there.
void check(const NamedManifold& m, int ambient_dim, int intrinsic_dim) {
  const int d = m.function.ambient_dim(), k = m.function.codim();
  ASSERT_EQ(d, ambient_dim);
  ASSERT_EQ(d - k, intrinsic_dim);
  ASSERT_EQ(m.point.size(), d);
  ASSERT_EQ(m.box.size(), d);
  std::vector<double> values(k), J(k * d);
  m.function.evaluate(m.point, values);
  for (double v : values) EXPECT_NEAR(v, 0, 4e-15);
  for (int i = 0; i < d; ++i) {
    EXPECT_LT(m.box[i][0], m.point[i]);
    EXPECT_LT(m.point[i], m.box[i][1]);
  }
  m.function.jacobian(m.point, J);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::MatrixXd Df = Eigen::Map<const RowMajor>(J.data(), k, d);
  EXPECT_GT(Eigen::JacobiSVD<Eigen::MatrixXd>(Df).singularValues()[k - 1], 1e-2);
}

TEST(NamedManifolds, PointsAndDimensions) {
  check(sphere(2, 3), 3, 2);
  check(sphere(1, 2, 0.5), 2, 1);
  check(sphere(3, 6), 6, 3);
  check(flat_torus(), 4, 2);
  check(flat_torus(10), 10, 2);
  check(chair(), 3, 2);
  check(chair(5), 5, 2);
  check(pentagon_linkage(), 6, 2);
  check(cyclo_heptane(), 14, 1);
  check(so3_vectors(), 6, 3);
  check(trefoil(), 4, 1);
  check(two_spheres(), 3, 2);
  check(torus_of_revolution(), 3, 2);
  check(torus_of_revolution(1, 0.25), 3, 2);
}

TEST(NamedManifolds, EveryNameIsMade) {
  const std::vector<std::string> names = manifold_names();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const std::string& name : names) {
    const NamedManifold m = named_manifold(name);
    check(m, m.function.ambient_dim(), m.function.ambient_dim() - m.function.codim());
  }
}

TEST(NamedManifolds, Parameters) {
  check(named_manifold("sphere", {{"intrinsic_dim", 1}, {"ambient_dim", 4}, {"radius", 3}}), 4, 1);
  check(named_manifold("sphere", {{"intrinsic_dim", 4}}), 5, 4);
  check(named_manifold("flat_torus", {{"ambient_dim", 7}}), 7, 2);
  check(named_manifold("torus_of_revolution", {{"R", 5}, {"r", 0.5}}), 3, 2);
  std::vector<double> value(1);
  named_manifold("sphere", {{"radius", 0.1}}).function.evaluate(std::vector<double>{0.1, 0, 0}, value);
  EXPECT_EQ(value[0], 0);
  // A point of the tube that is not on the equator: angle 1 along, angle 2 around.
  const double R = 3, r = 0.7, rho = R + r * std::cos(2);
  torus_of_revolution(R, r).function.evaluate(
      std::vector<double>{rho * std::cos(1), rho * std::sin(1), r * std::sin(2)}, value);
  EXPECT_NEAR(value[0], 0, 1e-12);
}

TEST(NamedManifolds, Errors) {
  const auto message = [](const std::string& name, const std::map<std::string, double>& parameters = {}) {
    try {
      named_manifold(name, parameters);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  using testing::AllOf;
  using testing::HasSubstr;
  EXPECT_THAT(message("spere"), AllOf(HasSubstr("'spere'"), HasSubstr("sphere"), HasSubstr("chair")));
  EXPECT_THAT(message("klein_bottle"), AllOf(HasSubstr("not orientable"), HasSubstr("whitney triangulate")));
  EXPECT_THAT(message("projective_plane_projectors"), HasSubstr("whitney triangulate"));
  EXPECT_THAT(message("klein_quartic"), HasSubstr("charts"));
  EXPECT_THAT(message("sphere", {{"raduis", 1}}), AllOf(HasSubstr("raduis"), HasSubstr("radius")));
  EXPECT_THAT(message("trefoil", {{"p", 1}}), HasSubstr("none"));
  EXPECT_THAT(message("sphere", {{"intrinsic_dim", 1.5}}), HasSubstr("integer"));
  EXPECT_THAT(message("sphere", {{"radius", -1}}), HasSubstr("radius"));
  EXPECT_THAT(message("sphere", {{"radius", std::numeric_limits<double>::quiet_NaN()}}), HasSubstr("radius"));
  EXPECT_THAT(message("sphere", {{"intrinsic_dim", 3}, {"ambient_dim", 3}}), HasSubstr("ambient_dim"));
  EXPECT_THAT(message("flat_torus", {{"ambient_dim", 3}}), HasSubstr("at least 4"));
  EXPECT_THAT(message("torus_of_revolution", {{"R", 1}, {"r", 1}}), HasSubstr("r < R"));
}

}  // namespace
}  // namespace whitney
