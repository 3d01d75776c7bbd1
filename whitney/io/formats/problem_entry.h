// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <coxeter/base/error.h>
#include <whitney/functions/expression.h>
#include <whitney/functions/function.h>

// What problem files are read with; not installed.

namespace whitney::io {

/// A value inside the file, and the way to it, for messages.
class Entry {
 public:
  Entry(const nlohmann::json& json, std::string file, std::string path)
      : json_(json), file_(std::move(file)), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& reason) const {
    throw InvalidInput(file_ + ": " + (path_.empty() ? "" : path_ + ": ") + reason);
  }

  /// Calls `work`; its InvalidInput gets file and key.
  template <class Work>
  auto located(Work work) const {
    try {
      return work();
    } catch (const InvalidInput& error) {
      fail(error.what());
    }
  }

  void expect_keys(std::initializer_list<const char*> known) const {
    if (!json_.is_object()) fail("expected an object {..}");
    for (const auto& [key, value] : json_.items()) {
      if (std::find_if(known.begin(), known.end(), [&k = key](const char* name) { return k == name; }) != known.end()) {
        continue;
      }
      std::string list;
      for (const char* name : known) list += (list.empty() ? "" : ", ") + std::string(name);
      fail("unknown key \"" + key + "\"; known here are " + list);
    }
  }

  bool has(const char* key) const { return json_.contains(key); }
  Entry at(const char* key) const {
    if (!has(key)) fail("the key \"" + std::string(key) + "\" is missing");
    return {json_.at(key), file_, path_.empty() ? key : path_ + "." + key};
  }
  /// The elements of a list that is not empty; size 0: any.
  std::vector<Entry> list(std::size_t size = 0) const {
    if (!json_.is_array()) fail("expected a list [..]");
    if (json_.empty()) fail("the list is empty");
    if (size != 0 && json_.size() != size) {
      fail("expected " + std::to_string(size) + " elements, not " + std::to_string(json_.size()));
    }
    std::vector<Entry> elements;
    for (std::size_t i = 0; i < json_.size(); ++i) {
      elements.emplace_back(json_[i], file_, path_ + "[" + std::to_string(i) + "]");
    }
    return elements;
  }
  std::vector<std::string> object_keys() const {
    if (!json_.is_object()) fail("expected an object {..}");
    std::vector<std::string> keys;
    for (const auto& [key, value] : json_.items()) keys.push_back(key);
    return keys;
  }

  bool is_list() const { return json_.is_array(); }
  std::string string() const {
    if (!json_.is_string()) fail("expected a text \"..\"");
    return json_.get<std::string>();
  }
  /// A number, or a constant expression.
  double number() const {
    if (json_.is_string()) return located([&] { return parse_constant(json_.get<std::string>()); });
    if (!json_.is_number()) fail("expected a number or a constant expression");
    return json_.get<double>();
  }
  double positive_number() const {
    const double value = number();
    if (!(value > 0)) fail("must be positive");
    return value;
  }
  std::vector<std::string> strings(std::size_t size = 0) const {
    std::vector<std::string> values;
    for (const Entry& element : list(size)) values.push_back(element.string());
    return values;
  }
  std::vector<double> numbers(std::size_t size) const {
    std::vector<double> values;
    for (const Entry& element : list(size)) values.push_back(element.number());
    return values;
  }
  std::uint64_t count() const {
    if (!json_.is_number_unsigned()) fail("expected an integer from 0 to 2^64 - 1");
    return json_.get<std::uint64_t>();
  }
  /// One of some words.
  template <class Value>
  Value choice(std::initializer_list<std::pair<const char*, Value>> choices) const {
    const std::string word = string();
    std::string list;
    for (const auto& [name, value] : choices) {
      if (word == name) return value;
      list += (list.empty() ? "" : ", ") + std::string(name);
    }
    fail("unknown word \"" + word + "\"; known here are " + list);
  }

 private:
  const nlohmann::json& json_;
  std::string file_, path_;
};

/// JSON, in which nlohmann would let the last of two equal keys win in silence. Throws InvalidInput.
nlohmann::json parse_json(std::string_view text, const std::string& file);

/// (lower, upper), in this order and with a finite width.
std::array<double, 2> read_side(const Entry& side);

/// A list of expressions of the variables; `make` makes the function of the texts, and throws InvalidInput.
template <class Make>
Function read_map(const std::vector<std::string>& variables, const Entry& entry, Make make) {
  const std::vector<std::string> texts = entry.strings();
  try {
    return make(texts);
  } catch (const InvalidInput& error) {
    // Which one was it?
    const std::vector<Entry> elements = entry.list();
    for (std::size_t i = 0; i < elements.size(); ++i) {
      elements[i].located([&] { compile(variables, std::span(texts).subspan(i, 1)); });
    }
    entry.fail(error.what());
  }
}

/// f of a list of equations, lhs = rhs or lhs.
Function read_equations(const std::vector<std::string>& variables, const Entry& entry);

/// Any number of expressions, each >= 0.
Function read_inequalities(const std::vector<std::string>& variables, const Entry& entry);

}  // namespace whitney::io
