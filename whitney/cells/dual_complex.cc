// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/cells/dual_complex.h>

#include <algorithm>
#include <string>
#include <utility>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>

namespace whitney {

DualComplex dual_complex(const CellComplex& complex) {
  const int d = complex.ambient_dim, n = complex.intrinsic_dim;
  if (n >= 1)
    for (std::size_t i = 0; i < complex.num_cells(n - 1); ++i)
      if (complex.cofacets[n - 1][i].size() != 2)
        throw InvalidInput("dual_complex: the cell " + std::to_string(i) + " of dimension " + std::to_string(n - 1) +
                           " does not lie in exactly two others, so the complex is not closed");
  DualComplex dual;
  dual.ambient_dim = d;
  dual.intrinsic_dim = n;
  for (int j = 0; j <= n; ++j) {
    dual.facets.push_back(complex.cofacets[n - j]);
    dual.cofacets.push_back(complex.facets[n - j]);
  }
  const SimplicialMesh subdivision = barycentric_subdivision(complex);
  dual.points.assign(subdivision.points.end() - static_cast<std::ptrdiff_t>(complex.num_cells(n) * d),
                     subdivision.points.end());
  return dual;
}

PolygonMesh polygon_mesh(const DualComplex& dual) {
  if (dual.intrinsic_dim > 2)
    throw InvalidInput("polygon_mesh: dual cells of dimension " + std::to_string(dual.intrinsic_dim) +
                       " are not polygons");
  CellComplex cells;  // what the polygons are read from
  cells.ambient_dim = dual.ambient_dim;
  cells.intrinsic_dim = dual.intrinsic_dim;
  cells.facets = dual.facets;
  cells.points = dual.points;
  PolygonMesh mesh = polygon_mesh(cells);
  for (std::size_t i = 0; i < mesh.num_cells(); ++i)
    if (mesh.offsets[i + 1] - mesh.offsets[i] != dual.facets[dual.intrinsic_dim][i].size())
      throw InvalidInput("polygon_mesh: the cells around the 0-cell " + std::to_string(i) + " are not one cycle");
  return mesh;
}

}  // namespace whitney
