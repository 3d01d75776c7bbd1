// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <whitney/functions/function.h>
#include <whitney/functions/tape.h>

namespace whitney {

// Expressions in text. A number is decimal or scientific (0.1, 1e-12) and means the nearest double, as in C++; integers
// and their quotients (2/3) are exact until they meet a double. Operators + - * / and ^ (or **), which binds closest
// and to the right: -x^2 is -(x^2). Functions sqrt sin cos tan asin acos atan sinh cosh tanh exp log abs, the constant
// pi; these names cannot be variables. Names are letters, digits and _, and do not begin with a digit. No
// multiplication without a sign.
//
// Everything is real: sqrt(-1), (-8)^(1/3), log(0), 1/0 among constants are errors, as is a constant that is beyond the
// range of double. Among variables they become NaN or infinite where the map is evaluated. Factors and powers stay as
// written: nothing is expanded, but what cancels is cancelled (x/x is 1, exp(log(x)) is x, on all of R). The same text
// always gives the same tape, bit for bit.
//
// Every function here throws InvalidInput; the message quotes the expression, and the position and symbol that were not
// understood. They lock: GiNaC, which simplifies and differentiates, is not safe for threads. A caller who uses GiNaC
// himself must not do so at the same time.

/// A map R^d -> R^k and its derivatives as programs.
struct CompiledMap {
  Tape values;    ///< R^d -> R^k
  Tape jacobian;  ///< R^d -> R^(k d), row-major
};

/// The map x -> (expressions) of the named coordinates x. At least one variable and one expression.
CompiledMap compile(std::span<const std::string> variables, std::span<const std::string> expressions);

/// The Function of the equations `expression = 0`, with exact derivatives. 1 <= k <= d.
Function parse_equations(std::span<const std::string> variables, std::span<const std::string> equations);

/// The Function of a compiled map, k >= 1. Throws InvalidInput when the tapes do not fit together.
Function make_function(CompiledMap map);

/// The value of an expression without variables: "2*pi".
double parse_constant(std::string_view expression);

/// Throws InvalidInput unless the names can serve as variables: well-formed, not reserved, all different.
void check_variables(std::span<const std::string> variables);

}  // namespace whitney
