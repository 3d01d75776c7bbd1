// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/read_problem.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

#include <coxeter/base/error.h>
#include <coxeter/placement.h>
#include <whitney/atlas/projective_charts.h>
#include <whitney/functions/expression.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/manifolds/catalogue.h>
#include <whitney/manifolds/implicit_manifold.h>
#include <whitney/manifolds/parametric_manifold.h>

namespace whitney {
namespace {

using Json = nlohmann::json;

/// A value inside the file, and the way to it, for messages.
class Entry {
 public:
  Entry(const Json& json, std::string file, std::string path)
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
  const Json& json_;
  std::string file_, path_;
};

/// JSON, in which nlohmann would let the last of two equal keys win in silence.
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

TriangulationSpec read_triangulation(const Entry& entry, std::size_t d) {
  using Spec = TriangulationSpec;
  entry.expect_keys({"type", "edge_length", "rotation", "offset", "rng_seed"});
  Spec spec;
  if (entry.has("type")) {
    spec.type = entry.at("type").choice<Spec::Type>(
        {{"coxeter", Spec::Type::kCoxeter}, {"freudenthal", Spec::Type::kFreudenthal}});
  }
  if (entry.has("edge_length")) spec.edge_length = entry.at("edge_length").positive_number();
  if (entry.has("rotation")) {
    spec.rotation = entry.at("rotation")
                        .choice<Spec::Rotation>({{"none", Spec::Rotation::kNone}, {"random", Spec::Rotation::kRandom}});
  }
  if (entry.has("offset")) {
    const Entry offset = entry.at("offset");
    if (offset.is_list()) {
      spec.offset = Spec::Offset::kGiven;
      spec.given_offset = offset.numbers(d);
    } else {
      spec.offset = offset.choice<Spec::Offset>({{"zero", Spec::Offset::kZero}, {"random", Spec::Offset::kRandom}});
    }
  }
  if (entry.has("rng_seed")) spec.rng_seed = entry.at("rng_seed").count();
  return spec;
}

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

Function read_equations(const std::vector<std::string>& variables, const Entry& entry) {
  return read_map(variables, entry, [&](const auto& texts) { return parse_equations(variables, texts); });
}

/// Any number of expressions, each >= 0.
Function read_inequalities(const std::vector<std::string>& variables, const Entry& entry) {
  return read_map(variables, entry, [&](const auto& texts) { return make_function(compile(variables, texts)); });
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Equations, closest point, or both: what is known under this name.
void read_named(const Entry& entry, Problem& problem) {
  std::map<std::string, double> parameters;
  for (const std::string& key : entry.object_keys()) {
    if (key != "name") parameters[key] = entry.at(key.c_str()).number();
  }
  const std::string name = entry.at("name").string();
  entry.located([&] {
    const bool has_foot = contains(submanifold_names(), name), has_equations = contains(manifold_names(), name);
    if (!has_foot && !has_equations) {
      try {
        named_manifold(name, parameters);  // says what it waits for, or that nobody knows it
      } catch (const InvalidInput& error) {
        std::string list;
        for (const std::string& known : submanifold_names()) list += (list.empty() ? "" : ", ") + known;
        throw InvalidInput(std::string(error.what()) + "; for `whitney triangulate`: " + list);
      }
    }
    if (has_equations) {
      NamedManifold manifold = named_manifold(name, parameters);
      problem.function = std::move(manifold.function);
      problem.box = std::move(manifold.box);
    }
    if (has_foot) problem.submanifold = named_submanifold(name, parameters);
  });
}

std::array<double, 2> read_side(const Entry& side) {
  const std::vector<double> bounds = side.numbers(2);
  if (!(bounds[0] < bounds[1])) side.fail("the lower bound must be less than the upper one");
  if (!std::isfinite(bounds[1] - bounds[0])) side.fail("the width is beyond the range of double");
  return {bounds[0], bounds[1]};
}

Submanifold read_parametrization(const Entry& entry) {
  entry.expect_keys({"parameters", "domain", "map"});
  std::vector<std::string> parameters, map;
  for (const Entry& element : entry.at("parameters").list()) parameters.push_back(element.string());
  entry.at("parameters").located([&] { check_variables(parameters); });
  std::vector<std::array<double, 2>> domain;
  for (const Entry& side : entry.at("domain").list(parameters.size())) domain.push_back(read_side(side));
  const std::vector<Entry> elements = entry.at("map").list();
  for (const Entry& element : elements) {
    map.push_back(element.string());
    element.located([&] { compile(parameters, std::span(&map.back(), 1)); });
  }
  return entry.at("map").located([&] { return parametric_manifold(parameters, std::move(domain), map); });
}

/// A map by its expressions; size 0: any number of them.
CoordinateMap read_coordinate_map(const std::vector<std::string>& variables, const Entry& entry, std::size_t size = 0) {
  entry.list(size);
  const Function map =
      read_map(variables, entry, [&](const auto& texts) { return make_function(compile(variables, texts)); });
  return [map](std::span<const double> x, std::span<double> y) { map.evaluate(x, y); };
}

ChartAtlas read_projective(const Entry& entry) {
  entry.expect_keys({"variables", "equations", "field", "weights"});
  ProjectiveOptions options;
  if (entry.has("field")) {
    options.field = entry.at("field").choice<Field>({{"complex", Field::kComplex}, {"real", Field::kReal}});
  }
  const std::vector<std::string> variables = entry.at("variables").strings();
  entry.at("variables").located([&] { check_variables(variables); });
  if (entry.has("weights")) options.weights = entry.at("weights").numbers(variables.size());
  const std::vector<std::string> equations = entry.at("equations").strings();
  return entry.located([&] { return projective_charts(variables, equations, options); });
}

Chart read_chart(const std::vector<std::string>& variables, const Entry& entry, ChartAtlas& atlas) {
  entry.expect_keys({"name", "equations", "inequalities", "box", "seed_points", "embedding"});
  const std::size_t d = variables.size();
  Chart chart{entry.at("name").string(), read_equations(variables, entry.at("equations"))};
  for (const Chart& other : atlas.charts) {
    if (other.name == chart.name) entry.at("name").fail("another chart has this name");
    if (other.function.codim() != chart.function.codim()) {
      entry.at("equations")
          .fail("every chart must have as many equations as the first, " + std::to_string(other.function.codim()));
    }
  }
  if (entry.has("inequalities")) chart.inequalities = read_inequalities(variables, entry.at("inequalities"));
  if (entry.has("box")) {
    for (const Entry& side : entry.at("box").list(d)) chart.box.push_back(read_side(side));
  }
  if (entry.has("seed_points")) {
    for (const Entry& point : entry.at("seed_points").list()) chart.seed_points.push_back(point.numbers(d));
  }
  if (entry.has("embedding") != (atlas.charts.empty() ? entry.has("embedding") : !atlas.embeddings.empty())) {
    entry.fail("either every chart has an \"embedding\", or none");
  }
  if (entry.has("embedding")) {
    const Entry embedding = entry.at("embedding");
    atlas.embeddings.push_back(read_coordinate_map(variables, embedding, atlas.embedding_variables.size()));
    for (std::size_t i = atlas.embedding_variables.size(); i < embedding.list().size(); ++i) {
      atlas.embedding_variables.push_back("e" + std::to_string(i + 1));
    }
  }
  return chart;
}

/// One side of a seam: [name of a chart, number of an inequality].
std::pair<int, int> read_seam_side(const Entry& entry, const ChartAtlas& atlas) {
  const std::vector<Entry> pair = entry.list(2);
  const std::string name = pair[0].string();
  const auto chart = std::find_if(atlas.charts.begin(), atlas.charts.end(),
                                  [&](const Chart& candidate) { return candidate.name == name; });
  if (chart == atlas.charts.end()) pair[0].fail("there is no chart \"" + name + "\"");
  const std::uint64_t inequality = pair[1].count(), known = chart->inequalities ? chart->inequalities->codim() : 0;
  if (inequality >= known) {
    pair[1].fail("chart \"" + name + "\" has " + std::to_string(known) + " inequalities, numbered from 0");
  }
  return {static_cast<int>(chart - atlas.charts.begin()), static_cast<int>(inequality)};
}

ChartAtlas read_charts(const Entry& root) {
  ChartAtlas atlas;
  atlas.variables = root.at("variables").strings();
  root.at("variables").located([&] { check_variables(atlas.variables); });
  for (const Entry& entry : root.at("charts").list()) {
    atlas.charts.push_back(read_chart(atlas.variables, entry, atlas));
  }
  if (!root.has("seams")) return atlas;
  for (const Entry& entry : root.at("seams").list()) {
    entry.expect_keys({"from", "to", "transition"});
    Seam seam;
    std::tie(seam.first_chart, seam.first_inequality) = read_seam_side(entry.at("from"), atlas);
    std::tie(seam.second_chart, seam.second_inequality) = read_seam_side(entry.at("to"), atlas);
    seam.transition = read_coordinate_map(atlas.variables, entry.at("transition"), atlas.variables.size());
    atlas.seams.push_back(std::move(seam));
  }
  return atlas;
}

/// A problem made of charts, which have boxes and seed points of their own.
Problem parse_charts(const Entry& root) {
  const bool projective = root.has("projective");
  if (projective && root.has("charts")) root.at("charts").fail("\"projective\" makes its own charts");
  const std::string source = projective ? "projective" : "charts";
  for (const char* key :
       {"equations", "named", "parametrization", "points", "inequalities", "box", "seed_points", "reach"}) {
    if (root.has(key)) root.at(key).fail("does not go with \"" + source + "\", which say this for themselves");
  }
  for (const char* key : {"variables", "seams"}) {
    if (projective && root.has(key)) root.at(key).fail("does not go with \"projective\", which makes its own");
  }
  Problem problem;
  problem.source = Problem::Source::kCharts;
  problem.atlas = projective ? read_projective(root.at("projective")) : read_charts(root);
  problem.variables = problem.atlas->variables;
  if (root.has("triangulation")) {
    problem.triangulation = read_triangulation(root.at("triangulation"), problem.ambient_dim());
  }
  return problem;
}

}  // namespace

Problem parse_problem(std::string_view text, const std::string& name) {
  const Json json = parse_json(text, name);
  const Entry root(json, name, "");
  root.expect_keys({"variables", "equations", "inequalities", "box", "seed_points", "reach", "triangulation", "named",
                    "parametrization", "points", "charts", "seams", "projective"});
  if (root.has("charts") || root.has("projective")) return parse_charts(root);
  if (root.has("seams")) root.at("seams").fail("seams are between \"charts\"");
  for (const char* key : {"points"}) {
    if (root.has(key)) root.at(key).fail("this version does not support it yet");
  }
  if (root.has("equations") + root.has("named") + root.has("parametrization") != 1) {
    root.fail(
        "exactly one of the keys \"equations\", \"named\", \"parametrization\", \"charts\" and \"projective\" is "
        "needed");
  }

  Problem problem;
  if (root.has("variables") || root.has("equations")) {
    const Entry entry = root.at("variables");
    if (root.has("named")) entry.fail("a named manifold has its own variables x1 .. xd");
    for (const Entry& element : entry.list()) problem.variables.push_back(element.string());
    entry.located([&] { check_variables(problem.variables); });
  }
  if (root.has("equations")) {
    problem.function = read_equations(problem.variables, root.at("equations"));
  } else if (root.has("named")) {
    problem.source = Problem::Source::kNamed;
    read_named(root.at("named"), problem);
  } else {
    problem.source = Problem::Source::kParametrization;
    problem.submanifold = read_parametrization(root.at("parametrization"));
  }
  const std::size_t d = problem.ambient_dim();
  if (problem.variables.empty()) {
    for (std::size_t i = 1; i <= d; ++i) problem.variables.emplace_back("x").append(std::to_string(i));
  } else if (problem.variables.size() != d) {
    root.at("variables").fail("the map has " + std::to_string(d) + " coordinates");
  }

  if (root.has("inequalities")) {
    const Entry entry = root.at("inequalities");
    problem.inequalities = read_inequalities(problem.variables, entry);
    problem.inequality_texts = entry.strings();
  }
  if (root.has("box")) {
    problem.box.clear();
    for (const Entry& side : root.at("box").list(d)) problem.box.push_back(read_side(side));
  }
  if (root.has("seed_points")) {
    for (const Entry& point : root.at("seed_points").list()) problem.seed_points.push_back(point.numbers(d));
  }
  if (root.has("reach")) problem.reach = root.at("reach").positive_number();
  if (problem.reach && problem.submanifold) {
    root.at("reach").located([&] {
      problem.submanifold = with_bending(*problem.submanifold, {*problem.reach, 0, Bending::Source::kCaller});
    });
  }
  if (root.has("triangulation")) problem.triangulation = read_triangulation(root.at("triangulation"), d);
  return problem;
}

Problem read_problem(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  // A file that is empty makes << fail too.
  if (file && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  if (file.bad() || (!file && !file.eof())) {
    throw FileError("cannot read " + path + (errno != 0 ? ": " + std::string(std::strerror(errno)) : ""));
  }
  return parse_problem(text.str(), path);
}

Submanifold submanifold_of(const Problem& problem) {
  if (problem.submanifold) return *problem.submanifold;
  if (problem.atlas) throw InvalidInput("charts are traced and glued; a submanifold needs its closest points");
  std::vector<double> seeds;
  ImplicitManifoldOptions options;
  if (!problem.box.empty()) {
    options.length_scale = 0;
    for (const auto& [lower, upper] : problem.box)
      options.length_scale = std::max(options.length_scale, (upper - lower) / 4);
  }
  for (const auto& point : problem.seed_points) seeds.insert(seeds.end(), point.begin(), point.end());
  if (seeds.empty()) {
    if (problem.box.empty()) throw InvalidInput("give seed_points, or a box in which they can be searched for");
    Box box;
    for (const auto& [lower, upper] : problem.box) {
      box.lower.push_back(lower);
      box.upper.push_back(upper);
    }
    seeds = find_seeds(*problem.function, box).points;
    if (seeds.empty()) throw InvalidInput("no point of the manifold was found in the box");
  }
  Submanifold manifold = implicit_manifold(*problem.function, std::move(seeds), options);
  if (!problem.reach) return manifold;
  return with_bending(std::move(manifold), {*problem.reach, 0, Bending::Source::kCaller});
}

coxeter::Triangulation make_triangulation(const TriangulationSpec& spec, int ambient_dim, double edge_length) {
  coxeter::Triangulation result = spec.type == TriangulationSpec::Type::kCoxeter
                                      ? coxeter::coxeter_a(ambient_dim, edge_length)
                                      : coxeter::freudenthal(ambient_dim, edge_length);
  if (spec.rotation == TriangulationSpec::Rotation::kRandom) {
    const std::vector<double> no_shift(static_cast<std::size_t>(ambient_dim));
    result = result.transformed(coxeter::random_rotation(ambient_dim, spec.rng_seed), no_shift);
  }
  std::vector<double> offset(static_cast<std::size_t>(ambient_dim));
  if (spec.offset == TriangulationSpec::Offset::kGiven) {
    if (spec.given_offset.size() != offset.size()) {
      throw InvalidInput("offset: " + std::to_string(spec.given_offset.size()) +
                         " numbers instead of d = " + std::to_string(ambient_dim));
    }
    offset = spec.given_offset;
  } else if (spec.offset == TriangulationSpec::Offset::kRandom) {
    offset = coxeter::random_offset(result.linear(), spec.rng_seed);
  }
  return coxeter::Triangulation(result.linear(), std::move(offset));
}

}  // namespace whitney
