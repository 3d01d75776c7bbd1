// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include <whitney/functions/expression.h>

namespace whitney {

/// The numbers that projective space is over.
enum class Field { kReal, kComplex };

/// The real equations of a set in the projective space of the variables z_0 .. z_N, one map for each affine chart
/// z_c = 1, all R^d -> R^k. Over R, d = N, the coordinates of chart c are the other variables in order. Over C,
/// d = 2N, each other variable gives two, its real and its imaginary part.
///
/// The text is that of expression.h, restricted to polynomials (constants may still use every function). Over C there
/// are, besides, the imaginary unit `i` and, of expressions, conj(z), real(z) = (z + conj(z))/2,
/// imag(z) = (z - conj(z))/(2i) and abs2(z) = z conj(z); these names cannot be variables then. An equation over C gives
/// its real and its imaginary part, or only one of them where the other vanishes identically:
/// "z1*conj(z1) - z2*conj(z2)" is one real equation.
///
/// The zero set is well defined in projective space when the monomials of an equation have the same degree in the
/// variables and, over C, the same degree in their conjugates (it is bihomogeneous).
///
/// Throws InvalidInput on less than two variables, no equations, text that is not understood, an equation that is not
/// (bi)homogeneous (naming two monomials that differ), constant, or 0 identically, and when k > d.
std::vector<CompiledMap> compile_affine_charts(std::span<const std::string> variables,
                                               std::span<const std::string> equations, Field field);

}  // namespace whitney
