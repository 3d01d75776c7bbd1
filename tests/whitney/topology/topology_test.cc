// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/topology.h>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include "test_complexes.h"

namespace whitney {
namespace {

using testing::Complex;
using testing::mesh_of;
using testing::Side;

std::string groups_of(const Topology& topology) {
  std::string text;
  for (const HomologyGroup& group : topology.homology_z.value()) text += (text.empty() ? "" : ", ") + to_string(group);
  return text;
}

struct Expected {
  std::string name;
  SimplicialMesh mesh;
  ManifoldKind kind;
  std::int64_t chi;
  std::size_t components;
  std::size_t boundary_components;
  bool orientable;
  std::string homology;
  std::vector<std::size_t> betti_z2;
};

TEST(Topology, OfKnownMeshes) {
  using enum ManifoldKind;
  const SimplicialMesh sphere = testing::simplex_sphere(2);
  const SimplicialMesh torus = testing::grid_surface(5, 4, Side::kGlued, Side::kGlued);
  const SimplicialMesh moebius = testing::grid_surface(7, 2, Side::kFlipped, Side::kOpen);
  const SimplicialMesh disc = testing::grid_surface(3, 3, Side::kOpen, Side::kOpen);
  const std::vector<Expected> cases{
      {"three points", mesh_of(0, {{0}, {1}, {2}}), kClosed, 3, 3, 0, true, "Z^3", {3}},
      {"circle", testing::simplex_sphere(1), kClosed, 0, 1, 0, true, "Z, Z", {1, 1}},
      {"arc and circle",
       testing::disjoint_union(mesh_of(1, {{0, 1}, {1, 2}}), testing::simplex_sphere(1)),
       kWithBoundary,
       1,
       2,
       2,
       true,
       "Z^2, Z",
       {2, 1}},
      {"theta", mesh_of(1, {{0, 1}, {0, 2}, {2, 1}, {0, 3}, {3, 1}}), kSingular, -1, 1, 0, false, "Z, Z^2", {1, 2}},
      {"sphere", sphere, kClosed, 2, 1, 0, true, "Z, 0, Z", {1, 0, 1}},
      {"torus", torus, kClosed, 0, 1, 0, true, "Z, Z^2, Z", {1, 2, 1}},
      {"genus 4", testing::genus_surface(4), kClosed, -6, 1, 0, true, "Z, Z^8, Z", {1, 8, 1}},
      {"projective plane", testing::projective_plane6(), kClosed, 1, 1, 0, false, "Z, Z/2, 0", {1, 1, 1}},
      {"Klein bottle",
       testing::grid_surface(5, 5, Side::kFlipped, Side::kGlued),
       kClosed,
       0,
       1,
       0,
       false,
       "Z, Z + Z/2, 0",
       {1, 2, 1}},
      {"Moebius strip", moebius, kWithBoundary, 0, 1, 1, false, "Z, Z, 0", {1, 1, 0}},
      {"cylinder",
       testing::grid_surface(5, 2, Side::kGlued, Side::kOpen),
       kWithBoundary,
       0,
       1,
       2,
       true,
       "Z, Z, 0",
       {1, 1, 0}},
      {"disc", disc, kWithBoundary, 1, 1, 1, true, "Z, 0, 0", {1, 0, 0}},
      {"disc, torus, Moebius strip",
       testing::disjoint_union(disc, testing::disjoint_union(torus, moebius)),
       kWithBoundary,
       1,
       3,
       2,
       false,
       "Z^3, Z^3, Z",
       {3, 3, 1}},
      {"two spheres at a point", testing::wedge(sphere, sphere), kSingular, 3, 1, 0, true, "Z, 0, Z^2", {1, 0, 2}},
      {"two triangles at a point", mesh_of(2, {{0, 1, 2}, {2, 3, 4}}), kSingular, 1, 1, 1, true, "Z, 0, 0", {1, 0, 0}},
      {"three triangles at an edge",
       mesh_of(2, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}),
       kSingular,
       1,
       1,
       1,
       false,
       "Z, 0, 0",
       {1, 0, 0}},
      {"suspended torus",
       testing::suspension(testing::torus7()),
       kSingular,
       2,
       1,
       0,
       true,
       "Z, 0, Z^2, Z",
       {1, 0, 2, 1}},
      {"solid", testing::cone(sphere), kWithBoundary, 1, 1, 1, true, "Z, 0, 0, 0", {1, 0, 0, 0}},
      {"RP^3", testing::flags(testing::projective_space(3)), kClosed, 0, 1, 0, true, "Z, Z/2, 0, Z", {1, 1, 1, 1}},
      {"L(3,1)", testing::flags(testing::lens_space(3, 1)), kClosed, 0, 1, 0, true, "Z, Z/3, 0, Z", {1, 0, 0, 1}},
      {"RP^4",
       testing::flags(testing::projective_space(4)),
       kClosed,
       1,
       1,
       0,
       false,
       "Z, Z/2, 0, Z/2, 0",
       {1, 1, 1, 1, 1}},
      {"S^4", testing::cross_polytope(4), kClosed, 2, 1, 0, true, "Z, 0, 0, 0, Z", {1, 0, 0, 0, 1}}};
  for (const Expected& expected : cases) {
    for (const int splits : {0, 25}) {
      SCOPED_TRACE(expected.name + (splits > 0 ? ", subdivided" : ""));
      if (splits > 0 && expected.mesh.dim == 0) continue;
      const SimplicialMesh mesh =
          splits == 0 ? expected.mesh : testing::randomly_subdivided(expected.mesh, splits, expected.name.size());
      const Topology found = topology_of(mesh);
      EXPECT_EQ(found.manifold, expected.kind);
      EXPECT_EQ(found.is_closed_manifold(), expected.kind == kClosed);
      EXPECT_EQ(found.is_manifold(), expected.kind != kSingular);
      EXPECT_TRUE(found.links_proved);
      EXPECT_EQ(found.witness.has_value(), expected.kind == kSingular);
      EXPECT_EQ(found.singular_vertices > 0, expected.kind == kSingular);
      EXPECT_EQ(found.euler_characteristic, expected.chi);
      EXPECT_EQ(found.components, expected.components);
      EXPECT_EQ(found.boundary_components, expected.boundary_components);
      EXPECT_EQ(found.boundary_faces > 0, expected.boundary_components > 0);
      EXPECT_EQ(found.orientable, expected.orientable);
      EXPECT_EQ(groups_of(found), expected.homology);
      EXPECT_EQ(found.betti_z2, expected.betti_z2);
      EXPECT_TRUE(found.pure);
      EXPECT_EQ(found.unused_points, 0u);
      EXPECT_EQ(found.f_vector.back(), mesh.num_simplices());
    }
  }
}

TEST(Topology, CountsDefects) {
  const Topology book = topology_of(mesh_of(2, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 5}}));
  EXPECT_EQ(book.branching_faces, 1u);
  EXPECT_EQ(book.boundary_faces, 8u);
  EXPECT_EQ(book.singular_vertices, 2u);
  ASSERT_TRUE(book.witness.has_value());
  EXPECT_EQ(book.witness->face, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(book.f_vector, (std::vector<std::size_t>{6, 9, 4}));
}

