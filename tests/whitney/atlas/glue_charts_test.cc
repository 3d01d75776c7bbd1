// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/glue_charts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/topology/topology.h>

namespace whitney {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Point = Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A disc whose boundary polygon is made of sides, each with its points from corner to corner; a fan around the middle.
/// Side i is the boundary part of inequality i.
ChartPiece polygon(const std::vector<std::vector<Point>>& sides) {
  ChartPiece piece;
  piece.mesh.ambient_dim = piece.mesh.dim = 2;
  std::vector<Point> ring;
  for (const auto& side : sides) ring.insert(ring.end(), side.begin(), side.end() - 1);
  const auto count = static_cast<std::uint32_t>(ring.size());
  Point middle = Point::Zero();
  for (const Point& p : ring) middle += p / count;
  std::uint32_t at = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    BoundaryPart part{static_cast<int>(i), {}};
    for (std::size_t j = 1; j < sides[i].size(); ++j, ++at) {
      part.simplices.insert(part.simplices.end(), {at, (at + 1) % count});
      piece.mesh.simplices.insert(piece.mesh.simplices.end(), {at, (at + 1) % count, count});
    }
    piece.boundary.push_back(part);
  }
  if (count == 3) {
    piece.mesh.simplices = {0, 1, 2};
  } else {
    ring.push_back(middle);
  }
  for (const Point& p : ring) piece.mesh.points.insert(piece.mesh.points.end(), {p[0], p[1]});
  return piece;
}

/// A disc whose whole boundary is the part of inequality 0, a loop.
ChartPiece disc(const std::vector<Point>& loop) {
  std::vector<Point> side = loop;
  side.push_back(loop.front());
  ChartPiece piece = polygon({side});
  return piece;
}

/// Points on the unit circle at these angles, moved by up to `noise`.
std::vector<Point> circle(const std::vector<double>& angles, double noise, std::mt19937_64& random) {
  std::vector<Point> loop;
  for (const double a : angles) {
    loop.push_back(Point(std::cos(a), std::sin(a)) + noise * Point(uniform(random, -1, 1), uniform(random, -1, 1)));
  }
  return loop;
}

std::vector<double> random_angles(std::size_t count, std::mt19937_64& random) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < count; ++i) {
    angles.push_back(2 * kPi * (static_cast<double>(i) + uniform(random, 0, 0.4)) / static_cast<double>(count));
  }
  return angles;
}

/// Points from a to b, `pieces` edges of random lengths; inner ones moved by up to `noise`.
std::vector<Point> segment(const Point& a, const Point& b, int pieces, double noise, std::mt19937_64& random) {
  std::vector<Point> side{a};
  for (int i = 1; i < pieces; ++i) {
    const double t = (i + uniform(random, -0.4, 0.4)) / pieces;
    side.push_back((1 - t) * a + t * b + noise * Point(uniform(random, -1, 1), uniform(random, -1, 1)));
  }
  side.push_back(b);
  return side;
}

/// The square [0, 1]^2: side 0 is y = 0, then x = 1, y = 1, x = 0; numbers of edges given.
ChartPiece square(const std::array<int, 4>& edges, double noise, std::mt19937_64& random) {
  const std::array<Point, 4> corners{Point(0, 0), Point(1, 0), Point(1, 1), Point(0, 1)};
  std::vector<std::vector<Point>> sides;
  for (int i = 0; i < 4; ++i) {
    sides.push_back(segment(corners[i], corners[(i + 1) % 4], edges[i], noise, random));
  }
  return polygon(sides);
}

CoordinateMap plane_map(std::function<Point(const Point&)> map) {
  return [map](std::span<const double> x, std::span<double> y) {
    const Point image = map(Point(x[0], x[1]));
    y[0] = image[0];
    y[1] = image[1];
  };
}

Seam seam(int chart, int inequality, int other, int other_inequality, std::function<Point(const Point&)> map) {
  return {chart, inequality, other, other_inequality, plane_map(std::move(map))};
}

