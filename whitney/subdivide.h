// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <whitney/cell_complex.h>
#include <whitney/mesh.h>

namespace whitney {

/// The barycentric subdivision: one vertex for every cell (a point in its interior), one simplex for every chain of
/// faces c_0 < c_1 < .. < c_n. Vertices come by dimension of their cell, then in the order of the cells; point_data has
/// "cell_dim". Source: BKW20, (25)-(26).
SimplicialMesh barycentric_subdivision(const CellComplex& complex);

/// A subdivision without new vertices: every cell is pulled at its vertex of least index (the cone from it over the
/// pulled facets that do not contain it). Neighbouring cells agree on common faces because the order of the vertices is
/// global. Source: Lee, Santos, Subdivisions and triangulations of polytopes (Handbook of Discrete and Computational
/// Geometry), pulling.
SimplicialMesh pulled_subdivision(const CellComplex& complex);

/// The cells themselves, for n = 1 (edges) and n = 2 (convex polygons, corners in cyclic order).
/// Throws InvalidInput for n >= 3, where a cell is no list of corners.
PolygonMesh polygon_mesh(const CellComplex& complex);

}  // namespace whitney
