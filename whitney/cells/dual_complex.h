// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <whitney/cells/cell_complex.h>
#include <whitney/topology/mesh.h>

namespace whitney {

/// The dual of a closed cell complex: one dual j-cell for every (n-j)-cell, under the same index, with inclusions
/// reversed. Dual vertices are n-cells; dual n-cells are the stars of 0-cells in the barycentric subdivision.
struct DualComplex {
  int ambient_dim = 0;    ///< d
  int intrinsic_dim = 0;  ///< n
  std::vector<Incidence>
      facets;  ///< facets[j]: the dual (j-1)-cells in the boundary of every dual j-cell; empty for j = 0
  std::vector<Incidence> cofacets;  ///< cofacets[j]: the dual (j+1)-cells around every dual j-cell; empty for j = n
  std::vector<double> points;       ///< num_cells(0) x d: the points of K that stand for the n-cells

  std::size_t num_cells(int dim) const { return facets[dim].size(); }
};

/// The dual of a cell complex in which every (n-1)-cell lies in exactly two n-cells, else InvalidInput.
/// A regular CW complex when the complex is that of a manifold: topology_of(dual.facets) applies.
DualComplex dual_complex(const CellComplex& complex);

/// The dual of a closed surface as polygons (n = 2), one for every 0-cell, in its order, the corners in cyclic order;
/// of a closed curve as edges (n = 1). The polygons are not planar. Throws InvalidInput for n >= 3 and when the cells
/// around a 0-cell are not one cycle.
PolygonMesh polygon_mesh(const DualComplex& dual);

}  // namespace whitney
