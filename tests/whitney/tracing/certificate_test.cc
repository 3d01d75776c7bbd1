// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/certificate.h>

#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/functions/expression.h>
#include <whitney/topology/topology.h>
#include <whitney/tracing/trace.h>

namespace whitney {
namespace {

using coxeter::Triangulation;
using Verdict = IsotopyCertificate::Verdict;

struct Problem {
  std::vector<std::string> variables, equations;
  std::vector<double> seed;
};

std::vector<std::string> coordinates(int d) {
  std::vector<std::string> names;
  for (int i = 1; i <= d; ++i) names.push_back("x" + std::to_string(i));
  return names;
}

Problem sphere(int n, int d) {
  Problem p{coordinates(d), {"-1"}, std::vector<double>(d, 0.0)};
  for (int i = 1; i <= n + 1; ++i) p.equations[0] += "+x" + std::to_string(i) + "^2";
  for (int i = n + 2; i <= d; ++i) p.equations.push_back("x" + std::to_string(i));
  p.seed[0] = 1;
  return p;
}

Problem in_space(std::string equation, std::vector<double> seed) {
  return {{"x", "y", "z"}, {std::move(equation)}, std::move(seed)};
}
Problem in_plane(std::string equation, std::vector<double> seed) {
  return {{"x", "y"}, {std::move(equation)}, std::move(seed)};
}

Triangulation random_triangulation(int d, double edge_length, int rng_seed) {
  std::mt19937_64 rng(rng_seed * 7919 + 13);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd matrix(d, d);
  for (int i = 0; i < d * d; ++i) matrix.data()[i] = normal(rng);
  const Eigen::MatrixXd rotation = Eigen::HouseholderQR<Eigen::MatrixXd>(matrix).householderQ();
  std::vector<double> shift(d);
  for (int i = 0; i < d; ++i) shift[i] = edge_length * normal(rng);
  return coxeter::coxeter_a(d, edge_length).transformed(rotation, shift);
}

struct TraceAndCertificate {
  TraceResult trace;
  IsotopyCertificate certificate;
};

TraceAndCertificate run(const Problem& p, double edge_length, int rng_seed, const TraceOptions& options = {}) {
  const Triangulation triangulation = random_triangulation(int(p.variables.size()), edge_length, rng_seed);
  TraceResult traced = trace(parse_equations(p.variables, p.equations), triangulation, p.seed, options);
  IsotopyCertificate certificate =
      certify_trace(Enclosure::of_expressions(p.variables, p.equations), triangulation, traced);
  return {std::move(traced), std::move(certificate)};
}

void expect_certified(const Problem& p, double edge_length, double largest_distance) {
  for (int rng_seed = 0; rng_seed < 5; ++rng_seed) {
    const IsotopyCertificate c = run(p, edge_length, rng_seed).certificate;
    EXPECT_TRUE(c.is_certified()) << p.equations[0] << " seed " << rng_seed << ": " << c.reason << "; radius "
                                  << c.worst_radius << ", drop " << c.worst_drop << ", failing " << c.num_failing << "/"
                                  << c.num_stars << ", try " << c.advised_edge_length;
    EXPECT_TRUE(c.has_exact_constants);
    EXPECT_LT(c.distance_bound, largest_distance);
    EXPECT_GT(c.distance_bound, 0);
  }
}

TEST(Certificate, SphereInSpace) { expect_certified(sphere(2, 3), 0.7, 0.6); }
TEST(Certificate, SphereInSixSpace) { expect_certified(sphere(2, 6), 0.6, 0.6); }
TEST(Certificate, ThreeSphereInSixSpace) { expect_certified(sphere(3, 6), 0.5, 0.6); }
TEST(Certificate, FlatTorus) {
  expect_certified({coordinates(4), {"x1^2+x2^2-1", "x3^2+x4^2-1"}, {1, 0, 1, 0}}, 0.5, 0.6);
}
TEST(Certificate, TorusOfRevolution) {
  expect_certified(in_space("(x^2+y^2+z^2+3)^2-16*(x^2+y^2)", {3, 0, 0}), 0.25, 0.6);
}
TEST(Certificate, Trefoil) {
  const double r = 0.7549;  // r^2 + r^3 = 1
  expect_certified({{"x1", "y1", "x2", "y2"},
                    {"x1^2-y1^2+x2^3-3*x2*y2^2", "2*x1*y1+3*x2^2*y2-y2^3", "x1^2+y1^2+x2^2+y2^2-1"},
                    {0, std::sqrt(1 - r * r), r, 0}},
                   0.13, 0.2);
}

TEST(Certificate, DistanceBoundHoldsForTheVertices) {
  const TraceAndCertificate r = run(sphere(2, 3), 0.3, 1);
  ASSERT_TRUE(r.certificate.is_certified());
  double farthest = 0;
  for (std::size_t i = 0; i < r.trace.num_simplices(); ++i) {
    double squared = 0;
    for (const double x : r.trace.point(i)) squared += x * x;
    farthest = std::max(farthest, std::fabs(std::sqrt(squared) - 1));
  }
  EXPECT_LE(farthest, r.certificate.distance_bound);
  EXPECT_LT(r.certificate.distance_bound, 0.1);
}

/// Singular, or with poles: never certified, at any edge length.
TEST(Certificate, SingularSetsAreNeverCertified) {
  const std::vector<Problem> problems{
      in_space("x^2+y^2-z^2+0.3*(x^2+y^2+z^2)^2", {0.5, 0, 0.6}),  // cone
      in_plane("x^4-x^2+y^2", {1, 0}),                             // node
      in_plane("y^2-x^3+x^5", {1, 0}),                             // cusp
      in_plane("(x^2+y^2)^2-2*(x^2-y^2)", {1.4142135, 0}),         // lemniscate
      {{"x", "y", "z"}, {"(x^2+y^2)^2-2*(x^2-y^2)", "z+0.1*x^2"}, {1.4142135, 0, -0.2}},
      in_space("x^2-y^2*z+0.2*(x^2+y^2+z^2)^2", {0, 1.25, 1.25}),      // Whitney's umbrella, closed up
      in_space("(sqrt(x^2+y^2)-1)^2+z^2-1", {2, 0, 0}),                // horn torus
      in_space("(x^2+y^2+z^2)^2-4*(x^2+y^2)", {2, 0, 0}),              // the same, a polynomial
      in_space("((x+1)^2+y^2+z^2-1)*((x-1)^2+y^2+z^2-1)", {2, 0, 0}),  // tangent spheres
      in_space("((x^2+y^2+z^2+3)^2-16*(x^2+y^2))*(((x-6)^2+y^2+z^2+3)^2-16*((x-6)^2+y^2))", {3, 0, 0}),
      in_space("(x^2+y^2+z^2-1)^2", {1, 0, 0}),
      in_space("(x^2+y^2+z^2-1)^3", {1, 0, 0}),
  };
  for (const Problem& p : problems) {
    for (const double edge_length : {0.7, 0.3, 0.15, 0.08}) {
      for (int rng_seed = 0; rng_seed < 2; ++rng_seed) {
        const IsotopyCertificate c = run(p, edge_length, rng_seed, {.run = {.max_simplices = 40'000}}).certificate;
        EXPECT_FALSE(c.is_certified()) << p.equations[0] << " at " << edge_length;
        EXPECT_FALSE(c.reason.empty());
      }
    }
  }
}

TEST(Certificate, PolesAreNeverCertified) {
  for (const double edge_length : {0.5, 0.2, 0.05}) {
    for (int rng_seed = 0; rng_seed < 3; ++rng_seed) {
      const Box box{{-3, -3}, {3, 3}};
      for (const char* equation : {"1/x-y", "tan(x)-y", "y-1/x^2"}) {
        const auto p = in_plane(equation, {0.7, 1.2});
        EXPECT_FALSE(run(p, edge_length, rng_seed, {.box = box}).certificate.is_certified()) << equation;
      }
      // A closed curve of poles: the sign changes at infinity.
      const auto p = in_plane("1/(x^2+y^2-1)", {1, 0});
      EXPECT_FALSE(run(p, edge_length, rng_seed).certificate.is_certified());
    }
  }
}

/// The constant is 0 for real numbers, and anything in doubles.
TEST(Certificate, TheCancellingTorusIsNeverCertified) {
  const auto p = in_space("(x^2+y^2+z^2+3)^2-16*(x^2+y^2)+exp(1)*exp(39)-exp(40)", {3, 0, 0});
  for (const double edge_length : {0.4, 0.2, 0.1}) {
    const Triangulation triangulation = random_triangulation(3, edge_length, 1);
    // What was traced may be the torus or what doubles made of it: give the certificate the good one.
    const auto torus = in_space("(x^2+y^2+z^2+3)^2-16*(x^2+y^2)", {3, 0, 0});
    for (const Problem& traced : {torus, p}) {
      const TraceResult t = trace(parse_equations(traced.variables, traced.equations), triangulation, p.seed);
      const auto c = certify_trace(Enclosure::of_expressions(p.variables, p.equations), triangulation, t);
      EXPECT_FALSE(c.is_certified());
    }
  }
}

TEST(Certificate, AMissedHandleIsNeverCertified) {
  struct Case {
    Problem problem;
    long euler_characteristic;
    std::size_t components;
  };
  const std::vector<Case> cases{
      {in_space("(sqrt(x^2+y^2)-1.03)^2+z^2-1", {2.03, 0, 0}), 0, 1},                   // a small hole
      {in_space("((x+1)^2+y^2+z^2-1)*((x-1)^2+y^2+z^2-1)-0.002", {2, 0, 0}), 2, 1},     // a thin neck
      {in_space("((x+1.02)^2+y^2+z^2-1)*((x-1.02)^2+y^2+z^2-1)", {2.02, 0, 0}), 2, 1},  // a thin gap
      {in_plane("x^2+y^2-1-0.5*exp(-400*((x-1)^2+y^2))", {-1, 0}), 0, 1},               // a small bump
  };
  for (const Case& c : cases) {
    for (const double edge_length : {1.0, 0.5, 0.3, 0.2, 0.1, 0.05}) {
      const TraceAndCertificate r = run(c.problem, edge_length, 3);
      if (!r.certificate.is_certified()) continue;
      TopologyOptions options;
      options.homology = false;
      options.links = false;
      const auto topology = topology_of(cell_complex(r.trace).facets, options);
      EXPECT_EQ(topology.euler_characteristic, c.euler_characteristic)
          << c.problem.equations[0] << " at " << edge_length;
      EXPECT_EQ(topology.components, c.components) << c.problem.equations[0] << " at " << edge_length;
    }
  }
}

TEST(Certificate, ChecksValuesAgainstItsOwnFunction) {
  // Values of another function: an evaluation error as large as the difference.
  const auto p = sphere(2, 3);
  const Triangulation triangulation = random_triangulation(3, 0.4, 2);
  const TraceResult t = trace(parse_equations(p.variables, p.equations), triangulation, p.seed);
  const auto certify = [&](const char* equation) {
    return certify_trace(Enclosure::of_expressions(p.variables, std::vector<std::string>{equation}), triangulation, t);
  };
  EXPECT_TRUE(certify("x1^2+x2^2+x3^2-1").is_certified());
  EXPECT_TRUE(certify("x1^2+x2^2+x3^2-1.001").is_certified());  // close enough to be isotopic, and that is proved
  EXPECT_FALSE(certify("x1^2+x2^2+x3^2-2").is_certified());
  EXPECT_FALSE(certify("x1^2+x2^2-x3^2-1").is_certified());
  EXPECT_NEAR(certify("x1^2+x2^2+x3^2-1.001").value_errors[0], 0.001, 1e-9);
}

TEST(Certificate, WhatIsNotWholeIsNotCovered) {
  const auto p = sphere(2, 3);
  EXPECT_EQ(run(p, 0.2, 1, {.run = {.max_simplices = 50}}).certificate.verdict, Verdict::kNotCovered);
  EXPECT_EQ(run(p, 0.4, 1, {.box = Box{{-2, -2, -0.5}, {2, 2, 2}}}).certificate.verdict, Verdict::kNotCovered);
  EXPECT_TRUE(run(p, 0.4, 1, {.box = Box{{-2, -2, -2}, {2, 2, 2}}}).certificate.is_certified());
  auto far = p;
  far.seed = {9, 9, 9};
  EXPECT_EQ(run(far, 0.1, 1).certificate.verdict, Verdict::kNotCovered);
  // An inequality that holds everywhere on the sphere, but only just.
  const Function inequality = parse_equations(p.variables, std::vector<std::string>{"2-x1"});
  const Triangulation triangulation = random_triangulation(3, 0.4, 2);
  const TraceResult t =
      trace(parse_equations(p.variables, p.equations), triangulation, p.seed, {.inequalities = inequality});
  const Enclosure f = Enclosure::of_expressions(p.variables, p.equations);
  EXPECT_EQ(certify_trace(f, triangulation, t).verdict, Verdict::kNotCovered);
  for (const auto& [text, is_certified] : {std::pair{"2-x1", true}, std::pair{"1.001-x1", false}}) {
    CertifyOptions options;
    options.inequalities = Enclosure::of_expressions(p.variables, std::vector<std::string>{text});
    EXPECT_EQ(certify_trace(f, triangulation, t, options).is_certified(), is_certified) << text;
  }
}

TEST(Certificate, AdvisedEdgeLengthPasses) {
  const auto p = in_space("(x^2+y^2+z^2+3)^2-16*(x^2+y^2)", {3, 0, 0});
  double edge_length = 1;
  for (int step = 0; step < 6; ++step) {
    const auto c = run(p, edge_length, 1).certificate;
    if (c.is_certified()) break;
    ASSERT_GT(c.advised_edge_length, 0);
    ASSERT_LT(c.advised_edge_length, edge_length);
    EXPECT_FALSE(c.places.empty());
    edge_length = c.advised_edge_length;
  }
  EXPECT_TRUE(run(p, edge_length, 1).certificate.is_certified()) << edge_length;
  EXPECT_GT(edge_length, 0.1);
}

TEST(Certificate, UnitsDoNotMatter) {
  for (const double scale : {1e-150, 1e-9, 1e9, 1e120}) {
    const auto p = sphere(2, 3);
    const auto scaled = in_space("(x^2+y^2+z^2-1)*" + std::to_string(0.5), {1, 0, 0});
    const Triangulation triangulation = random_triangulation(3, 0.6, 4);
    std::ostringstream text;
    text << "(x^2+y^2+z^2-1)*" << scale;
    const std::vector<std::string> equations{text.str()};
    const TraceResult t = trace(parse_equations(scaled.variables, equations), triangulation, p.seed);
    EXPECT_TRUE(certify_trace(Enclosure::of_expressions(scaled.variables, equations), triangulation, t).is_certified())
        << scale;
  }
}

TEST(Certificate, DimensionsMustFit) {
  const TraceAndCertificate r = run(sphere(2, 3), 0.5, 1);
  EXPECT_THROW(certify_trace(Enclosure::of_expressions(coordinates(4), std::vector<std::string>{"x1"}),
                             random_triangulation(3, 0.5, 1), r.trace),
               InvalidInput);
}

}  // namespace
}  // namespace whitney
