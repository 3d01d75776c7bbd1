// SPDX-License-Identifier: GPL-3.0-or-later
// Text -> Enclosure. The grammar of expression.h once more, without GiNaC: nothing is simplified, nothing rounded.
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <coxeter/base/error.h>
#include <whitney/functions/enclosure.h>

namespace whitney {
namespace {

using Node = EnclosureBuilder::Node;

constexpr std::array<std::pair<std::string_view, TapeOp>, 13> kFunctions{{{"sqrt", TapeOp::kSqrt},
                                                                          {"sin", TapeOp::kSin},
                                                                          {"cos", TapeOp::kCos},
                                                                          {"tan", TapeOp::kTan},
                                                                          {"asin", TapeOp::kAsin},
                                                                          {"acos", TapeOp::kAcos},
                                                                          {"atan", TapeOp::kAtan},
                                                                          {"sinh", TapeOp::kSinh},
                                                                          {"cosh", TapeOp::kCosh},
                                                                          {"tanh", TapeOp::kTanh},
                                                                          {"exp", TapeOp::kExp},
                                                                          {"log", TapeOp::kLog},
                                                                          {"abs", TapeOp::kAbs}}};
constexpr int kDeepest = 500;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// Whether a decimal number without exponent is seen to be the double itself: 0.5, 2.0.
bool is_exact(std::string_view digits, double value) {
  double whole = 0, power = 1;
  bool is_fraction = false;
  if (digits.size() > 15) return false;
  for (const char c : digits) {
    if (c == '.') {
      is_fraction = true;
    } else if (!is_digit(c)) {
      return false;
    } else {
      whole = 10 * whole + (c - '0');
      if (is_fraction) power *= 10;
    }
  }
  return std::fma(value, power, -whole) == 0;  // whole and power are below 2^53
}

class Parser {
 public:
  Parser(std::string_view text, std::span<const std::string> variables, EnclosureBuilder& builder)
      : text_(text), variables_(variables), builder_(builder) {}

  Node parse() {
    skip_space();
    const Node result = sum();
    if (position_ != text_.size()) fail("expected an operator");
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw InvalidInput("\"" + std::string(text_) + "\", position " + std::to_string(position_ + 1) + ": " + reason);
  }
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

  Node sum() {
    Node result = product();
    for (;;) {
      if (accept("+")) {
        result = builder_.add(result, product());
      } else if (accept("-")) {
        result = builder_.subtract(result, product());
      } else {
        return result;
      }
    }
  }

  Node product() {
    Node result = signed_power();
    for (;;) {
      if (accept("*")) {
        result = builder_.product(result, signed_power());
      } else if (accept("/")) {
        const Node divisor = signed_power();
        result = builder_.quotient(result, divisor);
      } else {
        return result;
      }
    }
  }

  Node signed_power() {
    if (++depth_ > kDeepest) fail("nested too deeply");
    Node result = 0;
    if (accept("-")) {
      result = builder_.product(builder_.constant(Range(-1)), signed_power());
    } else if (accept("+")) {
      result = signed_power();
    } else {
      result = atom();
      if (accept("**") || accept("^")) result = builder_.pow(result, signed_power());
    }
    --depth_;
    return result;
  }

  Node atom() {
    if (accept("(")) return close();
    if (position_ < text_.size() && (is_digit(text_[position_]) || text_[position_] == '.')) return number();
    const std::size_t start = position_;
    while (position_ < text_.size() && (is_letter(text_[position_]) || is_digit(text_[position_]))) ++position_;
    const std::string_view name = text_.substr(start, position_ - start);
    if (name.empty()) fail("expected a number, a name or '('");
    skip_space();
    if (name == "pi") return builder_.constant(pi_range());
    for (const auto& [function, op] : kFunctions) {
      if (name != function) continue;
      if (!accept("(")) fail("expected '('");
      return builder_.function(op, close());
    }
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      if (name == variables_[i]) return builder_.input(static_cast<int>(i));
    }
    position_ = start;
    fail("unknown name '" + std::string(name) + "'");
  }

  Node close() {
    const Node result = sum();
    if (!accept(")")) fail("expected ')'");
    return result;
  }

  Node number() {
    double value = 0;
    const char* const begin = text_.data() + position_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) fail("not a number in the range of double");
    const bool is_whole = std::string_view(begin, end).find_first_not_of("0123456789") == std::string_view::npos;
    position_ += end - begin;
    skip_space();
    if (is_whole && value < 0x1p53) return builder_.constant(Range(value));
    if (is_exact(std::string_view(begin, end), value)) return builder_.constant(Range(value));
    return builder_.constant({outward::down(value), outward::up(value)});
  }

  std::string_view text_;
  std::span<const std::string> variables_;
  EnclosureBuilder& builder_;
  std::size_t position_ = 0;
  int depth_ = 0;
};

}  // namespace

Enclosure Enclosure::of_expressions(std::span<const std::string> variables, std::span<const std::string> expressions) {
  EnclosureBuilder builder(static_cast<int>(variables.size()));
  std::vector<EnclosureBuilder::Node> outputs;
  for (const std::string& expression : expressions) outputs.push_back(Parser(expression, variables, builder).parse());
  return builder.build(outputs, true);
}

}  // namespace whitney
