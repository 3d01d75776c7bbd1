// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/report.h>

#include <gtest/gtest.h>

namespace whitney {
namespace {

TEST(Report, StoppedAndSingular) {
  Report report;
  EXPECT_FALSE(report.stopped() || report.singular());
  report.stop_reason = StopReason::kBox;
  EXPECT_FALSE(report.stopped());
  report.stop_reason = StopReason::kMemoryLimit;
  EXPECT_TRUE(report.stopped());
  report.charts.emplace_back().singular_points = {{1, 2}};
  EXPECT_TRUE(report.singular());
}

TEST(Report, Words) {
  EXPECT_EQ(point_text({1, 0.5}), "(1, 0.5)");
  EXPECT_STREQ(to_string(TopologyLevel::kEuler), "euler");
}

}  // namespace
}  // namespace whitney
