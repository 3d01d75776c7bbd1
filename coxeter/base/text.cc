// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/text.h>

#include <charconv>
#include <cstddef>

namespace whitney {

std::string text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string text(double value, int digits) {
  char buffer[64];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr};
}

std::string text(std::span<const double> point) {
  std::string result = "(";
  for (std::size_t c = 0; c < point.size(); ++c) result += (c == 0 ? "" : ", ") + text(point[c]);
  return result + ")";
}

}  // namespace whitney
