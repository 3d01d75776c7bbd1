// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/read_problem.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

const fs::path kExamples = fs::path(WHITNEY_SOURCE_DIR) / "examples" / "problems";

/// A problem in two variables with some more keys.
std::string with(const std::string& keys) {
  return R"({"variables": ["x","y"], "equations": ["x^2+y^2-1"])" + (keys.empty() ? "" : ", " + keys) + "}";
}

std::string error_of(const std::string& text) {
  try {
    parse_problem(text, "file.json");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "no error";
}

TEST(Problem, Everything) {
  const Problem p = parse_problem(R"json(// a comment
    { "variables": ["x","y","z"], "equations": ["x^2+y^2-1", "z-sin(x)"],   // another
      "box": [[-2,2],["-pi","pi"],[-1.5,"1/2"]],
      "seed_points": [[1,0,0],["cos(1)","sin(1)",0]],
      "reach": "1/4",
      "triangulation": {
  "type" : "freudenthal",
           "edge_length" : "0.1*2",
                           "rotation" : "random",
                                        "offset" : [ 0, "pi", 1e-3 ],
                                                   "rng_seed" : 18446744073709551615} })json",
                                  "p.json");
  EXPECT_EQ(p.source, Problem::Source::kEquations);
  EXPECT_EQ(p.variables, (std::vector<std::string>{"x", "y", "z"}));
  EXPECT_EQ(p.ambient_dim(), 3);
  EXPECT_EQ(p.codim(), 2);
  ASSERT_EQ(p.box.size(), 3);
  EXPECT_EQ(p.box[1][1], std::numbers::pi);
  EXPECT_EQ(p.box[2][1], 0.5);
  ASSERT_EQ(p.seed_points.size(), 2);
  EXPECT_EQ(p.seed_points[1][0], std::cos(1.0));
  EXPECT_EQ(p.reach, 0.25);
  EXPECT_EQ(p.triangulation.type, TriangulationSpec::Type::kFreudenthal);
  EXPECT_EQ(p.triangulation.edge_length, 0.2);
  EXPECT_EQ(p.triangulation.rotation, TriangulationSpec::Rotation::kRandom);
  EXPECT_EQ(p.triangulation.offset, TriangulationSpec::Offset::kGiven);
  EXPECT_EQ(p.triangulation.given_offset, (std::vector<double>{0, std::numbers::pi, 1e-3}));
  EXPECT_EQ(p.triangulation.rng_seed, ~std::uint64_t{0});
}

TEST(Problem, Defaults) {
  const Problem p = parse_problem(with(""), "p.json");
  EXPECT_TRUE(p.box.empty());
  EXPECT_TRUE(p.seed_points.empty());
  EXPECT_FALSE(p.reach);
  EXPECT_FALSE(p.triangulation.edge_length);
  EXPECT_EQ(p.triangulation.type, TriangulationSpec::Type::kCoxeter);
  EXPECT_EQ(p.triangulation.rotation, TriangulationSpec::Rotation::kNone);
  EXPECT_EQ(p.triangulation.offset, TriangulationSpec::Offset::kRandom);
  EXPECT_EQ(p.triangulation.rng_seed, 1);
}

TEST(Problem, Named) {
  const Problem p =
      parse_problem(R"json({"named": {"name": "sphere", "intrinsic_dim": 1, "radius": "sqrt(2)"}})json", "p.json");
  EXPECT_EQ(p.source, Problem::Source::kNamed);
  EXPECT_EQ(p.variables, (std::vector<std::string>{"x1", "x2"}));
  EXPECT_EQ(p.box.size(), 2);
  std::vector<double> value(1);
  p.function->evaluate(std::vector<double>{1, 1}, value);
  EXPECT_NEAR(value[0], 0, 1e-15);
  const Problem boxed = parse_problem(R"({"named": {"name": "trefoil"}, "box": [[-9,9],[-9,9],[-9,9],[-9,9]]})", "p");
  EXPECT_EQ(boxed.box[3][1], 9);
}

