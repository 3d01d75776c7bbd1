// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/hash_slots.h>

#include <cstdint>

#include <gtest/gtest.h>

namespace whitney::coxeter {
namespace {

TEST(HashSlots, EveryIndexIsFoundThroughGrowth) {
  HashSlots slots;
  for (std::uint32_t i = 0; i < 20000; ++i) slots.insert(mix64(i), i);
  for (std::uint32_t i = 0; i < 20000; ++i) {
    EXPECT_EQ(slots.find(mix64(i), [i](std::uint32_t index) { return index == i; }), i);
  }
  EXPECT_EQ(slots.find(mix64(20000), [](std::uint32_t index) { return index == 20000; }), HashSlots::kNone);
}

TEST(HashSlots, EqualHashesAreToldApartByTheKey) {
  HashSlots slots;
  for (std::uint32_t i = 0; i < 600; ++i) slots.insert(~std::uint64_t{0}, i);
  for (std::uint32_t i = 0; i < 600; ++i) {
    EXPECT_EQ(slots.find(~std::uint64_t{0}, [i](std::uint32_t index) { return index == i; }), i);
  }
  EXPECT_NE(slots.guess(~std::uint64_t{0}), HashSlots::kNone);
}

}  // namespace
}  // namespace whitney::coxeter
