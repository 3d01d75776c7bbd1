// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace whitney {

/// The operations of a Tape. kInput and kConstant name leaves; the functions stand last.
enum class TapeOp : std::uint8_t {
  kInput,
  kConstant,
  kSum,       ///< c_0 + sum c_i a_i + sum c_j a_j b_j
  kProduct,   ///< a b; a square when a = b
  kQuotient,  ///< a / b
  kPower,     ///< a^n, n >= 3 an integer
  kPow,       ///< a^b
  kSqrt,
  kSin,
  kCos,
  kTan,
  kAsin,
  kAcos,
  kAtan,
  kSinh,
  kCosh,
  kTanh,
  kExp,
  kLog,
  kAbs
};

/// What a tape needs of double beyond <cmath>; a number type of its own brings both in its own namespace.
namespace tape_arithmetic {
inline double sqr(double a) { return a * a; }
/// a^n by repeated squaring, n >= 1.
template <class T>
T repeated_squaring(const T& base, int n) {
  T a = base;
  while (n % 2 == 0) {
    a = a * a;
    n /= 2;
  }
  T result = a;
  for (n /= 2; n > 0; n /= 2) {
    a = a * a;
    if (n % 2 != 0) result = result * a;
  }
  return result;
}
inline double pow(double a, int n) { return repeated_squaring(a, n); }
}  // namespace tape_arithmetic

/// A straight-line program for a map R^d -> R^k: a flat list of instructions over a small file of registers.
///
/// Immutable, and safe to run from several threads. Made by TapeBuilder, which shares equal subexpressions. The one
/// fused operation, a constant plus a sum of scaled variables and of scaled products, is what rotated and polynomial
/// manifolds are full of. Sums are added from left to right, in the order in which they were built.
class Tape {
 public:
  /// register[result] = op(register[a], register[b]). Operands are read before the result is written: the result may
  /// take an operand's register.
  struct Instruction {
    TapeOp op;             ///< never kInput
    std::uint32_t result;  ///< register
    /// Registers; a alone for functions of one argument. kSum: numbers of linear and of product terms; kPower: b is the
    /// exponent, an integer >= 3; kConstant: neither is read.
    std::uint32_t a, b;
    friend bool operator==(const Instruction&, const Instruction&) = default;
  };
  /// factor (a constant), factor * register[a] (linear; a == b) or factor * register[a] * register[b] (product).
  /// A kConstant reads one of them, a kSum 1 + (linear) + (product): its constant, then the linear ones, then the
  /// products; consumed one after the other in the order of the code.
  struct Term {
    double factor;
    std::uint32_t a, b;
    friend bool operator==(const Term&, const Term&) = default;
  };

  /// The program, for readers that run it in an arithmetic of their own or analyze it. Registers 0 .. d - 1 hold x at
  /// the start and may be overwritten once x_i is needed no more; the others are written before they are read.
  std::span<const Instruction> instructions() const { return code_; }
  std::span<const Term> terms() const { return terms_; }                        ///< of kSum and kConstant
  std::span<const std::uint32_t> output_registers() const { return outputs_; }  ///< k, read after the last one

  int num_inputs() const { return num_inputs_; }                         ///< d
  int num_outputs() const { return static_cast<int>(outputs_.size()); }  ///< k
  int num_registers() const { return num_registers_; }                   ///< size of the workspace
  int num_instructions() const { return static_cast<int>(code_.size()); }

  /// values = f(x) in any arithmetic; x: d, values: k; workspace is resized as needed, keep it for the next run.
  /// T is constructible from double and offers + * /, and by argument-dependent look-up sqr(T), pow(T, int >= 3),
  /// pow(T, T), sqrt, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, exp, log, abs; double does.
  /// A type that encloses (an interval) gets an enclosure of the program as it is: every constant is a double.
  /// Throws InvalidInput when a size does not fit.
  template <class T>
  void run(std::span<const T> x, std::span<T> values, std::vector<T>& workspace) const;

  /// The same on doubles for many points; points: m x d, values: m x k, one point after the other. Groups of points go
  /// through the code at once. A value does not depend on the batch it came in, to the last bit; it may differ from
  /// run<double> by the rounding of multiplications that a compiler fused with additions.
  /// Throws InvalidInput when a size does not fit.
  void run_batch(std::span<const double> points, std::span<double> values) const;

