// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <coxeter/base/error.h>
#include <whitney/atlas/glue_charts.h>
#include <whitney/topology/topology.h>
#include "atlas/glue_cases.h"

namespace whitney {
namespace {

using namespace glue_cases;

/// The surface of a cube, each face a chart with coordinates of its own, rotated and shifted.
TEST(GlueCorners, SphereFromSixFaces) {
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
TEST(GlueCorners, SphereFromThreeLunes) {
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
TEST(GlueCorners, TorusFromTwoAnnuli) {
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

}  // namespace
}  // namespace whitney
