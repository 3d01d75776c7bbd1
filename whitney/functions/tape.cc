// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/tape.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <type_traits>
#include <utility>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

/// Bytes of the widest register of the target.
#if defined(__AVX512F__)
constexpr int kRegisterBytes = 64;
#elif defined(__AVX__)
constexpr int kRegisterBytes = 32;
#else
constexpr int kRegisterBytes = 16;
#endif
constexpr int kLanesPerVector = kRegisterBytes / int(sizeof(double));
typedef double Vector __attribute__((vector_size(kRegisterBytes)));
typedef std::int64_t BitVector __attribute__((vector_size(kRegisterBytes)));

/// kLanes numbers that are computed with at once. One and many go through the same code, made of operations that round
/// correctly (a compiler that fuses a multiplication with an addition does so in all of them) and of the same functions
/// of one number, so they agree in every bit.
template <int kLanes>
struct Pack {
  static constexpr bool kIsVector = kLanes > 1;
  using Part = std::conditional_t<kIsVector, Vector, double>;
  static constexpr int kParts = kIsVector ? kLanes / kLanesPerVector : 1;

  Part part[kParts];

  Pack() = default;
  explicit Pack(double value) {
    for (Part& p : part) {
      if constexpr (kIsVector) {
        p = value - Vector{};
      } else {
        p = value;
      }
    }
  }
  double lane(int l) const {
    if constexpr (kIsVector) {
      return part[l / kLanesPerVector][l % kLanesPerVector];
    } else {
      return part[0];
    }
  }
};

/// The pack of operation(0), operation(1), .., one of each part.
template <int kLanes, class Operation>
inline Pack<kLanes> by_parts(Operation operation) {
  Pack<kLanes> result;
#pragma GCC unroll 16
  for (int p = 0; p < Pack<kLanes>::kParts; ++p) result.part[p] = operation(p);
  return result;
}
/// The pack of function(0), function(1), .., one of each lane.
template <int kLanes, class Function>
inline Pack<kLanes> by_lanes(Function function) {
  alignas(Pack<kLanes>) double lanes[kLanes];
  for (int l = 0; l < kLanes; ++l) lanes[l] = function(l);
  return std::bit_cast<Pack<kLanes>>(lanes);
}