/// Every vertex of every piece is where vertex_of says, unless it was united with one of a lower chart.
void expect_consistent(const GluedMesh& glued, const std::vector<ChartPiece>& pieces) {
  ASSERT_EQ(glued.vertex_of.size(), pieces.size());
  const std::size_t d = pieces[0].mesh.ambient_dim;
  const std::vector<double>& chart = glued.mesh.point_data.at(0).values;
  ASSERT_EQ(chart.size(), glued.mesh.num_points());
  ASSERT_EQ(glued.chart_points.size(), glued.mesh.num_points() * d);
  EXPECT_EQ(glued.mesh.cell_data.at(0).values.size(), glued.mesh.num_simplices());
  for (std::size_t c = 0; c < pieces.size(); ++c) {
    ASSERT_EQ(glued.vertex_of[c].size(), pieces[c].mesh.num_points());
    for (std::size_t v = 0; v < glued.vertex_of[c].size(); ++v) {
      const std::uint32_t at = glued.vertex_of[c][v];
      ASSERT_LT(at, glued.mesh.num_points());
      EXPECT_LE(chart[at], static_cast<double>(c));
      if (chart[at] != static_cast<double>(c)) continue;
      bool united = std::count(glued.vertex_of[c].begin(), glued.vertex_of[c].end(), at) > 1;
      for (std::size_t i = 0; !united && i < d; ++i) {
        EXPECT_EQ(glued.chart_points[at * d + i], pieces[c].mesh.points[v * d + i]);
      }
    }
  }
}

void expect_surface(const GluedMesh& glued, std::int64_t chi, bool orientable, std::size_t boundary_loops = 0) {
  const Topology topology = topology_of(glued.mesh);
  EXPECT_EQ(topology.euler_characteristic, chi);
  EXPECT_EQ(topology.orientable, orientable);
  EXPECT_EQ(topology.components, 1);
  EXPECT_EQ(topology.manifold, boundary_loops == 0 ? ManifoldKind::kClosed : ManifoldKind::kWithBoundary);
  EXPECT_EQ(topology.boundary_components, boundary_loops);
}

