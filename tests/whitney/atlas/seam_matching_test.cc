// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/seam_matching.h>

#include <limits>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include "atlas/glue_cases.h"

namespace whitney::internal {
namespace {

using namespace glue_cases;
using testing::ElementsAre;

/// Pieces with their strands, ready for a SeamMatcher.
struct Prepared {
  std::vector<ChartPiece> pieces;
  std::vector<Seam> seams;
  SeamNames names{pieces, seams};
  Quilt quilt{2, 2};
  std::vector<Quilt::Vertex> first = add_patches(pieces, names, quilt);
  StrandsBySide strands = boundary_strands(pieces, names, 2, quilt, first);

  const BoundaryStrands& side(int chart, int inequality) const { return strands.at({chart, inequality}); }
  SeamMatcher matcher(double max_distance) const {
    const Seam& s = seams[0];
    return {seams,
            0,
            names,
            2,
            2,
            quilt,
            max_distance,
            side(s.first_chart, s.first_inequality),
            side(s.second_chart, s.second_inequality)};
  }
};

TEST(SeamMatching, CornersGoToTheNearest) {
  std::mt19937_64 random(1);
  // The right side of a square to the left side of another, moved and a little off.
  const Prepared p{{square({1, 2, 1, 3}, 0, random), square({1, 2, 1, 4}, 0, random)},
                   {seam(0, 1, 1, 3, [](const Point& x) { return Point(x[0] - 1 + 0.01, x[1] - 0.02); })}};
  SeamMatcher matcher = p.matcher(0.5);
  const Matching matching = matcher.match_corners(p.side(0, 1), p.side(1, 3));
  // Corners are sorted by number: (1, 0), (1, 1) there; (0, 0), (0, 1) here, where (0, 0) is vertex 0.
  EXPECT_THAT(matching, ElementsAre(0u, 1u));
  EXPECT_EQ(matcher.report().num_corners, 2u);
  EXPECT_EQ(matcher.report().num_arcs, 1u);
  EXPECT_NEAR(matcher.report().worst_distance, std::hypot(0.01, 0.02), 1e-15);
  EXPECT_FALSE(matcher.is_own_mirror());
  SeamMatcher strict = p.matcher(1e-3);
  EXPECT_THROW(strict.match_corners(p.side(0, 1), p.side(1, 3)), SeamMismatch);
}

TEST(SeamMatching, LoopsAndTheirDirections) {
  std::mt19937_64 random(2);
  for (const double mirror : {1.0, -1.0}) {
    const Prepared p{
        {disc(circle(random_angles(15, random), 0, random)), disc(circle(random_angles(23, random), 0, random))},
        {seam(0, 0, 1, 0, [=](const Point& x) { return Point(x[0], mirror * x[1]); })}};
    SeamMatcher matcher = p.matcher(0.5);
    const LoopMatching loops = matcher.match_loops(p.side(0, 0), p.side(1, 0));
    EXPECT_THAT(loops.partner, ElementsAre(0u));
    const bool same = matcher.runs_along(loops.from[0], loops.to[0]);
    // Of two loops in directions of their own, a reflection of one turns over which of the two it is.
    static bool without_mirror;
    if (mirror > 0) {
      without_mirror = same;
    } else {
      EXPECT_NE(same, without_mirror);
    }
  }
}

TEST(SeamMatching, ImagesMustBeFinite) {
  const CoordinateMap bad = [](std::span<const double>, std::span<double> y) {
    y[0] = std::numeric_limits<double>::quiet_NaN();
  };
  EXPECT_THROW(apply(bad, std::vector<double>{1, 2}, 1, "the map"), OracleError);
}

TEST(SeamMatching, ClosedPolyline) {
  const Polyline square = closed_polyline({0, 0, 1, 0, 1, 1, 0, 1}, 2);
  EXPECT_EQ(square.num_vertices(), 5u);
  EXPECT_EQ(square.length(), 4);
}

}  // namespace
}  // namespace whitney::internal
