// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/hit_walk.h>

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tests/perturbation/circle_oracle.h>

namespace whitney::perturbation {
namespace {

using coxeter::coxeter_a;

const std::vector<double> kSeed{1.013, 0.027};

class HitWalkOnACircle : public ::testing::Test {
 protected:
  HitWalk walk(const HitWalkOptions& options = {}) {
    const std::uint32_t start = find_start(near_, kSeed);
    return walk_hit_facets(near_, std::span(&start, 1), options);
  }

  CircleOracle circle_{0.013, 0.027, 1};
  coxeter::Triangulation triangulation_ = coxeter_a(2, 0.1);
  PerturbedTriangulation near_{triangulation_, circle_};
};

TEST_F(HitWalkOnACircle, GoesRoundIt) {
  const HitWalk trace = walk();
  EXPECT_EQ(trace.stop_reason, StopReason::kNone);
  EXPECT_TRUE(trace.complete);
  // In the plane the walk is a ring: every triangle has two hit edges, and both neighbours are in it.
  for (const std::uint32_t s : trace.simplices) {
    const std::uint32_t hit = near_.evaluate(s, 1).hit_facets;
    EXPECT_EQ(__builtin_popcount(hit), 2);
    for (int q = 0; q <= 2; ++q)
      if (hit >> q & 1) {
        const std::uint32_t other = near_.neighbour(s, q);
        EXPECT_NE(std::find(trace.simplices.begin(), trace.simplices.end(), other), trace.simplices.end());
      }
  }
  // In canonical order, each once, whatever the start.
  std::vector<std::uint32_t> sorted = trace.simplices;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end());
  std::vector<std::uint32_t> ordered = trace.simplices;
  std::reverse(ordered.begin(), ordered.end());
  canonical_order(near_, ordered);
  EXPECT_EQ(ordered, trace.simplices);
  const std::uint32_t elsewhere = find_start(near_, std::vector<double>{-0.987, 0.027});
  EXPECT_EQ(walk_hit_facets(near_, std::span(&elsewhere, 1)).simplices, trace.simplices);
}

TEST_F(HitWalkOnACircle, KeepsToARegion) {
  HitWalkOptions options;
  options.region = [](const PerturbedTriangulation& near, std::uint32_t s) {
    return near.position(near.corners(s)[0])[0] > 0;
  };
  const HitWalk whole = walk(), part = walk(options);
  EXPECT_TRUE(part.complete);
  EXPECT_LT(part.simplices.size(), whole.simplices.size());
  EXPECT_GT(part.simplices.size(), whole.simplices.size() / 4);
  for (const std::uint32_t s : part.simplices) EXPECT_GT(near_.position(near_.corners(s)[0])[0], 0);
}

TEST_F(HitWalkOnACircle, SaysWhatStoppedIt) {
  HitWalkOptions options;
  options.run.max_simplices = 7;
  const HitWalk few = walk(options);
  EXPECT_EQ(few.stop_reason, StopReason::kMaxSimplices);
  EXPECT_FALSE(few.complete);
  EXPECT_EQ(few.simplices.size(), 7u);

  options = {};
  options.run.time_limit = 0;
  EXPECT_EQ(walk(options).stop_reason, StopReason::kTimeLimit);

  options = {};
  std::size_t calls = 0;
  options.run.progress = [&](const Progress& progress) {
    ++calls;
    EXPECT_STREQ(progress.phase, "walk");
    EXPECT_GT(progress.evaluations, 0u);
    return false;
  };
  const HitWalk cancelled = walk(options);
  EXPECT_EQ(cancelled.stop_reason, StopReason::kCancelled);
  EXPECT_EQ(calls, 1u);
  EXPECT_FALSE(cancelled.complete);
}

TEST_F(HitWalkOnACircle, StartsAtTheNearestSimplexThatIsHit) {
  const std::uint32_t hit = find_start(near_, std::vector<double>{1.2, 0.03});
  EXPECT_TRUE(near_.evaluate(hit, 1).is_hit());
  // Too far away for so few: the simplex itself.
  const std::vector<double> far{3, 3};
  EXPECT_EQ(find_start(near_, far, 5), near_.locate(far));
}

}  // namespace
}  // namespace whitney::perturbation
