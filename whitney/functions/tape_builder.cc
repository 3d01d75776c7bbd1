// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/tape_builder.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <utility>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

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

/// Whether b is an operand besides a.
bool is_binary(TapeOp op) { return op == TapeOp::kProduct || op == TapeOp::kQuotient || op == TapeOp::kPow; }

/// Calls visit(operand) for every register that an instruction reads, `term` being the first of its terms; returns the
/// first term of the next instruction.
template <class Visit>
Tape::Term* for_each_operand(Tape::Instruction& i, Tape::Term* term, Visit visit) {
  if (i.op == TapeOp::kSum) {
    ++term;
    for (Tape::Term* const end = term + i.a + i.b; term != end; ++term) {
      visit(term->a);
      visit(term->b);
    }
  } else if (i.op == TapeOp::kConstant) {
    ++term;
  } else {
    visit(i.a);
    if (is_binary(i.op)) visit(i.b);
  }
  return term;
}

}  // namespace

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

std::vector<TapeBuilder::Uses> TapeBuilder::count_uses(std::span<const Node> outputs) const {
  std::vector<Uses> uses(nodes_.size());
  const auto use = [&](Node a, bool by_sum) {
    ++uses[a].all;
    if (!by_sum) ++uses[a].outside_sums;
  };
  for (Node output : outputs) {
    node(output);
    use(output, false);
  }
  // Users come after their operands.
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    if (uses[i].all == 0) continue;
    const NodeData& data = nodes_[i];
    if (data.op == TapeOp::kSum) {
      for (const Term& term : data.terms) use(term.node, true);
    } else if (data.op != TapeOp::kInput && data.op != TapeOp::kConstant) {
      use(data.a, false);
      if (is_binary(data.op)) use(data.b, false);
    }
  }
  return uses;
}

void TapeBuilder::emit(const std::vector<Uses>& uses, Tape& tape) const {
  // A product that only one sum asks for is computed inside it.
  const auto is_fused = [&](Node a) {
    return nodes_[a].op == TapeOp::kProduct && uses[a].all == 1 && uses[a].outside_sums == 0;
  };
  for (Node i = 0; i < nodes_.size(); ++i) {
    const NodeData& data = nodes_[i];
    if (uses[i].all == 0 || data.op == TapeOp::kInput || is_fused(i)) continue;
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
}

void TapeBuilder::assign_registers(std::span<const Node> outputs, Tape& tape) const {
  const std::size_t num_nodes = nodes_.size();
  constexpr std::size_t kNever = 0, kForever = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> last_use(num_nodes, kNever);  // 1 + index of the instruction
  Tape::Term* term = tape.terms_.data();
  for (std::size_t i = 0; i < tape.code_.size(); ++i) {
    term = for_each_operand(tape.code_[i], term, [&](Node a) { last_use[a] = i + 1; });
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
  term = tape.terms_.data();
  for (std::size_t i = 0; i < tape.code_.size(); ++i) {
    term = for_each_operand(tape.code_[i], term, [&](std::uint32_t& a) {
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
}

Tape TapeBuilder::build(std::span<const Node> outputs) const {
  Tape tape;
  tape.num_inputs_ = num_inputs_;
  emit(count_uses(outputs), tape);
  assign_registers(outputs, tape);
  return tape;
}

}  // namespace whitney
