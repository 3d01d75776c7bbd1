// SPDX-License-Identifier: GPL-3.0-or-later
#include "source_text.h"

#include <algorithm>
#include <cctype>
#include <regex>

namespace whitney::architecture {

std::string without_comments(const std::string& text) {
  std::string code;
  code.reserve(text.size());
  const auto at = [&text](std::size_t i) { return i < text.size() ? text[i] : '\0'; };
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '/' && at(i + 1) == '/') {
      while (i < text.size() && text[i] != '\n') ++i;
    } else if (c == '/' && at(i + 1) == '*') {
      for (i += 2; i < text.size() && !(text[i] == '*' && at(i + 1) == '/'); ++i) code += text[i] == '\n' ? '\n' : ' ';
      i += 2;
    } else if (c == 'R' && at(i + 1) == '"') {
      const std::size_t open = text.find('(', i);
      if (open == std::string::npos) return code;
      std::string close(1, ')');
      close.append(text, i + 2, open - i - 2).append(1, '"');
      const std::size_t end = std::min(text.find(close, open), text.size() - close.size()) + close.size();
      code.append(text, i, end - i);
      i = end;
    } else if (c == '"' || (c == '\'' && !(i > 0 && std::isalnum(static_cast<unsigned char>(text[i - 1]))))) {
      code += text[i++];
      while (i < text.size() && text[i] != c && text[i] != '\n') {
        if (text[i] == '\\' && at(i + 1) != '\n') code += text[i++];
        if (i < text.size()) code += text[i++];
      }
      if (at(i) == c) code += text[i++];
    } else {
      code += text[i++];
    }
  }
  return code;
}

namespace {

/// A literal keeps its quotes and its length; preprocessor lines become blank.
std::string without_literals_and_directives(const std::string& text) {
  std::string code = without_comments(text);
  bool line_start = true;
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (line_start && code[i] == '#') {
      for (; i < code.size() && (code[i] != '\n' || code[i - 1] == '\\'); ++i) {
        if (code[i] != '\n') code[i] = ' ';
      }
    } else if (code[i] == 'R' && i + 1 < code.size() && code[i + 1] == '"') {
      const std::size_t open = std::min(code.find('(', i), code.size() - 1);
      const std::string close = ")" + code.substr(i + 2, open - i - 2) + '"';
      const std::size_t end = std::min(code.find(close, open), code.size());
      for (std::size_t j = i; j < end; ++j) {
        if (code[j] != '\n') code[j] = ' ';
      }
      i = std::min(end + close.size() - 1, code.size() - 1);
    } else if (code[i] == '"' ||
               (code[i] == '\'' && !(i > 0 && std::isalnum(static_cast<unsigned char>(code[i - 1]))))) {
      const char quote = code[i];
      for (++i; i < code.size() && code[i] != quote && code[i] != '\n'; ++i) {
        if (code[i] == '\\') code[i++] = ' ';
        if (i < code.size()) code[i] = ' ';
      }
    }
    if (i < code.size())
      line_start = code[i] == '\n' || (line_start && std::isspace(static_cast<unsigned char>(code[i])));
  }
  return code;
}

/// What stands before a brace at the outer level: the start of a namespace or class, of a function, or neither.
enum class Head { kScope, kFunction, kOther };

Head kind_of(const std::string& head) {
  static const std::regex kScope(R"(^\s*(inline\s+)?namespace\b|^\s*extern\s*"\s*"\s*$)");
  static const std::regex kClass(
      R"(\b(class|struct|union|enum)\s+(\[\[|alignas|[A-Za-z_]|:|$)|\b(struct|union|enum)\s*$)");
  static const std::regex kRequires(R"(\brequires\b)");
  if (std::regex_search(head, kScope)) return Head::kScope;
  const std::size_t parenthesis = head.find('(');
  if (parenthesis != std::string::npos) {
    std::smatch match;
    // "struct alignas(64) Row {" opens a class; "struct Row f(int) {" a function.
    static const std::regex kAligned(R"(\b(class|struct|union)\s+alignas\s*\([^)]*\)[^()]*$)");
    if (std::regex_search(head, kAligned)) return Head::kScope;
    return Head::kFunction;
  }
  return std::regex_search(head, kClass) ? Head::kScope : Head::kOther;
}

/// The name before the first parenthesis, or "operator".
std::string name_of(const std::string& head) {
  static const std::regex kName(R"(([A-Za-z_~][A-Za-z0-9_]*)\s*(<[^<>()]*>)?\s*\()");
  static const std::regex kTest(R"(\b(TEST|TEST_F|TEST_P)\s*\(\s*(\w+)\s*,\s*(\w+))");
  std::smatch match;
  if (head.find("operator") != std::string::npos) return "operator";
  if (std::regex_search(head, match, kTest)) return match[2].str() + "." + match[3].str();
  return std::regex_search(head, match, kName) ? match[1].str() : "?";
}

}  // namespace

std::vector<Function> functions_of(const std::string& text) {
  const std::string code = without_literals_and_directives(text);
  static const std::regex kAccess(R"(^\s*(public|protected|private)\s*$)");
  std::vector<Function> functions;
  std::string head;
  std::size_t line = 1, head_line = 0;
  std::size_t depth = 0;  // braces open inside a function or an initializer
  bool in_function = false;
  const auto clear_head = [&] {
    head.clear();
    head_line = 0;
  };
  for (std::size_t i = 0; i < code.size(); ++i) {
    const char c = code[i];
    if (c == '\n') ++line;
    if (depth > 0) {
      if (c == '{') ++depth;
      if (c != '}' || --depth > 0) continue;
      const std::size_t next = code.find_first_not_of(" \n", i + 1);
      if (in_function && next != std::string::npos && (code[next] == '{' || code[next] == ',')) continue;
      if (in_function) functions.push_back({name_of(head), head_line, line - head_line + 1});
      clear_head();
    } else if (c == '{') {
      const Head kind = kind_of(head);
      in_function = kind == Head::kFunction;
      if (kind == Head::kScope) {
        clear_head();
      } else {
        depth = 1;
      }
    } else if (c == ';' || c == '}' || (c == ':' && std::regex_match(head, kAccess))) {
      clear_head();
    } else {
      if (head_line == 0 && !std::isspace(static_cast<unsigned char>(c))) head_line = line;
      head += c;
    }
  }
  return functions;
}

}  // namespace whitney::architecture
