// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <whitney/functions/tape.h>

namespace whitney {

/// Builds a Tape from the leaves up. Equal subexpressions become one node; constants are folded, in doubles.
/// Every member throws InvalidInput when the result is a constant that is not finite, or a node does not exist.
class TapeBuilder {
 public:
  using Node = std::uint32_t;
  struct Term {
    double factor;
    Node node;
  };

  /// d = num_inputs >= 0.
  explicit TapeBuilder(int num_inputs);

  Node input(int i);
  Node constant(double value);
  /// constant + sum of factor * node, added in the given order; equal nodes are collected at the first of them.
  Node sum(double constant, const std::vector<Term>& terms);
  Node product(Node a, Node b);
  Node quotient(Node a, Node b);
  Node power(Node a, int n);  ///< a^n, any integer n
  Node pow(Node a, Node b);
  Node function(TapeOp op, Node a);  ///< op: kSqrt .. kAbs

  /// Whether the node is a constant, and then its value.
  bool is_constant(Node a) const { return node(a).op == TapeOp::kConstant; }
  double value(Node a) const { return node(a).constant; }

  /// The program that computes the nodes.
  Tape build(std::span<const Node> outputs) const;

 private:
  struct NodeData {
    TapeOp op = TapeOp::kConstant;
    double constant = 0;  ///< kConstant, kSum
    Node a = 0, b = 0;    ///< operands; kInput: its index; kPower: b is the exponent
    std::vector<Term> terms{};
  };

  /// How often a node is used, at all and by others than sums.
  struct Uses {
    std::uint32_t all = 0, outside_sums = 0;
  };

  const NodeData& node(Node a) const;
  Node intern(NodeData data);
  /// node = factor * rest
  Term split_factor(Node a) const;
  std::vector<Uses> count_uses(std::span<const Node> outputs) const;
  /// The instructions of all nodes in use, with nodes in the place of registers.
  void emit(const std::vector<Uses>& uses, Tape& tape) const;
  /// Replaces nodes by registers.
  void assign_registers(std::span<const Node> outputs, Tape& tape) const;

  int num_inputs_;
  std::vector<NodeData> nodes_;  ///< operands before their users
  std::map<std::vector<std::uint64_t>, Node> index_;
};

}  // namespace whitney
