// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/tape.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/functions/tape_builder.h>

namespace whitney {

/// The smallest number type that a tape accepts: it counts its operations.
struct Counted {
  double value = 0;
  explicit Counted(double v) : value(v) {}
};
static int num_sqr = 0;
Counted operator+(Counted a, Counted b) { return Counted(a.value + b.value); }
Counted operator*(Counted a, Counted b) { return Counted(a.value * b.value); }
Counted operator/(Counted a, Counted b) { return Counted(a.value / b.value); }
Counted sqr(Counted a) { return ++num_sqr, Counted(a.value * a.value); }
Counted pow(Counted a, int n) { return Counted(std::pow(a.value, n)); }
Counted pow(Counted a, Counted b) { return Counted(std::pow(a.value, b.value)); }
Counted sqrt(Counted a) { return Counted(std::sqrt(a.value)); }
Counted sin(Counted a) { return Counted(std::sin(a.value)); }
Counted cos(Counted a) { return Counted(std::cos(a.value)); }
Counted tan(Counted a) { return Counted(std::tan(a.value)); }
Counted asin(Counted a) { return Counted(std::asin(a.value)); }
Counted acos(Counted a) { return Counted(std::acos(a.value)); }
Counted atan(Counted a) { return Counted(std::atan(a.value)); }
Counted sinh(Counted a) { return Counted(std::sinh(a.value)); }
Counted cosh(Counted a) { return Counted(std::cosh(a.value)); }
Counted tanh(Counted a) { return Counted(std::tanh(a.value)); }
Counted exp(Counted a) { return Counted(std::exp(a.value)); }
Counted log(Counted a) { return Counted(std::log(a.value)); }
Counted abs(Counted a) { return Counted(std::abs(a.value)); }

namespace {

using Node = TapeBuilder::Node;

constexpr TapeOp kFunctions[] = {TapeOp::kSqrt, TapeOp::kSin,  TapeOp::kCos,  TapeOp::kTan,  TapeOp::kAsin,
                                 TapeOp::kAcos, TapeOp::kAtan, TapeOp::kSinh, TapeOp::kCosh, TapeOp::kTanh,
                                 TapeOp::kExp,  TapeOp::kLog,  TapeOp::kAbs};
double (*const kByHand[])(double) = {std::sqrt, std::sin,  std::cos,  std::tan, std::asin, std::acos, std::atan,
                                     std::sinh, std::cosh, std::tanh, std::exp, std::log,  std::fabs};

/// Every operation once, on three inputs.
Tape everything() {
  TapeBuilder b(3);
  const Node x = b.input(0), y = b.input(1), z = b.input(2);
  std::vector<Node> outputs{b.sum(0.5, {{2, x}, {-1, b.product(y, z)}, {3, b.product(x, x)}}),
                            b.product(b.sum(1, {{1, x}}), y),
                            b.quotient(x, y),
                            b.power(x, 5),
                            b.power(y, -3),
                            b.pow(x, y),
                            b.constant(7),
                            z,
                            z};
  for (TapeOp op : kFunctions) outputs.push_back(b.function(op, x));
  return b.build(outputs);
}

std::vector<double> everything_by_hand(double x, double y, double z) {
  std::vector<double> values{
      0.5 + 2 * x - y * z + 3 * x * x, (1 + x) * y, x / y, std::pow(x, 5), 1 / (y * y * y), std::pow(x, y), 7, z, z};
  for (auto f : kByHand) values.push_back(f(x));
  return values;
}

TEST(Tape, AllOperations) {
  const Tape tape = everything();
  std::vector<double> values(tape.num_outputs()), workspace;
  const std::vector<double> x{0.3, 1.7, -2.5}, expected = everything_by_hand(0.3, 1.7, -2.5);
  ASSERT_EQ(values.size(), expected.size());
  tape.run<double>(x, values, workspace);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], expected[i], 1e-14 * std::abs(expected[i])) << i;
  tape.run_batch(x, values);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], expected[i], 1e-14 * std::abs(expected[i])) << i;
}

TEST(Tape, OtherNumberTypes) {
  const Tape tape = everything();
  std::vector<Counted> values(tape.num_outputs(), Counted(0)), workspace;
  const std::vector<Counted> x{Counted(0.3), Counted(1.7), Counted(-2.5)};
  num_sqr = 0;
  tape.run<Counted>(x, values, workspace);
  const std::vector<double> expected = everything_by_hand(0.3, 1.7, -2.5);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(values[i].value, expected[i], 1e-14 * std::abs(expected[i])) << i;
  }
  EXPECT_EQ(num_sqr, 1);
}

