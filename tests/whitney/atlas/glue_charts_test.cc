// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/glue_charts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/topology/topology.h>
#include "atlas/glue_cases.h"

namespace whitney {
namespace {

using namespace glue_cases;
using testing::AllOf;
using testing::HasSubstr;

TEST(GlueCharts, SphereFromTwoDiscs) {
  std::mt19937_64 random(1);
  for (int run = 0; run < 60; ++run) {
    const std::size_t m = 3 + random() % (run < 30 ? 5 : 60), k = 3 + random() % (run < 30 ? 5 : 60);
    SCOPED_TRACE(testing::Message() << "run " << run << ": " << m << " and " << k << " edges");
    const double noise = 0.02 / static_cast<double>(std::max(m, k));
    const std::vector<ChartPiece> pieces{disc(circle(random_angles(m, random), noise, random)),
                                         disc(circle(random_angles(k, random), noise, random))};
    GlueOptions options;
    options.max_distance = 1;  // triangles with random angles are coarse
    const std::vector<Seam> seams{seam(0, 0, 1, 0, inversion(uniform(random, -7, 7), run % 2 == 0))};
    const GluedMesh glued = glue_charts(pieces, seams, options);
    expect_surface(glued, 2, true);
    expect_consistent(glued, pieces);
    EXPECT_EQ(glued.seams.at(0).num_loops, 1);
    // A chord of one circle is at most as far from the other polygon as the two sagittas.
    EXPECT_GT(glued.seams[0].worst_distance, 0);
    EXPECT_EQ(glued.seams[0].worst_place.size(), 2);
  }
}

TEST(GlueCharts, TheRefinementIsAsFineAsNeeded) {
  // The same polygon on both sides: nothing is inserted, and the triangles are those of the pieces.
  std::mt19937_64 random(2);
  const auto loop = circle(random_angles(20, random), 0, random);
  const std::vector<ChartPiece> pieces{disc(loop), disc(loop)};
  const GluedMesh glued = glue_charts(pieces, std::vector{seam(0, 0, 1, 0, [](const Point& p) { return p; })});
  EXPECT_EQ(glued.mesh.num_simplices(), 40);
  EXPECT_EQ(glued.mesh.num_points(), 22);
  EXPECT_LT(glued.seams[0].worst_distance, 1e-15);
  expect_surface(glued, 2, true);
  // Two single triangles: their quotient is no simplicial complex before it is refined.
  const auto triangle = circle({0, 2, 4}, 0, random);
  const std::vector<ChartPiece> two{disc(triangle), disc(triangle)};
  const GluedMesh pillow = glue_charts(two, std::vector{seam(0, 0, 1, 0, [](const Point& p) { return p; })});
  expect_surface(pillow, 2, true);
}

TEST(GlueCharts, QuotientsOfTheSquare) {
  struct Case {
    const char* name;
    bool flip_x, flip_y;
    std::int64_t chi;
    bool orientable;
  };
  for (const Case& c : {Case{"torus", false, false, 0, true}, Case{"Klein bottle", true, false, 0, false},
                        Case{"projective plane", true, true, 1, false}}) {
    std::mt19937_64 random(3);
    for (int run = 0; run < 30; ++run) {
      SCOPED_TRACE(testing::Message() << c.name << ", run " << run);
      std::array<int, 4> edges;
      for (int& e : edges) e = run == 0 ? 1 : 1 + static_cast<int>(random() % (run < 15 ? 3 : 12));
      const std::vector<ChartPiece> pieces{square(edges, 0.005, random)};
      const std::vector<Seam> seams{
          seam(0, 3, 0, 1, [&](const Point& p) { return Point(p[0] + 1, c.flip_x ? 1 - p[1] : p[1]); }),
          seam(0, 2, 0, 0, [&](const Point& p) { return Point(c.flip_y ? 1 - p[0] : p[0], p[1] - 1); })};
      const GluedMesh glued = glue_charts(pieces, seams);
      expect_surface(glued, c.chi, c.orientable);
      expect_consistent(glued, pieces);
      EXPECT_EQ(glued.seams[0].num_arcs, 1);
      EXPECT_EQ(glued.seams[0].num_corners, 2);
      // The four corners are one vertex of the torus and the Klein bottle, two of the projective plane.
      EXPECT_EQ(glued.vertex_of[0][0] == glued.vertex_of[0][edges[0]], c.chi == 0);
    }
  }
}

TEST(GlueCharts, BoundaryThatNoSeamNamesStays) {
  std::mt19937_64 random(4);
  for (const bool flip : {false, true}) {
    const std::vector<ChartPiece> pieces{square({4, 3, 2, 5}, 0.005, random)};
    const GluedMesh glued = glue_charts(
        pieces, std::vector{seam(0, 3, 0, 1, [&](const Point& p) { return Point(p[0] + 1, flip ? 1 - p[1] : p[1]); })});
    expect_surface(glued, 0, !flip, flip ? 1 : 2);
  }
  // Without seams the pieces stand side by side.
  const std::vector<ChartPiece> pieces{square({1, 1, 1, 1}, 0, random), square({2, 2, 2, 2}, 0, random)};
  const Topology topology = topology_of(glue_charts(pieces, {}).mesh);
  EXPECT_EQ(topology.components, 2);
  EXPECT_EQ(topology.boundary_components, 2);
}

TEST(GlueCharts, AntipodalBoundaryOfADisc) {
  std::mt19937_64 random(5);
  for (int run = 0; run < 40; ++run) {
    const std::size_t m = run < 3 ? 3 + run : 3 + random() % 40;
    SCOPED_TRACE(testing::Message() << m << " edges");
    // Triangles are far from their antipodal images.
    GlueOptions options;
    options.max_distance = 1;
    const std::vector<ChartPiece> pieces{disc(circle(random_angles(m, random), 0.02 / double(m), random))};
    const GluedMesh glued =
        glue_charts(pieces, std::vector{seam(0, 0, 0, 0, [](const Point& p) { return Point(-p); })}, options);
    expect_surface(glued, 1, false);
  }
  const std::vector<ChartPiece> pieces{disc(circle(random_angles(30, random), 0, random))};
  EXPECT_THAT(mismatch_of(pieces, {seam(0, 0, 0, 0, [](const Point& p) { return Point(p[0], -p[1]); })}),
              HasSubstr("fixed points"));
  EXPECT_THAT(mismatch_of(pieces, {seam(0, 0, 0, 0, [](const Point& p) { return p; })}), HasSubstr("fixed points"));
}

/// A closed surface of triangles whose sides are paired at random, each triangle a chart: every state that a quotient
/// can be in before it is made simplicial.
TEST(GlueCharts, RandomPairingsOfTriangles) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    std::mt19937_64 random(seed);
    const int triangles = 2 * (1 + static_cast<int>(random() % 4));
    const bool subdivided = seed % 3 == 2;
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << triangles << " triangles");
    const std::array<Point, 3> corners{Point(0, 0), Point(1, 0), Point(0.4, 0.9)};
    std::vector<ChartPiece> pieces;
    for (int t = 0; t < triangles; ++t) {
      std::vector<std::vector<Point>> sides;
      for (int i = 0; i < 3; ++i) {
        sides.push_back(
            segment(corners[i], corners[(i + 1) % 3], subdivided ? 1 + int(random() % 4) : 1, 0.001, random));
      }
      pieces.push_back(polygon(sides));
    }
    std::vector<int> side(3 * triangles);
    std::iota(side.begin(), side.end(), 0);
    std::shuffle(side.begin(), side.end(), random);
    std::vector<Seam> seams;
    std::vector<int> vertex(3 * triangles), component(triangles), flipped(3 * triangles), partner(3 * triangles);
    std::iota(vertex.begin(), vertex.end(), 0);
    std::iota(component.begin(), component.end(), 0);
    const auto find = [](std::vector<int>& parent, int x) {
      while (parent[x] != x) x = parent[x];
      return x;
    };
    for (std::size_t i = 0; i < side.size(); i += 2) {
      const int a = side[i], b = side[i + 1];
      const bool same = random() % 4 == 0;  // start to start: turns the orientation around
      const Point a0 = corners[a % 3], a1 = corners[(a + 1) % 3], b0 = corners[b % 3], b1 = corners[(b + 1) % 3];
      seams.push_back(seam(a / 3, a % 3, b / 3, b % 3, [=](const Point& p) {
        const double t = (p - a0).dot(a1 - a0) / (a1 - a0).squaredNorm();
        return Point(same ? (1 - t) * b0 + t * b1 : (1 - t) * b1 + t * b0);
      }));
      const auto end = [](int s) { return s / 3 * 3 + (s + 1) % 3; };
      vertex[find(vertex, a)] = find(vertex, same ? b : end(b));
      vertex[find(vertex, end(a))] = find(vertex, same ? end(b) : b);
      component[find(component, a / 3)] = find(component, b / 3);
      partner[a] = b;
      partner[b] = a;
      flipped[a] = flipped[b] = same;
    }
    std::int64_t num_vertices = 0;
    std::size_t num_components = 0;
    for (int v = 0; v < 3 * triangles; ++v) num_vertices += find(vertex, v) == v;
    for (int t = 0; t < triangles; ++t) num_components += find(component, t) == t;
    std::vector<int> sign(triangles, 0);
    bool orientable = true;
    for (int root = 0; root < triangles; ++root) {
      if (sign[root] != 0) continue;
      std::vector<int> stack{root};
      sign[root] = 1;
      while (!stack.empty()) {
        const int t = stack.back();
        stack.pop_back();
        for (int s = 3 * t; s < 3 * t + 3; ++s) {
          const int other = partner[s] / 3, wanted = flipped[s] ? -sign[t] : sign[t];
          if (sign[other] == 0) stack.push_back(other), sign[other] = wanted;
          orientable = orientable && sign[other] == wanted;
        }
      }
    }

