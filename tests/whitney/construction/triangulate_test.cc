// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/triangulate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <coxeter/placement.h>
#include <whitney/cells/subdivide.h>
#include <whitney/construction/scale_search.h>
#include <whitney/io/read_problem.h>
#include <whitney/manifolds/closed_form_manifolds.h>
#include <whitney/manifolds/immersed_surfaces.h>
#include <whitney/manifolds/matrix_manifolds.h>
#include <whitney/manifolds/submanifold_combinators.h>
#include <whitney/topology/orientation.h>
#include <whitney/topology/topology.h>

namespace whitney {
namespace {

using perturbation::Verdict;

struct Case {
  std::string name;
  Submanifold (*make)();
  double ratio;  ///< edge length / reach
  std::int64_t chi;
  bool orientable;
  std::string homology;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

coxeter::Triangulation moved_coxeter(int d, double edge_length, std::uint64_t rng_seed = 1) {
  TriangulationSpec spec;
  spec.rotation = TriangulationSpec::Rotation::kRandom;
  spec.rng_seed = rng_seed;
  return make_triangulation(spec, d, edge_length);
}

std::string homology_of(const Topology& topology) {
  std::string text;
  for (const HomologyGroup& group : *topology.homology_z) text += (text.empty() ? "" : ", ") + to_string(group);
  return text;
}

double distance(const double* a, const double* b, int d) {
  double sum = 0;
  for (int c = 0; c < d; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(sum);
}

class Certified : public testing::TestWithParam<Case> {};

// Certified, and K has the homology that theory gives: the proof and the topology of K are computed apart.
TEST_P(Certified, IsTheManifold) {
  const Case& c = GetParam();
  const Submanifold M = c.make();
  const int d = M.ambient_dim(), n = M.intrinsic_dim();
  const Bending bending = *M.bending();
  const auto seeds = M.seed_points();
  const TriangulateResult result = triangulate(M, bending, moved_coxeter(d, c.ratio * bending.reach), seeds);
  ASSERT_EQ(result.certificate.verdict, Verdict::kCertified) << result.certificate.reason;
  EXPECT_GT(result.certificate.margin_min, 1);
  EXPECT_LE(result.vertices_moved, result.vertices_near);
  EXPECT_TRUE(result.reach_check.consistent);
  EXPECT_GE(result.reach_check.largest_possible, bending.reach * (1 - 1e-6));

  const SimplicialMesh K = barycentric_subdivision(result.complex);
  const Topology topology = topology_of(K);
  EXPECT_TRUE(topology.is_closed_manifold());
  EXPECT_EQ(topology.euler_characteristic, c.chi);
  EXPECT_EQ(topology.orientable, c.orientable);
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(homology_of(topology), c.homology);

  // The distance bound, against the feet of the vertices and barycentres of K, and of points of M.
  ASSERT_TRUE(result.hausdorff_bound);
  const double hausdorff_bound = *result.hausdorff_bound;
  ASSERT_LT(hausdorff_bound, bending.reach);
  std::vector<double> point(d), frame(d * d), centre(d);
  FootErrors errors;
  double farthest = 0;
  for (std::size_t s = 0; s < K.num_simplices(); s += 1 + K.num_simplices() / 3000) {
    std::fill(centre.begin(), centre.end(), 0.0);
    for (int j = 0; j <= n; ++j)
      for (int x = 0; x < d; ++x) centre[x] += K.points[K.simplices[s * (n + 1) + j] * d + x] / (n + 1);
    ASSERT_TRUE(M.project(centre, point, frame, errors));
    farthest = std::max(farthest, distance(centre.data(), point.data(), d));
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < K.num_points() && nearest > hausdorff_bound; ++v)
      nearest = std::min(nearest, distance(point.data(), &K.points[v * d], d));
    // Vertices alone are a coarse stand-in for K: half the longest edge of the triangulation is far more than enough.
    EXPECT_LT(nearest, hausdorff_bound + 0.5 * result.edge_length);
  }
  EXPECT_LE(farthest, hausdorff_bound);
  EXPECT_GT(farthest, 1e-4 * hausdorff_bound);  // the bound speaks of this
}

const Case kCases[] = {
    {"circle_r2", [] { return closed_form::sphere(1, 2); }, 0.8, 0, true, "Z, Z"},
    {"circle_r3", [] { return closed_form::sphere(1, 3); }, 0.3, 0, true, "Z, Z"},
    {"circle_r4", [] { return closed_form::sphere(1, 4); }, 0.2, 0, true, "Z, Z"},
    {"circle_r5", [] { return closed_form::sphere(1, 5); }, 0.1, 0, true, "Z, Z"},
    {"circle_r6", [] { return closed_form::sphere(1, 6); }, 0.08, 0, true, "Z, Z"},
    {"sphere_r3", [] { return closed_form::sphere(2, 3); }, 0.5, 2, true, "Z, 0, Z"},
    {"torus_r3", [] { return closed_form::torus_of_revolution(); }, 0.5, 0, true, "Z, Z^2, Z"},
    {"sphere_r4", [] { return closed_form::sphere(2, 4); }, 0.25, 2, true, "Z, 0, Z"},
    {"flat_torus", [] { return closed_form::flat_torus(); }, 0.3, 0, true, "Z, Z^2, Z"},
    {"three_sphere", [] { return closed_form::sphere(3, 4); }, 0.5, 0, true, "Z, 0, 0, Z"},
    {"klein_bottle", [] { return klein_bottle(); }, 0.4, 0, false, "Z, Z + Z/2, 0"},
    {"projective_plane", [] { return projective_plane(); }, 0.3, 1, false, "Z, Z/2, 0"},
    {"projectors", [] { return projective_plane_projectors(); }, 0.2, 1, false, "Z, Z/2, 0"},
};
INSTANTIATE_TEST_SUITE_P(Triangulate, Certified, testing::ValuesIn(kCases),
                         [](const auto& test) { return test.param.name; });

TEST(Triangulate, MovedAndScaledCopiesHaveTheSameTopology) {
  for (const double unit : {1.0, 1e-9, 1e9})
    for (std::uint64_t rng_seed = 1; rng_seed <= 2; ++rng_seed) {
      const Submanifold M = scale(rotate(closed_form::sphere(1, 3), coxeter::random_rotation(3, rng_seed)), unit);
      const TriangulateResult result =
          triangulate(M, *M.bending(), moved_coxeter(3, 0.3 * unit, rng_seed), M.seed_points());
      EXPECT_EQ(result.certificate.verdict, Verdict::kCertified) << unit << " " << result.certificate.reason;
      EXPECT_EQ(topology_of(barycentric_subdivision(result.complex)).euler_characteristic, 0);
    }
}

TEST(Triangulate, ExactZerosInFreudenthalPosition) {
  const Submanifold M = closed_form::sphere(2, 3, 2);  // lattice vertices lie on it
  const TriangulateResult result =
      triangulate(M, *M.bending(), coxeter::freudenthal(3, 0.5 * std::sqrt(3.0)), M.seed_points());
  EXPECT_EQ(result.certificate.verdict, Verdict::kCertified) << result.certificate.reason;
  const Topology topology = topology_of(barycentric_subdivision(result.complex));
  EXPECT_TRUE(topology.is_closed_manifold());
  EXPECT_EQ(topology.euler_characteristic, 2);
}

TEST(Triangulate, SequentialSchemeOfThePaper) {
  const Submanifold M = closed_form::sphere(2, 3);
  TriangulateOptions options;
  options.scheme = TriangulateOptions::Scheme::kSequential;
  const TriangulateResult result = triangulate(M, *M.bending(), moved_coxeter(3, 0.3), M.seed_points(), options);
  EXPECT_EQ(result.certificate.verdict, Verdict::kCertified) << result.certificate.reason;
  EXPECT_EQ(topology_of(barycentric_subdivision(result.complex)).euler_characteristic, 2);
}

TEST(Triangulate, SameResultFromAnotherSeedPoint) {
  const Submanifold M = closed_form::sphere(2, 3);
  const auto triangulation = moved_coxeter(3, 0.4);
  const TriangulateResult a = triangulate(M, *M.bending(), triangulation, std::vector<double>{1, 0, 0});
  const TriangulateResult b = triangulate(M, *M.bending(), triangulation, std::vector<double>{0, -0.3, 0.2});
  EXPECT_EQ(a.complex.points, b.complex.points);
  EXPECT_EQ(a.complex.facets.back().index, b.complex.facets.back().index);
}

TEST(Triangulate, SeedsOfOneComponentAreMerged) {
  const Submanifold M = closed_form::sphere(1, 2);
  const std::vector<double> seeds{1, 0, 1.1, 0.001, -1, 0, 0, 0};
  const TriangulateResult result = triangulate(M, *M.bending(), moved_coxeter(2, 0.3), seeds);
  EXPECT_EQ(result.seeds_dropped, 1u);  // the centre has no closest point
  EXPECT_EQ(result.seeds_used + result.seeds_merged, 3u);
  EXPECT_EQ(result.certificate.verdict, Verdict::kCertified);
}

TEST(Triangulate, AClaimedReachThatFeetContradictIsNotCertified) {
  const Submanifold M = closed_form::sphere(1, 2);
  const TriangulateResult result =
      triangulate(M, {5, 5, Bending::Source::kCaller}, moved_coxeter(2, 0.3), M.seed_points());
  EXPECT_EQ(result.certificate.verdict, Verdict::kNotCertified);
  EXPECT_FALSE(result.reach_check.consistent);
  EXPECT_NEAR(result.reach_check.largest_possible, 1, 1e-6);
  EXPECT_NE(result.certificate.reason.find("reach"), std::string::npos);
  EXPECT_EQ(result.reach_check.p.size(), 2u);
}

TEST(Triangulate, TooCoarseIsNotCertifiedAndSaysWhere) {
  const Submanifold M = closed_form::sphere(1, 2);
  for (const double edge_length : {1.6, 2.5, 4.0, 10.0}) {
    const TriangulateResult result = triangulate(M, *M.bending(), moved_coxeter(2, edge_length), M.seed_points());
    EXPECT_NE(result.certificate.verdict, Verdict::kCertified) << edge_length;
    EXPECT_FALSE(result.certificate.reason.empty());
    // The whole circle in one triangle: proved.
    if (edge_length == 10.0) {
      EXPECT_EQ(result.certificate.verdict, Verdict::kViolated);
    }
  }
}

TEST(Triangulate, StopsAtItsLimits) {
  const Submanifold M = closed_form::flat_torus();
  const auto triangulation = moved_coxeter(4, 0.2);
  TriangulateOptions options;
  options.run.max_simplices = 500;
  TriangulateResult result = triangulate(M, *M.bending(), triangulation, M.seed_points(), options);
  EXPECT_EQ(result.stop_reason, StopReason::kMaxSimplices);
  EXPECT_EQ(result.certificate.verdict, Verdict::kNotCertified);
  options = {};
  options.run.time_limit = 0;
  result = triangulate(M, *M.bending(), triangulation, M.seed_points(), options);
  EXPECT_EQ(result.stop_reason, StopReason::kTimeLimit);
  EXPECT_NE(result.certificate.verdict, Verdict::kCertified);
  options = {};
  int asked = 0;
  options.run.progress = [&](const Progress& progress) {
    EXPECT_NE(progress.phase, nullptr);
    return ++asked < 3;
  };
  result = triangulate(M, *M.bending(), triangulation, M.seed_points(), options);
  EXPECT_EQ(result.stop_reason, StopReason::kCancelled);
  EXPECT_NE(result.certificate.verdict, Verdict::kCertified);
}

TEST(Triangulate, APartNearADomainIsCertifiedByItself) {
  const double edge_length = 0.3;
  const Submanifold M = closed_form::sphere(2, 3);
  TriangulateOptions options;
  options.inequalities = make_function(3, 1, [](auto x, auto v) { v[0] = x[2] - 0.1; });
  const auto triangulation = moved_coxeter(3, edge_length);
  const std::vector<double> pole{0, 0, 1};
  const TriangulateResult cap = triangulate(M, *M.bending(), triangulation, pole, options);
  EXPECT_EQ(cap.certificate.verdict, Verdict::kCertified) << cap.certificate.reason;
  EXPECT_TRUE(cap.cut);
  const SimplicialMesh K = barycentric_subdivision(cap.complex);
  const Topology t = topology_of(K);
  EXPECT_TRUE(t.is_manifold());
  EXPECT_EQ(t.euler_characteristic, 1);
  EXPECT_EQ(t.boundary_components, 1u);
  // It covers the cap and ends less than an edge length beyond it.
  for (std::size_t i = 2; i < K.points.size(); i += 3) EXPECT_GT(K.points[i], 0.1 - 2 * edge_length);
  for (int i = 0; i < 400; ++i) {
    const double z = 0.1 + 0.9 * (i + 0.5) / 400, angle = 2.4 * i, r = std::sqrt(1 - z * z);
    const double x[3] = {r * std::cos(angle), r * std::sin(angle), z};
    double nearest = 10;
    for (std::size_t v = 0; v < K.num_points(); ++v) nearest = std::min(nearest, distance(x, &K.points[3 * v], 3));
    EXPECT_LT(nearest, edge_length / 2);
  }
  // An inequality that M does not meet changes nothing; outside the domain there is nothing to find.
  options.inequalities = make_function(3, 1, [](auto x, auto v) { v[0] = x[2] + 3; });
  const TriangulateResult all = triangulate(M, *M.bending(), triangulation, pole, options);
  EXPECT_FALSE(all.cut);
  EXPECT_EQ(all.complex.points, triangulate(M, *M.bending(), triangulation, pole).complex.points);
  options.inequalities = make_function(3, 1, [](auto x, auto v) { v[0] = x[2] - 3; });
  EXPECT_EQ(triangulate(M, *M.bending(), triangulation, pole, options).certificate.simplices, 0u);
  options.inequalities = make_function(3, 1, [](auto x, auto v) { v[0] = std::sqrt(x[2]); });
  EXPECT_THROW(triangulate(M, *M.bending(), triangulation, pole, options), OracleError);
}

TEST(Triangulate, RejectsWrongArguments) {
  const Submanifold M = closed_form::sphere(1, 3);
  const auto triangulation = moved_coxeter(3, 0.3);
  const Bending bending = *M.bending();
  const std::vector<double> seeds = M.seed_points();
  EXPECT_THROW(triangulate(M, bending, moved_coxeter(2, 0.3), seeds), InvalidInput);
  EXPECT_THROW(triangulate(M, bending, triangulation, {}), InvalidInput);
  EXPECT_THROW(triangulate(M, bending, triangulation, std::vector<double>{1, 0}), InvalidInput);
  EXPECT_THROW(triangulate(M, bending, triangulation, std::vector<double>{1, 0, std::nan("")}), InvalidInput);
  EXPECT_THROW(triangulate(M, {0, 0, Bending::Source::kCaller}, triangulation, seeds), InvalidInput);
  EXPECT_THROW(triangulate(M, {std::nan(""), 0, Bending::Source::kCaller}, triangulation, seeds), InvalidInput);
  EXPECT_THROW(triangulate(M, {1, 0.5, Bending::Source::kCaller}, triangulation, seeds), InvalidInput);
  TriangulateOptions options;
  options.box = Box{{-2, -2}, {2, 2}};
  EXPECT_THROW(triangulate(M, bending, triangulation, seeds, options), InvalidInput);
  options.box = Box{{-2, -0.5, -2}, {2, 2, 2}};  // M leaves it
  EXPECT_THROW(triangulate(M, bending, triangulation, seeds, options), InvalidInput);
  options.box = Box{{-1, -1, -1}, {1, 1, 1}};  // M touches its faces
  EXPECT_EQ(triangulate(M, bending, triangulation, seeds, options).certificate.verdict, Verdict::kCertified);
  options = {};
  options.displacement_fraction = 1;
  EXPECT_THROW(triangulate(M, bending, triangulation, seeds, options), InvalidInput);
}

TEST(ScaleSearch, FindsACertifiedScaleByItself) {
  for (const Submanifold& M : {closed_form::sphere(1, 2), closed_form::sphere(2, 3), closed_form::sphere(1, 4)}) {
    const int d = M.ambient_dim();
    const ScaleSearchResult search = search_scale(
        M, *M.bending(), [&](double L) { return moved_coxeter(d, L); }, M.seed_points());
    EXPECT_EQ(search.result.certificate.verdict, Verdict::kCertified);
    ASSERT_FALSE(search.attempts.empty());
    EXPECT_LE(search.attempts.size(), 4u);
    for (std::size_t i = 0; i + 1 < search.attempts.size(); ++i)
      EXPECT_NE(search.attempts[i].verdict, Verdict::kCertified);
  }
}

TEST(ScaleSearch, EndsWhenTheReachIsContradicted) {
  const Submanifold M = closed_form::sphere(1, 2);
  ScaleSearchOptions options;
  options.first_edge_length = 0.3;
  const ScaleSearchResult search = search_scale(
      M, {7, 7, Bending::Source::kCaller}, [](double L) { return moved_coxeter(2, L); }, M.seed_points(), options);
  EXPECT_EQ(search.attempts.size(), 1u);
  EXPECT_NE(search.result.certificate.verdict, Verdict::kCertified);
}

}  // namespace
}  // namespace whitney