std::string mismatch_of(const std::vector<ChartPiece>& pieces, const std::vector<Seam>& seams) {
  try {
    glue_charts(pieces, seams);
  } catch (const SeamMismatch& error) {
    return error.what();
  }
  return "no error";
}
std::string invalid_of(const std::vector<ChartPiece>& pieces, const std::vector<Seam>& seams) {
  try {
    glue_charts(pieces, seams);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "no error";
}

/// z -> e^{i turn} / conj(z), or its conjugate: the identity or a reflection of the unit circle, then a rotation.
std::function<Point(const Point&)> inversion(double turn, bool reflect) {
  return [=](const Point& p) {
    const Point q(p[0] / p.squaredNorm(), (reflect ? -1 : 1) * p[1] / p.squaredNorm());
    return Point(Eigen::Rotation2Dd(turn) * q);
  };
}

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

/// The surface of a cube, each face a chart with coordinates of its own, rotated and shifted.
TEST(GlueCharts, SphereFromSixFaces) {
  std::mt19937_64 random(6);
  for (int run = 0; run < 20; ++run) {
    SCOPED_TRACE(run);
    struct Face {
      Eigen::Vector3d normal, u, v;
      Eigen::Rotation2Dd turn{0};
      Point shift;
      Eigen::Vector3d to_space(const Point& p) const {
        const Point q = turn.inverse() * (p - shift);
        return normal + q[0] * u + q[1] * v;
      }
      Point from_space(const Eigen::Vector3d& x) const { return turn * Point(x.dot(u), x.dot(v)) + shift; }
    };
    std::vector<Face> faces;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        Face face;
        face.normal = sign * Eigen::Vector3d::Unit(axis);
        face.u = Eigen::Vector3d::Unit((axis + 1) % 3);
        face.v = face.normal.cross(face.u);
        face.turn = Eigen::Rotation2Dd(uniform(random, -4, 4));
        face.shift = Point(uniform(random, -9, 9), uniform(random, -9, 9));
        faces.push_back(face);
      }
    }
    std::vector<ChartPiece> pieces;
    std::vector<std::vector<Eigen::Vector3d>> towards(6);  // normals of the neighbours, side by side
    for (int f = 0; f < 6; ++f) {
      std::vector<std::vector<Point>> sides;
      const Face& face = faces[f];
      const std::array<Eigen::Vector3d, 4> around{face.u, face.v, -face.u, -face.v};
      const auto corner = [&](int i) {
        Point p = face.from_space(face.normal + around[i % 4] + around[(i + 3) % 4]);
        return Point(p + 0.01 * Point(uniform(random, -1, 1), uniform(random, -1, 1)));
      };
      std::array<Point, 4> corners;
      for (int i = 0; i < 4; ++i) corners[i] = corner(i);
      for (int i = 0; i < 4; ++i) {
        sides.push_back(segment(corners[i], corners[(i + 1) % 4], 1 + int(random() % 9), 0.01, random));
        towards[f].push_back(around[i]);
      }
      pieces.push_back(polygon(sides));
      pieces.back().name = std::string(1, char('A' + f));
    }
    std::vector<Seam> seams;
    for (int f = 0; f < 6; ++f) {
      for (int g = f + 1; g < 6; ++g) {
        for (int i = 0; i < 4; ++i) {
          for (int j = 0; j < 4; ++j) {
            if (towards[f][i].dot(faces[g].normal) < 0.5 || towards[g][j].dot(faces[f].normal) < 0.5) continue;
            seams.push_back(
                seam(f, i, g, j, [a = faces[f], b = faces[g]](const Point& p) { return b.from_space(a.to_space(p)); }));
          }
        }
      }
    }
    ASSERT_EQ(seams.size(), 12);
    GlueOptions options;
    options.embedding_dim = 3;
    for (const Face& face : faces) {
      options.embeddings.push_back([face](std::span<const double> x, std::span<double> y) {
        Eigen::Map<Eigen::Vector3d>(y.data()) = face.to_space(Point(x[0], x[1]));
      });
    }
    const GluedMesh glued = glue_charts(pieces, seams, options);
    expect_surface(glued, 2, true);
    expect_consistent(glued, pieces);
    EXPECT_EQ(glued.mesh.ambient_dim, 3);
    for (const double x : glued.mesh.points) EXPECT_LT(std::abs(x), 1.05);
    // Oriented, and the pieces are oriented alike: the volume is that of the cube, up to the noise.
    double volume = 0;
    for (std::size_t t = 0; t < glued.mesh.num_simplices(); ++t) {
      Eigen::Matrix3d M;
      for (int i = 0; i < 3; ++i) {
        M.col(i) = Eigen::Map<const Eigen::Vector3d>(&glued.mesh.points[3 * glued.mesh.simplices[3 * t + i]]);
      }
      volume += M.determinant() / 6;
    }
    EXPECT_NEAR(volume, 8, 0.5);

    // Without one of the seams two sides stay boundary, from corner to corner.
    seams.pop_back();
    expect_surface(glue_charts(pieces, seams, options), 1, true, 1);
  }
}

/// Three lunes between the poles: two arcs between the same two corners.
TEST(GlueCharts, SphereFromThreeLunes) {
  std::mt19937_64 random(7);
  for (int run = 0; run < 20; ++run) {
    SCOPED_TRACE(run);
    // In a chart, the lune has its corners at +-1 on the first axis and is bounded by halves of the unit circle.
    std::vector<ChartPiece> pieces;
    for (int c = 0; c < 3; ++c) {
      std::vector<std::vector<Point>> sides(2);
      for (int side = 0; side < 2; ++side) {
        const int edges = (run == 0 ? 1 + side : 2 + int(random() % 12));
        for (int i = 0; i <= edges; ++i) {
          const double a = kPi * (side + (i == 0 || i == edges ? i : i + uniform(random, -0.4, 0.4)) / edges);
          sides[side].push_back(Point(std::cos(a), std::sin(a)));
        }
      }
      sides[1].back() = sides[0].front();
      sides[1].front() = sides[0].back();
      pieces.push_back(polygon(sides));
    }
    std::vector<Seam> seams;
    for (int c = 0; c < 3; ++c) {
      seams.push_back(seam(c, 0, (c + 1) % 3, 1, [](const Point& p) { return Point(p[0], -p[1]); }));
    }
    GlueOptions options;
    options.max_distance = 1;
    expect_surface(glue_charts(pieces, seams, options), 2, true);
  }
}

