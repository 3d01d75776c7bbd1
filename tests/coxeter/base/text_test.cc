// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/text.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace whitney {
namespace {

TEST(Text, Numbers) {
  EXPECT_EQ(text(0.1), "0.1");
  EXPECT_EQ(text(-2), "-2");
  EXPECT_EQ(text(1e300), "1e+300");
  EXPECT_EQ(text(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(text(std::numeric_limits<double>::denorm_min()), "5e-324");
  EXPECT_EQ(text(3.14159, 4), "3.142");
  EXPECT_EQ(text(-1e-20 / 3, 4), "-3.333e-21");
  std::mt19937_64 generator(1);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::ldexp(static_cast<double>(generator()), static_cast<int>(generator() % 600) - 300);
    EXPECT_EQ(std::strtod(text(value).c_str(), nullptr), value);
  }
}

TEST(Text, Points) {
  EXPECT_EQ(text(std::vector<double>{}), "()");
  EXPECT_EQ(text(std::vector<double>{0.5, -2, 1e-9}), "(0.5, -2, 1e-09)");
  // Neighbours in double read differently.
  EXPECT_NE(text(std::vector<double>{1}), text(std::vector<double>{std::nextafter(1.0, 2.0)}));
}

}  // namespace
}  // namespace whitney
