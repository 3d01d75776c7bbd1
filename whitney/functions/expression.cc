// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/expression.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include <ginac/ginac.h>

#include <coxeter/base/error.h>
#include <whitney/functions/homogeneous_equations.h>

// Everything that touches GiNaC stands in this file: its headers stay out of ours, and one mutex guards it.

namespace whitney {
namespace {

using GiNaC::ex;
using GiNaC::exvector;
using GiNaC::numeric;
using Node = TapeBuilder::Node;

/// Guards every GiNaC object: their reference counts and tables are shared and not atomic.
std::mutex& ginac_mutex() {
  static std::mutex mutex;
  return mutex;
}

struct NamedFunction {
  const char* name;
  TapeOp op;
  double (*value)(double);
  ex (*symbolic)(const ex&);
};

const std::array<NamedFunction, 13> kFunctions{{
    {"sqrt", TapeOp::kSqrt, std::sqrt, [](const ex& e) { return GiNaC::sqrt(e); }},
    {"sin", TapeOp::kSin, std::sin, [](const ex& e) -> ex { return GiNaC::sin(e); }},
    {"cos", TapeOp::kCos, std::cos, [](const ex& e) -> ex { return GiNaC::cos(e); }},
    {"tan", TapeOp::kTan, std::tan, [](const ex& e) -> ex { return GiNaC::tan(e); }},
    {"asin", TapeOp::kAsin, std::asin, [](const ex& e) -> ex { return GiNaC::asin(e); }},
    {"acos", TapeOp::kAcos, std::acos, [](const ex& e) -> ex { return GiNaC::acos(e); }},
    {"atan", TapeOp::kAtan, std::atan, [](const ex& e) -> ex { return GiNaC::atan(e); }},
    {"sinh", TapeOp::kSinh, std::sinh, [](const ex& e) -> ex { return GiNaC::sinh(e); }},
    {"cosh", TapeOp::kCosh, std::cosh, [](const ex& e) -> ex { return GiNaC::cosh(e); }},
    {"tanh", TapeOp::kTanh, std::tanh, [](const ex& e) -> ex { return GiNaC::tanh(e); }},
    {"exp", TapeOp::kExp, std::exp, [](const ex& e) -> ex { return GiNaC::exp(e); }},
    {"log", TapeOp::kLog, std::log, [](const ex& e) -> ex { return GiNaC::log(e); }},
    {"abs", TapeOp::kAbs, std::fabs, [](const ex& e) -> ex { return GiNaC::abs(e); }},
}};
constexpr std::string_view kPi = "pi";

const NamedFunction* find_function(std::string_view name) {
  for (const NamedFunction& function : kFunctions) {
    if (name == function.name) return &function;
  }
  return nullptr;
}

/// Locale-free, unlike <cctype>.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// The nearest double of a rational number.
double nearest_double(const numeric& value) {
  if (!value.is_real()) throw InvalidInput("it is complex");
  const numeric bound = numeric(1L << 53), num = value.numer(), den = value.denom();
  if (GiNaC::abs(num) <= bound && den <= bound) return double(num.to_long()) / double(den.to_long());
  return value.to_double();
}

/// What a text may say.
enum class Dialect {
  kFunctions,           ///< everything that expression.h lists, over R
  kPolynomials,         ///< polynomials over R: functions, quotients and other powers of constants only
  kComplexPolynomials,  ///< polynomials over C in the variables and their conjugates: i, conj, real, imag, abs2
};

/// The names that kComplexPolynomials adds.
const std::array<std::string_view, 5> kComplexNames{"i", "conj", "real", "imag", "abs2"};

/// The symbols of one parse. With kComplexPolynomials, variable i stands for the i-th name and variable N + i for its
/// conjugate; both are real for GiNaC, which must not simplify what it thinks it knows about them. Decimal numbers are
/// opaque symbols: GiNaC would round them in its own way, or, as rational numbers, pull common factors of twenty digits
/// out of sums.
class Symbols {
 public:
  explicit Symbols(std::span<const std::string> names, Dialect dialect = Dialect::kFunctions)
      : names_(names), dialect_(dialect) {
    for (std::size_t i = 0; i < names.size() * (dialect == Dialect::kComplexPolynomials ? 2 : 1); ++i) {
      variables_.push_back(GiNaC::realsymbol());
      index_[variables_.back()] = static_cast<int>(i);
    }
  }

