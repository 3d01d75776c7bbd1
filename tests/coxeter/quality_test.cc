// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/quality.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>
#include <tests/coxeter/brute_force.h>

#include <coxeter/base/error.h>
#include <coxeter/triangulation.h>

namespace whitney::coxeter {
namespace {

Eigen::VectorXd position(const Triangulation& t, const LatticeVertex& v) {
  Eigen::VectorXd x(t.ambient_dim());
  t.cartesian(v, {x.data(), static_cast<std::size_t>(x.size())});
  return x;
}

/// Everything in Quality from the vertices of one d-simplex; what concerns the lattice from all vertices with lattice
/// coordinates within 2 of those of the simplex.
Quality brute_force_quality(const Triangulation& t, const Simplex& s) {
  const int d = t.ambient_dim();
  Quality q{};
  q.ambient_dim = d;
  Eigen::MatrixXd v(d + 1, d + 1);  // columns (1, vertex); the rows of the inverse are (value at 0, grad lambda_i)
  for (int i = 0; i <= d; ++i) v.col(i) << 1, position(t, s.vertex(i));
  q.shortest_edge = INFINITY;
  for (int i = 0; i <= d; ++i)
    for (int j = 0; j < i; ++j) {
      q.longest_edge = std::max(q.longest_edge, (v.col(i) - v.col(j)).norm());
      q.shortest_edge = std::min(q.shortest_edge, (v.col(i) - v.col(j)).norm());
    }
  const Eigen::MatrixXd gradients = v.inverse().rightCols(d);
  q.smallest_altitude = 1 / gradients.rowwise().norm().maxCoeff();
  q.thickness = q.smallest_altitude / q.longest_edge;
  q.inradius = 1 / gradients.rowwise().norm().sum();  // the point with lambda_i proportional to |grad lambda_i|
  double steepest = 0;
  for (int mask = 1; mask < (1 << (d + 1)) - 1; ++mask) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(d);
    for (int i = 0; i <= d; ++i)
      if (mask >> i & 1) sum += gradients.row(i);
    steepest = std::max(steepest, sum.norm());
  }
  q.width = 1 / steepest;

  Eigen::MatrixXd edges(d, d);
  Eigen::VectorXd right(d);
  for (int i = 0; i < d; ++i) {
    edges.row(i) = 2 * (v.col(i + 1) - v.col(0)).tail(d);
    right[i] = v.col(i + 1).tail(d).squaredNorm() - v.col(0).tail(d).squaredNorm();
  }
  const Eigen::VectorXd centre = edges.lu().solve(right);
  q.circumradius = (centre - v.col(0).tail(d)).norm();