TEST(Tape, ValueDoesNotDependOnTheBatch) {
  const Tape tape = everything();
  const std::size_t k = tape.num_outputs();
  std::mt19937_64 generator(1);
  std::vector<double> points(3 * 75);
  for (double& x : points) x = static_cast<double>(generator() >> 11) * 0x1p-53;
  points[0] = -1;  // NaN too
  points[4] = 0;
  std::vector<double> one(75 * k);
  for (int i = 0; i < 75; ++i) tape.run_batch({&points[3 * i], 3}, {&one[i * k], k});
  for (std::size_t m : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 31, 32, 33, 41, 64, 75}) {
    for (std::size_t first : {std::size_t{0}, 75 - m}) {
      std::vector<double> values(m * k);
      tape.run_batch({&points[3 * first], 3 * m}, values);
      for (std::size_t i = 0; i < m * k; ++i) {
        const double expected = one[first * k + i];
        if (std::isnan(expected)) {
          ASSERT_TRUE(std::isnan(values[i]));
        } else {
          ASSERT_EQ(std::bit_cast<std::uint64_t>(values[i]), std::bit_cast<std::uint64_t>(expected))
              << "batch of " << m << ", value " << i % k;
        }
      }
    }
  }
}

/// Runs the instructions of a tape one by one, as any reader of them may.
std::vector<double> run_by_reading(const Tape& tape, std::span<const double> x) {
  std::vector<double> r(tape.num_registers());
  std::copy(x.begin(), x.end(), r.begin());
  auto term = tape.terms().begin();
  for (const Tape::Instruction& i : tape.instructions()) {
    double& result = r[i.result];
    if (i.op == TapeOp::kConstant) {
      result = (term++)->factor;
    } else if (i.op == TapeOp::kSum) {
      double sum = (term++)->factor;
      for (std::uint32_t j = 0; j < i.a; ++j, ++term) {
        EXPECT_EQ(term->a, term->b);
        sum += term->factor * r[term->a];
      }
      for (std::uint32_t j = 0; j < i.b; ++j, ++term) sum += term->factor * r[term->a] * r[term->b];
      result = sum;
    } else if (i.op == TapeOp::kProduct) {
      result = r[i.a] * r[i.b];
    } else if (i.op == TapeOp::kQuotient) {
      result = r[i.a] / r[i.b];
    } else if (i.op == TapeOp::kPower) {
      result = std::pow(r[i.a], static_cast<int>(i.b));
    } else if (i.op == TapeOp::kPow) {
      result = std::pow(r[i.a], r[i.b]);
    } else {
      result = kByHand[std::find(std::begin(kFunctions), std::end(kFunctions), i.op) - std::begin(kFunctions)](r[i.a]);
    }
  }
  EXPECT_TRUE(term == tape.terms().end());
  std::vector<double> values;
  for (std::uint32_t o : tape.output_registers()) values.push_back(r[o]);
  return values;
}

TEST(Tape, ItsInstructionsCanBeRead) {
  const std::vector<double> x{0.3, 1.7, -2.5}, expected = everything_by_hand(0.3, 1.7, -2.5);
  const std::vector<double> values = run_by_reading(everything(), x);
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], expected[i], 1e-14 * std::abs(expected[i])) << i;
}

TEST(Tape, ManyRegisters) {
  // More values alive at once than fit the stack: sum of a_i a_(n-1-i).
  TapeBuilder b(1);
  std::vector<Node> a;
  std::vector<TapeBuilder::Term> terms;
  constexpr int n = 300;
  for (int i = 0; i < n; ++i) a.push_back(b.function(TapeOp::kSin, b.sum(i, {{1, b.input(0)}})));
  for (int i = 0; i < n; ++i) terms.push_back({1, b.product(a[i], a[n - 1 - i])});
  const Tape tape = b.build(std::vector<Node>{b.sum(0, terms)});
  EXPECT_GT(tape.num_registers(), 250);
  std::vector<double> x(45, 0.5), values(45);
  tape.run_batch(x, values);
  double expected = 0;
  for (int i = 0; i < n; ++i) expected += std::sin(i + 0.5) * std::sin(n - 1 - i + 0.5);
  for (double value : values) EXPECT_NEAR(value, expected, 1e-11);
}

TEST(Tape, WithoutInputs) {
  TapeBuilder b(0);
  const Tape tape = b.build(std::vector<Node>{b.constant(3)});
  std::vector<double> value(1), workspace;
  tape.run<double>({}, value, workspace);
  EXPECT_EQ(value[0], 3);
  value[0] = 0;
  tape.run_batch({}, value);
  EXPECT_EQ(value[0], 3);
}

TEST(Tape, RejectsBadInput) {
  const Tape tape = everything();
  std::vector<double> x(3), values(tape.num_outputs()), workspace, twice(2 * tape.num_outputs());
  EXPECT_THROW(tape.run<double>(std::vector<double>(6), twice, workspace), InvalidInput);
  EXPECT_THROW(tape.run<double>(x, twice, workspace), InvalidInput);
  EXPECT_THROW(tape.run_batch(std::vector<double>(4), values), InvalidInput);
  EXPECT_THROW(tape.run_batch(x, twice), InvalidInput);
}

}  // namespace
}  // namespace whitney