TEST(Problem, ClosestPoints) {
  // Known both as a zero set and by its closest point.
  const Problem torus = parse_problem(R"({"named": {"name": "flat_torus", "r2": 0.5}})", "p");
  ASSERT_TRUE(torus.function && torus.submanifold);
  EXPECT_EQ(torus.submanifold->bending()->reach, 0.5);
  std::vector<double> values(2);
  torus.function->evaluate(torus.submanifold->seed_points(), values);
  EXPECT_EQ(values, (std::vector<double>{0, 0}));
  // Not a zero set. The file's reach takes the place of what is known.
  const Problem plane = parse_problem(R"({"named": {"name": "projective_plane_projectors"}, "reach": 0.5})", "p");
  EXPECT_FALSE(plane.function);
  EXPECT_EQ(plane.ambient_dim(), 5);
  EXPECT_EQ(plane.codim(), 3);
  EXPECT_EQ(plane.variables.size(), 5);
  EXPECT_EQ(plane.submanifold->bending()->reach, 0.5);
  EXPECT_EQ(plane.submanifold->bending()->source, Bending::Source::kCaller);

  const std::string circle =
      R"x("parametrization": {"parameters": ["t"], "domain": [[0,"2*pi"]], "map": ["3*cos(t)","3*sin(t)"]})x";
  const Problem p = parse_problem(R"({"variables": ["a","b"], "reach": 3, )" + circle + "}", "p");
  EXPECT_EQ(p.source, Problem::Source::kParametrization);
  EXPECT_EQ(p.variables, (std::vector<std::string>{"a", "b"}));
  std::vector<double> point(2), frame(4);
  FootErrors errors;
  ASSERT_TRUE(p.submanifold->project(std::vector<double>{0, 4}, point, frame, errors));
  EXPECT_NEAR(point[1], 3, 1e-14);

  // Equations give an implicit manifold when asked for one; seeds are searched for.
  const Problem sphere = parse_problem(with(R"("box": [[-2,2],[-2,2]], "reach": 1)"), "p");
  EXPECT_FALSE(sphere.submanifold);
  const Submanifold implicit = submanifold_of(sphere);
  EXPECT_FALSE(implicit.seed_points().empty());
  EXPECT_EQ(implicit.bending()->reach, 1);
  ASSERT_TRUE(implicit.project(std::vector<double>{0.3, 0.4}, point, frame, errors));
  EXPECT_NEAR(point[0], 0.6, 1e-14);
  EXPECT_THROW(submanifold_of(parse_problem(with(""), "p")), InvalidInput);
}

TEST(Problem, Examples) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(kExamples)) {
    if (entry.path().extension() != ".json") continue;
    ++count;
    SCOPED_TRACE(entry.path());
    const Problem p = read_problem(entry.path());
    EXPECT_EQ(p.box.size(), p.function ? p.ambient_dim() : 0);
    EXPECT_GT(p.triangulation.edge_length.value_or(0), 0);
    const coxeter::Triangulation t = make_triangulation(p.triangulation, p.ambient_dim(), *p.triangulation.edge_length);
    EXPECT_NEAR(t.edge_length(), *p.triangulation.edge_length, 1e-12);
  }
  EXPECT_GE(count, 14);
}

/// Two charts of the unit circle in the plane; `more` continues chart B, `rest` the file.
std::string circle_charts(const std::string& more = "", const std::string& rest = "") {
  return R"json({"variables": ["x", "y"], "charts": [
    {"name": "A", "equations": ["x^2+y^2-1"], "inequalities": ["y"], "box": [[-2,2],[-2,2]], "seed_points": [[0,1]],
     "embedding": ["x", "y", "0*x"]},
    {"name": "B", "equations": ["x^2+y^2-1"], "inequalities": ["y", "x+2", "2-x"])json" +
         more + R"json(, "embedding": ["x", "-y", "0"]}]
    , "seams": [{"from": ["A", 0], "to": ["B", 0], "transition": ["x", "-y"]}])json" +
         rest + "}";
}