TEST(Topology, UnusedPointsAreCountedApart) {
  SimplicialMesh mesh = testing::torus7();
  mesh.points.resize(12);
  const Topology found = topology_of(mesh);
  EXPECT_EQ(found.unused_points, 5u);
  EXPECT_EQ(found.f_vector, (std::vector<std::size_t>{7, 21, 14}));
  EXPECT_EQ(found.components, 1u);
  EXPECT_TRUE(found.is_closed_manifold());
}

TEST(Topology, OfNothing) {
  const Topology mesh = topology_of(SimplicialMesh{.ambient_dim = 3, .dim = 2, .points = {}, .simplices = {}});
  EXPECT_EQ(mesh.f_vector, (std::vector<std::size_t>{0, 0, 0}));
  EXPECT_EQ(mesh.components, 0u);
  EXPECT_TRUE(mesh.is_closed_manifold());
  EXPECT_EQ(groups_of(mesh), "0, 0, 0");
  const Topology complex = topology_of(Complex{});
  EXPECT_TRUE(complex.f_vector.empty());
  EXPECT_EQ(complex.components, 0u);
}

TEST(Topology, ComputesWhatIsAsked) {
  const SimplicialMesh torus = testing::torus7();
  const Topology no_links = topology_of(torus, {.links = false});
  EXPECT_EQ(no_links.manifold, ManifoldKind::kNotChecked);
  EXPECT_FALSE(no_links.is_closed_manifold());
  EXPECT_FALSE(no_links.is_manifold());
  EXPECT_TRUE(no_links.homology_z.has_value());
  const Topology no_homology = topology_of(torus, {.homology = false});
  EXPECT_FALSE(no_homology.homology_z.has_value());
  EXPECT_FALSE(no_homology.betti_z2.has_value());
  EXPECT_TRUE(no_homology.is_closed_manifold());
  EXPECT_FALSE(topology_of(torus, {.max_homology_cells = 41}).homology_z.has_value());
  EXPECT_TRUE(topology_of(torus, {.max_homology_cells = 42}).homology_z.has_value());
}

