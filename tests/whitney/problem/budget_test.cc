// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/budget.h>

#include <gtest/gtest.h>

#include <coxeter/base/memory_use.h>

namespace whitney {
namespace {

TEST(Budget, TimeIsUpOnce) {
  Budget budget({.time_limit = 0});
  EXPECT_TRUE(budget.spent("trace"));
  EXPECT_EQ(budget.stop_reason(), StopReason::kTimeLimit);
  EXPECT_FALSE(budget.allows("homology", 0));
  ASSERT_EQ(budget.left_out().size(), 1u);
  EXPECT_EQ(budget.left_out()[0].what, "homology");
  EXPECT_EQ(budget.left_out()[0].reason, StopReason::kTimeLimit);
}

TEST(Budget, MemoryLeavesOutWhatDoesNotFitAndGoesOn) {
  RunControl run;
  run.memory_limit = resident_bytes() + (std::uint64_t{1} << 30);
  Budget budget(run);
  EXPECT_TRUE(budget.allows("counts", 1000));
  EXPECT_FALSE(budget.allows("homology", std::uint64_t{1} << 33));
  EXPECT_EQ(budget.stop_reason(), StopReason::kMemoryLimit);
  EXPECT_EQ(budget.left_out().at(0).estimated_bytes, std::uint64_t{1} << 33);
  EXPECT_TRUE(budget.allows("vertex links", 1000));
}

TEST(Budget, AnAlgorithmIsStoppedWhileItsResultStillFits) {
  RunControl run;
  run.memory_limit = resident_bytes() + (std::uint64_t{1} << 30);
  Budget budget(run);
  const RunControl rest = budget.rest(0, 1e6);
  EXPECT_TRUE(rest.progress({"trace", 10, 0, 0}));
  EXPECT_FALSE(rest.progress({"trace", 2000, 0, 1}));
  EXPECT_EQ(budget.ended(StopReason::kCancelled), StopReason::kMemoryLimit);
}

TEST(Budget, WhatIsLeftAfterEarlierCalls) {
  std::size_t seen = 0;
  RunControl run;
  run.max_simplices = 100;
  run.progress = [&](const Progress& progress) { return seen = progress.simplices, true; };
  Budget budget(run);
  const RunControl rest = budget.rest(30);
  EXPECT_EQ(rest.max_simplices, 70u);
  EXPECT_TRUE(rest.progress({"trace", 5, 0, 0}));
  EXPECT_EQ(seen, 35u);
  EXPECT_TRUE(budget.halve());
  EXPECT_EQ(budget.rest().max_simplices, 17u);
  EXPECT_EQ(budget.stop_reason(), StopReason::kMemoryLimit);
}

}  // namespace
}  // namespace whitney