template <int kLanes>
inline Pack<kLanes> operator+(const Pack<kLanes>& a, const Pack<kLanes>& b) {
  return by_parts<kLanes>([&](int p) { return a.part[p] + b.part[p]; });
}
template <int kLanes>
inline Pack<kLanes> operator*(const Pack<kLanes>& a, const Pack<kLanes>& b) {
  return by_parts<kLanes>([&](int p) { return a.part[p] * b.part[p]; });
}
template <int kLanes>
inline Pack<kLanes> operator/(const Pack<kLanes>& a, const Pack<kLanes>& b) {
  return by_parts<kLanes>([&](int p) { return a.part[p] / b.part[p]; });
}
template <int kLanes>
inline Pack<kLanes> sqr(const Pack<kLanes>& a) {
  return a * a;
}
template <int kLanes>
inline Pack<kLanes> pow(const Pack<kLanes>& a, int n) {
  return tape_arithmetic::repeated_squaring(a, n);
}
template <int kLanes>
inline Pack<kLanes> abs(const Pack<kLanes>& a) {
  if constexpr (kLanes == 1) {
    return Pack<1>(std::abs(a.part[0]));
  } else {
    constexpr std::int64_t kAllButSign = std::numeric_limits<std::int64_t>::max();
    return by_parts<kLanes>([&](int p) { return (Vector)((BitVector)a.part[p] & kAllButSign); });
  }
}
template <int kLanes>
inline Pack<kLanes> pow(const Pack<kLanes>& a, const Pack<kLanes>& b) {
  return by_lanes<kLanes>([&](int l) { return std::pow(a.lane(l), b.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> sqrt(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::sqrt(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> sin(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::sin(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> cos(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::cos(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> tan(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::tan(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> asin(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::asin(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> acos(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::acos(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> atan(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::atan(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> sinh(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::sinh(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> cosh(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::cosh(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> tanh(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::tanh(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> exp(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::exp(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> log(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::log(a.lane(l)); });
}

/// x[0], x[stride], x[2 stride], ..: built at once, as element after element is slow.
inline Vector gather(const double* x, std::size_t stride) {
  return [&]<std::size_t... l>(std::index_sequence<l...>) { return Vector{x[l * stride]...}; }
  (std::make_index_sequence<kLanesPerVector>{});
}

double apply(TapeOp op, double a) {
  switch (op) {
    case TapeOp::kSqrt:
      return std::sqrt(a);
    case TapeOp::kSin:
      return std::sin(a);
    case TapeOp::kCos:
      return std::cos(a);
    case TapeOp::kTan:
      return std::tan(a);
    case TapeOp::kAsin:
      return std::asin(a);
    case TapeOp::kAcos:
      return std::acos(a);
    case TapeOp::kAtan:
      return std::atan(a);
    case TapeOp::kSinh:
      return std::sinh(a);
    case TapeOp::kCosh:
      return std::cosh(a);
    case TapeOp::kTanh:
      return std::tanh(a);
    case TapeOp::kExp:
      return std::exp(a);
    case TapeOp::kLog:
      return std::log(a);
    case TapeOp::kAbs:
      return std::abs(a);
    default:
      throw InvalidInput("op: not a function of one argument");
  }
}

}  // namespace

void Tape::throw_sizes(std::size_t num_coordinates, std::size_t num_values) const {
  throw InvalidInput("tape: " + std::to_string(num_coordinates) + " coordinates and room for " +
                     std::to_string(num_values) + " values do not fit a map from R^" + std::to_string(num_inputs_) +
                     " to R^" + std::to_string(outputs_.size()));
}

template <int kLanes>
std::size_t Tape::run_groups(const double* points, double* values, std::size_t num_points) const {
  const std::size_t d = num_inputs_, k = outputs_.size();
  // Most tapes need few registers: they live on the stack.
  constexpr int kStackRegisters = 64;
  Pack<kLanes> stack[kStackRegisters];
  std::vector<Pack<kLanes>> heap(num_registers_ > kStackRegisters ? num_registers_ : 0);
  Pack<kLanes>* const r = heap.empty() ? stack : heap.data();
  std::size_t i = 0;
  for (; i + kLanes <= num_points; i += kLanes) {
    for (std::size_t j = 0; j < d; ++j) {
      const double* const x = points + i * d + j;
      if constexpr (kLanes == 1) {
        r[j] = Pack<1>(*x);
      } else {
        r[j] = by_parts<kLanes>([&](int p) { return gather(x + p * kLanesPerVector * d, d); });
      }
    }
    execute(r);
    for (std::size_t o = 0; o < k; ++o) {
      const Pack<kLanes>& result = r[outputs_[o]];
      double* const value = values + i * k + o;
      if (k == 1) {
        std::memcpy(value, &result, sizeof result);
      } else {
#pragma GCC unroll 32
        for (int l = 0; l < kLanes; ++l) value[l * k] = result.lane(l);
      }
    }
  }
  return i;
}

void Tape::run_batch(std::span<const double> points, std::span<double> values) const {
  const std::size_t d = num_inputs_, k = outputs_.size();
  // One point is common, and a division is slow.
  const std::size_t num_points = points.size() == d ? 1 : d == 0 ? 0 : points.size() / d;
  if (points.size() != num_points * d || values.size() != num_points * k) throw_sizes(points.size(), values.size());
  std::size_t done = 0;
  if (num_points >= 32) done += run_groups<32>(points.data(), values.data(), num_points);
  if (num_points - done >= 8) {
    done += run_groups<8>(points.data() + done * d, values.data() + done * k, num_points - done);
  }
  if (num_points > done) run_groups<1>(points.data() + done * d, values.data() + done * k, num_points - done);
}

TapeBuilder::TapeBuilder(int num_inputs) : num_inputs_(num_inputs) {
  if (num_inputs < 0) throw InvalidInput("num_inputs must not be negative: " + std::to_string(num_inputs));
}

const TapeBuilder::NodeData& TapeBuilder::node(Node a) const {
  if (a >= nodes_.size()) throw InvalidInput("tape node " + std::to_string(a) + " does not exist");
  return nodes_[a];
}

TapeBuilder::Node TapeBuilder::intern(NodeData data) {
  std::vector<std::uint64_t> key{static_cast<std::uint64_t>(data.op), std::bit_cast<std::uint64_t>(data.constant),
                                 data.a, data.b};
  for (const Term& term : data.terms) {
    key.push_back(std::bit_cast<std::uint64_t>(term.factor));
    key.push_back(term.node);
  }
  const auto [entry, is_new] = index_.try_emplace(std::move(key), static_cast<Node>(nodes_.size()));
  if (is_new) nodes_.push_back(std::move(data));
  return entry->second;
}

TapeBuilder::Term TapeBuilder::split_factor(Node a) const {
  const NodeData& data = node(a);
  if (data.op == TapeOp::kSum && data.terms.size() == 1 && data.constant == 0) return data.terms[0];
  return {1, a};
}

TapeBuilder::Node TapeBuilder::input(int i) {
  if (i < 0 || i >= num_inputs_) throw InvalidInput("tape input " + std::to_string(i) + " does not exist");
  return intern({.op = TapeOp::kInput, .a = static_cast<Node>(i)});
}

TapeBuilder::Node TapeBuilder::constant(double value) {
  if (!std::isfinite(value)) throw InvalidInput("a constant part is not a finite real number");
  return intern({.op = TapeOp::kConstant, .constant = value + 0.0});  // + 0.0: one zero, not two
}

TapeBuilder::Node TapeBuilder::sum(double constant, const std::vector<Term>& terms) {
  NodeData result{.op = TapeOp::kSum, .constant = constant};
  std::map<Node, std::size_t> position;
  for (Term term : terms) {
    if (is_constant(term.node)) {
      result.constant += term.factor * value(term.node);
      continue;
    }
    const Term inner = split_factor(term.node);
    term = {term.factor * inner.factor, inner.node};
    const auto [entry, is_new] = position.try_emplace(term.node, result.terms.size());
    if (is_new) {
      result.terms.push_back(term);
    } else {
      result.terms[entry->second].factor += term.factor;
    }
  }
  std::erase_if(result.terms, [](const Term& term) { return term.factor == 0; });
  for (const Term& term : result.terms) this->constant(term.factor);  // must be finite
  if (result.terms.empty()) return this->constant(result.constant);
  this->constant(result.constant);
  result.constant += 0.0;
  if (result.constant == 0 && result.terms.size() == 1 && result.terms[0].factor == 1) return result.terms[0].node;
  return intern(std::move(result));
}

TapeBuilder::Node TapeBuilder::product(Node a, Node b) {
  if (is_constant(a)) return sum(0, {{value(a), b}});
  if (is_constant(b)) return sum(0, {{value(b), a}});
  return intern({.op = TapeOp::kProduct, .a = std::min(a, b), .b = std::max(a, b)});
}

TapeBuilder::Node TapeBuilder::quotient(Node a, Node b) {
  if (is_constant(a) && is_constant(b)) return constant(value(a) / value(b));
  if (is_constant(b) && value(b) == 0) return constant(value(a) / value(b));  // throws
  if (is_constant(a) && value(a) == 0) return a;
  if (is_constant(b) && value(b) == 1) return a;
  return intern({.op = TapeOp::kQuotient, .a = a, .b = b});
}

TapeBuilder::Node TapeBuilder::power(Node a, int n) {
  if (n == 0) return constant(1);
  if (n == std::numeric_limits<int>::min()) return pow(a, constant(n));
  if (n < 0) return quotient(constant(1), power(a, -n));
  if (is_constant(a)) return constant(tape_arithmetic::pow(value(a), n));
  if (n == 1) return a;
  if (n == 2) return product(a, a);
  return intern({.op = TapeOp::kPower, .a = a, .b = static_cast<Node>(n)});
}

TapeBuilder::Node TapeBuilder::pow(Node a, Node b) {
  if (is_constant(a) && is_constant(b)) return constant(std::pow(value(a), value(b)));
  return intern({.op = TapeOp::kPow, .a = a, .b = b});
}

TapeBuilder::Node TapeBuilder::function(TapeOp op, Node a) {
  if (op < TapeOp::kSqrt || op > TapeOp::kAbs) throw InvalidInput("op: not a function of one argument");
  if (is_constant(a)) return constant(apply(op, value(a)));
  return intern({.op = op, .a = a});
}

Tape TapeBuilder::build(std::span<const Node> outputs) const {
  const std::size_t num_nodes = nodes_.size();
  // How often a node is used, by others than sums and at all. Users come after their operands.
  std::vector<std::uint32_t> uses(num_nodes, 0), uses_outside_sums(num_nodes, 0);
  const auto use = [&](Node a, bool by_sum) {
    ++uses[a];
    if (!by_sum) ++uses_outside_sums[a];
  };
  for (Node output : outputs) {
    node(output);
    use(output, false);
  }
  for (std::size_t i = num_nodes; i-- > 0;) {
    if (uses[i] == 0) continue;
    const NodeData& data = nodes_[i];
    if (data.op == TapeOp::kSum) {
      for (const Term& term : data.terms) use(term.node, true);
    } else if (data.op != TapeOp::kInput && data.op != TapeOp::kConstant) {
      use(data.a, false);
      if (data.op == TapeOp::kProduct || data.op == TapeOp::kQuotient || data.op == TapeOp::kPow) use(data.b, false);
    }
  }
  // A product that only one sum asks for is computed inside it.
  const auto is_fused = [&](Node a) {
    return nodes_[a].op == TapeOp::kProduct && uses[a] == 1 && uses_outside_sums[a] == 0;
  };

  // First with nodes in the place of registers.
  Tape tape;
  tape.num_inputs_ = num_inputs_;
  for (Node i = 0; i < num_nodes; ++i) {
    const NodeData& data = nodes_[i];
    if (uses[i] == 0 || data.op == TapeOp::kInput || is_fused(i)) continue;
    if (data.op == TapeOp::kConstant) tape.terms_.push_back({data.constant, 0, 0});
    Tape::Instruction instruction{data.op, i, data.a, data.b};
    if (data.op == TapeOp::kSum) {
      tape.terms_.push_back({data.constant, 0, 0});
      instruction.a = instruction.b = 0;
      for (const Term& term : data.terms) {
        if (is_fused(term.node)) continue;
        tape.terms_.push_back({term.factor, term.node, term.node});
        ++instruction.a;
      }
      for (const Term& term : data.terms) {
        if (!is_fused(term.node)) continue;
        tape.terms_.push_back({term.factor, nodes_[term.node].a, nodes_[term.node].b});
        ++instruction.b;
      }
    }
    tape.code_.push_back(instruction);
  }

  // Calls visit(operand) for every register an instruction reads; `term` runs along.
  const auto for_each_operand = [&tape](Tape::Instruction& i, std::size_t& term, auto visit) {
    if (i.op == TapeOp::kSum) {
      ++term;
      for (std::size_t end = term + i.a + i.b; term != end; ++term) {
        visit(tape.terms_[term].a);
        visit(tape.terms_[term].b);
      }
    } else if (i.op == TapeOp::kConstant) {
      ++term;
    } else {
      visit(i.a);
      if (i.op == TapeOp::kProduct || i.op == TapeOp::kQuotient || i.op == TapeOp::kPow) visit(i.b);
    }
  };
  constexpr std::size_t kNever = 0, kForever = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> last_use(num_nodes, kNever);  // 1 + index of the instruction
  std::size_t term = 0;
  for (std::size_t i = 0; i < tape.code_.size(); ++i) {
    for_each_operand(tape.code_[i], term, [&](Node a) { last_use[a] = i + 1; });
  }
  for (Node output : outputs) last_use[output] = kForever;

  // A result goes to the lowest register whose value nobody needs any more.
  std::vector<std::uint32_t> register_of(num_nodes, 0);
  std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> free_registers;
  std::vector<char> is_input_used(num_inputs_, false);
  for (Node i = 0; i < num_nodes; ++i) {
    if (nodes_[i].op != TapeOp::kInput || last_use[i] == kNever) continue;
    register_of[i] = nodes_[i].a;
    is_input_used[nodes_[i].a] = true;
  }
  for (int i = 0; i < num_inputs_; ++i) {
    if (!is_input_used[i]) free_registers.push(i);
  }
  tape.num_registers_ = num_inputs_;
  term = 0;
  for (std::size_t i = 0; i < tape.code_.size(); ++i) {
    for_each_operand(tape.code_[i], term, [&](std::uint32_t& a) {
      const Node operand = a;
      a = register_of[operand];
      if (last_use[operand] == i + 1) {
        free_registers.push(a);
        last_use[operand] = kNever;
      }
    });
    const Node result = tape.code_[i].result;
    if (free_registers.empty()) free_registers.push(tape.num_registers_++);
    register_of[result] = tape.code_[i].result = free_registers.top();
    free_registers.pop();
  }
  for (Node output : outputs) tape.outputs_.push_back(register_of[output]);
  return tape;
}

}  // namespace whitney