  const auto own = testing::vertex_set(s);
  double next = INFINITY;
  LatticeVertex z(d);
  for (int code = 0, codes = static_cast<int>(std::pow(6, d)); code < codes; ++code) {
    for (int c = 0, rest = code; c < d; ++c, rest /= 6) z[c] = s.base()[c] + rest % 6 - 2;
    const Eigen::VectorXd x = position(t, z);
    if (!own.contains(z)) next = std::min(next, (x - centre).norm());
    if (z != s.base()) q.shortest_edge = std::min(q.shortest_edge, (x - v.col(0).tail(d)).norm());
  }
  q.protection = std::max(0.0, next - q.circumradius);
  return q;
}

void expect_near(const Quality& a, const Quality& b) {
  constexpr double kTolerance = 1e-12;
  EXPECT_EQ(a.ambient_dim, b.ambient_dim);
  EXPECT_NEAR(a.longest_edge, b.longest_edge, kTolerance);
  EXPECT_NEAR(a.shortest_edge, b.shortest_edge, kTolerance);
  EXPECT_NEAR(a.smallest_altitude, b.smallest_altitude, kTolerance);
  EXPECT_NEAR(a.thickness, b.thickness, kTolerance);
  EXPECT_NEAR(a.width, b.width, kTolerance);
  EXPECT_NEAR(a.circumradius, b.circumradius, kTolerance);
  EXPECT_NEAR(a.inradius, b.inradius, kTolerance);
  EXPECT_NEAR(a.protection, b.protection, kTolerance);
}

TEST(Quality, ClosedFormsAgreeWithBruteForce) {
  std::mt19937 gen(1);
  for (int d = 1; d <= 6; ++d)
    for (int i = 0; i < 3; ++i) {  // all d-simplices are congruent
      const Simplex s = testing::random_simplex(d, d, gen, 3);
      expect_near(coxeter_a_quality(d, 0.7), brute_force_quality(coxeter_a(d, 0.7), s));
      expect_near(freudenthal_quality(d, 0.7), brute_force_quality(freudenthal(d, 0.7), s));
    }
}

TEST(Quality, NoSlabIsNarrowerThanTheWidth) {
  std::mt19937 gen(2);
  std::normal_distribution<double> normal;
  for (int d = 2; d <= 5; ++d)
    for (const bool coxeter : {true, false}) {
      const Triangulation t = coxeter ? coxeter_a(d, 1) : freudenthal(d, 1);
      const double width = coxeter ? coxeter_a_quality(d, 1).width : freudenthal_quality(d, 1).width;
      const Simplex s = testing::random_simplex(d, d, gen, 3);
      for (int i = 0; i < 3000; ++i) {
        Eigen::VectorXd e(d);
        for (double& c : e) c = normal(gen);
        e.normalize();
        double low = INFINITY, high = -INFINITY;
        for (const auto& v : s.vertices()) {
          low = std::min(low, e.dot(position(t, v)));
          high = std::max(high, e.dot(position(t, v)));
        }
        EXPECT_GE(high - low, width * (1 - 1e-12));
      }
    }
}

TEST(Quality, WidthOverEdgeLength) {
  for (const int d : {1, 3, 9, 399}) EXPECT_NEAR(coxeter_a_quality(d, 1).width * (d + 1) / 2, 1, 1e-14);
  for (const int d : {2, 4, 10, 400})
    EXPECT_NEAR(coxeter_a_quality(d, 1).width * d * std::sqrt(d + 2.0) / (2 * std::sqrt(d + 1.0)), 1, 1e-14);
}

TEST(Quality, ThicknessOfTheErratum) {
  EXPECT_NEAR(coxeter_a_quality(3, 5).thickness, std::sqrt(0.5), 1e-15);  // BKW20 (3) prints sqrt(2/3)
}

TEST(Quality, RejectsBadInput) {
  EXPECT_THROW(coxeter_a_quality(0, 1), InvalidInput);
  EXPECT_THROW(freudenthal_quality(3, 0), InvalidInput);
  EXPECT_THROW(freudenthal_quality(3, std::nan("")), InvalidInput);
}

TEST(SimplexWidth, IsTheClosedFormForMovedCoxeterAndFreudenthal) {
  for (int d = 1; d <= 9; ++d) {
    Eigen::MatrixXd Q = Eigen::MatrixXd::Identity(d, d);
    for (int c = 0; c + 1 < d; ++c) {
      Eigen::MatrixXd plane = Eigen::MatrixXd::Identity(d, d);
      plane(c, c) = plane(c + 1, c + 1) = std::cos(0.4 + c);
      plane(c, c + 1) = -(plane(c + 1, c) = std::sin(0.4 + c));
      Q = plane * Q;
    }
    for (const double L : {1.0, 1e-9, 3e7}) {
      const std::vector<double> b(d, 0.3 * L);
      const double coxeter_width = coxeter_a_quality(d, L).width, freudenthal_width = freudenthal_quality(d, L).width;
      for (const auto& T : {coxeter_a(d, L), coxeter_a(d, L).transformed(Q, b)}) {
        EXPECT_LE(simplex_width(T), coxeter_width) << d;
        EXPECT_GE(simplex_width(T), coxeter_width * (1 - 2e-6)) << d;
      }
      for (const auto& T : {freudenthal(d, L), freudenthal(d, L).transformed(Q, b)}) {
        EXPECT_LE(simplex_width(T), freudenthal_width) << d;
        EXPECT_GE(simplex_width(T), freudenthal_width * (1 - 2e-6)) << d;
      }
    }
  }
}

TEST(SimplexWidth, OfAnyAffineImageByAllSimplices) {
  // 1 / the longest sum of gradients of barycentric coordinates, over all sets of vertices of all d! simplices at 0.
  for (int d = 2; d <= 4; ++d) {
    Eigen::MatrixXd A(d, d);
    for (int i = 0; i < d; ++i)
      for (int j = 0; j < d; ++j) A(i, j) = (i == j ? 1.3 + i : 0) + 0.37 * std::sin(1 + 3 * i + 7 * j);
    const Triangulation T(A, std::vector<double>(d));
    std::vector<int> order(d);
    std::iota(order.begin(), order.end(), 0);
    double longest = 0;
    do {
      Eigen::MatrixXd system(d + 1, d + 1);  // columns (1, v_q); rows of the inverse: (constant, grad lambda_q)
      system.row(0).setOnes();
      Eigen::VectorXd z = Eigen::VectorXd::Zero(d);
      for (int q = 0; q <= d; ++q) {
        system.col(q).tail(d) = A * z;
        if (q < d) z[order[q]] += 1;
      }
      const Eigen::MatrixXd gradients = system.inverse().rightCols(d);
      for (int set = 1; set < 1 << (d + 1); ++set) {
        Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(d);
        for (int q = 0; q <= d; ++q)
          if (set >> q & 1) sum += gradients.row(q);
        longest = std::max(longest, sum.norm());
      }
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_LE(simplex_width(T), 1 / longest);
    EXPECT_GE(simplex_width(T), (1 - 2e-6) / longest);
  }
  Eigen::MatrixXd skew = Eigen::MatrixXd::Identity(13, 13);
  skew(0, 1) = 0.5;
  EXPECT_THROW(simplex_width(Triangulation(skew, std::vector<double>(13))), InvalidInput);
}

/// The width for the linear part c I + J, from the inverse in closed form, in long double.
long double width_of_sum(int d, long double c) {
  // Gram matrix c^2 I + (2 c + d) J.
  const long double a = c * c, b = 2 * c + d, beta = -b / (a + d * b) / a;
  long double largest = 0;
  for (int ones = 0; ones <= d; ++ones)
    for (int minus = std::max(0, ones - 1); minus <= ones + 1 && ones + minus <= d; ++minus)
      largest = std::max(largest, (ones + minus) / a + beta * (ones - minus) * (ones - minus));
  return 1 / std::sqrt(largest);
}

TEST(SimplexWidth, IsALowerBoundHoweverIllConditioned) {
  for (const int d : {2, 3, 5, 8})
    for (const double shift : {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11}) {
      const double diagonal = 1 + shift;
      Eigen::MatrixXd A = Eigen::MatrixXd::Ones(d, d);
      A.diagonal().setConstant(diagonal);
      const long double exact = width_of_sum(d, static_cast<long double>(diagonal) - 1);  // no rounding
      const double bound = simplex_width(Triangulation(A, std::vector<double>(d)));
      EXPECT_LE(bound, exact) << d << " " << shift;
      EXPECT_GE(bound, exact * (1 - 2e-6L - 1e-12L / shift)) << d << " " << shift;
    }
}

TEST(SimplexWidth, ClaimsLittleNextToSingularMaps) {
  const int d = 5;
  const double diagonal = 1 + 1e-13;
  Eigen::MatrixXd A = Eigen::MatrixXd::Ones(d, d);
  A.diagonal().setConstant(diagonal);
  const double bound = simplex_width(Triangulation(A, std::vector<double>(d)));
  EXPECT_GE(bound, 0);
  EXPECT_LE(bound, width_of_sum(d, static_cast<long double>(diagonal) - 1));
}

TEST(SimplexWidth, IsALowerBoundInHighDimensionsToo) {
  const int d = 16;
  for (const double shift : {1e-5, 1e-7}) {
    const double diagonal = 1 + shift;
    Eigen::MatrixXd A = Eigen::MatrixXd::Ones(d, d);
    A.diagonal().setConstant(diagonal);
    const long double exact = width_of_sum(d, static_cast<long double>(diagonal) - 1);
    const double bound = simplex_width(Triangulation(A, std::vector<double>(d)));
    EXPECT_LE(bound, exact);
    EXPECT_GE(bound, exact / 5);
  }
}

}  // namespace
}  // namespace whitney::coxeter
