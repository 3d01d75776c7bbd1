// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace whitney::architecture {

/// The text without its comments: blanks in their place, line breaks kept.
std::string without_comments(const std::string& text);

struct Function {
  std::string name;
  std::size_t line;   ///< of the first word of its head
  std::size_t lines;  ///< from there to the brace that closes it
};

/// The functions defined in a file, by their braces: members too, lambdas and local classes not, for they are part of
/// the function around them. What #if leaves out counts too.
std::vector<Function> functions_of(const std::string& text);

}  // namespace whitney::architecture
