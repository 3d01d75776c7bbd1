// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/displacement.h>

#include <cmath>
#include <limits>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <coxeter/faces/cofaces.h>

namespace whitney::perturbation {
namespace {

using coxeter::LatticeVertex;

TEST(DisplacementMap, SetFindReplace) {
  DisplacementMap u(2);
  EXPECT_TRUE(u.find({0, 0}).empty());
  u.set({0, 0}, std::vector{0.25, 0.5});
  u.set({3, -1}, std::vector{1.0, 2.0});
  u.set({0, 0}, std::vector{-0.25, -0.5});
  EXPECT_EQ(u.size(), 2u);
  EXPECT_EQ(u.find({0, 0})[1], -0.5);
  EXPECT_EQ(u.displacement(1)[0], 1.0);
  EXPECT_EQ(u.vertices()[1], (LatticeVertex{3, -1}));
}

TEST(DisplacementMap, PositionAddsToTheTriangulation) {
  const auto t = coxeter::freudenthal(4, 2);
  DisplacementMap u(4);
  u.set({1, 2, 3, 4}, std::vector{0.5, 0.0, 0.0, -0.25});
  EXPECT_EQ(position(t, u, {1, 2, 3, 4}), (std::vector<double>{1.5, 2, 3, 3.75}));
  EXPECT_EQ(position(t, u, {1, 2, 3, 5}), (std::vector<double>{1, 2, 3, 5}));
}

TEST(DisplacementMap, RejectsBadInput) {
  EXPECT_THROW(DisplacementMap(0), InvalidInput);
  DisplacementMap u(2);
  EXPECT_THROW(u.set({0, 0, 0}, std::vector{1.0, 2.0}), InvalidInput);
  EXPECT_THROW(u.set({0, 0}, std::vector{1.0}), InvalidInput);
  EXPECT_THROW(u.set({0, 0}, std::vector{1.0, std::nan("")}), InvalidInput);
  EXPECT_EQ(u.size(), 0u);
  EXPECT_THROW(position(coxeter::coxeter_a(3, 1), u, LatticeVertex(3)), InvalidInput);
  EXPECT_THROW(check_embedding(u, 0), InvalidInput);
  EXPECT_THROW(check_embedding(u, std::nan("")), InvalidInput);
}

TEST(Embedding, BoundIsTheWidth) {
  // certificate.md: w/L = 2/(d+1) for odd d, so rho may reach almost L/4 at d = 3.
  const double bound = embedding_bound(coxeter::coxeter_a_quality(3, 1));
  EXPECT_LE(bound, 0.5);
  EXPECT_NEAR(bound, 0.5, 1e-14);
}

TEST(Embedding, ShortCutAndEdges) {
  DisplacementMap u(2);
  EXPECT_EQ(check_embedding(u, 1).verdict, Embedding::kProven);
  u.set({0, 0}, std::vector{0.25, 0.0});
  u.set({1, 1}, std::vector{-0.25, 0.0});
  EmbeddingCheck check = check_embedding(u, 0.75);
  EXPECT_EQ(check.verdict, Embedding::kProven);
  EXPECT_NEAR(check.largest_displacement, 0.25, 1e-15);
  EXPECT_NEAR(check.largest_difference, 0.5, 1e-15);
  // Exactly on the bound is not below it.
  check = check_embedding(u, 0.5);
  EXPECT_EQ(check.verdict, Embedding::kNotProven);
  EXPECT_EQ(check.witness->first, (LatticeVertex{0, 0}));
  EXPECT_EQ(check.witness->second, (LatticeVertex{1, 1}));
  // Opposite displacements of vertices without a common edge do not matter.
  DisplacementMap far(2);
  far.set({0, 0}, std::vector{0.25, 0.0});
  far.set({1, -1}, std::vector{-0.25, 0.0});
  EXPECT_EQ(check_embedding(far, 0.5).verdict, Embedding::kProven);
  // Nor do equal displacements of neighbours, but the undisplaced ones around do.
  DisplacementMap shift(2);
  shift.set({0, 0}, std::vector{0.5, 0.0});
  shift.set({0, 1}, std::vector{0.5, 0.0});
  EXPECT_EQ(check_embedding(shift, 0.75).verdict, Embedding::kProven);
  check = check_embedding(shift, 0.5);
  EXPECT_EQ(check.verdict, Embedding::kNotProven);
  EXPECT_EQ(check.witness->first, check.witness->second);
}

TEST(Embedding, PairsAndNeighboursAgree) {
  std::mt19937 gen(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int round = 0; round < 40; ++round) {
    // 3 x 3 x 3 vertices: more than 2^3, so by neighbours. The same embedded in R^5 (fewer than 2^5): by pairs.
    DisplacementMap low(3), high(5);
    for (int i = 0; i < 27; ++i) {
      const std::vector<double> u{uniform(gen), uniform(gen), uniform(gen)};
      low.set({i % 3, i / 3 % 3, i / 9}, u);
      high.set({i % 3, i / 3 % 3, i / 9, 7, 7}, std::vector{u[0], u[1], u[2], 0.0, 0.0});
    }
    const auto a = check_embedding(low, 2.3), b = check_embedding(high, 2.3);
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_NEAR(a.largest_difference, b.largest_difference, 1e-14);
  }
}

TEST(Embedding, RoundingIsOutward) {
  // Squares that underflow: the true length is 2e-200.
  DisplacementMap u(1);
  u.set({0}, std::vector{2e-200});
  EXPECT_GE(check_embedding(u, 1).largest_displacement, 2e-200);
  EXPECT_EQ(check_embedding(u, 1e-200).verdict, Embedding::kNotProven);
  // Squares that overflow.
  u.set({0}, std::vector{1e200});
  EXPECT_EQ(check_embedding(u, 1e300).verdict, Embedding::kNotProven);
}

TEST(Embedding, ExtremeVerticesHaveNoNeighbourBeyondTheRange) {
  constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();
  DisplacementMap u(1);
  for (std::int32_t z : {kMax, kMax - 1, kMax - 2, std::numeric_limits<std::int32_t>::min()})
    u.set({z}, std::vector{0.6});
  EXPECT_EQ(check_embedding(u, 1).verdict, Embedding::kProven);
}

/// Smallest ratio of the signed volumes of the displaced and the original d-simplices around a vertex.
double least_volume_ratio(const coxeter::Triangulation& t, const DisplacementMap& u, const LatticeVertex& centre) {
  const int d = t.ambient_dim();
  std::vector<int> all;
  for (int i = 0; i <= d; ++i) all.push_back(i);
  const coxeter::Simplex vertex(centre, coxeter::OrderedPartition::from_parts({all}));
  const DisplacementMap none(d);
  double least = std::numeric_limits<double>::infinity();
  for_each_coface(vertex, d, [&](const coxeter::Simplex& s) {
    Eigen::MatrixXd before(d, d), after(d, d);
    const auto v = s.vertices();
    for (int i = 0; i < d; ++i) {
      before.col(i) =
          as_eigen(position(t, none, v[static_cast<std::size_t>(i) + 1])) - as_eigen(position(t, none, v[0]));
      after.col(i) = as_eigen(position(t, u, v[static_cast<std::size_t>(i) + 1])) - as_eigen(position(t, u, v[0]));
    }
    least = std::min(least, after.determinant() / before.determinant());
  });
  return least;
}

TEST(Embedding, NothingFoldsBelowTheBoundAndSomethingDoesAboveIt) {
  std::mt19937 gen(2);
  std::normal_distribution<double> normal;
  for (int d = 2; d <= 5; ++d) {
    const auto t = coxeter::coxeter_a(d, 1);
    const double bound = embedding_bound(coxeter::coxeter_a_quality(d, 1));
    for (int round = 0; round < 10; ++round) {
      DisplacementMap u(d);
      LatticeVertex v(d);
      for (int code = 0; code < static_cast<int>(std::pow(3, d)); ++code) {
        for (int c = 0, rest = code; c < d; ++c, rest /= 3) v[c] = rest % 3 - 1;
        Eigen::VectorXd x(d);
        for (double& c : x) c = normal(gen);
        x *= 0.4999 * bound / x.norm();
        u.set(v, {x.data(), static_cast<std::size_t>(d)});
      }
      ASSERT_EQ(check_embedding(u, bound).verdict, Embedding::kProven);
      EXPECT_GT(least_volume_ratio(t, u, LatticeVertex(d)), 0);
    }
    // Sharpness: against the gradient of the widest sum of barycentric coordinates, a little more than the width
    // between the two classes of vertices of one simplex turns it over. The classes alternate along the chain.
    DisplacementMap fold(d);
    const int num_vertices = d + 1;
    std::vector<LatticeVertex> chain(static_cast<std::size_t>(num_vertices), LatticeVertex(d));
    for (int q = 1; q <= d; ++q)
      for (int c = 0; c < q; ++c) chain[static_cast<std::size_t>(q)][c] = 1;
    Eigen::MatrixXd corners(num_vertices, num_vertices);
    for (int q = 0; q <= d; ++q) corners.col(q) << 1, as_eigen(position(t, fold, chain[static_cast<std::size_t>(q)]));
    const Eigen::MatrixXd gradients = corners.inverse().rightCols(d);
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(d);
    for (int q = 0; q < (num_vertices % 2 ? d : num_vertices); q += 2) slope += gradients.row(q);
    EXPECT_NEAR(1 / slope.norm(), bound, 1e-12);
    for (int q = 0; q <= d; ++q) {
      const bool raised = q % 2 == 0 && !(num_vertices % 2 && q == d);
      const Eigen::VectorXd x = slope.normalized() * (raised ? -0.5001 : 0.5001) * bound;
      fold.set(chain[static_cast<std::size_t>(q)], {x.data(), static_cast<std::size_t>(d)});
    }
    EXPECT_EQ(check_embedding(fold, bound).verdict, Embedding::kNotProven);
    EXPECT_LT(least_volume_ratio(t, fold, LatticeVertex(d)), 0);
  }
}

}  // namespace
}  // namespace whitney::perturbation
