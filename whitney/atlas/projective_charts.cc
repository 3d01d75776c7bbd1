// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/projective_charts.h>

#include <charconv>
#include <cmath>
#include <complex>
#include <numbers>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

using Complex = std::complex<double>;

/// Room in the box of a chart on either side of its domain, as a share of half its width.
constexpr double kMargin = 0.25;

/// The fractional parts of multiples of the golden ratio keep away from each other.
std::vector<double> default_weights(std::size_t count) {
  constexpr double kSpread = 0.4;
  std::vector<double> weights;
  for (std::size_t i = 0; i < count; ++i) {
    weights.push_back(std::exp(kSpread * std::fmod(static_cast<double>(i) * std::numbers::phi, 1)));
  }
  return weights;
}

std::string shortest_text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

/// The coordinates of the charts of P^N and what they stand for.
class Coordinates {
 public:
  Coordinates(std::size_t count, Field field) : count_(count), width_(field == Field::kComplex ? 2 : 1) {}

  std::size_t width() const { return width_; }  ///< real coordinates of one number
  /// The homogeneous coordinates z, z_chart = 1.
  std::vector<Complex> homogeneous(std::size_t chart, std::span<const double> x) const {
    std::vector<Complex> z(count_, 1);
    for (std::size_t j = 0; j < count_; ++j) {
      if (j == chart) continue;
      const std::size_t at = width_ * place(chart, j);
      z[j] = {x[at], width_ == 2 ? x[at + 1] : 0};
    }
    return z;
  }
  void affine(std::size_t chart, std::span<const Complex> z, std::span<double> x) const {
    for (std::size_t j = 0; j < count_; ++j) {
      if (j == chart) continue;
      const Complex w = z[j] / z[chart];
      const std::size_t at = width_ * place(chart, j);
      x[at] = w.real();
      if (width_ == 2) x[at + 1] = w.imag();
    }
  }
  /// Which coordinate of the chart, and which of its inequalities, belongs to variable j.
  static std::size_t place(std::size_t chart, std::size_t j) { return j - (j > chart); }

  void projector(std::span<const Complex> z, std::span<double> p) const {
    double squared = 0;
    for (const Complex& entry : z) squared += std::norm(entry);
    std::size_t at = 0;
    for (const Complex& entry : z) p[at++] = std::norm(entry) / squared;
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = i + 1; j < count_; ++j) {
        const Complex entry = std::numbers::sqrt2 * z[i] * std::conj(z[j]) / squared;
        p[at++] = entry.real();
        if (width_ == 2) p[at++] = entry.imag();
      }
    }
  }
  std::vector<std::string> projector_names() const {
    const auto name = [](const char* kind, std::size_t i, std::size_t j) {
      return kind + std::to_string(i + 1) + "_" + std::to_string(j + 1);
    };
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count_; ++i) names.push_back(name("p_", i, i));
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = i + 1; j < count_; ++j) {
        names.push_back(name(width_ == 2 ? "re_" : "p_", i, j));
        if (width_ == 2) names.push_back(name("im_", i, j));
      }
    }
    return names;
  }

 private:
  std::size_t count_, width_;
};

}  // namespace

ChartAtlas projective_charts(std::span<const std::string> variables, std::span<const std::string> equations,
                             const ProjectiveOptions& options) {
  std::vector<CompiledMap> maps = compile_affine_charts(variables, equations, options.field);
  const std::size_t count = variables.size();
  std::vector<double> weights = options.weights;
  if (weights.empty()) weights = default_weights(count);
  if (weights.size() != count) {
    throw InvalidInput("weights: " + std::to_string(weights.size()) + " numbers for " + std::to_string(count) +
                       " variables");
  }
  for (const double weight : weights) {
    if (!(weight > 0) || !std::isfinite(weight)) throw InvalidInput("weights: must be positive numbers");
  }

  const Coordinates coordinates(count, options.field);
  ChartAtlas atlas;
  for (std::size_t j = 1; j < count; ++j) {
    for (const char* part : {"x", "y"}) {
      if (*part == 'x' || coordinates.width() == 2) atlas.variables.push_back(part + std::to_string(j));
    }
  }
  atlas.embedding_variables = coordinates.projector_names();
  for (std::size_t c = 0; c < count; ++c) {
    Chart chart{variables[c] + " = 1", make_function(std::move(maps[c]))};
    std::vector<std::string> inequalities;
    for (std::size_t j = 0; j < count; ++j) {
      if (j == c) continue;
      const double radius = weights[c] / weights[j], room = (1 + kMargin) * radius;
      if (!std::isfinite(radius * radius) || radius * radius == 0) {
        throw InvalidInput("weights: their ratios are beyond the range of double");
      }
      const std::string number = std::to_string(Coordinates::place(c, j) + 1);
      inequalities.push_back(shortest_text(radius * radius) + " - x" + number + "^2");
      if (coordinates.width() == 2) inequalities.back() += " - y" + number + "^2";
      chart.box.insert(chart.box.end(), coordinates.width(), {-room, room});
    }
    chart.inequalities = make_function(compile(atlas.variables, inequalities));
    atlas.charts.push_back(std::move(chart));
    atlas.embeddings.push_back([coordinates, c](std::span<const double> x, std::span<double> p) {
      coordinates.projector(coordinates.homogeneous(c, x), p);
    });
    for (std::size_t b = c + 1; b < count; ++b) {
      Seam seam;
      seam.first_chart = static_cast<int>(c);
      seam.first_inequality = static_cast<int>(Coordinates::place(c, b));
      seam.second_chart = static_cast<int>(b);
      seam.second_inequality = static_cast<int>(Coordinates::place(b, c));
      seam.transition = [coordinates, c, b](std::span<const double> x, std::span<double> y) {
        coordinates.affine(b, coordinates.homogeneous(c, x), y);
      };
      atlas.seams.push_back(std::move(seam));
    }
  }
  return atlas;
}

}  // namespace whitney
