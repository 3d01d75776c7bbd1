// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <whitney/io/formats/mesh_builder.h>

namespace whitney::io {

/// Words and numbers of a text, with the number of the line for messages.
class TextReader {
 public:
  /// From `comment` to the end of a line is not read.
  TextReader(std::string path, std::string_view text, std::size_t first_line = 1, char comment = '#')
      : path_(std::move(path)), rest_(text), line_number_(first_line - 1), comment_(comment) {}

  /// Goes to the next line that is not blank; false at the end.
  bool next_line();
  /// The next word of the current line; empty if there is none.
  std::string_view word();
  /// The next word, on this line or a later one; the end of the file is an error that says `what` is missing.
  std::string_view word_anywhere(const char* what);

  double number(std::string_view word) const;        ///< any double; error if it is not one
  std::uint64_t count(std::string_view word) const;  ///< error if it is not a number >= 0
  std::int64_t integer(std::string_view word) const;

  std::size_t line_number() const { return line_number_; }
  /// What has not been read of the text after this line.
  std::string_view rest() const { return rest_; }

  [[noreturn]] void fail(const std::string& reason) const { fail_reading(path_, line_number_, reason); }
  /// Fails if there is a reason.
  void check(const std::string& reason) const {
    if (!reason.empty()) fail(reason);
  }
  void check(const char* reason) const {
    if (reason != nullptr) fail(reason);
  }

 private:
  std::string path_;
  std::string_view rest_;
  std::string_view line_{};
  std::size_t line_number_;
  char comment_;
};

}  // namespace whitney::io
