// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/correspondence.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>
#include <whitney/topology/topology.h>
#include "whitney_cases.h"

namespace whitney {
namespace {

constexpr double kPi = std::numbers::pi;
using Status = Preimage::Status;

Correspondence correspondence_of(const WhitneyCase& c) {
  return Correspondence(barycentric_subdivision(c.result.complex), c.manifold, *c.result.hausdorff_bound);
}

double distance(std::span<const double> a, std::span<const double> b) {
  double squares = 0;
  for (std::size_t c = 0; c < a.size(); ++c) squares += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(squares);
}

/// A point of K, uniform in a random simplex.
std::vector<double> random_point(const SimplicialMesh& mesh, std::mt19937_64& rng) {
  const int d = mesh.ambient_dim, size = mesh.dim + 1;
  std::exponential_distribution<double> exponential;
  const std::size_t s = std::uniform_int_distribution<std::size_t>(0, mesh.num_simplices() - 1)(rng);
  std::vector<double> weights(size), x(d, 0.0);
  double total = 0;
  for (double& w : weights) total += w = exponential(rng);
  for (int q = 0; q < size; ++q)
    for (int c = 0; c < d; ++c)
      x[c] += weights[q] / total * mesh.points[std::size_t{mesh.simplices[s * size + q]} * d + c];
  return x;
}

struct Shape {
  const char* name;
  double edge_length;
  std::map<std::string, double> parameters;
};

const Shape kShapes[] = {{"sphere", 0.3, {}},
                         {"sphere", 0.3, {{"intrinsic_dim", 1}}},
                         {"sphere", 0.2, {{"intrinsic_dim", 1}, {"ambient_dim", 4}}},
                         {"torus_of_revolution", 0.3, {}},
                         {"flat_torus", 0.25, {}},
                         {"klein_bottle", 0.45, {}}};

TEST(Correspondence, RoundTrips) {
  for (const Shape& shape : kShapes) {
    SCOPED_TRACE(shape.name);
    const WhitneyCase c = whitney_case(shape.name, shape.edge_length, shape.parameters);
    ASSERT_EQ(c.result.certificate.verdict, perturbation::Verdict::kCertified);
    const Correspondence correspondence = correspondence_of(c);
    const CorrespondenceCheck check = check_correspondence(correspondence, *c.manifold.bending());
    EXPECT_TRUE(check.homeomorphism) << check.reason;
    EXPECT_EQ(check.components, 1u);
    EXPECT_LE(check.angle_max, kPi / 2);
    std::mt19937_64 rng(7);
    std::normal_distribution<double> normal;
    const SimplicialMesh& mesh = correspondence.mesh();
    for (int i = 0; i < 500; ++i) {
      // K -> M -> K
      const std::vector<double> x = random_point(mesh, rng);
      const std::vector<double> y = correspondence.to_manifold(x);
      Preimage preimage = correspondence.from_manifold(y);
      ASSERT_EQ(preimage.status, Status::kFound);
      EXPECT_LT(distance(preimage.point, x), 1e-9);
      EXPECT_NEAR(preimage.distance, distance(x, y), 1e-9);
      EXPECT_LE(preimage.distance, *c.result.hausdorff_bound);
      // M -> K -> M, from a point of M that has nothing to do with K.
      std::vector<double> z = x;
      for (double& a : z) a += 0.3 * c.manifold.bending()->reach * normal(rng);
      const std::vector<double> foot = correspondence.to_manifold(z);
      if (foot.empty()) continue;
      preimage = correspondence.from_manifold(foot);
      ASSERT_EQ(preimage.status, Status::kFound);
      EXPECT_LT(distance(correspondence.to_manifold(preimage.point), foot), 1e-9);
      // The coordinates mean the point.
      std::vector<double> meant(x.size(), 0.0);
      double total = 0;
      for (int q = 0; q <= mesh.dim; ++q) {
        total += preimage.barycentric[q];
        EXPECT_GE(preimage.barycentric[q], 0);
        const std::size_t v = mesh.simplices[preimage.simplex * (mesh.dim + 1) + q];
        for (std::size_t b = 0; b < x.size(); ++b) meant[b] += preimage.barycentric[q] * mesh.points[v * x.size() + b];
      }
      EXPECT_NEAR(total, 1, 1e-14);
      EXPECT_LT(distance(meant, preimage.point), 1e-14);
    }
  }
}

TEST(Correspondence, VerticesAndEdgesHaveOnePreimage) {
  // There all simplices around them answer.
  const WhitneyCase c = whitney_case("sphere", 0.4);
  const Correspondence correspondence = correspondence_of(c);
  const SimplicialMesh& mesh = correspondence.mesh();
  for (std::size_t s = 0; s < mesh.num_simplices(); s += 3) {
    const double* a = &mesh.points[mesh.simplices[3 * s] * 3];
    const double* b = &mesh.points[mesh.simplices[3 * s + 1] * 3];
    for (const double t : {0.0, 0.4, 1.0}) {
      const std::vector<double> x = {(1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1], (1 - t) * a[2] + t * b[2]};
      const Preimage preimage = correspondence.from_manifold(correspondence.to_manifold(x));
      ASSERT_EQ(preimage.status, Status::kFound);
      EXPECT_LT(distance(preimage.point, x), 1e-9);
    }
  }
}

TEST(Correspondence, CarriesFunctions) {
  double previous = 1;
  for (const double edge_length : {0.4, 0.2}) {
    const WhitneyCase c = whitney_case("sphere", edge_length);
    const Correspondence correspondence = correspondence_of(c);
    const SimplicialMesh& mesh = correspondence.mesh();
    std::vector<double> values;  // the coordinates, and a smooth function of the foot
    const auto smooth = [](std::span<const double> y) { return std::sin(2 * y[0]) * y[1] + y[2] * y[2]; };
    for (std::size_t v = 0; v < mesh.num_points(); ++v) {
      const std::span<const double> x(&mesh.points[3 * v], 3);
      values.insert(values.end(), x.begin(), x.end());
      values.push_back(smooth(correspondence.to_manifold(x)));
    }
    std::mt19937_64 rng(3);
    double worst = 0;
    for (int i = 0; i < 300; ++i) {
      const std::vector<double> x = random_point(mesh, rng), y = correspondence.to_manifold(x);
      const auto carried = correspondence.carry(values, 4, y);
      ASSERT_TRUE(carried);
      EXPECT_LT(distance(std::span(*carried).first(3), x), 1e-9);
      worst = std::max(worst, std::abs((*carried)[3] - smooth(y)));
    }
    EXPECT_LT(worst, previous / 2.5);  // second order: a quarter for half the edge length
    previous = worst;
    EXPECT_THROW(correspondence.carry(values, 3, std::vector<double>{1, 0, 0}), InvalidInput);
  }
}

/// The regular polygon with m vertices on the unit circle, going round `turns` times.
SimplicialMesh polygon(int m, int turns) {
  SimplicialMesh mesh{2, 1, {}, {}};
  for (int i = 0; i < m * turns; ++i) {
    mesh.points.insert(mesh.points.end(), {std::cos(2 * kPi * i / m), std::sin(2 * kPi * i / m)});
    mesh.simplices.insert(mesh.simplices.end(), {std::uint32_t(i), std::uint32_t((i + 1) % (m * turns))});
  }
  return mesh;
}

TEST(CheckCorrespondence, SaysWhichConditionFails) {
  const Submanifold circle = named_submanifold("sphere", {{"intrinsic_dim", 1}});
  const Bending bending = *circle.bending();
  const double sagitta = 1 - std::cos(kPi / 12);
  EXPECT_TRUE(check_correspondence(Correspondence(polygon(12, 1), circle, sagitta), bending).homeomorphism);

  CorrespondenceCheck check = check_correspondence(Correspondence(polygon(12, 1), circle, 1.0), bending);
  EXPECT_FALSE(check.homeomorphism || check.within_reach);

  // Twice round, with slightly other radii so that the points differ: locally all is well.
  SimplicialMesh twice = polygon(12, 2);
  for (std::size_t i = 24; i < 46; ++i) twice.points[i] *= 1 + 0.001 * std::min<int>(i - 22, 46 - i);
  check = check_correspondence(Correspondence(twice, circle, 0.1), bending);
  EXPECT_FALSE(check.homeomorphism);
  EXPECT_EQ(check.folded_facets + check.steep + check.bad_facets, 0u);
  EXPECT_EQ(check.covered_twice, 1u);

  SimplicialMesh open = polygon(12, 1);
  open.simplices.resize(22);
  check = check_correspondence(Correspondence(open, circle, sagitta), bending);
  EXPECT_EQ(check.bad_facets, 2u);
  EXPECT_FALSE(check.homeomorphism);

  // Three steps forth, one back, and on.
  SimplicialMesh folded = polygon(12, 1);
  std::swap_ranges(folded.points.begin(), folded.points.begin() + 2, folded.points.begin() + 2);
  check = check_correspondence(Correspondence(folded, circle, 0.2), bending);
  EXPECT_EQ(check.folded_facets, 2u);
  EXPECT_FALSE(check.homeomorphism);

  // A step outwards: orthogonal to the circle.
  SimplicialMesh step = polygon(24, 1);
  step.points[2] = 1.1 * step.points[0];
  step.points[3] = 1.1 * step.points[1];
  check = check_correspondence(Correspondence(step, circle, 0.15), bending);
  EXPECT_EQ(check.steep, 1u);
  EXPECT_NEAR(check.angle_max, kPi / 2, 1e-9);
  EXPECT_FALSE(check.homeomorphism);
}

TEST(CheckCorrespondence, FindsFoldsOfASurface) {
  const WhitneyCase c = whitney_case("sphere", 0.4);
  SimplicialMesh mesh = barycentric_subdivision(c.result.complex);
  ASSERT_TRUE(check_correspondence(Correspondence(mesh, c.manifold, 0.2), *c.manifold.bending()).homeomorphism);
  // The vertex of a 2-cell pulled beyond its neighbours.
  for (int a = 0; a < 3; ++a) {
    double& x = mesh.points[mesh.points.size() - 3 + a];
    x += a == 0 ? 0.3 : -0.3;
  }
  const CorrespondenceCheck check = check_correspondence(Correspondence(mesh, c.manifold, 0.8), *c.manifold.bending());
  EXPECT_FALSE(check.homeomorphism);
  EXPECT_GT(check.folded_facets, 0u);
}

TEST(Correspondence, StatusesAndMisuse) {
  const Submanifold circle = named_submanifold("sphere", {{"intrinsic_dim", 1}});
  const Correspondence once(polygon(12, 1), circle, 0.05);
  EXPECT_EQ(once.from_manifold(std::vector<double>{0, 0}).status, Status::kNoFoot);
  EXPECT_TRUE(once.to_manifold(std::vector<double>{0, 0}).empty());
  SimplicialMesh open = polygon(12, 1);
  open.simplices.resize(22);
  const double middle[] = {std::cos(kPi / 12), -std::sin(kPi / 12)};
  EXPECT_EQ(once.from_manifold(middle).status, Status::kFound);
  EXPECT_EQ(Correspondence(open, circle, 0.05).from_manifold(middle).status, Status::kNone);
  SimplicialMesh folded = polygon(12, 1);
  std::swap_ranges(folded.points.begin(), folded.points.begin() + 2, folded.points.begin() + 2);
  const double between[] = {std::cos(kPi / 14), std::sin(kPi / 14)};
  const Preimage three = Correspondence(folded, circle, 0.2).from_manifold(between);
  EXPECT_EQ(three.status, Status::kAmbiguous);
  EXPECT_EQ(three.num_points, 3u);
  EXPECT_EQ(Correspondence(folded, circle, 0.2).carry(std::vector<double>(12, 1.0), 1, between), std::nullopt);

  EXPECT_THROW(Correspondence(polygon(12, 1), named_submanifold("sphere"), 0.1), InvalidInput);
  EXPECT_THROW(Correspondence(SimplicialMesh{2, 1, {}, {}}, circle, 0.1), InvalidInput);
  EXPECT_THROW(Correspondence(polygon(12, 1), circle, -1), InvalidInput);
  EXPECT_THROW(Correspondence(polygon(12, 1), circle, std::numeric_limits<double>::infinity()), InvalidInput);
  EXPECT_THROW(Correspondence(SimplicialMesh{2, 1, {0, 0}, {0, 1}}, circle, 0.1), InvalidInput);
  EXPECT_THROW(check_correspondence(once, Bending{0, 0}), InvalidInput);
}

}  // namespace
}  // namespace whitney