TEST(Problem, Charts) {
  const Problem p =
      parse_problem(circle_charts("", R"(, "triangulation": {"edge_length": 0.2, "offset": [0, 1]})"), "p");
  EXPECT_EQ(p.source, Problem::Source::kCharts);
  EXPECT_FALSE(p.function || p.submanifold);
  ASSERT_TRUE(p.atlas);
  EXPECT_EQ(p.ambient_dim(), 2);
  EXPECT_EQ(p.codim(), 1);
  EXPECT_EQ(p.variables, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(p.triangulation.edge_length, 0.2);
  const ChartAtlas& atlas = *p.atlas;
  ASSERT_EQ(atlas.charts.size(), 2);
  EXPECT_EQ(atlas.charts[0].name, "A");
  EXPECT_EQ(atlas.charts[0].box.size(), 2);
  EXPECT_EQ(atlas.charts[0].seed_points.size(), 1);
  EXPECT_TRUE(atlas.charts[1].box.empty() && atlas.charts[1].seed_points.empty());
  ASSERT_TRUE(atlas.charts[1].inequalities);
  EXPECT_EQ(atlas.charts[1].inequalities->codim(), 3);  // more than there are dimensions
  std::vector<double> g(3);
  atlas.charts[1].inequalities->evaluate(std::vector<double>{0.5, 0.25}, g);
  EXPECT_EQ(g, (std::vector<double>{0.25, 2.5, 1.5}));
  ASSERT_EQ(atlas.seams.size(), 1);
  EXPECT_EQ(atlas.seams[0].second_chart, 1);
  std::vector<double> y(2), e(3);
  atlas.seams[0].transition(std::vector<double>{3, 4}, y);
  EXPECT_EQ(y, (std::vector<double>{3, -4}));
  EXPECT_EQ(atlas.embedding_dim(), 3);
  EXPECT_EQ(atlas.embedding_variables[2], "e3");
  atlas.embeddings.at(1)(std::vector<double>{3, 4}, e);
  EXPECT_EQ(e, (std::vector<double>{3, -4, 0}));
  EXPECT_THROW(submanifold_of(p), InvalidInput);
}

TEST(Problem, Projective) {
  const Problem p = parse_problem(
      R"json({"projective": {"variables": ["z1","z2","z3"], "equations": ["z1^2*conj(z2) + z2^2*conj(z3) + z3^2*conj(z1)"],
              "weights": [1, "5/4", 1.1]}})json",
      "p");
  ASSERT_TRUE(p.atlas);
  EXPECT_EQ(p.ambient_dim(), 4);
  EXPECT_EQ(p.codim(), 2);
  EXPECT_EQ(p.variables, (std::vector<std::string>{"x1", "y1", "x2", "y2"}));
  EXPECT_EQ(p.atlas->charts.size(), 3);
  EXPECT_EQ(p.atlas->embedding_dim(), 9);
  std::vector<double> g(2);
  p.atlas->charts[0].inequalities->evaluate(std::vector<double>{0, 0.8, 0, 0}, g);
  EXPECT_NEAR(g[0], 0, 1e-15);
  const Problem real =
      parse_problem(R"({"projective": {"variables": ["x","y","z"], "equations": ["x*y-z^2"], "field": "real"}})", "p");
  EXPECT_EQ(real.ambient_dim(), 2);
}

TEST(Problem, ChartErrors) {
  const auto expect = [](const std::string& text, const std::string& key, const std::string& reason) {
    EXPECT_THAT(error_of(text), AllOf(HasSubstr("file.json"), HasSubstr(key), HasSubstr(reason))) << text;
  };
  EXPECT_EQ(error_of(circle_charts()), "no error");
  expect(circle_charts(R"(, "colour": 1)"), "charts[1]", "colour");
  expect(circle_charts(R"(, "box": [[0,1]])"), "charts[1].box", "2 elements");
  expect(circle_charts("", R"(, "box": [[0,1],[0,1]])"), "box", "does not go with");
  expect(circle_charts("", R"(, "equations": ["x"])"), "equations", "does not go with");
  expect(circle_charts("", R"(, "projective": {})"), "charts", "own charts");
  const auto seam = [](const std::string& seam) {
    std::string text = circle_charts();
    const std::size_t at = text.find("{\"from\"");
    return text.substr(0, at) + seam + "]}";
  };
  expect(seam(R"({"from": ["A", 1], "to": ["B", 0], "transition": ["x", "y"]})"), "seams[0].from[1]", "1 inequalities");
  expect(seam(R"({"from": ["A", 0], "to": ["C", 0], "transition": ["x", "y"]})"), "seams[0].to[0]", "no chart \"C\"");
  expect(seam(R"({"from": ["A", 0], "to": ["B", 0], "transition": ["x"]})"), "seams[0].transition", "2 elements");
  expect(seam(R"({"from": ["A", 0], "to": ["B", 0], "transition": ["x", "q"]})"), "seams[0].transition[1]", "'q'");
  expect(seam(R"({"from": ["A", 0], "to": ["B", 0]})"), "seams[0]", "\"transition\" is missing");
  const auto chart = [](const std::string& b) {
    return R"({"variables": ["x","y"], "charts": [{"name": "A", "equations": ["x"]}, )" + b + "]}";
  };
  expect(chart(R"({"name": "A", "equations": ["x"]})"), "charts[1].name", "another");
  expect(chart(R"({"name": "B", "equations": ["x", "y"]})"), "charts[1].equations", "as many equations");
  expect(chart(R"({"name": "B", "equations": ["x"], "embedding": ["x"]})"), "charts[1]", "or none");
  expect(chart(R"({"name": "B", "equations": ["x"], "inequalities": ["1", "+"]})"), "charts[1].inequalities[1]",
         "expected");
  expect(chart(R"({"equations": ["x"]})"), "charts[1]", "\"name\" is missing");
  expect(with(R"("seams": [])"), "seams", "charts");
  expect(R"({"projective": {"variables": ["a","b"], "equations": ["a+1"]}})", "projective", "not bihomogeneous");
  expect(R"({"projective": {"variables": ["a","b"], "equations": ["a+b"], "weights": [1]}})", "projective.weights",
         "2 elements");
  expect(R"({"projective": {"variables": ["a","b"], "equations": ["a+b"], "field": "rational"}})", "projective.field",
         "complex, real");
  expect(R"({"projective": {"variables": ["a","b"], "equations": ["a+b"]}, "variables": ["a"]})", "variables",
         "does not go");
}