/// Two annuli make a torus: two loops at a seam, to be told apart by distance.
TEST(GlueCharts, TorusFromTwoAnnuli) {
  std::mt19937_64 random(8);
  for (int run = 0; run < 20; ++run) {
    std::vector<ChartPiece> pieces;
    for (int c = 0; c < 2; ++c) {
      ChartPiece piece;
      piece.mesh.ambient_dim = piece.mesh.dim = 2;
      const auto count = static_cast<std::uint32_t>(9 + random() % 30);
      const auto angles = random_angles(count, random);
      BoundaryPart part;
      for (const double radius : {1.0, 2.0}) {
        for (const double a : angles) {
          piece.mesh.points.insert(piece.mesh.points.end(), {radius * std::cos(a), radius * std::sin(a)});
        }
      }
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t j = (i + 1) % count;
        piece.mesh.simplices.insert(piece.mesh.simplices.end(), {i, j, count + j, i, count + j, count + i});
        part.simplices.insert(part.simplices.end(), {i, j, count + i, count + j});
      }
      piece.boundary.push_back(part);
      pieces.push_back(piece);
    }
    const bool reflect = run % 2 == 1;
    // Reflecting one loop and not the other makes a Klein bottle.
    const auto transition = [&](const Point& p) { return p.norm() < 1.5 && reflect ? Point(p[0], -p[1]) : p; };
    const GluedMesh glued = glue_charts(pieces, std::vector{seam(0, 0, 1, 0, transition)});
    EXPECT_EQ(glued.seams[0].num_loops, 2);
    expect_surface(glued, 0, !reflect);
    // One loop each, mapped to each other, of a single annulus.
    const GluedMesh own = glue_charts(std::span(pieces).first(1), std::vector{seam(0, 0, 0, 0, [&](const Point& p) {
                                        const double scale = 2 / p.squaredNorm();
                                        return Point(scale * p[0], (reflect ? -1 : 1) * scale * p[1]);
                                      })});
    expect_surface(own, 0, !reflect);
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

TEST(GlueCharts, PiecesThatDisagree) {
  std::mt19937_64 random(11);
  std::vector<ChartPiece> discs{disc(circle(random_angles(20, random), 0, random)),
                                disc(circle(random_angles(30, random), 0, random))};
  discs[0].name = "north";
  discs[1].name = "south";
  EXPECT_THAT(mismatch_of(discs, {seam(0, 0, 1, 0, [](const Point& p) { return Point(p[0] + 1, p[1]); })}),
              AllOf(HasSubstr("seam 0"), HasSubstr("chart north, inequality 0"), HasSubstr("chart south"),
                    HasSubstr("apart"), HasSubstr("smaller edge length")));
  // Same set, but once around twice as fast.
  EXPECT_THAT(
      mismatch_of(discs,
                  {seam(0, 0, 1, 0, [](const Point& p) { return Point(p[0] * p[0] - p[1] * p[1], 2 * p[0] * p[1]); })}),
      HasSubstr("once along"));
  EXPECT_THROW(glue_charts(discs, std::vector{seam(0, 0, 1, 0,
                                                   [](const Point& p) {
                                                     return Point(p[0] / 0.0, std::numeric_limits<double>::quiet_NaN());
                                                   })}),
               OracleError);

  std::vector<ChartPiece> squares{square({4, 4, 4, 4}, 0, random)};
  EXPECT_THAT(mismatch_of(squares, {seam(0, 3, 0, 1, [](const Point& p) { return Point(p[0] + 1, p[1] + 0.4); })}),
              AllOf(HasSubstr("corner (0, "), HasSubstr("0.4")));
  EXPECT_THAT(mismatch_of(squares, {seam(0, 3, 0, 1, [](const Point& p) { return Point(p[0] + 1, 0); })}),
              HasSubstr("same nearest corner"));
  // A loop here, an arc there.
  squares.push_back(disc(circle(random_angles(20, random), 0, random)));
  EXPECT_THAT(mismatch_of(squares, {seam(0, 0, 1, 0, [](const Point& p) { return p; })}),
              AllOf(HasSubstr("1 arc with 2 corners and 0 loops"), HasSubstr("0 arcs with 0 corners and 1 loop")));

  // Embeddings that contradict the transition.
  GlueOptions options;
  options.embedding_dim = 2;
  for (const double sign : {1.0, -1.0}) {
    options.embeddings.push_back(plane_map([sign](const Point& p) { return Point(sign * p); }));
  }
  try {
    glue_charts(discs, std::vector{seam(0, 0, 1, 0, [](const Point& p) { return p; })}, options);
    FAIL();
  } catch (const SeamMismatch& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("contradict"), HasSubstr("chart north"), HasSubstr("chart south")));
  }
}

