// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/formats/read_atlas.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <whitney/atlas/projective_charts.h>

namespace whitney::io {
namespace {

/// A map by its expressions; size 0: any number of them.
CoordinateMap read_coordinate_map(const std::vector<std::string>& variables, const Entry& entry, std::size_t size = 0) {
  entry.list(size);
  const Function map =
      read_map(variables, entry, [&](const auto& texts) { return make_function(compile(variables, texts)); });
  return [map](std::span<const double> x, std::span<double> y) { map.evaluate(x, y); };
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

}  // namespace

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

}  // namespace whitney::io
