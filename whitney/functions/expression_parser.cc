// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/expression_parser.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include <coxeter/base/error.h>

namespace whitney::symbolic {
namespace {

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
/// Text -> GiNaC expression, by recursive descent.
class Parser {
 public:
  using Value = ParsedExpression;

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

}  // namespace

std::mutex& ginac_mutex() {
  static std::mutex mutex;
  return mutex;
}

const NamedFunction* find_function(std::string_view name) {
  for (const NamedFunction& function : kFunctions) {
    if (name == function.name) return &function;
  }
  return nullptr;
}

double nearest_double(const numeric& value) {
  if (!value.is_real()) throw InvalidInput("it is complex");
  const numeric bound = numeric(1L << 53), num = value.numer(), den = value.denom();
  if (GiNaC::abs(num) <= bound && den <= bound) return double(num.to_long()) / double(den.to_long());
  return value.to_double();
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 200;
  return "\"" + std::string(text.substr(0, kLongest)) + (text.size() > kLongest ? "...\"" : "\"");
}

ParsedExpression parse(std::string_view text, Symbols& symbols) { return Parser(text, symbols).parse(); }

}  // namespace whitney::symbolic
