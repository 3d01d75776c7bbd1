// SPDX-License-Identifier: GPL-3.0-or-later
// The errata of BKW20 are checked one by one, by counting, measuring and random trials.
#include <perturbation/parameters.h>

#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <tests/coxeter/brute_force.h>

#include <coxeter/base/error.h>
#include <coxeter/counts.h>
#include <coxeter/triangulation.h>
#include <perturbation/min_norm_point.h>
#include <perturbation/vertex_subsets.h>

namespace whitney::perturbation {
namespace {

constexpr Variant kBoth[] = {Variant::kAsPrinted, Variant::kCorrected};

double value(const WhitneyParameters& p, const std::string& symbol) {
  for (const Parameter& parameter : p.list)
    if (parameter.symbol == symbol) return std::pow(10, parameter.log10);
  ADD_FAILURE() << symbol;
  return 0;
}

/// The part of the unit d-ball between two hyperplanes at distance half_width from its centre, by the trapezoidal rule
/// after x = sin(t), which makes the integrand smooth.
double slab_fraction(int d, double half_width) {
  const auto integral = [&](double end) {
    const int steps = 4000;
    double sum = 0;
    for (int i = 0; i <= steps; ++i)
      sum += std::pow(std::cos(end * (2.0 * i / steps - 1)), d) * (i == 0 || i == steps ? 0.5 : 1);
    return sum * 2 * end / steps;
  };
  return integral(std::asin(half_width)) / integral(std::acos(-1) / 2);
}

TEST(Parameters, GiveTheQuotedEdgeLengths) {
  // The exponents quoted for the paper, for curves in the plane and surfaces in R^3 and R^4.
  const auto exponent = [](int d, int n) {
    return std::lround(whitney_parameters(d, n, Variant::kAsPrinted).log10_edge_length_over_reach);
  };
  EXPECT_EQ(exponent(2, 1), -20);
  EXPECT_EQ(exponent(3, 2), -31);
  EXPECT_EQ(exponent(4, 2), -68);
}

TEST(Parameters, RadiusAtD3) {
  EXPECT_NEAR(value(whitney_parameters(3, 2, Variant::kAsPrinted), "c~"), 0.0080, 5e-5);
  EXPECT_NEAR(value(whitney_parameters(3, 2, Variant::kCorrected), "c~"), 0.0069, 5e-5);
  // What our embedding proof allows: almost L / 4.
  EXPECT_NEAR(value(whitney_parameters(3, 2, Variant::kCorrected), "w/(2L)"), 0.25, 1e-12);
}

TEST(Parameters, ThicknessByBruteForce) {
  for (int d = 2; d <= 7; ++d) {
    const auto t = coxeter::coxeter_a(d, 1);
    Eigen::MatrixXd corners = Eigen::MatrixXd::Ones(d + 1, d + 1);
    for (int q = 0; q <= d; ++q) {
      coxeter::LatticeVertex z(d);
      for (int c = 0; c < q; ++c) z[c] = 1;
      Eigen::VectorXd x(d);
      t.cartesian(z, {x.data(), static_cast<std::size_t>(d)});
      corners.col(q).tail(d) = x;
    }
    // The rows of the inverse are the gradients of the barycentric coordinates, and an altitude is 1 / abs(gradient).
    const double altitude = 1 / corners.inverse().rightCols(d).rowwise().norm().maxCoeff();
    double longest = 0;
    for (int i = 0; i <= d; ++i)
      for (int j = 0; j < i; ++j) longest = std::max(longest, (corners.col(i) - corners.col(j)).norm());
    EXPECT_NEAR(value(whitney_parameters(d, 1, Variant::kCorrected), "t"), altitude / longest, 1e-12) << d;
    const double printed = value(whitney_parameters(d, 1, Variant::kAsPrinted), "t");
    EXPECT_NEAR(printed, d % 2 == 1 ? std::sqrt(2.0 / d) : altitude / longest, 1e-12) << d;
  }
}

TEST(Parameters, FacesAroundAVertexByBruteForce) {
  for (int d = 2; d <= 4; ++d) {
    double around = 0;
    for (int j = 0; j < d; ++j) {
      around += static_cast<double>(coxeter::testing::brute_force_cofaces({coxeter::LatticeVertex(d)}, j).size());
      const int n = d - 1 - j;
      if (n < 1) continue;
      EXPECT_NEAR(value(whitney_parameters(d, n, Variant::kCorrected), "N"), 1 + around, 1e-9 * around);
      // What is printed falls short as soon as edges count (the 2 is the empty face and the vertex).
      const double printed = value(whitney_parameters(d, n, Variant::kAsPrinted), "N");
      if (j == 0)
        EXPECT_NEAR(printed, 1 + around, 1e-9);
      else
        EXPECT_LT(printed, 1 + around);
    }
  }
  EXPECT_EQ(coxeter::testing::brute_force_cofaces({coxeter::LatticeVertex(2)}, 1).size(), 6u);
}

TEST(Parameters, SlabsLeaveHalfTheBall) {
  for (int d = 2; d <= 12; ++d)
    for (int n = 1; n < d; ++n) {
      for (const Variant variant : kBoth) {
        const WhitneyParameters p = whitney_parameters(d, n, variant);
        const double num = value(p, "N"), filled = num * slab_fraction(d, value(p, "rho_1"));
        if (variant == Variant::kCorrected) {
          EXPECT_LE(filled, 0.5 + 1e-9) << d << " " << n;
          EXPECT_GE(filled, 0.45) << d << " " << n;
        } else if (d >= 6 && num > 10) {
          EXPECT_GT(filled, 0.5) << d << " " << n;  // the printed formula is inverted
        } else if (d <= 5) {
          EXPECT_LT(filled, 0.5) << d << " " << n;
        }
      }
    }
  // Closed forms: pi / (8 N) and 1 / (3 N), N = 2.
  EXPECT_NEAR(value(whitney_parameters(2, 1, Variant::kCorrected), "rho_1"), std::acos(-1) / 16, 1e-12);
  EXPECT_NEAR(value(whitney_parameters(3, 2, Variant::kCorrected), "rho_1"), 1.0 / 6, 1e-12);
  // As implementations of the paper quote it: 1 / (2 pi N) and 3 / (16 N).
  EXPECT_NEAR(value(whitney_parameters(2, 1, Variant::kAsPrinted), "rho_1"), 0.25 / std::acos(-1), 1e-12);
  EXPECT_NEAR(value(whitney_parameters(3, 2, Variant::kAsPrinted), "rho_1"), 3.0 / 32, 1e-12);
}

TEST(Parameters, AVertexIsNoFurtherFromAPlaneThanItWasPlaced) {
  // M a plane, so M = T_p M: a vertex placed by (19) at rho_1 c~ L may have exactly this distance from M.
  for (int d = 2; d <= 9; ++d) {
    const WhitneyParameters printed = whitney_parameters(d, 1, Variant::kAsPrinted);
    const WhitneyParameters corrected = whitney_parameters(d, 1, Variant::kCorrected);
    EXPECT_GT(value(printed, "alpha_1"), value(printed, "rho_1 c~"));
    EXPECT_LT(value(corrected, "alpha_1"), value(corrected, "rho_1 c~"));
    EXPECT_EQ(corrected.log10_alpha[0], 0);
    for (const WhitneyParameters& p : {printed, corrected})
      for (int k = 2; k < d; ++k)
        EXPECT_NEAR(value(p, "alpha_" + std::to_string(k)) / value(p, "alpha_" + std::to_string(k - 1)),
                    2 * value(p, "rho_1 c~") / 3, 1e-9);
  }
}

TEST(Parameters, TheJoinWithAVertexKeepsItsDistance) {
  // The recursion behind (8): a face at distance a from the plane, a vertex at distance D from the span of both, and
  // edges of length at most E give a join at distance at least a D / E; E < 13 L / 12 and what M departs leave 2/3.
  std::mt19937 gen(1);
  std::normal_distribution<double> normal;
  MinNormPoint min_norm;
  for (int round = 0; round < 2000; ++round) {
    const int k = 2 + round % 3, num = 1 + round % (k - 1);
    Eigen::MatrixXd points(k, num + 1);  // normal parts of the face and, last, of the vertex
    for (double& c : points.reshaped()) c = normal(gen);
    points.leftCols(num) *= std::pow(10, -2 * std::abs(normal(gen)));
    std::vector<const double*> pointers;
    double edge = 0;
    for (int i = 0; i <= num; ++i) {
      pointers.push_back(points.data() + i * k);
      edge = std::max(edge, (points.col(i) - points.col(num)).norm());
    }
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::vector<double> lambda(num + 1), x(k);
    const double a = min_norm(pointers.data(), num, k, kInfinity, lambda.data(), x.data());
    const double join = min_norm(pointers.data(), num + 1, k, kInfinity, lambda.data(), x.data());
    const Eigen::MatrixXd face = points.leftCols(num);
    const Eigen::VectorXd vertex = points.col(num);
    const double distance = (vertex - face * face.colPivHouseholderQr().solve(vertex)).norm();
    EXPECT_GE(join, std::min(a / edge, 1.0) * distance * (1 - 1e-6));
  }
}

/// The largest number of (d-n)-faces of a d-simplex hit by one of many random n-planes.
int most_hit_faces(int d, int n, std::mt19937& gen) {
  std::normal_distribution<double> normal;
  const int k = d - n;
  const VertexSubsets faces(d, k);
  int most = 0;
  for (int round = 0; round < 20000; ++round) {
    Eigen::MatrixXd P(k, d + 1);
    for (double& c : P.reshaped()) c = normal(gen);
    int hits = 0;
    for (std::size_t f = 0; f < faces.num(); ++f) {
      Eigen::MatrixXd A = Eigen::MatrixXd::Ones(k + 1, k + 1);
      for (int j = 0; j <= k; ++j) A.col(j).head(k) = P.col(faces[f][j]);
      hits += (A.partialPivLu().solve(Eigen::VectorXd::Unit(k + 1, k)).array() >= 0).all();
    }
    most = std::max(most, hits);
  }
  return most;
}

TEST(Parameters, HowManyFacesAPlaneHits) {
  std::mt19937 gen(2);
  // {d, n, vertices of a simple n-polytope with d + 1 facets at most (McMullen)}
  constexpr int kCases[][3] = {{2, 1, 2}, {3, 1, 2}, {3, 2, 4}, {4, 1, 2}, {4, 2, 5}, {4, 3, 6}, {5, 3, 8}};
  for (const auto& [d, n, most] : kCases) {
    EXPECT_EQ(most_hit_faces(d, n, gen), most) << d << " " << n;
    EXPECT_LE(most, coxeter::num_faces(d, n - 1));                            // C(d+1, n)
    EXPECT_EQ(most > coxeter::num_faces(d - 1, n - 1), n == d - 1 && d > 2);  // C(d, n) fails for hypersurfaces
  }
}

TEST(Parameters, EdgeLengthSolvesItsEquation) {
  for (const Variant variant : kBoth)
    for (const auto& [d, n] : {std::pair(2, 1), std::pair(4, 2), std::pair(5, 2)}) {
      const WhitneyParameters p = whitney_parameters(d, n, variant, 100);
      // (1 - sqrt(1 - 36 x^2)) / x = 18 x (1 + O(x^2)).
      EXPECT_NEAR(std::log10(value(p, "h(6L)/L")), p.log10_edge_length_over_reach + std::log10(18), 1e-9);
      EXPECT_NEAR(p.log10_edge_length, p.log10_edge_length_over_reach + 2, 1e-12);
      EXPECT_LT(p.log10_edge_length_over_reach, 2 * p.log10_alpha.back() - std::log10(54));  // (12) implies (13)
      EXPECT_LE(value(p, "c~"), 1.0 / 24);                                                   // (7)
      EXPECT_LE(value(p, "L~/L"), 13.0 / 12);
    }
}

TEST(Parameters, LogarithmsStayFinite) {
  for (const Variant variant : kBoth)
    for (const int n : {1, 70, 139}) {
      const WhitneyParameters p = whitney_parameters(140, n, variant);
      for (const Parameter& parameter : p.list) EXPECT_TRUE(std::isfinite(parameter.log10)) << parameter.symbol;
    }
}

TEST(Parameters, TheVariantsListTheSame) {
  const auto a = whitney_parameters(5, 2, Variant::kAsPrinted), b = whitney_parameters(5, 2, Variant::kCorrected);
  ASSERT_EQ(a.list.size(), b.list.size());
  for (std::size_t i = 0; i < a.list.size(); ++i) {
    EXPECT_EQ(a.list[i].symbol, b.list[i].symbol);
    EXPECT_EQ(a.list[i].equation, b.list[i].equation);
  }
}

TEST(Parameters, RejectBadInput) {
  EXPECT_THROW(whitney_parameters(2, 0, Variant::kCorrected), InvalidInput);
  EXPECT_THROW(whitney_parameters(2, 2, Variant::kCorrected), InvalidInput);
  EXPECT_THROW(whitney_parameters(141, 2, Variant::kCorrected), InvalidInput);
  for (const double reach : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(whitney_parameters(3, 2, Variant::kCorrected, reach), InvalidInput);
}

}  // namespace
}  // namespace whitney::perturbation
