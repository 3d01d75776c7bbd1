// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <whitney/atlas/glue_charts.h>
#include <whitney/functions/function.h>

namespace whitney {

/// One coordinate patch of a manifold: the part of f = 0 where g >= 0.
struct Chart {
  std::string name;
  Function function;                               ///< f: R^d -> R^k
  std::optional<Function> inequalities{};          ///< g: R^d -> R^m, m as large as it likes; none: no boundary to glue
  std::vector<std::array<double, 2>> box{};        ///< d x (lower, upper), the domain inside; or empty: none is known
  std::vector<std::vector<double>> seed_points{};  ///< m x d; empty: to be searched for in the box
};

/// A manifold made of charts, all in R^d with the same codimension, and how to glue them.
struct ChartAtlas {
  std::vector<std::string> variables{};            ///< names of the coordinates, d; the same in every chart
  std::vector<Chart> charts{};                     ///< at least one
  std::vector<Seam> seams{};                       ///< by numbers of charts and of inequalities, from 0
  std::vector<CoordinateMap> embeddings{};         ///< of every chart into R^D, or none
  std::vector<std::string> embedding_variables{};  ///< D names

  int ambient_dim() const { return charts.at(0).function.ambient_dim(); }
  int codim() const { return charts.at(0).function.codim(); }
  int embedding_dim() const { return static_cast<int>(embedding_variables.size()); }  ///< D; 0: no embedding
};

}  // namespace whitney