  std::span<const std::string> names() const { return names_; }
  Dialect dialect() const { return dialect_; }
  bool is_complex() const { return dialect_ == Dialect::kComplexPolynomials; }
  const GiNaC::realsymbol& variable(int i) const { return variables_[i]; }
  std::optional<int> variable_index(const ex& symbol) const {
    const auto found = index_.find(symbol);
    return found == index_.end() ? std::nullopt : std::optional(found->second);
  }

  ex constant(double value) {
    if (std::abs(value) < double(1L << 53) && value == std::floor(value)) return numeric(static_cast<long>(value));
    const auto [entry, is_new] = symbol_of_.try_emplace(value);
    if (is_new) {
      const GiNaC::realsymbol symbol;
      entry->second = symbol;
      value_of_[symbol] = value;
    }
    return entry->second;
  }
  double constant_value(const ex& symbol) const { return value_of_.at(symbol); }

  bool has_variables(const ex& e) const {
    if (GiNaC::is_a<GiNaC::symbol>(e)) return index_.contains(e);
    return std::any_of(e.begin(), e.end(), [this](const ex& part) { return has_variables(part); });
  }

  /// The conjugate of a polynomial; kComplexPolynomials.
  ex conjugate(const ex& e) const {
    GiNaC::exmap exchange;
    const std::size_t count = names_.size();
    for (std::size_t i = 0; i < 2 * count; ++i) exchange[variables_[i]] = variables_[(i + count) % (2 * count)];
    return e.conjugate().subs(exchange, GiNaC::subs_options::no_pattern);
  }

 private:
  std::span<const std::string> names_;
  Dialect dialect_;
  std::vector<GiNaC::realsymbol> variables_;
  std::map<ex, int, GiNaC::ex_is_less> index_;
  std::map<double, ex> symbol_of_;
  std::map<ex, double, GiNaC::ex_is_less> value_of_;
};

/// Text -> GiNaC expression, by recursive descent.
class Parser {
 public:
  /// `constant` is the value when the expression has no variables.
  struct Value {
    ex e;
    std::optional<double> constant;
  };

  Parser(std::string_view text, Symbols& symbols) : text_(text), symbols_(symbols) {}

  Value parse() {
    skip_space();
    if (position_ == text_.size()) fail(position_, "the expression is empty");
    Value result = sum();
    if (position_ == text_.size()) return result;
    if (text_[position_] == '=') fail(position_, "an equation is written as an expression that is zero, without '='");
    if (text_[position_] == ')') fail(position_, "')' without '('");
    fail(position_, "expected an operator instead of " + symbol_at(position_));
  }

  [[noreturn]] void fail(std::size_t position, const std::string& reason) const {
    throw InvalidInput(quoted(text_) + ", position " + std::to_string(position + 1) + ": " + reason);
  }

  static std::string quoted(std::string_view text) {
    constexpr std::size_t kLongest = 200;
    return "\"" + std::string(text.substr(0, kLongest)) + (text.size() > kLongest ? "...\"" : "\"");
  }

