// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/homogeneous_equations.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <ginac/ginac.h>

#include <coxeter/base/error.h>
#include <whitney/functions/expression_lowering.h>
#include <whitney/functions/expression_parser.h>
#include <whitney/functions/tape_builder.h>

namespace whitney {
namespace {

using namespace symbolic;
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
      Equation result{parse(equation, homogeneous).e};
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
