// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <ginac/ginac.h>

#include <whitney/functions/tape.h>

// Internal: text -> GiNaC. Only expression*.cc and homogeneous_equations.cc include this header and GiNaC with it.

namespace whitney::symbolic {

using GiNaC::ex;
using GiNaC::exvector;
using GiNaC::numeric;

/// Guards every GiNaC object: their reference counts and tables are shared and not atomic. Whoever calls anything of
/// this namespace holds it.
std::mutex& ginac_mutex();

/// A function of one argument: its name in a text and in GiNaC, and its three meanings.
struct NamedFunction {
  const char* name;
  TapeOp op;
  double (*value)(double);
  ex (*symbolic)(const ex&);
};

/// Null when the name is none of a function.
const NamedFunction* find_function(std::string_view name);

inline constexpr std::string_view kPi = "pi";

/// Locale-free, unlike <cctype>.
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// The nearest double of a rational number.
double nearest_double(const numeric& value);

/// What a text may say.
enum class Dialect {
  kFunctions,           ///< everything that expression.h lists, over R
  kPolynomials,         ///< polynomials over R: functions, quotients and other powers of constants only
  kComplexPolynomials,  ///< polynomials over C in the variables and their conjugates: i, conj, real, imag, abs2
};

/// The names that kComplexPolynomials adds.
inline constexpr std::array<std::string_view, 5> kComplexNames{"i", "conj", "real", "imag", "abs2"};

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

/// `constant` is the value when the expression has no variables.
struct ParsedExpression {
  ex e;
  std::optional<double> constant;
};

/// The expression of a text, by recursive descent. Throws InvalidInput that quotes the text, the position and the
/// symbol that was not understood.
ParsedExpression parse(std::string_view text, Symbols& symbols);

/// The text, or its beginning, in quotation marks: how the messages of parse() begin.
std::string quoted(std::string_view text);

}  // namespace whitney::symbolic
