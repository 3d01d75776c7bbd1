// SPDX-License-Identifier: GPL-3.0-or-later
// What triangulate() says that its verdict rests on, and what it does not say.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/memory_use.h>
#include <whitney/cells/subdivide.h>
#include <whitney/construction/triangulate.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/io/read_problem.h>
#include <whitney/manifolds/closed_form_manifolds.h>
#include <whitney/manifolds/implicit_manifold.h>
#include <whitney/topology/topology.h>

namespace whitney {
namespace {

using perturbation::Verdict;

coxeter::Triangulation moved_coxeter(int d, double edge_length) {
  TriangulationSpec spec;
  spec.rotation = TriangulationSpec::Rotation::kRandom;
  return make_triangulation(spec, d, edge_length);
}

Submanifold implicit_circle() {
  return implicit_manifold(
      make_function(2, 1, [](std::span<const double> x, std::span<double> f) { f[0] = x[0] * x[0] + x[1] * x[1] - 1; }),
      {1, 0});
}

TEST(Ingredients, AreNamed) {
  const Submanifold exact = closed_form::sphere(1, 2);
  const auto triangulation = moved_coxeter(2, 0.3);
  TriangulateResult result = triangulate(exact, *exact.bending(), triangulation, exact.seed_points());
  EXPECT_EQ(result.ingredients.reach, Bending::Source::kProven);
  EXPECT_EQ(result.ingredients.feet.errors, FootPromise::Errors::kProven);
  EXPECT_EQ(result.ingredients.components, Components::kAll);
  EXPECT_TRUE(result.ingredients.are_proven());

  const Submanifold zero_set = implicit_circle();
  result = triangulate(zero_set, {0.9, 0.9, Bending::Source::kCaller}, triangulation, zero_set.seed_points());
  EXPECT_EQ(result.certificate.verdict, Verdict::kCertified);
  EXPECT_EQ(result.ingredients.reach, Bending::Source::kCaller);
  EXPECT_EQ(result.ingredients.feet.errors, FootPromise::Errors::kModelled);
  EXPECT_EQ(result.ingredients.components, Components::kOfGivenSeeds);
  EXPECT_FALSE(result.ingredients.are_proven());
  EXPECT_STREQ(to_string(result.ingredients.components), "seeds_given");
}

TEST(Ingredients, OneOfTwoSpheres) {
  const NamedManifold spheres = two_spheres();
  const Submanifold M = implicit_manifold(spheres.function, spheres.point);
  TriangulateOptions options;
  options.seeds_were_searched = true;
  const auto result = triangulate(M, {1, 1, Bending::Source::kCaller}, moved_coxeter(3, 0.4), spheres.point, options);
  EXPECT_EQ(result.certificate.verdict, Verdict::kCertified) << result.certificate.reason;
  EXPECT_EQ(topology_of(barycentric_subdivision(result.complex)).components, 1u);
  EXPECT_EQ(result.ingredients.components, Components::kOfSearchedSeeds);
}

/// The unit circle, except that points near (2.5, 0) are on another component.
class OneMorePoint : public Submanifold::Model {
 public:
  int ambient_dim() const override { return 2; }
  int intrinsic_dim() const override { return 1; }
  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
               FootErrors& errors) const override {
    const bool is_other = std::hypot(x[0] - 2.5, x[1]) < 0.001;
    const double length = std::hypot(x[0], x[1]);
    if (!(length > 0)) return false;
    for (int c = 0; c < 2; ++c) {
      frame[2 + c] = x[c] / length;
      point[c] = is_other ? (c == 0 ? 2.5 : 0) : frame[2 + c];
    }
    frame[0] = -frame[3];
    frame[1] = frame[2];
    errors = {1e-14, 1e-14};
    return true;
  }
  std::optional<Bending> bending() const override { return Bending{1, 1, Bending::Source::kCaller}; }
  std::vector<double> seed_points() const override { return {1, 0, 2.5, 0}; }
};

TEST(Ingredients, ASeedOutsideTheCertifiedSimplicesIsNamed) {
  const Submanifold M(std::make_shared<OneMorePoint>());
  const auto triangulation = moved_coxeter(2, 0.3);
  const std::vector<double> one{1, 0}, both = M.seed_points();
  EXPECT_EQ(triangulate(M, *M.bending(), triangulation, one).certificate.verdict, Verdict::kCertified);
  const TriangulateResult result = triangulate(M, *M.bending(), triangulation, both);
  EXPECT_EQ(result.certificate.verdict, Verdict::kNotCertified);
  EXPECT_EQ(result.seeds_outside, (std::vector<double>{2.5, 0}));
  EXPECT_NE(result.certificate.reason.find("(2.5, 0)"), std::string::npos) << result.certificate.reason;
  EXPECT_FALSE(result.hausdorff_bound);
}

TEST(Ingredients, ModelledFeetProveNothingAboutTheReach) {
  const Submanifold M = implicit_circle();
  const TriangulateResult result =
      triangulate(M, {5, 5, Bending::Source::kCaller}, moved_coxeter(2, 0.3), M.seed_points());
  EXPECT_EQ(result.certificate.verdict, Verdict::kNotCertified);
  EXPECT_FALSE(result.reach_check.consistent);
  EXPECT_NE(result.certificate.reason.find("suggest"), std::string::npos) << result.certificate.reason;
  EXPECT_EQ(result.certificate.reason.find("cannot be"), std::string::npos) << result.certificate.reason;
}

// f is a difference of numbers of 1e12, so the feet are off by 1e-5, and some are not found at all.
TEST(Ingredients, AFarCircleWrittenOut) {
  const Function f = make_function(2, 1, [](std::span<const double> x, std::span<double> v) {
    v[0] = x[0] * x[0] - 2e6 * x[0] + 1e12 + x[1] * x[1] - 100;
  });
  const Submanifold M = implicit_manifold(f, {1e6 + 10, 0});
  for (const auto scheme : {TriangulateOptions::Scheme::kRepair, TriangulateOptions::Scheme::kNone}) {
    TriangulateOptions options;
    options.scheme = scheme;
    options.max_rounds = 2;
    options.run.max_simplices = 300;
    const TriangulateResult result =
        triangulate(M, {10, 10, Bending::Source::kCaller}, moved_coxeter(2, 1), M.seed_points(), options);
    EXPECT_NE(result.certificate.verdict, Verdict::kViolated) << result.certificate.reason;
    EXPECT_EQ(result.certificate.reason.find("cannot be"), std::string::npos) << result.certificate.reason;
    EXPECT_EQ(result.complex.ambient_dim, 2);
  }
}

TEST(HausdorffBoundOfTriangulate, HoldsInBothDirections) {
  // Distances of points of the circle from K, exactly.
  for (const double edge_length : {0.2, 0.5, 0.8, 1.0, 1.2}) {
    const Submanifold M = closed_form::sphere(1, 2);
    const TriangulateResult result = triangulate(M, *M.bending(), moved_coxeter(2, edge_length), M.seed_points());
    EXPECT_EQ(result.hausdorff_bound.has_value() && result.certificate.verdict != Verdict::kCertified, false);
    if (!result.hausdorff_bound) continue;
    const SimplicialMesh K = barycentric_subdivision(result.complex);
    double farthest = 0;
    for (int i = 0; i < 2000; ++i) {
      const double y[2] = {std::cos(0.00314159 * i), std::sin(0.00314159 * i)};
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t s = 0; s < K.num_simplices(); ++s) {
        const double *a = &K.points[2 * K.simplices[2 * s]], *b = &K.points[2 * K.simplices[2 * s + 1]];
        const double u[2] = {b[0] - a[0], b[1] - a[1]}, squared = u[0] * u[0] + u[1] * u[1];
        const double t = std::clamp(((y[0] - a[0]) * u[0] + (y[1] - a[1]) * u[1]) / squared, 0.0, 1.0);
        nearest = std::min(nearest, std::hypot(a[0] + t * u[0] - y[0], a[1] + t * u[1] - y[1]));
      }
      farthest = std::max(farthest, nearest);
    }
    EXPECT_LE(farthest, *result.hausdorff_bound) << edge_length;
  }
  const Submanifold M = closed_form::sphere(1, 2);
  EXPECT_TRUE(triangulate(M, *M.bending(), moved_coxeter(2, 0.5), M.seed_points()).hausdorff_bound);
}