 private:
  void skip_space() {
    while (position_ < text_.size() && std::string_view(" \t\r\n").find(text_[position_]) != std::string_view::npos) {
      ++position_;
    }
  }
  bool accept(std::string_view token) {
    if (text_.substr(position_, token.size()) != token) return false;
    position_ += token.size();
    skip_space();
    return true;
  }
  std::string symbol_at(std::size_t position) const {
    if (position >= text_.size()) return "the end";
    std::size_t end = position + 1;
    const auto is_word = [](char c) { return is_letter(c) || is_digit(c); };
    if (is_word(text_[position])) {
      while (end < text_.size() && is_word(text_[end])) ++end;
    } else {
      while (end < text_.size() && (text_[end] & 0xC0) == 0x80) ++end;  // the rest of a UTF-8 character
    }
    return "'" + std::string(text_.substr(position, end - position)) + "'";
  }

  /// The value of an operation on constants must be a real number; what GiNaC knows exactly replaces what was computed.
  Value checked(ex e, std::optional<double> constant, std::size_t position) const {
    if (constant && !std::isfinite(*constant)) fail(position, "the value is not a finite real number");
    if (GiNaC::is_exactly_a<numeric>(e)) {
      const numeric& value = GiNaC::ex_to<numeric>(e);
      if (!value.is_real()) {
        if (symbols_.is_complex()) return {std::move(e), std::nullopt};
        fail(position, "the value is complex");
      }
      constant = nearest_double(value);
      if (!std::isfinite(*constant)) fail(position, "the value is beyond the range of double");
    }
    return {std::move(e), constant};
  }

  Value sum() {
    const std::size_t start = position_;
    Value first = product();
    exvector terms{first.e};
    std::optional<double> constant = first.constant;
    for (;;) {
      const bool minus = text_.substr(position_, 1) == "-";
      if (!accept("+") && !accept("-")) break;
      const Value next = product();
      terms.push_back(minus ? -next.e : next.e);
      if (constant && next.constant) {
        *constant += minus ? -*next.constant : *next.constant;
      } else {
        constant.reset();
      }
    }
    if (terms.size() == 1) return first;
    return checked(GiNaC::add(terms), constant, start);
  }

  Value product() {
    const std::size_t start = position_;
    Value first = signed_power();
    exvector factors{first.e};
    std::optional<double> constant = first.constant;
    for (;;) {
      const bool divide = text_.substr(position_, 1) == "/";
      if (!accept("*") && !accept("/")) break;
      const std::size_t operand = position_;
      const Value next = signed_power();
      if (divide && (next.e.is_zero() || next.constant == 0.0)) fail(operand, "division by zero");
      if (divide) check_polynomial(next.e, "a quotient", operand);
      factors.push_back(divide ? GiNaC::pow(next.e, -1) : next.e);
      if (constant && next.constant) {
        *constant = divide ? *constant / *next.constant : *constant * *next.constant;
      } else {
        constant.reset();
      }
    }
    if (factors.size() == 1) return first;
    return checked(GiNaC::mul(factors), constant, start);
  }

  Value signed_power() {
    // Every nesting passes here.
    if (++depth_ > kDeepest) fail(position_, "nested too deeply");
    const std::size_t start = position_;
    Value result;
    if (accept("-")) {
      result = signed_power();
      result = checked(-result.e, result.constant ? std::optional(-*result.constant) : std::nullopt, start);
    } else if (accept("+")) {
      result = signed_power();
    } else {
      result = atom();
      if (accept("**") || accept("^")) result = power(result, signed_power(), start);
    }
    --depth_;
    return result;
  }

