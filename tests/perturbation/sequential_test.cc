// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/sequential.h>

#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <tests/coxeter/brute_force.h>

#include <coxeter/base/error.h>
#include <coxeter/quality.h>
#include <perturbation/displacement.h>
#include <perturbation/parameters.h>

namespace whitney::perturbation {
namespace {

using coxeter::LatticeVertex;

/// The unit n-sphere in the first n + 1 coordinates of R^d, about a point that is no vertex.
class Sphere : public FootOracle {
 public:
  Sphere(int ambient_dim, int intrinsic_dim) : d_(ambient_dim), n_(intrinsic_dim), centre_(ambient_dim) {
    for (int c = 0; c < d_; ++c) centre_[c] = 0.1234567 + 0.0789 * c;
  }
  int ambient_dim() const override { return d_; }
  int intrinsic_dim() const override { return n_; }
  double reach() const override { return 1; }
  double curvature_radius() const override { return 1; }
  FootPromise promise() const override { return {FootPromise::Place::kGlobal, FootPromise::Errors::kProven}; }
  bool foot(std::span<const double> x, std::span<double> point, std::span<double> frame,
            FootErrors& errors) const override {
    errors = {1e-15, 1e-15};
    const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(x.data(), d_) - centre_;
    const double length = y.head(n_ + 1).norm();
    if (!(length > 1e-9)) return false;
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(d_);
    unit.head(n_ + 1) = y.head(n_ + 1) / length;
    Eigen::Map<Eigen::VectorXd>(point.data(), d_) = centre_ + unit;
    // The reflection that takes unit to -+ e_n: rows 0 .. n-1 are tangent, row n is normal.
    Eigen::VectorXd w = unit;
    w[n_] += unit[n_] >= 0 ? 1 : -1;
    Eigen::Map<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(frame.data(), d_, d_) =
        Eigen::MatrixXd::Identity(d_, d_) - 2 / w.squaredNorm() * w * w.transpose();
    return true;
  }
  /// A point of the sphere.
  std::vector<double> point() const {
    std::vector<double> x(d_, 0.4), p(d_), frame(d_ * d_);
    FootErrors errors;
    foot(x, p, frame, errors);
    return p;
  }

 private:
  int d_, n_;
  Eigen::VectorXd centre_;
};

/// Half of what the embedding proof allows.
double largest_displacement(int d, double edge_length) {
  return 0.499 * embedding_bound(coxeter::coxeter_a_quality(d, edge_length));
}

struct Scheme {
  Sphere sphere;
  coxeter::Triangulation triangulation;
  PerturbedTriangulation near;
  SequentialResult result;