TEST(TriangulateLimits, EveryPhaseAsks) {
  const Submanifold M = closed_form::sphere(2, 3);
  const auto triangulation = moved_coxeter(3, 0.2);
  for (const std::string last : {"perturb", "certify", "complex", "place"}) {
    TriangulateOptions options;
    std::vector<std::string> phases;
    options.run.progress = [&](const Progress& progress) {
      if (phases.empty() || phases.back() != progress.phase) phases.emplace_back(progress.phase);
      return progress.phase != last;
    };
    const TriangulateResult result = triangulate(M, *M.bending(), triangulation, M.seed_points(), options);
    EXPECT_EQ(result.stop_reason, StopReason::kCancelled) << last;
    EXPECT_FALSE(result.left_out.empty()) << last;
    EXPECT_EQ(phases.back(), last);
    EXPECT_FALSE(result.hausdorff_bound) << last;
  }
}

TEST(TriangulateLimits, Memory) {
  const Submanifold M = closed_form::flat_torus();
  const auto triangulation = moved_coxeter(4, 0.12);
  TriangulateOptions options;
  options.run.memory_limit = 1;
  TriangulateResult result = triangulate(M, *M.bending(), triangulation, M.seed_points(), options);
  EXPECT_EQ(result.stop_reason, StopReason::kMemoryLimit);
  EXPECT_NE(result.certificate.verdict, Verdict::kCertified);
  EXPECT_FALSE(result.left_out.empty());
  const std::uint64_t before = resident_bytes();
  options.run.memory_limit = before + (std::uint64_t{30} << 20);
  result = triangulate(M, *M.bending(), triangulation, M.seed_points(), options);
  EXPECT_EQ(result.stop_reason, StopReason::kMemoryLimit);
  EXPECT_GT(result.certificate.simplices, 0u);
  EXPECT_LT(resident_bytes(), options.run.memory_limit + (std::uint64_t{30} << 20));
}

}  // namespace
}  // namespace whitney