  Value power(const Value& base, const Value& exponent, std::size_t position) {
    std::optional<double> constant;
    if (base.constant && exponent.constant) {
      constant = std::pow(*base.constant, *exponent.constant);
      if (*base.constant == 0 && *exponent.constant <= 0) fail(position, "0 to the power of 0 or less");
      if (!std::isfinite(*constant)) fail(position, "the value is not a finite real number");
      if (*constant == 0 && *base.constant != 0) fail(position, "the value is too small for double");
    }
    if (!exponent.constant) {
      check_polynomial(base.e * exponent.e, "a power", position);
      if (symbols_.is_complex()) fail(position, "an exponent must be real");
      return checked(GiNaC::pow(base.e, exponent.e), constant, position);
    }
    if (base.e.is_zero() && *exponent.constant <= 0) fail(position, "0 to the power of 0 or less");
    // A constant exponent is a number for GiNaC, so that it knows the derivative: rational, or the double as it is.
    numeric n;
    if (GiNaC::is_exactly_a<numeric>(exponent.e)) {
      n = GiNaC::ex_to<numeric>(exponent.e);
    } else {
      int binary = 0;
      const double mantissa = std::frexp(*exponent.constant, &binary);
      n = numeric(static_cast<long>(std::ldexp(mantissa, 53))) * numeric(2).power(binary - 53);
    }
    if (!n.is_nonneg_integer()) check_polynomial(base.e, "a power that is no integer from 0 on", position);
    if (!n.is_integer()) {
      if (symbols_.is_complex() && !constant) fail(position, "a power of a complex number must be an integer");
      if (constant && symbols_.dialect() != Dialect::kFunctions) return {symbols_.constant(*constant), constant};
      if (constant && n != numeric(1, 2)) return checked(symbols_.constant(*constant), constant, position);
    } else {
      // GiNaC raises the numeric content of the base to the power exactly: keep it within the range of double.
      const numeric content = base.e.integer_content();
      const double bits = content.is_real() ? std::log2(nearest_double(content)) * *exponent.constant : 0;
      if (!base.e.is_zero() && !(std::abs(bits) < 1000)) fail(position, "the power leaves the range of double");
    }
    return checked(GiNaC::pow(base.e, n), constant, position);
  }

  Value atom() {
    const std::size_t start = position_;
    if (accept("(")) return parenthesis(start);
    if (start < text_.size() && (is_digit(text_[start]) || text_[start] == '.')) return number();
    if (start == text_.size() || !is_letter(text_[start])) {
      fail(start, "expected a number, a name or '(' instead of " + symbol_at(start));
    }
    while (position_ < text_.size() && (is_letter(text_[position_]) || is_digit(text_[position_]))) ++position_;
    const std::string_view name = text_.substr(start, position_ - start);
    skip_space();
    if (name == kPi) return {GiNaC::Pi, std::numbers::pi};
    if (symbols_.is_complex() && name == "i") return {GiNaC::I, std::nullopt};
    if (symbols_.is_complex() && std::find(kComplexNames.begin(), kComplexNames.end(), name) != kComplexNames.end()) {
      const Value z = argument_of(name);
      const ex conjugate = symbols_.conjugate(z.e);
      if (name == "conj") return checked(conjugate, z.constant, start);
      if (name == "abs2") {
        return checked(z.e * conjugate, z.constant ? std::optional(*z.constant * *z.constant) : std::nullopt, start);
      }
      if (name == "real") return checked((z.e + conjugate) / 2, z.constant, start);
      return checked((z.e - conjugate) / (2 * GiNaC::I), z.constant ? std::optional(0.0) : std::nullopt, start);
    }
    if (const NamedFunction* function = find_function(name)) {
      const Value argument = argument_of(name);
      check_polynomial(argument.e, "the function '" + std::string(name) + "'", start);
      if (symbols_.is_complex() && !argument.constant) {
        fail(start, "the function '" + std::string(name) + "' of a complex number");
      }
      const std::optional<double> constant =
          argument.constant ? std::optional(function->value(*argument.constant)) : std::nullopt;
      if (constant && !std::isfinite(*constant)) fail(start, "the value is not a finite real number");
      // A decimal: among the coefficients of a polynomial there are no functions.
      if (symbols_.dialect() != Dialect::kFunctions) return {symbols_.constant(*constant), constant};
      return checked(function->symbolic(argument.e), constant, start);
    }
    const auto names = symbols_.names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      std::string known;
      for (const std::string& other : names) known += other + " ";
      fail(start, "unknown name '" + std::string(name) + "'; " +
                      (names.empty() ? "a constant has no variables" : "the variables are " + known.substr(0, 200)));
    }
    return {symbols_.variable(static_cast<int>(found - names.begin())), std::nullopt};
  }

