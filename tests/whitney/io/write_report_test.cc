// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/write_report.h>

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace whitney {
namespace {

using nlohmann::json;

TEST(WriteReport, WhatWasNotComputedIsNull) {
  Report report;
  report.ambient_dim = 3;
  report.intrinsic_dim = 2;
  report.topology_level = TopologyLevel::kEuler;
  report.topology.f_vector = {4, 6, 4};
  report.topology.euler_characteristic = 2;
  const std::string text = to_json(report);
  const json out = json::parse(text);
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(out.at("topology"), "euler");
  EXPECT_EQ(out.at("euler_characteristic"), 2);
  EXPECT_TRUE(out.at("homology_z").is_null());
  EXPECT_TRUE(out.at("certificate").is_null());
  EXPECT_EQ(out.at("stop_reason"), "none");
}

TEST(WriteReport, WhatWasLeftOutIsNamedWithItsReason) {
  Report report;
  report.stop_reason = StopReason::kMemoryLimit;
  report.left_out = {{"homology", StopReason::kMemoryLimit, 1234}};
  const json out = json::parse(to_json(report));
  ASSERT_EQ(out.at("left_out").size(), 1u);
  EXPECT_EQ(out.at("left_out")[0].at("what"), "homology");
  EXPECT_EQ(out.at("stop_reason"), "memory_limit");
}

TEST(WriteReport, TheCertificateSaysWhatItRestsOn) {
  Report report;
  report.certificate.emplace();
  report.certificate->verdict = "certified";
  report.certificate->reach_source = "caller";
  report.certificate->feet_source = "modelled";
  report.certificate->components = "seeds_searched";
  const json certificate = json::parse(to_json(report)).at("certificate");
  EXPECT_EQ(certificate.at("reach_source"), "caller");
  EXPECT_EQ(certificate.at("feet_source"), "modelled");
  EXPECT_EQ(certificate.at("components"), "seeds_searched");
  EXPECT_TRUE(certificate.at("hausdorff_bound").is_null());
}

}  // namespace
}  // namespace whitney
