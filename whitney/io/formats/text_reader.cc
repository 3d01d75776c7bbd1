// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/formats/text_reader.h>

#include <charconv>
#include <cstdlib>

namespace whitney::io {

namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

std::string quoted(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  return "\"" + std::string(word.substr(0, kLongest)) + (word.size() > kLongest ? "...\"" : "\"");
}

template <class T>
T parse(const TextReader& reader, std::string_view word, const char* kind) {
  std::string_view digits = word;
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') digits.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (end != digits.data() + digits.size() || error == std::errc::invalid_argument || digits.empty()) {
    reader.fail("expected " + std::string(kind) + ", found " + quoted(word));
  }
  if (error == std::errc::result_out_of_range) {
    // Only the smallest doubles underflow in good faith; strtod gives what the number rounds to.
    if constexpr (std::is_floating_point_v<T>) return std::strtod(std::string(digits).c_str(), nullptr);
    reader.fail("the number " + quoted(word) + " is too large");
  }
  return value;
}

}  // namespace

bool TextReader::next_line() {
  while (!rest_.empty()) {
    const auto end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_number_;
    line_ = line_.substr(0, line_.find(comment_));
    const auto first = line_.find_first_not_of(kBlanks);
    if (first != std::string_view::npos) {
      line_.remove_prefix(first);
      return true;
    }
  }
  line_ = {};
  return false;
}

std::string_view TextReader::word() {
  const auto first = line_.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  line_.remove_prefix(first);
  const std::string_view result = line_.substr(0, line_.find_first_of(kBlanks));
  line_.remove_prefix(result.size());
  return result;
}

std::string_view TextReader::word_anywhere(const char* what) {
  for (;;) {
    const std::string_view found = word();
    if (!found.empty()) return found;
    if (!next_line()) fail(std::string("the file ends where ") + what + " should be");
  }
}

double TextReader::number(std::string_view word) const { return parse<double>(*this, word, "a number"); }
std::uint64_t TextReader::count(std::string_view word) const {
  return parse<std::uint64_t>(*this, word, "a number >= 0");
}
std::int64_t TextReader::integer(std::string_view word) const { return parse<std::int64_t>(*this, word, "an integer"); }

}  // namespace whitney::io