TEST(GlueCharts, BadInput) {
  std::mt19937_64 random(12);
  const auto identity = [](const Point& p) { return p; };
  const std::vector<ChartPiece> good{disc(circle(random_angles(5, random), 0, random)),
                                     disc(circle(random_angles(5, random), 0, random))};
  EXPECT_THAT(invalid_of({}, {}), HasSubstr("no pieces"));
  EXPECT_THAT(invalid_of(good, {seam(0, 0, 2, 0, identity)}), HasSubstr("no chart 2"));
  EXPECT_THAT(invalid_of(good, {seam(0, 0, 1, 0, identity), seam(1, 0, 0, 3, identity)}),
              AllOf(HasSubstr("seam 1"), HasSubstr("chart 1, inequality 0"), HasSubstr("already")));
  EXPECT_THAT(invalid_of(good, {Seam{0, 0, 1, 0, {}}}), HasSubstr("transition"));
  auto pieces = good;
  pieces[1].mesh.dim = 3;
  EXPECT_THAT(invalid_of(pieces, {}), HasSubstr("chart 1"));
  pieces = {good[0]};
  pieces[0].mesh.dim = 3;
  EXPECT_THAT(invalid_of(pieces, {}), HasSubstr("curves and surfaces"));
  pieces = good;
  pieces[0].mesh.simplices[0] = 77;
  EXPECT_THAT(invalid_of(pieces, {}), AllOf(HasSubstr("chart 0"), HasSubstr("77")));
  pieces = good;
  pieces[0].boundary[0].simplices = {0, 5};
  EXPECT_THAT(invalid_of(pieces, {}), HasSubstr("not on the boundary"));
  pieces[0].boundary[0].simplices = {0, 1, 1, 0};
  EXPECT_THAT(invalid_of(pieces, {}), HasSubstr("twice"));
  pieces[0].boundary[0].simplices = {0};
  EXPECT_THAT(invalid_of(pieces, {}), HasSubstr("odd"));
  pieces[0].boundary[0].simplices = {0, 66};
  EXPECT_THAT(invalid_of(pieces, {}), HasSubstr("no vertex 66"));
  pieces[0].boundary = {{0, {}}, {0, {}}};
  EXPECT_THAT(invalid_of(pieces, {}), HasSubstr("two boundary parts"));
  pieces = good;
  pieces[0].mesh.simplices.insert(pieces[0].mesh.simplices.end(), {0, 5, 2});
  EXPECT_THAT(invalid_of(pieces, {}), HasSubstr("more than two triangles"));
  pieces = good;
  pieces[0].mesh.simplices = {0, 1, 2, 0, 3, 4};
  pieces[0].boundary.clear();
  EXPECT_THAT(invalid_of(pieces, {}), HasSubstr("no surface"));
  GlueOptions options;
  options.embeddings.resize(1);
  EXPECT_THROW(glue_charts(good, {}, options), InvalidInput);
}

}  // namespace
}  // namespace whitney