TEST(Problem, ErrorsNameFileKeyAndReason) {
  const auto expect = [](const std::string& text, const std::string& key, const std::string& reason) {
    EXPECT_THAT(error_of(text), AllOf(HasSubstr("file.json"), HasSubstr(key), HasSubstr(reason))) << text;
  };
  expect("", "", "parse error");
  expect("{", "", "line 1");
  expect("[]", "", "object");
  expect("{}", "", "\"equations\"");
  expect(with(R"("edge_length": 1)"), "\"edge_length\"", "triangulation, named");
  expect(with(R"("triangulation": {"edgelength": 1})"), "triangulation: unknown key \"edgelength\"",
         "type, edge_length");
  expect(with(R"("box": [[0,1],[0,1]], "box": [[0,2],[0,2]])"), "\"box\"", "twice");
  expect(with(R"("triangulation": {"type": "coxeter", "type": "coxeter"})"), "\"type\"", "twice");
  expect(with(R"("named": {"name": "sphere"})"), "\"named\"", "exactly one");
  expect(R"({"equations": ["x"]})", "\"variables\"", "missing");
  expect(R"({"variables": [], "equations": ["1"]})", "variables", "empty");
  expect(R"({"variables": "x", "equations": ["1"]})", "variables", "list");
  expect(R"({"variables": ["x", 1], "equations": ["1"]})", "variables[1]", "text");
  expect(R"({"variables": ["x","x"], "equations": ["x"]})", "variables", "twice");
  expect(R"({"variables": ["x","sin"], "equations": ["x"]})", "variables", "reserved");
  expect(R"({"variables": ["x"], "equations": []})", "equations", "empty");
  expect(R"({"variables": ["x"], "equations": [1]})", "equations[0]", "text");
  expect(R"({"variables": ["x"], "equations": ["x","x"]})", "equations", "more equations");
  expect(R"({"variables": ["x","y"], "equations": ["x","x+u"]})", "equations[1]", "position 3");
  expect(R"({"variables": ["x"], "named": {"name": "chair"}})", "variables", "named");
  expect(R"({"named": {}})", "named", "\"name\"");
  expect(R"({"named": "chair"})", "named", "object");
  expect(R"({"named": {"name": "chairs"}})", "named", "cyclo_heptane");
  expect(R"({"named": {"name": "klein_bottles"}})", "named", "klein_bottle,");
  expect(R"({"named": {"name": "klein_quartic"}})", "named", "charts");
  expect(R"({"named": {"name": "klein_bottle", "r": 1}})", "named", "none");
  expect(R"({"parametrization": {}})", "parametrization", "\"parameters\"");
  expect(R"({"parametrization": {"parameters": ["u"], "domain": [[0,1],[0,1]], "map": ["u","u"]}})",
         "parametrization.domain", "expected 1");
  expect(R"({"parametrization": {"parameters": ["u"], "domain": [[1,0]], "map": ["u","u"]}})",
         "parametrization.domain[0]", "less than");
  expect(R"({"parametrization": {"parameters": ["u"], "domain": [[0,1]], "map": ["u","u+w"]}})",
         "parametrization.map[1]", "unknown name 'w'");
  expect(R"({"parametrization": {"parameters": ["u"], "domain": [[0,1]], "map": ["u"]}})", "parametrization.map",
         "n < d");
  expect(R"({"parametrization": {"parameters": ["u"], "domain": [[0,1]], "map": ["1","2"]}})", "parametrization.map",
         "constant");
  expect(R"x({"variables": ["x"],
              "parametrization": {"parameters": ["u"], "domain": [[0,7]], "map": ["cos(u)","sin(u)"]}})x",
         "variables", "2 coordinates");
  expect(R"({"named": {"name": "sphere", "radius": "r"}})", "named.radius", "unknown name 'r'");
  expect(R"({"named": {"name": "sphere", "radius": -1}})", "named", "positive");
  expect(with(R"("box": [[0,1]])"), "box", "expected 2 elements, not 1");
  expect(with(R"("box": [[0,1],[0,1,2]])"), "box[1]", "expected 2");
  expect(with(R"("box": [[0,1],[1,1]])"), "box[1]", "less than");
  expect(with(R"("box": [[0,1],[2,1]])"), "box[1]", "less than");
  expect(with(R"("box": [[0,1],[0,"1/0"]])"), "box[1][1]", "division by zero");
  expect(with(R"("box": [[0,1],[0,"1e999"]])"), "box[1][1]", "range");
  expect(with(R"("box": [[0,1],[-1.7e308,1.7e308]])"), "box[1]", "range");
  expect(with(R"("box": [[0,1],[0,null]])"), "box[1][1]", "number");
  expect(with(R"("box": [[0,1],[0,1e999]])"), "", "1e999");
  expect(with(R"("box": [])"), "box", "empty");
  expect(with(R"("seed_points": [])"), "seed_points", "empty");
  expect(with(R"("seed_points": [[1,0],[1]])"), "seed_points[1]", "expected 2");
  expect(with(R"("seed_points": [1,0])"), "seed_points[0]", "list");
  expect(with(R"("reach": 0)"), "reach", "positive");
  expect(with(R"("reach": true)"), "reach", "number");
  expect(with(R"("triangulation": [])"), "triangulation", "object");
  expect(with(R"("triangulation": {"type": "Coxeter"})"), "triangulation.type", "coxeter, freudenthal");
  expect(with(R"("triangulation": {"rotation": "some"})"), "triangulation.rotation", "none, random");
  expect(with(R"("triangulation": {"offset": "some"})"), "triangulation.offset", "zero, random");
  expect(with(R"("triangulation": {"offset": [1]})"), "triangulation.offset", "expected 2");
  expect(with(R"("triangulation": {"offset": 1})"), "triangulation.offset", "text");
  expect(with(R"("triangulation": {"edge_length": 0})"), "triangulation.edge_length", "positive");
  expect(with(R"("triangulation": {"edge_length": "-pi"})"), "triangulation.edge_length", "positive");
  expect(with(R"("triangulation": {"rng_seed": -1})"), "triangulation.rng_seed", "integer");
  expect(with(R"("triangulation": {"rng_seed": 1.5})"), "triangulation.rng_seed", "integer");
  expect(with(R"("inequalities": [])"), "inequalities", "empty");
  expect(with(R"("inequalities": "x")"), "inequalities", "list");
  expect(with(R"("inequalities": ["x", "x +"])"), "inequalities[1]", "position");
  expect(with(R"("points": [])"), "unknown key \"points\"", "variables, equations");
}

TEST(Problem, Files) {
  EXPECT_THROW(read_problem("/nowhere/problem.json"), FileError);
  EXPECT_THROW(read_problem("/"), FileError);
  const fs::path path = fs::path(testing::TempDir()) / "whitney_problem_test.json";
  std::ofstream(path) << "";
  EXPECT_THROW(read_problem(path), InvalidInput);
  std::ofstream(path) << with("");
  EXPECT_EQ(read_problem(path).ambient_dim(), 2);
  fs::remove(path);
}

}  // namespace
}  // namespace whitney
