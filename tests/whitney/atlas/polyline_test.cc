// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/polyline.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace whitney::internal {
namespace {

TEST(Polyline, LengthsAndFeet) {
  const Polyline line({0, 0, 3, 0, 3, 4}, 2);
  EXPECT_EQ(line.num_vertices(), 3);
  EXPECT_EQ(line.length(), 7);
  EXPECT_EQ(line.arc(1), 3);
  EXPECT_EQ(line.longest_segment(), 4);
  EXPECT_EQ(line.point_at(5), (std::vector<double>{3, 2}));
  EXPECT_EQ(line.point_at(-1), (std::vector<double>{0, 0}));
  EXPECT_EQ(line.point_at(99), (std::vector<double>{3, 4}));
  const Polyline::Foot foot = line.nearest(std::vector<double>{1, -2});
  EXPECT_EQ(foot.segment, 0);
  EXPECT_NEAR(foot.arc, 1, 1e-15);
  EXPECT_NEAR(foot.distance, 2, 1e-15);
  // Within bounds only.
  EXPECT_NEAR(line.nearest(std::vector<double>{1, -2}, 2).arc, 2, 1e-15);
  EXPECT_NEAR(line.nearest(std::vector<double>{4, 4}, 0, 4.5).arc, 4.5, 1e-15);
  EXPECT_NEAR(line.nearest(std::vector<double>{4, 4}, 3.5, 3.5).arc, 3.5, 1e-15);
}

TEST(Polyline, CoincidingVertices) {
  const Polyline point({1, 1, 1, 1, 1, 1}, 2);
  EXPECT_EQ(point.length(), 0);
  EXPECT_EQ(point.point_at(0), (std::vector<double>{1, 1}));
  const Polyline line({0, 0, 1, 0, 1, 0, 2, 0}, 2);
  for (const CommonRefinement& refinement :
       {common_refinement(point, line, 9), common_refinement(line, point, 9), common_refinement(point, point, 9)}) {
    EXPECT_GE(refinement.stations.size(), 3);
  }
}

/// Every vertex of both polylines is a station once, in order.
void check(const Polyline& first, const Polyline& second, const CommonRefinement& refinement) {
  const auto position = [](const PolylinePlace& place) { return static_cast<double>(place.index) + place.fraction; };
  std::size_t first_vertices = 0, second_vertices = 0;
  for (std::size_t i = 0; i < refinement.stations.size(); ++i) {
    const auto& [a, b] = refinement.stations[i];
    ASSERT_TRUE(a.is_vertex || b.is_vertex);
    if (a.is_vertex) {
      EXPECT_EQ(a.index, first_vertices++);
    }
    if (b.is_vertex) {
      EXPECT_EQ(b.index, second_vertices++);
    }
    if (i > 0) {
      EXPECT_GE(position(a), position(refinement.stations[i - 1].first));
      EXPECT_GE(position(b), position(refinement.stations[i - 1].second));
    }
  }
  EXPECT_EQ(first_vertices, first.num_vertices());
  EXPECT_EQ(second_vertices, second.num_vertices());
}

TEST(CommonRefinement, TwoPolygonsOfACurve) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int run = 0; run < 200; ++run) {
    const auto inscribed = [&](int edges) {
      std::vector<double> points;
      for (int i = 0; i <= edges; ++i) {
        const double t = 5 * (i == 0 || i == edges ? i : i + 0.8 * uniform(random) - 0.4) / edges;
        points.insert(points.end(), {std::cos(t), std::sin(t), std::sin(2 * t)});
      }
      return Polyline(points, 3);
    };
    const int m = 1 + int(random() % 60), k = 1 + int(random() % 60);
    const Polyline first = inscribed(m), second = inscribed(k);
    const CommonRefinement refinement = common_refinement(first, second, 2);
    check(first, second, refinement);
    if (std::min(m, k) < 12) continue;
    // Both chords are O(h^2) away from the curve, h = 1.8 * 5 / edges at most, curvature below 5.
    const double h = 9.0 / std::min(m, k);
    EXPECT_LT(refinement.worst_distance, h * h) << m << " and " << k << " edges";
  }
}

TEST(CommonRefinement, EqualPolylinesShareTheirVertices) {
  const Polyline line({0, 0, 1, 0, 1.5, 1, 4, 1}, 2);
  const CommonRefinement refinement = common_refinement(line, line, 0.5);
  EXPECT_EQ(refinement.stations.size(), 4);
  EXPECT_LT(refinement.worst_distance, 1e-15);
}

}  // namespace
}  // namespace whitney::internal
