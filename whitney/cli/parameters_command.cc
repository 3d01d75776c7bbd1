// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <iostream>

#include <perturbation/parameters.h>
#include <whitney/cli/commands.h>
#include <whitney/io/atomic_file.h>

namespace whitney::cli {
namespace {

using perturbation::Parameter;
using perturbation::WhitneyParameters;

std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string fixed(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

/// None of the texts has a character that JSON escapes.
std::string to_json(const WhitneyParameters& printed, const WhitneyParameters& corrected) {
  std::string text = "{\n  \"ambient_dim\": " + std::to_string(printed.ambient_dim) +
                     ",\n  \"intrinsic_dim\": " + std::to_string(printed.intrinsic_dim) + ",\n  \"parameters\": [";
  for (std::size_t i = 0; i < printed.list.size(); ++i) {
    const Parameter& p = printed.list[i];
    text += std::string(i ? "," : "") + "\n    {\"symbol\": \"" + p.symbol + "\", \"equation\": \"" + p.equation +
            "\", \"meaning\": \"" + p.meaning + "\", \"log10_as_printed\": " + shortest(p.log10) +
            ", \"log10_corrected\": " + shortest(corrected.list[i].log10) + "}";
  }
  return text + "\n  ]\n}\n";
}

std::string padded(std::string text, std::size_t width, bool right = false) {
  if (text.size() < width) text.insert(right ? 0 : text.size(), width - text.size(), ' ');
  return text;
}

}  // namespace

int run_parameters(const ParametersArguments& arguments) {
  using perturbation::Variant;
  const auto of = [&](Variant variant) {
    return perturbation::whitney_parameters(arguments.ambient_dim, arguments.intrinsic_dim, variant);
  };
  const WhitneyParameters printed = of(Variant::kAsPrinted), corrected = of(Variant::kCorrected);
  if (!arguments.stats.empty()) write_file(arguments.stats, to_json(printed, corrected));

  std::size_t symbol = 6, meaning = 7;
  for (const Parameter& p : printed.list) {
    symbol = std::max(symbol, p.symbol.size());
    meaning = std::max(meaning, p.meaning.size());
  }
  const auto line = [&](const std::string& s, const std::string& e, const std::string& m, const std::string& a,
                        const std::string& b) {
    std::cout << padded(s, symbol) << "  " << padded(e, 8) << "  " << padded(m, meaning) << "  " << padded(a, 10, true)
              << "  " << padded(b, 10, true) << "\n";
  };
  std::cout << "A manifold of dimension " << arguments.intrinsic_dim << " in R^" << arguments.ambient_dim
            << ". Boissonnat, Kachanovich, Wintraecken, Triangulating submanifolds, DCG 2020; log10:\n";
  line("symbol", "equation", "meaning", "as printed", "corrected");
  for (std::size_t i = 0; i < printed.list.size(); ++i) {
    const Parameter& p = printed.list[i];
    line(p.symbol, p.equation, p.meaning, fixed(p.log10), fixed(corrected.list[i].log10));
  }
  return kDone;
}

}  // namespace whitney::cli
