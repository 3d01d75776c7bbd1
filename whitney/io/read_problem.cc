// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/read_problem.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <whitney/functions/expression.h>
#include <whitney/io/formats/problem_entry.h>
#include <whitney/io/formats/read_atlas.h>
#include <whitney/io/read_file.h>
#include <whitney/manifolds/catalogue.h>
#include <whitney/manifolds/parametric_manifold.h>

namespace whitney {
namespace {

using io::Entry;
using io::read_equations;
using io::read_inequalities;
using io::read_side;

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

/// Equations, closest point, or both: what is known under this name.
void read_named(const Entry& entry, Problem& problem) {
  std::map<std::string, double> parameters;
  for (const std::string& key : entry.object_keys()) {
    if (key != "name") parameters[key] = entry.at(key.c_str()).number();
  }
  const std::string name = entry.at("name").string();
  entry.located([&] {
    KnownManifold known = known_manifold(name, parameters);
    if (known.function) {
      problem.function = std::move(known.function);
      problem.box = std::move(known.box);
    }
    problem.submanifold = std::move(known.submanifold);
  });
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

/// A problem made of charts, which have boxes and seed points of their own.
Problem parse_charts(const Entry& root) {
  const bool projective = root.has("projective");
  if (projective && root.has("charts")) root.at("charts").fail("\"projective\" makes its own charts");
  const std::string source = projective ? "projective" : "charts";
  for (const char* key : {"equations", "named", "parametrization", "inequalities", "box", "seed_points", "reach"}) {
    if (root.has(key)) root.at(key).fail("does not go with \"" + source + "\", which say this for themselves");
  }
  for (const char* key : {"variables", "seams"}) {
    if (projective && root.has(key)) root.at(key).fail("does not go with \"projective\", which makes its own");
  }
  Problem problem;
  problem.source = Problem::Source::kCharts;
  problem.atlas = projective ? io::read_projective(root.at("projective")) : io::read_charts(root);
  problem.variables = problem.atlas->variables;
  if (root.has("triangulation")) {
    problem.triangulation = read_triangulation(root.at("triangulation"), problem.ambient_dim());
  }
  return problem;
}

}  // namespace

Problem parse_problem(std::string_view text, const std::string& name) {
  const nlohmann::json json = io::parse_json(text, name);
  const Entry root(json, name, "");
  root.expect_keys({"variables", "equations", "inequalities", "box", "seed_points", "reach", "triangulation", "named",
                    "parametrization", "charts", "seams", "projective"});
  if (root.has("charts") || root.has("projective")) return parse_charts(root);
  if (root.has("seams")) root.at("seams").fail("seams are between \"charts\"");
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

Problem read_problem(const std::string& path) { return parse_problem(read_file(path), path); }

}  // namespace whitney
