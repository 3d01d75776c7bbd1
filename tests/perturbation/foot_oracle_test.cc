// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/foot_oracle.h>

#include <gtest/gtest.h>

namespace whitney::perturbation {
namespace {

using Place = FootPromise::Place;
using Errors = FootPromise::Errors;

TEST(FootOracle, VouchesForNothingUnlessItSaysSo) {
  class Silent : public FootOracle {
   public:
    int ambient_dim() const override { return 2; }
    int intrinsic_dim() const override { return 1; }
    double reach() const override { return 1; }
    double curvature_radius() const override { return 1; }
    bool foot(std::span<const double>, std::span<double>, std::span<double>, FootErrors&) const override {
      return false;
    }
  };
  const Silent oracle;
  EXPECT_EQ(oracle.promise(), (FootPromise{Place::kUnknown, Errors::kModelled}));
  EXPECT_EQ(oracle.reach_source(), ReachSource::kCaller);
}

TEST(FootOracle, OfTwoPromisesTheLeastHolds) {
  EXPECT_EQ(weaker({Place::kGlobal, Errors::kModelled}, {Place::kLocal, Errors::kProven}),
            (FootPromise{Place::kLocal, Errors::kModelled}));
  EXPECT_EQ(weaker({Place::kGlobal, Errors::kProven}, {Place::kGlobal, Errors::kProven}),
            (FootPromise{Place::kGlobal, Errors::kProven}));
  EXPECT_EQ(weaker({Place::kUnknown, Errors::kProven}, {Place::kLocal, Errors::kProven}).place, Place::kUnknown);
}

TEST(FootOracle, Words) {
  EXPECT_STREQ(to_string(Place::kGlobal), "global");
  EXPECT_STREQ(to_string(Place::kLocal), "local");
  EXPECT_STREQ(to_string(Place::kUnknown), "unknown");
  EXPECT_STREQ(to_string(Errors::kProven), "proven");
  EXPECT_STREQ(to_string(Errors::kModelled), "modelled");
  EXPECT_STREQ(to_string(ReachSource::kProven), "proven");
  EXPECT_STREQ(to_string(ReachSource::kCaller), "caller");
  EXPECT_STREQ(to_string(ReachSource::kEstimated), "estimated");
}

}  // namespace
}  // namespace whitney::perturbation