  Value argument_of(std::string_view function) {
    const std::size_t open = position_;
    if (!accept("(")) fail(open, "expected '(' after the function '" + std::string(function) + "'");
    return parenthesis(open);
  }

  void check_polynomial(const ex& e, const std::string& what, std::size_t position) const {
    if (symbols_.dialect() == Dialect::kFunctions || !symbols_.has_variables(e)) return;
    fail(position, what + " of variables is no polynomial");
  }

  Value parenthesis(std::size_t open) {
    Value result = sum();
    if (!accept(")")) {
      fail(position_,
           "expected ')' for the '(' at position " + std::to_string(open + 1) + " instead of " + symbol_at(position_));
    }
    return result;
  }

  Value number() {
    const std::size_t start = position_;
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + start, text_.data() + text_.size(), value);
    position_ = end - text_.data();
    if (error == std::errc::result_out_of_range) fail(start, "the number is beyond the range of double");
    if (error != std::errc()) fail(start, "not a number: " + symbol_at(start));
    if (position_ < text_.size() && (is_letter(text_[position_]) || text_[position_] == '.')) {
      fail(position_, "expected an operator after the number instead of " + symbol_at(position_));
    }
    const std::string literal(text_.substr(start, position_ - start));
    skip_space();
    if (std::all_of(literal.begin(), literal.end(), is_digit)) return {numeric(literal.c_str()), value};
    return {symbols_.constant(value), value};
  }

  static constexpr int kDeepest = 250;

  std::string_view text_;
  Symbols& symbols_;
  std::size_t position_ = 0;
  int depth_ = 0;
};

/// GiNaC expression -> nodes of a tape.
///
/// GiNaC orders terms and factors by hashes that change from run to run, and with the order the sign it pulls out of
/// (x - y)^3 changes. So terms and factors are sorted here by keys made of their structure, and in a factor the first
/// term of a sum gets a positive coefficient.
class Lowering {
 public:
  Lowering(const Symbols& symbols, TapeBuilder& builder) : symbols_(symbols), builder_(builder) {}

  struct Factor {
    std::string key;
    ex base, exponent;
  };
  struct Monomial {
    std::string key;  ///< of the factors
    numeric coefficient = 1;
    std::vector<Factor> factors{};
  };