  Scheme(int d, int n, double edge_length, const SequentialOptions& options, std::optional<std::vector<double>> at = {})
      : sphere(d, n), triangulation(coxeter::coxeter_a(d, edge_length)), near(triangulation, sphere) {
    const std::uint32_t start[] = {find_start(near, at ? *at : sphere.point())};
    result = sequential(near, start, options);
  }
  std::map<LatticeVertex, std::vector<double>> displacements() const {
    std::map<LatticeVertex, std::vector<double>> all;
    for (std::uint32_t v = 0; v < near.num_vertices(); ++v)
      all[LatticeVertex(near.lattice_vertex(v))].assign(near.displacement(v),
                                                        near.displacement(v) + near.ambient_dim());
    return all;
  }
};

SequentialOptions best_of(int d, double edge_length, int candidates) {
  SequentialOptions options;
  options.max_displacement = largest_displacement(d, edge_length);
  options.min_distance = 1;
  options.candidates = candidates;
  return options;
}

TEST(Sequential, TheSumOfCoordinatesColoursTheGraph) {
  std::mt19937 gen(1);
  for (int d = 1; d <= 6; ++d)
    for (int round = 0; round < 20; ++round) {
      LatticeVertex v(d);
      for (int c = 0; c < d; ++c) v[c] = static_cast<std::int32_t>(gen() % 2001) - 1000;
      EXPECT_GE(colour(v), 0);
      EXPECT_LE(colour(v), d);
      for (const LatticeVertex& other : coxeter::testing::neighbours(v)) EXPECT_NE(colour(v), colour(other));
    }
  EXPECT_EQ(colour(LatticeVertex{-1, 0}), 2);
  constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
  EXPECT_EQ(colour(LatticeVertex{kMin, kMin}), 2);  // -2^32 mod 3
}

/// The least distance of placed vertices from span(tau', T_p M), over all faces tau' of dimension at most k - 2 of
/// their stars with vertices of smaller colour, straight from the definition.
double least_distance(const Scheme& run, const std::map<LatticeVertex, std::vector<double>>& displacements) {
  const int d = run.sphere.ambient_dim(), k = d - run.sphere.intrinsic_dim();
  double least = std::numeric_limits<double>::infinity();
  const auto position = [&](const LatticeVertex& z, bool displaced) {
    Eigen::VectorXd x(d);
    run.triangulation.cartesian(z, {x.data(), static_cast<std::size_t>(d)});
    if (displaced) x += Eigen::Map<const Eigen::VectorXd>(displacements.at(z).data(), d);
    return x;
  };
  for (const auto& [z, u] : displacements) {
    const Eigen::VectorXd x = position(z, false);
    Eigen::VectorXd p(d);
    std::vector<double> frame(d * d);
    FootErrors errors;
    if (!run.sphere.foot({x.data(), x.data() + d}, {p.data(), p.data() + d}, frame, errors)) continue;
    if ((x - p).norm() >= 1.5 * run.triangulation.edge_length()) {
      for (const double c : u) EXPECT_EQ(c, 0);
      continue;
    }
    const Eigen::MatrixXd tangent =
        Eigen::Map<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(frame.data(), d, d).topRows(d - k).transpose();
    std::vector<LatticeVertex> earlier;
    bool known = true;
    for (const LatticeVertex& other : coxeter::testing::neighbours(z))
      if (colour(other) < colour(z)) {
        earlier.push_back(other);
        known = known && displacements.count(other) > 0;
      }
    if (!known) continue;  // at the rim of what was visited
    for (int size = 0; size < k; ++size) {
      std::set<coxeter::testing::VertexSet> cliques;
      coxeter::testing::grow_cliques({z}, earlier, 0, static_cast<std::size_t>(size) + 1, cliques);
      for (const auto& clique : cliques) {
        Eigen::MatrixXd span = tangent;
        for (const LatticeVertex& other : clique) {
          if (other == z) continue;
          span.conservativeResize(Eigen::NoChange, span.cols() + 1);
          span.rightCols(1) = position(other, true) - p;
        }
        const Eigen::VectorXd y = position(z, true) - p;
        least = std::min(least, (y - span * span.colPivHouseholderQr().solve(y)).norm());
      }
    }
  }
  return least;
}

TEST(Sequential, EveryPlacedVertexIsFarFromTheSpansOfTheEarlierFaces) {
  std::size_t moved = 0;
  for (const auto& [d, n] : {std::pair(2, 1), std::pair(3, 2), std::pair(3, 1), std::pair(4, 2), std::pair(4, 1)}) {
    const double length = d == 2 ? 0.1 : 0.35;
    // A small ball, so that what is accepted matters, and the paper's part of it, or more for hypersurfaces, where the
    // paper's would move hardly a vertex.
    SequentialOptions options;
    options.max_displacement = 0.1 * length;
    if (d == n + 1) options.min_distance = 0.9;
    options.candidates = 1000;
    const Scheme run(d, n, length, options);
    EXPECT_TRUE(run.result.complete);
    EXPECT_EQ(run.result.below, 0u) << d << " " << n;
    const double part = d == n + 1 ? 0.9 : std::pow(10, whitney_parameters(d, n, Variant::kCorrected).log10_slab);
    EXPECT_GE(run.result.least_distance, part);
    moved += run.result.moved;
    EXPECT_GE(run.result.placed, run.result.moved);
    const auto all = run.displacements();
    for (const auto& [z, u] : all)
      EXPECT_LE(Eigen::Map<const Eigen::VectorXd>(u.data(), d).norm(), options.max_displacement);
    const double least = least_distance(run, all);
    EXPECT_LT(least, 1e9);
    EXPECT_GE(least, part * options.max_displacement * (1 - 1e-6)) << d << " " << n;
    EXPECT_GE(least, run.result.least_distance * options.max_displacement * (1 - 1e-6));
  }
  EXPECT_GT(moved, 10u);
}

TEST(Sequential, PlacesTheVerticesWithinThreeHalvesOfAnEdge) {
  SequentialOptions options = best_of(3, 0.3, 4);
  options.min_distance = std::numeric_limits<double>::infinity();  // so hardly one is content with where it is
  const Scheme run(3, 2, 0.3, options);
  std::size_t within = 0;
  for (std::uint32_t v = 0; v < run.near.num_vertices(); ++v) {
    std::vector<double> x(3), p(3), frame(9);
    FootErrors errors;
    run.triangulation.cartesian(run.near.lattice_vertex(v), x);
    ASSERT_TRUE(run.sphere.foot(x, p, frame, errors));
    const double distance = std::hypot(x[0] - p[0], x[1] - p[1], x[2] - p[2]);
    const double* u = run.near.displacement(v);
    const bool moved = std::hypot(u[0], u[1], u[2]) > 0;
    within += distance < 1.5 * 0.3;
    EXPECT_FALSE(moved && distance >= 1.5 * 0.3);
  }
  EXPECT_EQ(run.result.placed, within);  // k = 1: no others are asked for
  EXPECT_GT(within, 100u);
  EXPECT_LE(run.result.moved, within);
  EXPECT_GT(run.result.moved, within / 2);
}

TEST(Sequential, APlaceDependsOnTheVertexAndTheSeedAlone) {
  SequentialOptions options = best_of(3, 0.3, 16);
  const Scheme one(3, 1, 0.3, options);
  // From the other side of the circle, so in another order.
  std::vector<double> opposite = one.sphere.point();
  opposite[0] -= 1.3;
  opposite[1] -= 1.3;
  const Scheme two(3, 1, 0.3, options, opposite);
  const auto a = one.displacements(), b = two.displacements();
  std::size_t common = 0, moved = 0;
  for (const auto& [z, u] : a)
    if (const auto other = b.find(z); other != b.end()) {
      EXPECT_EQ(u, other->second);
      ++common;
      moved += u != std::vector<double>(3, 0.0);
    }
  EXPECT_GT(common, 80u);
  EXPECT_GT(moved, 40u);
  EXPECT_EQ(one.result.rounds.back().simplices, two.result.rounds.back().simplices);
  options.rng_seed = 2;
  EXPECT_NE(Scheme(3, 1, 0.3, options).displacements(), a);
}

TEST(Sequential, CertifiesCirclesAndSpheres) {
  // Edge lengths that leave a margin to the largest ones found: 0.8, 0.5, 0.4 and 0.35.
  for (const auto& [d, n, length] :
       {std::tuple(2, 1, 0.5), std::tuple(3, 2, 0.4), std::tuple(3, 1, 0.2), std::tuple(4, 3, 0.3)}) {
    Scheme run(d, n, length, best_of(d, length, 200));
    EXPECT_TRUE(run.result.all_accepted) << d << " " << n;
    EXPECT_TRUE(run.result.complete);
    EXPECT_GE(run.result.rounds.back().worst_margin, 1.02);
    EXPECT_EQ(run.result.rounds.back().vertices, run.near.num_vertices());
    EXPECT_GE(run.result.worst_separation, run.result.rounds.back().worst_margin);
    EXPECT_GE(run.result.worst_transversality, run.result.rounds.back().worst_margin);
    EXPECT_GT(run.result.rounds.back().hit, 10u);
  }
}

TEST(Sequential, MarginsGrowAsTheEdgesShrink) {
  // Displacements scale with L, and the bending of M over a simplex with L^2.
  const Scheme coarse(3, 2, 0.4, best_of(3, 0.4, 64)), fine(3, 2, 0.1, best_of(3, 0.1, 64));
  EXPECT_GT(fine.result.rounds.back().worst_margin, 2 * coarse.result.rounds.back().worst_margin);
  // The paper's own radius, and its part of it, at an edge length that is nowhere near its own.
  const Scheme paper(2, 1, 0.005, {});
  EXPECT_TRUE(paper.result.all_accepted);
  EXPECT_GE(paper.result.least_distance, std::acos(-1) / 16);
  for (const auto& [z, u] : paper.displacements()) EXPECT_LE(std::hypot(u[0], u[1]), 0.02406 * 0.005);
}

TEST(Sequential, StopsWhenAsked) {
  SequentialOptions options = best_of(3, 0.1, 8);
  options.run.progress = [](const Progress&) { return false; };
  const Scheme cancelled(3, 2, 0.1, options);
  EXPECT_FALSE(cancelled.result.complete);
  EXPECT_EQ(cancelled.result.stop_reason, StopReason::kCancelled);
  options.run.progress = {};
  options.run.max_simplices = 10;
  const Scheme run(3, 2, 0.1, options);
  EXPECT_FALSE(run.result.complete);
  EXPECT_FALSE(run.result.all_accepted);
}

TEST(Sequential, RejectsBadInput) {
  SequentialOptions options;
  options.max_displacement = -1;
  EXPECT_THROW(Scheme(2, 1, 0.5, options), InvalidInput);
  options.max_displacement = std::nan("");
  EXPECT_THROW(Scheme(2, 1, 0.5, options), InvalidInput);
  options = {};
  options.min_distance = -1;
  EXPECT_THROW(Scheme(2, 1, 0.5, options), InvalidInput);
  options = {};
  options.candidates = 0;
  EXPECT_THROW(Scheme(2, 1, 0.5, options), InvalidInput);
  // 5! S(8, 5) = 126 000 spans; and no limit to the dimension for hypersurfaces.
  const Sphere curve(7, 2), hypersurface(9, 8);
  const auto t7 = coxeter::coxeter_a(7, 0.5), t9 = coxeter::coxeter_a(9, 0.5);
  PerturbedTriangulation near7(t7, curve), near9(t9, hypersurface);
  const std::uint32_t start[] = {near7.locate(curve.point())};
  EXPECT_THROW(sequential(near7, start), InvalidInput);
  const std::uint32_t start9[] = {near9.locate(hypersurface.point())};
  options = {};
  options.run.max_simplices = 5;
  EXPECT_NO_THROW(sequential(near9, start9, options));
}

}  // namespace
}  // namespace whitney::perturbation