TEST(Topology, RejectsWhatIsNoSimplicialComplex) {
  EXPECT_THROW(topology_of(mesh_of(2, {{0, 1, 1}})), InvalidInput);
  EXPECT_THROW(topology_of(mesh_of(2, {{0, 1, 2}, {2, 1, 0}})), InvalidInput);
  SimplicialMesh mesh = testing::torus7();
  mesh.points.pop_back();
  EXPECT_THROW(topology_of(mesh), InvalidInput);
}

TEST(Topology, OfComplexes) {
  const Complex klein = face_lattice(testing::grid_surface(5, 5, Side::kFlipped, Side::kGlued)).facets;
  const Topology solid = topology_of(testing::product(klein, testing::interval(3)));
  EXPECT_EQ(solid.manifold, ManifoldKind::kNotChecked);
  EXPECT_EQ(solid.euler_characteristic, 0);
  EXPECT_EQ(solid.components, 1u);
  EXPECT_EQ(solid.boundary_components, 2u);
  EXPECT_EQ(solid.boundary_faces, 100u);
  EXPECT_FALSE(solid.orientable);
  EXPECT_EQ(groups_of(solid), "Z, Z + Z/2, 0, 0");
  EXPECT_EQ(solid.betti_z2, (std::vector<std::size_t>{1, 2, 1, 0}));

  const Topology lens = topology_of(testing::lens_space(6, 1));
  EXPECT_TRUE(lens.orientable);
  EXPECT_EQ(lens.boundary_components, 0u);
  EXPECT_EQ(groups_of(lens), "Z, Z/6, 0, Z");

  Complex open_cell = testing::interval(2);
  testing::push(open_cell.emplace_back(), {0, 1});
  EXPECT_THROW(topology_of(open_cell), InvalidInput);
}

TEST(Topology, AComplexNeedNotBePure) {
  // A triangle, an edge at its corner, and a point.
  Complex facets(3);
  for (int v = 0; v < 5; ++v) testing::push(facets[0], {});
  for (const auto& edge : {std::vector<std::uint32_t>{0, 1}, {1, 2}, {2, 0}, {2, 3}}) testing::push(facets[1], edge);
  testing::push(facets[2], {0, 1, 2});
  const Topology found = topology_of(facets);
  EXPECT_FALSE(found.pure);
  EXPECT_EQ(found.components, 2u);
  EXPECT_EQ(found.boundary_faces, 3u);
  EXPECT_EQ(found.boundary_components, 1u);
  EXPECT_EQ(groups_of(found), "Z^2, 0, 0");
  EXPECT_TRUE(topology_of(Complex(facets.begin(), facets.begin() + 2)).pure == false);
}

