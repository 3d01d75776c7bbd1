// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

namespace whitney {

/// The shortest decimal text that reads back as the same double: "0.1", "1e-300", "inf", "nan". Independent of the
/// locale.
std::string text(double value);

/// Rounded to so many significant digits, where a reader needs no more: "0.3142".
std::string text(double value, int digits);

/// A point in messages, "(0.1, -2, 3e10)", with all its digits: two points that differ read differently, and a point
/// from a message can be put into a problem file.
std::string text(std::span<const double> point);

}  // namespace whitney
