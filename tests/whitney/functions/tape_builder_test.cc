// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/tape_builder.h>

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

using Node = TapeBuilder::Node;

TEST(TapeBuilder, SharesSubexpressionsAndFusesSums) {
  TapeBuilder b(2);
  const Node x = b.input(0), y = b.input(1);
  EXPECT_EQ(b.product(x, y), b.product(y, x));
  EXPECT_EQ(b.function(TapeOp::kSin, x), b.function(TapeOp::kSin, x));
  EXPECT_EQ(b.sum(0, {{1, x}}), x);
  EXPECT_EQ(b.power(x, 2), b.product(x, x));
  // One fused instruction.
  const Node circle = b.sum(-1, {{1, b.product(x, x)}, {1, b.product(y, y)}});
  EXPECT_EQ(b.build(std::vector<Node>{circle}).num_instructions(), 1);
  // The product is needed by itself too, so it is computed once: two instructions.
  EXPECT_EQ(b.build(std::vector<Node>{circle, b.product(x, x)}).num_instructions(), 2);
  // Nothing but what the outputs need.
  EXPECT_EQ(b.build(std::vector<Node>{x}).num_instructions(), 0);
}

TEST(TapeBuilder, CollectsAndFolds) {
  TapeBuilder b(1);
  const Node x = b.input(0);
  const Node seven = b.sum(1, {{1, x}, {-1, x}, {2, b.constant(3)}});
  EXPECT_TRUE(b.is_constant(seven));
  EXPECT_EQ(b.value(seven), 7);
  EXPECT_EQ(b.sum(0, {{0.5, b.sum(0, {{2, x}})}}), x);
  EXPECT_EQ(b.value(b.product(b.constant(0), x)), 0);
  EXPECT_EQ(b.value(b.power(b.constant(2), -2)), 0.25);
  EXPECT_EQ(b.value(b.power(x, 0)), 1);
  EXPECT_EQ(b.value(b.function(TapeOp::kSqrt, b.constant(16))), 4);
  EXPECT_EQ(b.quotient(x, b.constant(1)), x);
  EXPECT_EQ(b.value(b.constant(-0.0)), 0);
  EXPECT_FALSE(std::signbit(b.value(b.constant(-0.0))));
}

TEST(TapeBuilder, RegistersAreReused) {
  // A long chain needs the input and little more.
  TapeBuilder b(1);
  Node a = b.input(0);
  for (int i = 0; i < 1000; ++i) a = b.function(TapeOp::kSin, a);
  const Tape tape = b.build(std::vector<Node>{a});
  EXPECT_EQ(tape.num_instructions(), 1000);
  EXPECT_EQ(tape.num_registers(), 1);
}

TEST(TapeBuilder, RejectsBadInput) {
  EXPECT_THROW(TapeBuilder(-1), InvalidInput);
  TapeBuilder b(1);
  EXPECT_THROW(b.input(1), InvalidInput);
  EXPECT_THROW(b.input(-1), InvalidInput);
  EXPECT_THROW(b.constant(std::numeric_limits<double>::infinity()), InvalidInput);
  EXPECT_THROW(b.quotient(b.constant(1), b.constant(0)), InvalidInput);
  EXPECT_THROW(b.quotient(b.input(0), b.constant(0)), InvalidInput);
  EXPECT_THROW(b.function(TapeOp::kLog, b.constant(-1)), InvalidInput);
  EXPECT_THROW(b.function(TapeOp::kSum, b.input(0)), InvalidInput);
  EXPECT_THROW(b.sum(1e308, {{1e308, b.constant(1)}}), InvalidInput);
  EXPECT_THROW(b.product(77, 0), InvalidInput);
  EXPECT_THROW(b.build(std::vector<Node>{77}), InvalidInput);
}

}  // namespace
}  // namespace whitney