  /// The same instructions on the same constants.
  friend bool operator==(const Tape&, const Tape&) = default;

 private:
  friend class TapeBuilder;

  [[noreturn]] void throw_sizes(std::size_t num_coordinates, std::size_t num_values) const;
  /// Runs the code on registers whose first d hold the input.
  template <class T>
  void execute(T* registers) const;
  /// Does as many groups of kLanes points as there are; returns the number of points done.
  template <int kLanes>
  std::size_t run_groups(const double* points, double* values, std::size_t num_points) const;

  int num_inputs_ = 0;
  int num_registers_ = 0;
  std::vector<Instruction> code_;
  std::vector<Term> terms_;
  std::vector<std::uint32_t> outputs_;  ///< register of every output
};

template <class T>
void Tape::run(std::span<const T> x, std::span<T> values, std::vector<T>& workspace) const {
  if (x.size() != static_cast<std::size_t>(num_inputs_) || values.size() != outputs_.size()) {
    throw_sizes(x.size(), values.size());
  }
  if (workspace.size() < static_cast<std::size_t>(num_registers_)) workspace.resize(num_registers_, T(0.0));
  for (std::size_t i = 0; i < x.size(); ++i) workspace[i] = x[i];
  execute(workspace.data());
  for (std::size_t i = 0; i < outputs_.size(); ++i) values[i] = workspace[outputs_[i]];
}

template <class T>
void Tape::execute(T* r) const {
  using std::abs, std::acos, std::asin, std::atan, std::cos, std::cosh, std::exp, std::log, std::sin, std::sinh,
      std::sqrt, std::tan, std::tanh, std::pow;
  using tape_arithmetic::sqr, tape_arithmetic::pow;
  // An interval's square is narrower than its product with itself.
  const auto product = [r](std::uint32_t a, std::uint32_t b) -> T { return a == b ? T(sqr(r[a])) : T(r[a] * r[b]); };
  const Term* term = terms_.data();
  for (const Instruction& i : code_) {
    switch (i.op) {
      case TapeOp::kInput:
        break;
      case TapeOp::kConstant:
        r[i.result] = T((term++)->factor);
        break;
      case TapeOp::kSum: {
        T sum((term++)->factor);
        for (const Term* end = term + i.a; term != end; ++term) sum = sum + T(term->factor) * r[term->a];
        for (const Term* end = term + i.b; term != end; ++term) {
          sum = sum + T(term->factor) * product(term->a, term->b);
        }
        r[i.result] = sum;
        break;
      }
      case TapeOp::kProduct:
        r[i.result] = product(i.a, i.b);
        break;
      case TapeOp::kQuotient:
        r[i.result] = r[i.a] / r[i.b];
        break;
      case TapeOp::kPower:
        r[i.result] = pow(r[i.a], static_cast<int>(i.b));
        break;
      case TapeOp::kPow:
        r[i.result] = pow(r[i.a], r[i.b]);
        break;
      case TapeOp::kSqrt:
        r[i.result] = sqrt(r[i.a]);
        break;
      case TapeOp::kSin:
        r[i.result] = sin(r[i.a]);
        break;
      case TapeOp::kCos:
        r[i.result] = cos(r[i.a]);
        break;
      case TapeOp::kTan:
        r[i.result] = tan(r[i.a]);
        break;
      case TapeOp::kAsin:
        r[i.result] = asin(r[i.a]);
        break;
      case TapeOp::kAcos:
        r[i.result] = acos(r[i.a]);
        break;
      case TapeOp::kAtan:
        r[i.result] = atan(r[i.a]);
        break;
      case TapeOp::kSinh:
        r[i.result] = sinh(r[i.a]);
        break;
      case TapeOp::kCosh:
        r[i.result] = cosh(r[i.a]);
        break;
      case TapeOp::kTanh:
        r[i.result] = tanh(r[i.a]);
        break;
      case TapeOp::kExp:
        r[i.result] = exp(r[i.a]);
        break;
      case TapeOp::kLog:
        r[i.result] = log(r[i.a]);
        break;
      case TapeOp::kAbs:
        r[i.result] = abs(r[i.a]);
        break;
      default:
        __builtin_unreachable();
    }
  }
}

}  // namespace whitney
