// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <coxeter/base/error.h>
#include <whitney/atlas/glue_charts.h>
#include <whitney/topology/topology.h>
#include "atlas/glue_cases.h"

namespace whitney {
namespace {

using namespace glue_cases;
using testing::AllOf;
using testing::HasSubstr;

TEST(GlueMismatch, PiecesThatDisagree) {
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

TEST(GlueMismatch, BadInput) {
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