    const Topology topology = topology_of(glue_charts(pieces, seams).mesh);
    EXPECT_EQ(topology.euler_characteristic, num_vertices - 3 * triangles / 2 + triangles);
    EXPECT_EQ(topology.components, num_components);
    EXPECT_EQ(topology.orientable, orientable);
    EXPECT_EQ(topology.manifold, ManifoldKind::kClosed);
  }
}

/// The arc of the unit circle between two angles.
ChartPiece arc(double from, double to, int edges) {
  ChartPiece piece;
  piece.mesh.ambient_dim = 2;
  piece.mesh.dim = 1;
  for (int i = 0; i <= edges; ++i) {
    const double a = from + (to - from) * i / edges;
    piece.mesh.points.insert(piece.mesh.points.end(), {std::cos(a), std::sin(a)});
    if (i > 0) piece.mesh.simplices.insert(piece.mesh.simplices.end(), {std::uint32_t(i - 1), std::uint32_t(i)});
  }
  piece.boundary = {{0, {0}}, {1, {std::uint32_t(edges)}}};
  return piece;
}

TEST(GlueCharts, CircleFromArcs) {
  const auto identity = [](const Point& p) { return p; };
  for (const int charts : {2, 3}) {
    for (const int edges : {1, 2, 7}) {
      std::vector<ChartPiece> pieces;
      std::vector<Seam> seams;
      for (int c = 0; c < charts; ++c) {
        pieces.push_back(arc(2 * kPi * c / charts, 2 * kPi * (c + 1) / charts, edges + c));
        seams.push_back(seam(c, 1, (c + 1) % charts, 0, identity));
      }
      const GluedMesh glued = glue_charts(pieces, seams);
      const Topology topology = topology_of(glued.mesh);
      EXPECT_EQ(topology.manifold, ManifoldKind::kClosed);
      EXPECT_EQ(topology.components, 1);
      expect_consistent(glued, pieces);
      EXPECT_EQ(glued.seams[0].num_corners, 1);
      seams.pop_back();
      EXPECT_EQ(topology_of(glue_charts(pieces, seams).mesh).manifold, ManifoldKind::kWithBoundary);
    }
  }
  // One arc, its ends glued; and both ends in one part, exchanged by the transition.
  for (const int edges : {1, 2, 3, 10}) {
    std::vector<ChartPiece> pieces{arc(0, kPi, edges)};
    const auto turn = [](const Point& p) { return Point(-p); };
    EXPECT_TRUE(topology_of(glue_charts(pieces, std::vector{seam(0, 0, 0, 1, turn)}).mesh).is_closed_manifold());
    pieces[0].boundary = {{0, {0, std::uint32_t(edges)}}};
    EXPECT_TRUE(topology_of(glue_charts(pieces, std::vector{seam(0, 0, 0, 0, turn)}).mesh).is_closed_manifold());
    EXPECT_THAT(mismatch_of(pieces, {seam(0, 0, 0, 0, identity)}), HasSubstr("fixed points"));
  }
}

