// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <coxeter/base/error.h>
#include <whitney/functions/expression.h>
#include <whitney/functions/expression_parser.h>
#include <whitney/functions/tape_builder.h>

// Internal: GiNaC -> tape. Only expression*.cc and homogeneous_equations.cc include this header.

namespace whitney::symbolic {

/// GiNaC expression -> nodes of a tape.
///
/// GiNaC orders terms and factors by hashes that change from run to run, and with the order the sign it pulls out of
/// (x - y)^3 changes. So terms and factors are sorted here by keys made of their structure, and in a factor the first
/// term of a sum gets a positive coefficient.
class Lowering {
 public:
  using Node = TapeBuilder::Node;

  /// base^exponent
  struct Factor {
    std::string key;
    ex base, exponent;
  };
  struct Monomial {
    std::string key;  ///< of the factors
    numeric coefficient = 1;
    std::vector<Factor> factors{};
  };

  Lowering(const Symbols& symbols, TapeBuilder& builder) : symbols_(symbols), builder_(builder) {}

  /// The node of the expression. Throws InvalidInput when it holds a function that tapes do not have.
  Node lower(const ex& e);

  /// The factors of a product, in an order and with signs that do not change from run to run.
  Monomial monomial(const ex& e);

 private:
  struct Sum {
    std::string key;
    numeric constant = 0;
    std::vector<Monomial> terms{};
  };

  const Sum& sum(const ex& e);
  void multiply(Monomial& product, const ex& e);
  std::string key(const ex& e);
  TapeBuilder::Term lower(const Monomial& monomial);
  /// The factor or its inverse, and which of the two.
  std::pair<Node, bool> power(const Factor& f);
  Node atom(const ex& e);

  const Symbols& symbols_;
  TapeBuilder& builder_;
  std::map<ex, Sum, GiNaC::ex_is_less> sums_;
  std::map<ex, Node, GiNaC::ex_is_less> nodes_;
};

/// Collects expressions in the variables of `symbols` into a map.
class MapCompiler {
 public:
  explicit MapCompiler(const Symbols& symbols)
      : symbols_(symbols), dim_(static_cast<int>(symbols.names().size())), values_(dim_), derivatives_(dim_) {}

  /// One more component of the map.
  void add(const ex& e);
  CompiledMap build() const { return {values_.build(value_nodes_), derivatives_.build(derivative_nodes_)}; }

 private:
  const Symbols& symbols_;
  int dim_;
  TapeBuilder values_, derivatives_;
  Lowering lower_value_{symbols_, values_}, lower_derivative_{symbols_, derivatives_};
  std::vector<TapeBuilder::Node> value_nodes_, derivative_nodes_;
};

/// Calls `work`; what GiNaC or the tape says against it becomes a statement about the expression.
template <class Work>
auto on_expression(std::string_view text, Work work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    const std::string expression = quoted(text);
    if (std::string_view(error.what()).starts_with(expression)) throw;
    throw InvalidInput(expression + ": " + error.what());
  }
}

}  // namespace whitney::symbolic
