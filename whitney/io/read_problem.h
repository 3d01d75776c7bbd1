// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include <whitney/problem/problem.h>

namespace whitney {

/// Reads a problem file: JSON with // comments. A number may be written as a constant expression, "2*pi".
/// A named manifold with equations brings its box, which "box" overrides.
/// Throws FileError when the file cannot be read, InvalidInput (file, key, reason) on everything else: text that is no
/// JSON, unknown, repeated or missing keys, wrong sizes, lower >= upper, and expressions that are not understood.
Problem read_problem(const std::string& path);

/// The same from text; `name` stands for the file in messages.
Problem parse_problem(std::string_view text, const std::string& name);

}  // namespace whitney