TEST(GlueCharts, SameBytes) {
  std::mt19937_64 random(9);
  const std::vector<ChartPiece> pieces{square({5, 9, 7, 4}, 0.005, random)};
  const std::vector<Seam> seams{seam(0, 3, 0, 1, [](const Point& p) { return Point(p[0] + 1, p[1]); }),
                                seam(0, 2, 0, 0, [](const Point& p) { return Point(p[0], p[1] - 1); })};
  const GluedMesh a = glue_charts(pieces, seams), b = glue_charts(pieces, seams);
  EXPECT_EQ(a.mesh.points, b.mesh.points);
  EXPECT_EQ(a.mesh.simplices, b.mesh.simplices);
  EXPECT_EQ(a.vertex_of, b.vertex_of);
}

TEST(GlueCharts, EmptyPieces) {
  std::mt19937_64 random(10);
  ChartPiece empty;
  empty.mesh.ambient_dim = empty.mesh.dim = 2;
  const std::vector<ChartPiece> pieces{empty, disc(circle(random_angles(9, random), 0, random))};
  EXPECT_EQ(glue_charts(pieces, {}).mesh.num_simplices(), 9);
  EXPECT_THAT(mismatch_of(pieces, {seam(0, 0, 1, 0, inversion(0, false))}),
              AllOf(HasSubstr("0 loops"), HasSubstr("1 loop")));
}

}  // namespace
}  // namespace whitney
