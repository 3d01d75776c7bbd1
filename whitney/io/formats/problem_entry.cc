// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/formats/problem_entry.h>

#include <cmath>
#include <set>

namespace whitney::io {

using Json = nlohmann::json;

Json parse_json(std::string_view text, const std::string& file) {
  std::vector<std::set<std::string>> keys;
  const auto check_key = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second) {
      throw InvalidInput(file + ": the key " + parsed.dump() + " is given twice");
    }
    return true;
  };
  try {
    return Json::parse(text, check_key, true, true);
  } catch (const Json::exception& error) {
    throw InvalidInput(file + ": " + error.what());
  }
}

std::array<double, 2> read_side(const Entry& side) {
  const std::vector<double> bounds = side.numbers(2);
  if (!(bounds[0] < bounds[1])) side.fail("the lower bound must be less than the upper one");
  if (!std::isfinite(bounds[1] - bounds[0])) side.fail("the width is beyond the range of double");
  return {bounds[0], bounds[1]};
}

Function read_equations(const std::vector<std::string>& variables, const Entry& entry) {
  return read_map(variables, entry, [&](const auto& texts) { return parse_equations(variables, texts); });
}

Function read_inequalities(const std::vector<std::string>& variables, const Entry& entry) {
  return read_map(variables, entry, [&](const auto& texts) { return make_function(compile(variables, texts)); });
}

}  // namespace whitney::io