TEST(Topology, AMeshAndItsFaceLatticeAgree) {
  for (const SimplicialMesh& mesh :
       {testing::torus7(), testing::cone(testing::torus7()), testing::projective_plane6()}) {
    const Topology a = topology_of(mesh);
    const Topology b = topology_of(face_lattice(mesh).facets);
    EXPECT_EQ(a.f_vector, b.f_vector);
    EXPECT_EQ(a.components, b.components);
    EXPECT_EQ(a.boundary_components, b.boundary_components);
    EXPECT_EQ(a.orientable, b.orientable);
    EXPECT_EQ(a.homology_z, b.homology_z);
  }
}

// A limit leaves out what it does not reach, and never leaves a wrong value.
TEST(Topology, LimitsLeaveOut) {
  const SimplicialMesh torus = testing::grid_surface(40, 40, Side::kGlued, Side::kGlued);
  const Topology whole = topology_of(torus);
  EXPECT_TRUE(whole.left_out.empty());
  EXPECT_EQ(whole.stop_reason, StopReason::kNone);

  const auto expect_counts_only = [&](const TopologyOptions& options, StopReason reason) {
    const Topology found = topology_of(torus, options);
    EXPECT_EQ(found.f_vector, whole.f_vector);
    EXPECT_EQ(found.euler_characteristic, 0);
    EXPECT_EQ(found.components, 1u);
    EXPECT_TRUE(found.orientable);
    EXPECT_FALSE(found.homology_z.has_value());
    EXPECT_FALSE(found.betti_z2.has_value());
    EXPECT_EQ(found.manifold, ManifoldKind::kNotChecked);
    EXPECT_FALSE(found.links_proved);
    EXPECT_EQ(found.left_out, (std::vector<std::string>{"homology", "vertex links"}));
    EXPECT_EQ(found.stop_reason, reason);
  };
  expect_counts_only({.run = {.time_limit = -1}}, StopReason::kTimeLimit);
  expect_counts_only({.run = {.memory_limit = 1000}}, StopReason::kMemoryLimit);
  expect_counts_only({.run = {.progress = [](const Progress&) { return false; }}}, StopReason::kCancelled);
  expect_counts_only({.begin_part = [](const char*, const auto&) { return false; }}, StopReason::kNone);

  // In the midst of each part.
  for (const std::string phase : {"homology", "links"}) {
    int calls = 0;
    const Topology found = topology_of(
        torus, {.run = {.progress = [&](const Progress& at) { return at.phase != phase || ++calls <= 3; }}});
    EXPECT_EQ(calls, 4) << phase;
    EXPECT_EQ(found.homology_z.has_value(), phase == "links");
    EXPECT_EQ(found.manifold, phase == "links" ? ManifoldKind::kNotChecked : ManifoldKind::kClosed);
    EXPECT_EQ(found.left_out.size(), 1u);
    EXPECT_EQ(found.stop_reason, StopReason::kCancelled);
  }
  // Limits that are not reached change nothing.
  const Topology limited = topology_of(torus, {.run = {.time_limit = 1e6, .memory_limit = std::uint64_t{1} << 50}});
  EXPECT_EQ(limited.homology_z, whole.homology_z);
  EXPECT_EQ(limited.manifold, ManifoldKind::kClosed);
  EXPECT_TRUE(limited.left_out.empty());
}

// A bad link that was found before the limit is a proof.
TEST(Topology, ADefectOutlivesALimit) {
  // Three triangles at an edge come first, a large torus after them.
  const SimplicialMesh book = mesh_of(2, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  const SimplicialMesh mesh = testing::disjoint_union(book, testing::grid_surface(40, 40, Side::kGlued, Side::kGlued));
  int calls = 0;
  const Topology found =
      topology_of(mesh, {.homology = false, .run = {.progress = [&](const Progress&) { return ++calls <= 3; }}});
  EXPECT_EQ(found.stop_reason, StopReason::kCancelled);
  EXPECT_EQ(found.manifold, ManifoldKind::kSingular);
  EXPECT_EQ(found.left_out, (std::vector<std::string>{"vertex links"}));
  EXPECT_FALSE(found.links_proved);
}

}  // namespace
}  // namespace whitney
