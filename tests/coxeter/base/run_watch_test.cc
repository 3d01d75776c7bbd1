// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/run_watch.h>

#include <cstdint>

#include <gtest/gtest.h>

namespace whitney {
namespace {

int calls_until_stopped(const RunControl& run, StopReason expected) {
  RunWatch watch(run, "test");
  for (int i = 1; i <= 100000; ++i) {
    if (!watch.stopped()) continue;
    EXPECT_EQ(watch.reason(), expected);
    EXPECT_TRUE(watch.stopped());
    EXPECT_THROW(watch.check(), RunWatch::Stopped);
    return i;
  }
  EXPECT_EQ(watch.reason(), StopReason::kNone);
  return 0;
}

TEST(RunWatch, StopsAtEachLimit) {
  EXPECT_EQ(calls_until_stopped({}, StopReason::kNone), 0);
  EXPECT_EQ(calls_until_stopped({.time_limit = 1e6}, StopReason::kNone), 0);
  EXPECT_GT(calls_until_stopped({.time_limit = 0}, StopReason::kTimeLimit), 0);
  EXPECT_GT(calls_until_stopped({.progress = [](const Progress&) { return false; }}, StopReason::kCancelled), 0);
}

TEST(RunWatch, TellsHowFarItIs) {
  Progress last;
  RunWatch watch({.progress =
                      [&](const Progress& progress) {
                        last = progress;
                        return progress.simplices < 5;
                      }},
                 "phase");
  EXPECT_FALSE(watch.stopped_now(4, 7));
  EXPECT_STREQ(last.phase, "phase");
  EXPECT_EQ(last.simplices, 4u);
  EXPECT_EQ(last.evaluations, 7u);
  EXPECT_TRUE(watch.stopped_now(5));
  EXPECT_EQ(watch.reason(), StopReason::kCancelled);
}

TEST(RunWatch, Memory) {
  RunWatch unlimited({}, "test");
  EXPECT_TRUE(unlimited.fits(std::uint64_t{1} << 60));
  RunWatch watch({.memory_limit = std::uint64_t{1} << 50}, "test");
  EXPECT_TRUE(watch.fits(1000));
  EXPECT_EQ(watch.reason(), StopReason::kNone);
  EXPECT_FALSE(watch.fits(std::uint64_t{1} << 51));
  EXPECT_EQ(watch.reason(), StopReason::kMemoryLimit);
  EXPECT_TRUE(watch.stopped());
  RunWatch used({.memory_limit = 1000}, "test");
  EXPECT_FALSE(used.fits(0));  // a process holds more than that
}

}  // namespace
}  // namespace whitney
