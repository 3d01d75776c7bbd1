// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <whitney/functions/range.h>
#include <whitney/functions/tape.h>

namespace whitney {

/// What is proved about a map f: R^d -> R^k over a box: Ranges that hold all values, gradients and second derivatives
/// of f there. Immutable; safe to use from several threads, with a Workspace for each.
///
/// Where an operation is not defined, or not twice differentiable, at some point of the box (a root, logarithm or power
/// at 0, a quotient by 0, abs at 0, asin beyond 1), the Ranges that come of it are everything; bounded second
/// derivatives over a box prove that f is defined and C^2 on it.
class Enclosure {
 public:
  /// f as its text says it. Every constant is enclosed: pi, 2/3, exp(1) as real numbers; a decimal number by the two
  /// neighbors of its nearest double, so that both readings, the double that expression.h promises and the decimal
  /// number itself, are inside. The grammar is that of expression.h, read by a parser of its own that simplifies
  /// nothing (x/x is everything where x may be 0). Throws InvalidInput.
  static Enclosure of_expressions(std::span<const std::string> variables, std::span<const std::string> expressions);

  /// f as the tape computes it in real arithmetic from its constants, which are doubles: where TapeBuilder folded
  /// constants, that is another function than the text's, by rounding errors. has_exact_constants() is false.
  static Enclosure of_tape(const Tape& tape);

  int ambient_dim() const { return num_variables_; }
  int codim() const { return static_cast<int>(outputs_.size()); }
  /// Whether f is the function of a text, not that of rounded constants.
  bool has_exact_constants() const { return has_exact_constants_; }
  /// The degree of component a where it is seen to be a polynomial of degree at most 2; 3 for everything else. Second
  /// derivatives of a component of degree 2 do not depend on the box.
  int degree(int a) const { return nodes_[outputs_[a]].degree; }

  class Workspace {
    friend class Enclosure;
    std::vector<Range> values_, gradients_, hessians_;
  };
  struct Jets {
    std::vector<Range> values;     ///< k
    std::vector<Range> gradients;  ///< k x d
    std::vector<Range> hessians;   ///< k x d(d+1)/2: the upper triangles, row by row
  };
  /// Enclosures over the box (d Ranges) up to the order, 0..2; what is beyond the order is left as it is.
  /// Throws InvalidInput when the box does not have d Ranges.
  void evaluate(std::span<const Range> box, int order, Jets& jets, Workspace& workspace) const;

  /// Of the internal program.
  int num_nodes() const { return static_cast<int>(nodes_.size()); }

 private:
  friend class EnclosureBuilder;
  enum class Op : std::uint8_t {
    kInput,
    kConstant,
    kAdd,
    kSubtract,
    kScale,
    kProduct,
    kQuotient,
    kPower,
    kPow,
    kFunction
  };
  struct Node {
    Op op = Op::kConstant;
    TapeOp function = TapeOp::kAbs;       ///< kFunction
    std::uint32_t a = 0, b = 0;           ///< operands, before their users; kInput: a is its index
    int exponent = 0;                     ///< kPower
    Range constant;                       ///< kConstant; kScale: times a
    int degree = 0;                       ///< 0..2 of a polynomial, 3 of anything else
    std::vector<std::uint32_t> inputs{};  ///< those that it depends on, increasing
  };

  void product(const Node& node, std::size_t n, int order, Workspace& w) const;
  void chain(const Node& node, std::size_t n, int order, const Range* phi, Workspace& w) const;
  void combine(const Node& node, std::size_t n, int order, Workspace& w) const;
  std::size_t pair(std::size_t i, std::size_t j) const { return i * (2 * num_variables_ - i - 1) / 2 + j; }

  int num_variables_ = 0;
  bool has_exact_constants_ = false;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> outputs_;
};

/// Builds an Enclosure's program; equal nodes become one, constants are folded as Ranges.
class EnclosureBuilder {
 public:
  using Node = std::uint32_t;
  explicit EnclosureBuilder(int num_variables);
  Node input(int i);
  Node constant(const Range& value);
  Node add(Node a, Node b);
  Node subtract(Node a, Node b);
  Node product(Node a, Node b);
  Node quotient(Node a, Node b);
  Node power(Node a, int n);
  Node pow(Node a, Node b);
  Node function(TapeOp op, Node a);
  bool is_constant(Node a) const;
  const Range& value(Node a) const;  ///< of a constant
  Enclosure build(std::span<const Node> outputs, bool has_exact_constants) const;

 private:
  Node insert(Enclosure::Node node);
  Enclosure program_;
};

}  // namespace whitney
