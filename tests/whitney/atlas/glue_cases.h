// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/atlas/glue_charts.h>
#include <whitney/topology/topology.h>

// Pieces to glue, made by hand, and what to expect of the result.

namespace whitney::glue_cases {

using Point = Eigen::Vector2d;
inline constexpr double kPi = std::numbers::pi;

inline double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A disc whose boundary polygon is made of sides, each with its points from corner to corner; a fan around the middle.
/// Side i is the boundary part of inequality i.
inline ChartPiece polygon(const std::vector<std::vector<Point>>& sides) {
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
inline ChartPiece disc(const std::vector<Point>& loop) {
  std::vector<Point> side = loop;
  side.push_back(loop.front());
  ChartPiece piece = polygon({side});
  return piece;
}

/// Points on the unit circle at these angles, moved by up to `noise`.
inline std::vector<Point> circle(const std::vector<double>& angles, double noise, std::mt19937_64& random) {
  std::vector<Point> loop;
  for (const double a : angles) {
    loop.push_back(Point(std::cos(a), std::sin(a)) + noise * Point(uniform(random, -1, 1), uniform(random, -1, 1)));
  }
  return loop;
}

inline std::vector<double> random_angles(std::size_t count, std::mt19937_64& random) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < count; ++i) {
    angles.push_back(2 * kPi * (static_cast<double>(i) + uniform(random, 0, 0.4)) / static_cast<double>(count));
  }
  return angles;
}

/// Points from a to b, `pieces` edges of random lengths; inner ones moved by up to `noise`.
inline std::vector<Point> segment(const Point& a, const Point& b, int pieces, double noise, std::mt19937_64& random) {
  std::vector<Point> side{a};
  for (int i = 1; i < pieces; ++i) {
    const double t = (i + uniform(random, -0.4, 0.4)) / pieces;
    side.push_back((1 - t) * a + t * b + noise * Point(uniform(random, -1, 1), uniform(random, -1, 1)));
  }
  side.push_back(b);
  return side;
}

/// The square [0, 1]^2: side 0 is y = 0, then x = 1, y = 1, x = 0; numbers of edges given.
inline ChartPiece square(const std::array<int, 4>& edges, double noise, std::mt19937_64& random) {
  const std::array<Point, 4> corners{Point(0, 0), Point(1, 0), Point(1, 1), Point(0, 1)};
  std::vector<std::vector<Point>> sides;
  for (int i = 0; i < 4; ++i) {
    sides.push_back(segment(corners[i], corners[(i + 1) % 4], edges[i], noise, random));
  }
  return polygon(sides);
}

inline CoordinateMap plane_map(std::function<Point(const Point&)> map) {
  return [map](std::span<const double> x, std::span<double> y) {
    const Point image = map(Point(x[0], x[1]));
    y[0] = image[0];
    y[1] = image[1];
  };
}

inline Seam seam(int chart, int inequality, int other, int other_inequality, std::function<Point(const Point&)> map) {
  return {chart, inequality, other, other_inequality, plane_map(std::move(map))};
}

/// Every vertex of every piece is where vertex_of says, unless it was united with one of a lower chart.
inline void expect_consistent(const GluedMesh& glued, const std::vector<ChartPiece>& pieces) {
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

inline void expect_surface(const GluedMesh& glued, std::int64_t chi, bool orientable, std::size_t boundary_loops = 0) {
  const Topology topology = topology_of(glued.mesh);
  EXPECT_EQ(topology.euler_characteristic, chi);
  EXPECT_EQ(topology.orientable, orientable);
  EXPECT_EQ(topology.components, 1);
  EXPECT_EQ(topology.manifold, boundary_loops == 0 ? ManifoldKind::kClosed : ManifoldKind::kWithBoundary);
  EXPECT_EQ(topology.boundary_components, boundary_loops);
}

inline std::string mismatch_of(const std::vector<ChartPiece>& pieces, const std::vector<Seam>& seams) {
  try {
    glue_charts(pieces, seams);
  } catch (const SeamMismatch& error) {
    return error.what();
  }
  return "no error";
}
inline std::string invalid_of(const std::vector<ChartPiece>& pieces, const std::vector<Seam>& seams) {
  try {
    glue_charts(pieces, seams);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "no error";
}

/// z -> e^{i turn} / conj(z), or its conjugate: the identity or a reflection of the unit circle, then a rotation.
inline std::function<Point(const Point&)> inversion(double turn, bool reflect) {
  return [=](const Point& p) {
    const Point q(p[0] / p.squaredNorm(), (reflect ? -1 : 1) * p[1] / p.squaredNorm());
    return Point(std::cos(turn) * q[0] - std::sin(turn) * q[1], std::sin(turn) * q[0] + std::cos(turn) * q[1]);
  };
}

}  // namespace whitney::glue_cases
