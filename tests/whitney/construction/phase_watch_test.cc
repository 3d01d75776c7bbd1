// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/phase_watch.h>

#include <gtest/gtest.h>

#include <coxeter/base/memory_use.h>

namespace whitney {
namespace {

TEST(PhaseWatch, TheFirstLimitReachedStays) {
  RunControl run;
  run.time_limit = -1;
  PhaseWatch late(run);
  EXPECT_FALSE(late.keep_going("a"));
  late.stop(StopReason::kMaxSimplices);
  EXPECT_EQ(late.stop_reason(), StopReason::kTimeLimit);

  run = {};
  int asked = 0;
  run.progress = [&](const Progress& progress) {
    EXPECT_STREQ(progress.phase, "b");
    EXPECT_EQ(progress.simplices, 7u);
    return ++asked < 2;
  };
  PhaseWatch impatient(run);
  EXPECT_TRUE(impatient.keep_going("b", 7));
  EXPECT_FALSE(impatient.keep_going("b", 7));
  EXPECT_FALSE(impatient.keep_going("b", 7));
  EXPECT_EQ(asked, 2);  // not asked again
  EXPECT_EQ(impatient.stop_reason(), StopReason::kCancelled);
}

TEST(PhaseWatch, Memory) {
  EXPECT_TRUE(PhaseWatch({}).fits(~std::uint64_t{0}));  // no limit
  RunControl run;
  run.memory_limit = resident_bytes() + (std::uint64_t{1} << 30);
  PhaseWatch watch(run);
  EXPECT_TRUE(watch.fits(1 << 20));
  EXPECT_TRUE(watch.keep_going("c"));
  EXPECT_FALSE(watch.fits(std::uint64_t{1} << 32));
  EXPECT_EQ(watch.stop_reason(), StopReason::kMemoryLimit);
  EXPECT_FALSE(watch.keep_going("c"));
  run.memory_limit = 1;
  PhaseWatch full(run);
  EXPECT_FALSE(full.keep_going("d"));
  EXPECT_EQ(full.stop_reason(), StopReason::kMemoryLimit);
}

}  // namespace
}  // namespace whitney
