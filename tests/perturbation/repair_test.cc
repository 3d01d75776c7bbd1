// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/repair.h>

#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <coxeter/quality.h>
#include <perturbation/inside.h>
#include <perturbation/verdict.h>
#include "sphere_oracle.h"

namespace whitney::perturbation {
namespace {

/// The Coxeter triangulation, moved into general position by fixed numbers.
coxeter::Triangulation moved_coxeter(int d, double edge_length, int variant = 0) {
  std::vector<double> shift(d);
  for (int c = 0; c < d; ++c) shift[c] = edge_length * (0.137 + 0.291 * c + 0.173 * variant);
  Eigen::MatrixXd turn = Eigen::MatrixXd::Identity(d, d);
  for (int c = 0; c + 1 < d; ++c) {
    Eigen::MatrixXd plane = Eigen::MatrixXd::Identity(d, d);
    const double angle = 0.7 + 0.4 * c + 0.3 * variant;
    plane(c, c) = plane(c + 1, c + 1) = std::cos(angle);
    plane(c, c + 1) = -(plane(c + 1, c) = std::sin(angle));
    turn = plane * turn;
  }
  return coxeter::coxeter_a(d, edge_length).transformed(turn, shift);
}

struct Trial {
  std::vector<std::vector<double>> displacements;  // of moved vertices, by lattice coordinates
  CertificateReport report;
  RepairResult repair;
  HitWalk trace;
};

Trial attempt(const FootOracle& oracle, const coxeter::Triangulation& triangulation, std::vector<double> seed,
              std::uint64_t rng_seed = 1, int max_rounds = 16, std::size_t max_simplices = 1'000'000) {
  PerturbedTriangulation near(triangulation, oracle);
  const double width = coxeter::simplex_width(triangulation);
  const std::uint32_t start = find_start(near, seed);
  RepairOptions options;
  options.max_displacement = 0.499 * width;
  options.rng_seed = rng_seed;
  options.max_rounds = max_rounds;
  Trial out;
  if (max_rounds > 0) out.repair = repair(near, std::span(&start, 1), options);
  const std::uint32_t again = find_start(near, seed);
  HitWalkOptions trace_options;
  trace_options.run.max_simplices = max_simplices;
  out.trace = walk_hit_facets(near, std::span(&again, 1), trace_options);
  out.report = certify(near, out.trace, width);
  std::map<std::vector<int>, std::vector<double>> sorted;
  const int d = triangulation.ambient_dim();
  for (std::uint32_t v = 0; v < near.num_vertices(); ++v) {
    const auto z = near.lattice_vertex(v);
    if (std::any_of(near.displacement(v), near.displacement(v) + d, [](double u) { return u != 0; }))
      sorted[{z.begin(), z.end()}] = {near.displacement(v), near.displacement(v) + d};
  }
  for (auto& [z, u] : sorted) {
    u.insert(u.end(), z.begin(), z.end());
    out.displacements.push_back(u);
  }
  return out;
}

std::vector<double> on_axis(int d, int axis = 0, double sign = 1) {
  std::vector<double> x(d, 0.0);
  x[axis] = sign;
  return x;
}

class Certifies : public testing::TestWithParam<std::tuple<int, int, double>> {};

TEST_P(Certifies, UnitSpheresAtTheScalesAskedFor) {
  const auto [d, n, edge_length] = GetParam();
  const SphereOracle oracle(d, n);
  for (int variant = 0; variant < 3; ++variant) {
    const auto triangulation = moved_coxeter(d, edge_length, variant);
    const Trial result = attempt(oracle, triangulation, on_axis(d));
    EXPECT_EQ(result.report.verdict, Verdict::kCertified) << result.report.reason;
    EXPECT_GT(result.report.margin_min, 1);
    EXPECT_TRUE(result.report.embedded);
    EXPECT_LT(2 * result.report.displacement_max, result.report.embedding_bound);
    EXPECT_EQ(result.report.not_certified, 0u);
    EXPECT_FALSE(result.report.witness.has_value());
    EXPECT_TRUE(result.report.reason.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Repair, Certifies,
                         testing::Values(std::tuple{2, 1, 0.8}, std::tuple{3, 2, 0.5}, std::tuple{3, 1, 0.3},
                                         std::tuple{4, 1, 0.2}, std::tuple{4, 2, 0.25}, std::tuple{5, 1, 0.1},
                                         std::tuple{4, 3, 0.4}));

TEST(Repair, SameDisplacementsFromAnotherStart) {
  const SphereOracle oracle(3, 1);
  const auto triangulation = moved_coxeter(3, 0.3);
  const Trial a = attempt(oracle, triangulation, on_axis(3)), b = attempt(oracle, triangulation, on_axis(3, 1, -1));
  EXPECT_EQ(a.displacements, b.displacements);
  EXPECT_EQ(a.report.margin_min, b.report.margin_min);
  EXPECT_EQ(a.trace.simplices.size(), b.trace.simplices.size());
}

TEST(Repair, SameDisplacementsTwiceAndOthersForAnotherRngSeed) {
  const SphereOracle oracle(4, 1);
  const auto triangulation = moved_coxeter(4, 0.2, 1);
  const Trial a = attempt(oracle, triangulation, on_axis(4)), b = attempt(oracle, triangulation, on_axis(4));
  EXPECT_EQ(a.displacements, b.displacements);
}

// Exact zeros: lattice vertices, edges and symmetry planes of the triangulation on the manifold.
TEST(Repair, ExactZerosAreRepaired) {
  for (const double edge_length : {0.5, 0.25}) {
    const SphereOracle oracle(3, 2);
    // Freudenthal, unmoved: (1, 0, 0) and its like are vertices, and whole faces are tangent there.
    const auto triangulation = coxeter::freudenthal(3, edge_length * std::sqrt(3.0));
    const Trial before = attempt(oracle, triangulation, on_axis(3), 1, 0);
    EXPECT_NE(before.report.verdict, Verdict::kCertified);
    const Trial after = attempt(oracle, triangulation, on_axis(3));
    if (edge_length < 0.3) {
      EXPECT_EQ(after.report.verdict, Verdict::kCertified) << after.report.reason;
    }
  }
  const SphereOracle circle(4, 1);
  const auto triangulation = coxeter::coxeter_a(4, 0.15);  // the circle's plane is full of lattice vertices
  const Trial in_plane = attempt(circle, triangulation, on_axis(4));
  EXPECT_EQ(in_plane.report.verdict, Verdict::kCertified) << in_plane.report.reason;
}

TEST(Repair, WithoutItTheVerdictIsNotCertified) {
  const SphereOracle oracle(4, 2);
  const Trial result = attempt(oracle, moved_coxeter(4, 0.2), on_axis(4), 1, 0);
  EXPECT_EQ(result.report.verdict, Verdict::kNotCertified);
  ASSERT_TRUE(result.report.witness.has_value());
  EXPECT_LT(result.report.witness->margin, 1);
  EXPECT_EQ(result.report.witness->barycentre.size(), 4u);
  EXPECT_GT(result.report.not_certified, 0u);
  EXPECT_FALSE(result.report.reason.empty());
}

TEST(Verdict, TooLargeAnEdgeLengthIsNeverCertified) {
  int violated = 0;
  for (const double edge_length : {1.5, 2.0, 3.0, 5.0})
    for (int variant = 0; variant < 4; ++variant) {
      const SphereOracle oracle(2, 1);
      const auto triangulation = moved_coxeter(2, edge_length, variant);
      PerturbedTriangulation fresh(triangulation, oracle);
      const std::uint32_t start = find_start(fresh, on_axis(2));
      RepairOptions options;
      options.max_displacement = 0.499 * coxeter::simplex_width(triangulation);
      repair(fresh, std::span(&start, 1), options);
      const HitWalk trace = walk_hit_facets(fresh, std::span(&start, 1));
      const CertificateReport report = certify(fresh, trace, coxeter::simplex_width(triangulation));
      EXPECT_NE(report.verdict, Verdict::kCertified) << edge_length << " " << variant;
      violated += report.verdict == Verdict::kViolated;
      if (report.violation) {
        EXPECT_FALSE(describe(*report.violation).empty());
        EXPECT_GE(report.violation->points.size(), 2u);
      }
    }
  EXPECT_GT(violated, 0);
}

TEST(Verdict, ADisplacementOverTheBoundIsNotCertified) {
  const SphereOracle oracle(2, 1);
  const auto triangulation = moved_coxeter(2, 0.3);
  PerturbedTriangulation near(triangulation, oracle);
  const double width = coxeter::simplex_width(triangulation);
  const std::uint32_t start = find_start(near, on_axis(2));
  RepairOptions options;
  options.max_displacement = 0.499 * width;
  repair(near, std::span(&start, 1), options);
  ASSERT_EQ(certify(near, walk_hit_facets(near, std::span(&start, 1)), width).verdict, Verdict::kCertified);
  // A vertex that the trace does not even use, moved too far.
  const std::uint32_t s = near.locate(std::vector<double>{5, 5});
  near.set_displacement(near.corners(s)[0], std::vector<double>{0.6 * width, 0});
  const CertificateReport report = certify(near, walk_hit_facets(near, std::span(&start, 1)), width);
  EXPECT_EQ(report.verdict, Verdict::kNotCertified);
  EXPECT_FALSE(report.embedded);
  EXPECT_NE(report.reason.find("embedded"), std::string::npos) << report.reason;
}

TEST(Verdict, AFacePushedOntoTheManifoldIsNotCertified) {
  const SphereOracle oracle(3, 2);
  const auto triangulation = moved_coxeter(3, 0.2);
  PerturbedTriangulation near(triangulation, oracle);
  const double width = coxeter::simplex_width(triangulation);
  const std::uint32_t start = find_start(near, on_axis(3));
  RepairOptions options;
  options.max_displacement = 0.499 * width;
  repair(near, std::span(&start, 1), options);
  const HitWalk trace = walk_hit_facets(near, std::span(&start, 1));
  ASSERT_EQ(certify(near, trace, width).verdict, Verdict::kCertified);
  // The vertex of the trace that is closest to the sphere goes onto it.
  std::uint32_t best = 0;
  double least = 1;
  for (const std::uint32_t s : trace.simplices)
    for (int q = 0; q <= 3; ++q) {
      const std::uint32_t v = near.corners(s)[q];
      const double gap = std::abs(Eigen::Map<const Eigen::Vector3d>(near.position(v)).norm() - 1);
      if (gap < least) {
        least = gap;
        best = v;
      }
    }
  const Eigen::Vector3d x = Eigen::Map<const Eigen::Vector3d>(near.position(best));
  const Eigen::Vector3d u = Eigen::Map<const Eigen::Vector3d>(near.displacement(best)) + x.normalized() - x;
  near.set_displacement(best, {u.data(), 3});
  const CertificateReport report = certify(near, walk_hit_facets(near, std::span(&start, 1)), width);
  EXPECT_NE(report.verdict, Verdict::kCertified);
}

TEST(Verdict, ATraceCutShortIsNotCertified) {
  const SphereOracle oracle(3, 2);
  const Trial whole = attempt(oracle, moved_coxeter(3, 0.4), on_axis(3));
  ASSERT_EQ(whole.report.verdict, Verdict::kCertified);
  const Trial part = attempt(oracle, moved_coxeter(3, 0.4), on_axis(3), 1, 16, 50);
  EXPECT_EQ(part.report.verdict, Verdict::kNotCertified);
  EXPECT_FALSE(part.report.complete);
  EXPECT_EQ(part.report.simplices, 50u);
}

/// Circles of radius 1 and 1 + gap about the origin, with their true reach. (A reach that is too large is the caller's
/// word; what the feet say of it is checked elsewhere, see reach_claim.h.)
class TwoSheets : public FootOracle {
 public:
  explicit TwoSheets(double gap) : gap_(gap) {}
  int ambient_dim() const override { return 2; }
  int intrinsic_dim() const override { return 1; }
  double reach() const override { return gap_ / 2; }
  double curvature_radius() const override { return 1; }
  bool foot(std::span<const double> x, std::span<double> point, std::span<double> frame,
            FootErrors& errors) const override {
    const double length = std::hypot(x[0], x[1]), radius = length < 1 + gap_ / 2 ? 1 : 1 + gap_;
    if (!(length > 1e-9)) return false;
    for (int c = 0; c < 2; ++c) point[c] = radius * x[c] / length;
    frame[0] = -x[1] / length;
    frame[1] = x[0] / length;
    frame[2] = x[0] / length;
    frame[3] = x[1] / length;
    errors = {1e-14, 1e-14};
    return true;
  }

 private:
  double gap_;
};

TEST(Verdict, TwoSheetsInASimplexAreNotCertified) {
  const TwoSheets oracle(0.1);
  const Trial result = attempt(oracle, moved_coxeter(2, 0.3), {1, 0});
  EXPECT_NE(result.report.verdict, Verdict::kCertified);
}

/// An oracle that contradicts itself: its feet jump outward by `step` across a ray, so that one simplex is left through
/// a facet that the next one does not think is hit.
class Jumping : public FootOracle {
 public:
  int ambient_dim() const override { return 2; }
  int intrinsic_dim() const override { return 1; }
  double reach() const override { return 0.5; }
  double curvature_radius() const override { return 0.5; }
  bool foot(std::span<const double> x, std::span<double> point, std::span<double> frame,
            FootErrors& errors) const override {
    const double length = std::hypot(x[0], x[1]);
    if (!(length > 1e-9)) return false;
    const double radius = std::atan2(x[1], x[0]) > 0.5 && x[0] > 0 ? 1.3 : 1;
    for (int c = 0; c < 2; ++c) point[c] = radius * x[c] / length;
    frame[0] = -x[1] / length;
    frame[1] = x[0] / length;
    frame[2] = x[0] / length;
    frame[3] = x[1] / length;
    errors = {1e-14, 1e-14};
    return true;
  }
};

TEST(Verdict, ASimplexThatIsEnteredButNotHitIsNotCertified) {
  const Jumping oracle;
  for (const double edge_length : {0.1, 0.15, 0.2}) {
    const Trial result = attempt(oracle, moved_coxeter(2, edge_length), {-1, 0});
    EXPECT_EQ(result.report.verdict, Verdict::kNotCertified);
    EXPECT_GT(result.report.not_certified, 0u);
  }
}

TEST(Verdict, LengthsInAnyUnitGiveTheSameVerdict) {
  class Scaled : public SphereOracle {
   public:
    explicit Scaled(double unit) : SphereOracle(3, 1), unit_(unit) {}
    double reach() const override { return unit_; }
    double curvature_radius() const override { return unit_; }
    bool foot(std::span<const double> x, std::span<double> point, std::span<double> frame,
              FootErrors& errors) const override {
      std::vector<double> y(x.begin(), x.end());
      for (double& c : y) c /= unit_;
      if (!SphereOracle::foot(y, point, frame, errors)) return false;
      for (double& c : point) c *= unit_;
      errors.point *= unit_;
      return true;
    }

   private:
    double unit_;
  };
  std::size_t expected = 0;
  for (const double unit : {1.0, 1e-9, 1e9}) {
    const Scaled oracle(unit);
    std::vector<double> seed{unit, 0, 0};
    const Trial result = attempt(oracle, moved_coxeter(3, 0.3 * unit), seed);
    EXPECT_EQ(result.report.verdict, Verdict::kCertified) << unit << ": " << result.report.reason;
    if (expected == 0) expected = result.report.simplices;
    EXPECT_EQ(result.report.simplices, expected);
  }
}

TEST(Verdict, InsideIsProvedWithTheErrorsOfThePoint) {
  const Eigen::Matrix<double, 2, 3> V = (Eigen::Matrix<double, 2, 3>() << 0, 1, 0, 0, 0, 1).finished();
  const double* const vertices[] = {V.col(0).data(), V.col(1).data(), V.col(2).data()};
  const auto inside = [&](double x, double y, double error) {
    const double point[] = {x, y};
    return proved_inside(vertices, 2, point, error);
  };
  EXPECT_TRUE(inside(0.25, 0.25, 0));
  EXPECT_TRUE(inside(0.25, 0.25, 0.1));
  EXPECT_FALSE(inside(0.25, 0.25, 0.26));
  EXPECT_FALSE(inside(0.5, 0.5, 0));  // on an edge
  EXPECT_FALSE(inside(0, 0, 0));      // a vertex
  EXPECT_FALSE(inside(1, 1, 0));
  EXPECT_TRUE(inside(1e-12, 1e-12, 1e-14));
  EXPECT_FALSE(inside(1e-12, 1e-12, 1e-11));
  const double* const flat[] = {V.col(0).data(), V.col(1).data(), V.col(1).data()};
  const double point[] = {0.5, 0};
  EXPECT_FALSE(proved_inside(flat, 2, point, 0));
}

/// A circle whose feet at barycentres and midpoints of edges claim errors that make every proof fail; feet near lattice
/// vertices of the triangulation stay good. The proof must then go through another foot than the one with the best
/// margin, and name it.
class GoodAtVerticesOnly : public SphereOracle {
 public:
  explicit GoodAtVerticesOnly(const coxeter::Triangulation& triangulation)
      : SphereOracle(2, 1), triangulation_(triangulation) {}
  bool foot(std::span<const double> x, std::span<double> point, std::span<double> frame,
            FootErrors& errors) const override {
    if (!SphereOracle::foot(x, point, frame, errors)) return false;
    const Eigen::VectorXd z = as_eigen(triangulation_.lattice_coordinates(x));
    if ((z - z.array().round().matrix()).cwiseAbs().maxCoeff() > 1e-9) errors.point = 10;
    return true;
  }

 private:
  const coxeter::Triangulation& triangulation_;
};

TEST(Verdict, NamesTheFootThatWasProved) {
  const auto triangulation = moved_coxeter(2, 0.05);
  const GoodAtVerticesOnly oracle(triangulation);
  PerturbedTriangulation near(triangulation, oracle);
  const std::uint32_t start = find_start(near, on_axis(2));
  const HitWalk trace = walk_hit_facets(near, std::span(&start, 1));
  const CertificateReport report = certify(near, trace, coxeter::simplex_width(triangulation));
  ASSERT_EQ(report.verdict, Verdict::kCertified) << report.reason;
  for (const std::uint32_t s : trace.simplices) {
    const std::uint16_t candidate = near.evaluate(s, 0).candidate;
    EXPECT_TRUE(candidate >= 1 && candidate <= 3) << candidate;
  }
}

TEST(Repair, RejectsWrongArguments) {
  const SphereOracle oracle(3, 1);
  const auto triangulation = moved_coxeter(3, 0.3);
  PerturbedTriangulation near(triangulation, oracle);
  const std::uint32_t start = find_start(near, on_axis(3));
  EXPECT_THROW(repair(near, std::span(&start, 1), RepairOptions{}), InvalidInput);
  EXPECT_THROW(certify(near, HitWalk{}, 0), InvalidInput);
  const auto plane = coxeter::coxeter_a(2, 0.3);
  EXPECT_THROW(PerturbedTriangulation(plane, oracle), InvalidInput);
}

TEST(Repair, StopsWhenAsked) {
  const SphereOracle oracle(4, 2);
  const auto triangulation = moved_coxeter(4, 0.2);
  PerturbedTriangulation near(triangulation, oracle);
  const std::uint32_t start = find_start(near, on_axis(4));
  RepairOptions options;
  options.max_displacement = 0.499 * coxeter::simplex_width(triangulation);
  options.run.progress = [](const Progress&) { return false; };
  const RepairResult result = repair(near, std::span(&start, 1), options);
  EXPECT_FALSE(result.complete);
  EXPECT_FALSE(result.all_accepted);
  EXPECT_EQ(result.stop_reason, StopReason::kCancelled);

  options.run = {.max_simplices = 50};
  EXPECT_EQ(repair(near, std::span(&start, 1), options).stop_reason, StopReason::kMaxSimplices);
  options.run = {.time_limit = 0};
  EXPECT_EQ(repair(near, std::span(&start, 1), options).stop_reason, StopReason::kTimeLimit);
}

}  // namespace
}  // namespace whitney::perturbation
