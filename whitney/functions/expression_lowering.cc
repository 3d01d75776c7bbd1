// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/expression_lowering.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>

namespace whitney::symbolic {
namespace {

std::string text(const numeric& value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace

Lowering::Node Lowering::lower(const ex& e) {
  if (const auto found = nodes_.find(e); found != nodes_.end()) return found->second;
  Node result;
  if (GiNaC::is_exactly_a<GiNaC::add>(e)) {
    const Sum& s = sum(e);
    std::vector<TapeBuilder::Term> terms;
    for (const Monomial& monomial : s.terms) terms.push_back(lower(monomial));
    result = builder_.sum(nearest_double(s.constant), terms);
  } else {
    result = builder_.sum(0, {lower(monomial(e))});
  }
  return nodes_[e] = result;
}

Lowering::Monomial Lowering::monomial(const ex& e) {
  Monomial result;
  if (GiNaC::is_exactly_a<GiNaC::mul>(e)) {
    for (const ex& factor : e) multiply(result, factor);
  } else {
    multiply(result, e);
  }
  std::sort(result.factors.begin(), result.factors.end(),
            [](const Factor& a, const Factor& b) { return a.key < b.key; });
  for (const Factor& factor : result.factors) result.key += "*" + factor.key;
  return result;
}

const Lowering::Sum& Lowering::sum(const ex& e) {
  if (const auto found = sums_.find(e); found != sums_.end()) return found->second;
  Sum result;
  for (const ex& term : e) {
    if (GiNaC::is_exactly_a<numeric>(term)) {
      result.constant += GiNaC::ex_to<numeric>(term);
    } else {
      result.terms.push_back(monomial(term));
    }
  }
  std::sort(result.terms.begin(), result.terms.end(),
            [](const Monomial& a, const Monomial& b) { return a.key < b.key; });
  result.key = "+" + text(result.constant);
  for (const Monomial& term : result.terms) result.key += "," + text(term.coefficient) + term.key;
  result.key += ";";
  return sums_[e] = std::move(result);
}

void Lowering::multiply(Monomial& product, const ex& e) {
  if (GiNaC::is_exactly_a<numeric>(e)) {
    product.coefficient *= GiNaC::ex_to<numeric>(e);
    return;
  }
  Factor factor{"", e, 1};
  if (GiNaC::is_exactly_a<GiNaC::power>(e)) {
    factor.base = e.op(0);
    factor.exponent = e.op(1);
  }
  if (GiNaC::is_exactly_a<GiNaC::add>(factor.base) && factor.exponent.info(GiNaC::info_flags::integer) &&
      sum(factor.base).terms[0].coefficient.is_negative()) {
    factor.base = -factor.base;
    if (factor.exponent.info(GiNaC::info_flags::odd)) product.coefficient *= -1;
  }
  factor.key = key(factor.base);
  if (!factor.exponent.is_equal(1)) factor.key += "^" + key(factor.exponent);
  product.factors.push_back(std::move(factor));
}

std::string Lowering::key(const ex& e) {
  if (GiNaC::is_exactly_a<numeric>(e)) return text(GiNaC::ex_to<numeric>(e));
  if (GiNaC::is_exactly_a<GiNaC::add>(e)) return sum(e).key;
  if (GiNaC::is_exactly_a<GiNaC::constant>(e)) return "pi";
  if (GiNaC::is_a<GiNaC::symbol>(e)) {
    std::ostringstream out;
    if (const std::optional<int> i = symbols_.variable_index(e)) {
      out << 'v' << std::setw(6) << std::setfill('0') << *i;
    } else {
      out << 'c' << std::hexfloat << symbols_.constant_value(e);
    }
    return out.str();
  }
  if (GiNaC::is_exactly_a<GiNaC::function>(e)) {
    return GiNaC::ex_to<GiNaC::function>(e).get_name() + "(" + key(e.op(0)) + ")";
  }
  if (!GiNaC::is_exactly_a<GiNaC::mul>(e) && !GiNaC::is_exactly_a<GiNaC::power>(e)) {
    throw InvalidInput("it has no derivative that can be written in the known functions");
  }
  const Monomial product = monomial(e);
  return "(" + text(product.coefficient) + product.key + ")";
}

TapeBuilder::Term Lowering::lower(const Monomial& monomial) {
  double factor = nearest_double(monomial.coefficient);
  std::optional<Node> numerator, denominator;
  for (const Factor& f : monomial.factors) {
    const auto [node, inverse] = power(f);
    if (builder_.is_constant(node)) {
      factor = inverse ? factor / builder_.value(node) : factor * builder_.value(node);
      continue;
    }
    std::optional<Node>& side = inverse ? denominator : numerator;
    side = side ? builder_.product(*side, node) : node;
  }
  if (!denominator)
    return numerator ? TapeBuilder::Term{factor, *numerator} : TapeBuilder::Term{1, builder_.constant(factor)};
  if (numerator) return {factor, builder_.quotient(*numerator, *denominator)};
  return {1, builder_.quotient(builder_.constant(factor), *denominator)};
}

std::pair<Lowering::Node, bool> Lowering::power(const Factor& f) {
  if (f.exponent.is_equal(1)) return {atom(f.base), false};
  const Node base = atom(f.base);
  if (!GiNaC::is_exactly_a<numeric>(f.exponent)) return {builder_.pow(base, lower(f.exponent)), false};
  const numeric& n = GiNaC::ex_to<numeric>(f.exponent);
  const numeric largest = std::numeric_limits<int>::max() / 2;  // as a multiple of 1/2, too
  if (n.is_rational() && GiNaC::abs(n) < largest) {
    if (n.is_integer()) return {builder_.power(base, std::abs(n.to_int())), n.is_negative()};
    if (n.denom() == 2) {
      const Node root = builder_.function(TapeOp::kSqrt, base);
      return {builder_.power(root, std::abs(n.numer().to_int())), n.is_negative()};
    }
  }
  return {builder_.pow(base, builder_.constant(nearest_double(n))), false};
}

Lowering::Node Lowering::atom(const ex& e) {
  if (GiNaC::is_a<GiNaC::symbol>(e)) {
    const std::optional<int> i = symbols_.variable_index(e);
    return i ? builder_.input(*i) : builder_.constant(symbols_.constant_value(e));
  }
  if (e.is_equal(GiNaC::Pi)) return builder_.constant(std::numbers::pi);
  if (GiNaC::is_exactly_a<GiNaC::function>(e)) {
    const std::string name = GiNaC::ex_to<GiNaC::function>(e).get_name();
    // GiNaC does not see that everything here is real.
    if (name == "conjugate_function" || name == "conjugate" || name == "real_part") return lower(e.op(0));
    const NamedFunction* function = find_function(name);
    if (!function) throw InvalidInput("a derivative needs the function '" + name + "'");
    return builder_.function(function->op, lower(e.op(0)));
  }
  if (GiNaC::is_exactly_a<numeric>(e)) return builder_.constant(nearest_double(GiNaC::ex_to<numeric>(e)));
  return lower(e);  // a sum, or a product under a power
}

void MapCompiler::add(const ex& e) {
  value_nodes_.push_back(lower_value_.lower(e));
  for (int i = 0; i < dim_; ++i) derivative_nodes_.push_back(lower_derivative_.lower(e.diff(symbols_.variable(i))));
}

}  // namespace whitney::symbolic
