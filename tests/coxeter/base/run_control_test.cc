// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/run_control.h>

#include <gtest/gtest.h>

namespace whitney {
namespace {

TEST(StopReason, HasTheNamesThatStatisticsUse) {
  EXPECT_STREQ(to_string(StopReason::kNone), "none");
  EXPECT_STREQ(to_string(StopReason::kBox), "box");
  EXPECT_STREQ(to_string(StopReason::kMaxSimplices), "max_simplices");
  EXPECT_STREQ(to_string(StopReason::kTimeLimit), "time_limit");
  EXPECT_STREQ(to_string(StopReason::kMemoryLimit), "memory_limit");
  EXPECT_STREQ(to_string(StopReason::kCancelled), "cancelled");
}

}  // namespace
}  // namespace whitney