  Node lower(const ex& e) {
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

  /// The factors of a product, in an order and with signs that do not change from run to run.
  Monomial monomial(const ex& e) {
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

 private:
  struct Sum {
    std::string key;
    numeric constant = 0;
    std::vector<Monomial> terms{};
  };

  static std::string text(const numeric& value) {
    std::ostringstream out;
    out << value;
    return out.str();
  }

  const Sum& sum(const ex& e) {
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

  void multiply(Monomial& product, const ex& e) {
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

  std::string key(const ex& e) {
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

  TapeBuilder::Term lower(const Monomial& monomial) {
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

  /// The factor or its inverse, and which of the two.
  std::pair<Node, bool> power(const Factor& f) {
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

  Node atom(const ex& e) {
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

  void add(const ex& e) {
    value_nodes_.push_back(lower_value_.lower(e));
    for (int i = 0; i < dim_; ++i) derivative_nodes_.push_back(lower_derivative_.lower(e.diff(symbols_.variable(i))));
  }
  CompiledMap build() const { return {values_.build(value_nodes_), derivatives_.build(derivative_nodes_)}; }

 private:
  const Symbols& symbols_;
  int dim_;
  TapeBuilder values_, derivatives_;
  Lowering lower_value_{symbols_, values_}, lower_derivative_{symbols_, derivatives_};
  std::vector<Node> value_nodes_, derivative_nodes_;
};

/// Calls `work`; what GiNaC or the tape says against it becomes a statement about the expression.
template <class Work>
auto on_expression(std::string_view text, Work work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    const std::string quoted = Parser::quoted(text);
    if (std::string_view(error.what()).starts_with(quoted)) throw;
    throw InvalidInput(quoted + ": " + error.what());
  }
}

class CompiledModel : public Function::Model {
 public:
  explicit CompiledModel(CompiledMap map) : map_(std::move(map)) {}
  int ambient_dim() const override { return map_.values.num_inputs(); }
  int codim() const override { return map_.values.num_outputs(); }
  void evaluate(std::span<const double> points, std::span<double> values) const override {
    map_.values.run_batch(points, values);
  }
  void jacobian(std::span<const double> point, std::span<double> jacobian, double) const override {
    map_.jacobian.run_batch(point, jacobian);
  }

 private:
  CompiledMap map_;
};

}  // namespace

void check_variables(std::span<const std::string> variables) {
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const std::string& name = variables[i];
    if (name.empty() || !is_letter(name[0]) ||
        !std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); })) {
      throw InvalidInput("variable '" + name + "': a name is made of letters, digits and _, and begins with no digit");
    }
    if (name == kPi || find_function(name)) throw InvalidInput("variable '" + name + "': the name is reserved");
    if (std::find(variables.begin(), variables.begin() + i, name) != variables.begin() + i) {
      throw InvalidInput("variable '" + name + "' is named twice");
    }
  }
}

CompiledMap compile(std::span<const std::string> variables, std::span<const std::string> expressions) {
  if (variables.empty()) throw InvalidInput("there are no variables");
  if (expressions.empty()) throw InvalidInput("there are no expressions");
  check_variables(variables);
  const std::lock_guard lock(ginac_mutex());
  Symbols symbols(variables);
  MapCompiler compiler(symbols);
  for (const std::string& text : expressions) {
    on_expression(text, [&] { compiler.add(Parser(text, symbols).parse().e); });
  }
  return compiler.build();
}

Function make_function(CompiledMap map) {
  const int d = map.values.num_inputs(), k = map.values.num_outputs();
  if (k < 1) throw InvalidInput("the map has no components");
  if (map.jacobian.num_inputs() != d || map.jacobian.num_outputs() != k * d) {
    throw InvalidInput("the Jacobian does not fit the map");
  }
  return Function(std::make_shared<CompiledModel>(std::move(map)));
}

Function parse_equations(std::span<const std::string> variables, std::span<const std::string> equations) {
  if (equations.size() > variables.size()) {
    throw InvalidInput(std::to_string(equations.size()) + " equations in " + std::to_string(variables.size()) +
                       " variables: there must not be more equations than variables");
  }
  return make_function(compile(variables, equations));
}

double parse_constant(std::string_view expression) {
  const std::lock_guard lock(ginac_mutex());
  return on_expression(expression, [&] {
    Symbols symbols({});
    return Parser(expression, symbols).parse().constant.value();
  });
}

// Homogeneous equations.

namespace {

using Exponents = std::vector<int>;  ///< of the variables of Symbols: those named, then their conjugates

/// The exponents of the monomials of a polynomial, sorted.
std::set<Exponents> monomials(const ex& polynomial, const Symbols& symbols) {
  const std::size_t count = symbols.names().size() * (symbols.is_complex() ? 2 : 1);
  const ex expanded = polynomial.expand();
  std::set<Exponents> result;
  const auto add = [&](const ex& term) {
    Exponents exponents;
    for (std::size_t i = 0; i < count; ++i) exponents.push_back(term.degree(symbols.variable(static_cast<int>(i))));
    result.insert(exponents);
  };
  if (GiNaC::is_exactly_a<GiNaC::add>(expanded)) {
    for (const ex& term : expanded) add(term);
  } else if (!expanded.is_zero()) {
    add(expanded);
  }
  return result;
}

std::string text(const Exponents& exponents, std::span<const std::string> names) {
  std::string result;
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    if (exponents[i] == 0) continue;
    const std::string& name = names[i % names.size()];
    result += (result.empty() ? "" : "*") + (i < names.size() ? name : "conj(" + name + ")");
    if (exponents[i] > 1) result += "^" + std::to_string(exponents[i]);
  }
  return result.empty() ? "1" : result;
}

/// Degree in the variables and degree in their conjugates.
std::pair<int, int> bidegree(const Exponents& exponents, std::size_t num_names) {
  std::pair<int, int> degree{0, 0};
  for (std::size_t i = 0; i < exponents.size(); ++i) (i < num_names ? degree.first : degree.second) += exponents[i];
  return degree;
}

void check_homogeneous(const ex& polynomial, const Symbols& symbols) {
  const auto names = symbols.names();
  const std::set<Exponents> all = monomials(polynomial, symbols);
  if (all.empty()) throw InvalidInput("it is 0 identically");
  const Exponents& first = *all.begin();
  const auto degree = bidegree(first, names.size());
  for (const Exponents& other : all) {
    const auto other_degree = bidegree(other, names.size());
    if (other_degree == degree) continue;
    const auto describe = [&](const Exponents& exponents, std::pair<int, int> its) {
      return text(exponents, names) + " has degree " + std::to_string(its.first) +
             (symbols.is_complex() ? " in the variables and " + std::to_string(its.second) + " in their conjugates"
                                   : "");
    };
    throw InvalidInput(std::string("it is not ") + (symbols.is_complex() ? "bihomogeneous: " : "homogeneous: ") +
                       describe(first, degree) + ", " + describe(other, other_degree) +
                       "; so its zeros are no set in projective space");
  }
  if (degree == std::pair(0, 0)) throw InvalidInput("it is constant");
}

/// A polynomial, taken apart into real and imaginary part in the coordinates of one chart. Nothing is expanded.
class ChartSubstitution {
 public:
  struct Complex {
    ex re, im;
  };

  ChartSubstitution(const Symbols& homogeneous, int chart, Symbols& coordinates)
      : homogeneous_(homogeneous), chart_(chart), coordinates_(coordinates) {}

  const Complex& operator()(const ex& e) {
    const auto found = done_.find(e);
    if (found != done_.end()) return found->second;
    Complex result = substitute(e);
    return done_[e] = std::move(result);
  }

 private:
  static Complex product(const Complex& a, const Complex& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }

  static Complex power(Complex base, int n) {
    if (base.im.is_zero()) return {GiNaC::pow(base.re, n), 0};
    if (n < 0) {  // of a constant
      const ex squared = GiNaC::pow(base.re, 2) + GiNaC::pow(base.im, 2);
      base = {base.re / squared, -base.im / squared};
      n = -n;
    }
    Complex result{1, 0};
    for (; n > 0; n /= 2) {
      if (n % 2 == 1) result = product(result, base);
      if (n > 1) base = {GiNaC::pow(base.re, 2) - GiNaC::pow(base.im, 2), 2 * base.re * base.im};
    }
    return result;
  }

  Complex substitute(const ex& e) {
    if (GiNaC::is_exactly_a<numeric>(e)) {
      const numeric& value = GiNaC::ex_to<numeric>(e);
      return {value.real(), value.imag()};
    }
    if (GiNaC::is_exactly_a<GiNaC::constant>(e)) return {e, 0};
    if (GiNaC::is_a<GiNaC::symbol>(e)) return symbol(e);
    if (GiNaC::is_exactly_a<GiNaC::add>(e)) {
      exvector re, im;
      for (const ex& term : e) {
        const Complex& part = (*this)(term);
        re.push_back(part.re);
        im.push_back(part.im);
      }
      return {GiNaC::add(re), GiNaC::add(im)};
    }
    if (GiNaC::is_exactly_a<GiNaC::mul>(e) || GiNaC::is_exactly_a<GiNaC::power>(e)) {
      const Lowering::Monomial monomial = order_.monomial(e);
      Complex result{monomial.coefficient.real(), monomial.coefficient.imag()};
      for (const Lowering::Factor& factor : monomial.factors) {
        if (!factor.exponent.info(GiNaC::info_flags::integer)) throw InvalidInput("it is no polynomial");
        result = product(result, power((*this)(factor.base), GiNaC::ex_to<numeric>(factor.exponent).to_int()));
      }
      return result;
    }
    throw InvalidInput("it is no polynomial");
  }

  Complex symbol(const ex& e) {
    const std::optional<int> index = homogeneous_.variable_index(e);
    if (!index) return {coordinates_.constant(homogeneous_.constant_value(e)), 0};
    const int count = static_cast<int>(homogeneous_.names().size()), variable = *index % count;
    if (variable == chart_) return {1, 0};
    const int place = variable - (variable > chart_);
    if (!homogeneous_.is_complex()) return {coordinates_.variable(place), 0};
    const ex y = coordinates_.variable(2 * place + 1);
    return {coordinates_.variable(2 * place), *index < count ? y : ex(-y)};
  }

  const Symbols& homogeneous_;
  int chart_;
  Symbols& coordinates_;
  TapeBuilder unused_{0};
  Lowering order_{homogeneous_, unused_};
  std::map<ex, Complex, GiNaC::ex_is_less> done_;
};

}  // namespace

std::vector<CompiledMap> compile_affine_charts(std::span<const std::string> variables,
                                               std::span<const std::string> equations, Field field) {
  const bool complex = field == Field::kComplex;
  if (variables.size() < 2) throw InvalidInput("projective space needs at least two variables");
  if (equations.empty()) throw InvalidInput("there are no equations");
  check_variables(variables);
  for (const std::string& name : variables) {
    if (complex && std::find(kComplexNames.begin(), kComplexNames.end(), name) != kComplexNames.end()) {
      throw InvalidInput("variable '" + name + "': the name is reserved in complex equations");
    }
  }
  const std::lock_guard lock(ginac_mutex());
  Symbols homogeneous(variables, complex ? Dialect::kComplexPolynomials : Dialect::kPolynomials);
  struct Equation {
    ex polynomial;
    bool has_re = true, has_im = false;
  };
  std::vector<Equation> parsed;
  const std::size_t d = (variables.size() - 1) * (complex ? 2 : 1);
  std::size_t k = 0;
  for (const std::string& equation : equations) {
    on_expression(equation, [&] {
      Equation result{Parser(equation, homogeneous).parse().e};
      check_homogeneous(result.polynomial, homogeneous);
      if (complex) {
        const ex conjugate = homogeneous.conjugate(result.polynomial);
        result.has_re = !(result.polynomial + conjugate).expand().is_zero();
        result.has_im = !(result.polynomial - conjugate).expand().is_zero();
      }
      k += result.has_re + result.has_im;
      parsed.push_back(result);
    });
  }
  if (k > d) {
    throw InvalidInput(std::to_string(k) + " real equations in projective space of real dimension " +
                       std::to_string(d) + ": there must not be more");
  }
  std::vector<CompiledMap> charts;
  const std::vector<std::string> unnamed(d);
  for (std::size_t c = 0; c < variables.size(); ++c) {
    Symbols coordinates(unnamed);
    ChartSubstitution substitute(homogeneous, static_cast<int>(c), coordinates);
    MapCompiler compiler(coordinates);
    for (std::size_t e = 0; e < parsed.size(); ++e) {
      on_expression(equations[e], [&] {
        const auto parts = substitute(parsed[e].polynomial);
        if (parsed[e].has_re) compiler.add(parts.re);
        if (parsed[e].has_im) compiler.add(parts.im);
      });
    }
    charts.push_back(compiler.build());
  }
  return charts;
}

}  // namespace whitney
