// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <whitney/cells/cell_complex.h>

namespace whitney {

/// A connected piece of the manifold on which the same inequalities vanish: the interior, a facet of the boundary, an
/// edge, a corner.
struct Stratum {
  int dim = 0;                       ///< n - |I|
  std::vector<int> inequalities;     ///< I, numbers as in Domain
  bool is_cut = false;               ///< I holds a side of the box: the manifold goes on behind it
  std::vector<std::uint32_t> cells;  ///< its cells of dimension dim
  /// The strata one dimension down that are in its closure: the edges of the stratum graph.
  std::vector<std::uint32_t> faces;
};

struct Strata {
  std::vector<Stratum> strata;  ///< by decreasing dimension, then by inequalities, then by their first cell
  /// stratum_of[j][i]: the stratum that the (open) j-cell i is part of.
  std::vector<std::vector<std::uint32_t>> stratum_of;
  std::size_t boundary_components =
      0;  ///< connected components of the closed set where one of the caller's inequalities vanishes
  std::size_t cut_components = 0;  ///< likewise for the sides of the box

  bool has_boundary() const { return boundary_components + cut_components > 0; }
};

/// The strata of a complex that is cut out by inequalities.
Strata strata_of(const CellComplex& complex);

}  // namespace whitney
