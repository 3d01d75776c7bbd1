// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <whitney/cells/cell_complex.h>
#include <whitney/cells/strata.h>
#include <whitney/topology/mesh.h>

namespace whitney {

// With strata, a mesh also gets its MeshStratum list, closed strata of all dimensions below n, point_data "stratum"
// (the stratum that a point lies in) and cell_data "stratum".

/// The barycentric subdivision: one vertex for every cell (a point in its interior), one simplex for every chain of
/// faces c_0 < c_1 < .. < c_n. Vertices come by dimension of their cell, then in the order of the cells; point_data has
/// "cell_dim". Source: BKW20, (25)-(26).
SimplicialMesh barycentric_subdivision(const CellComplex& complex, const Strata* strata = nullptr);

/// A subdivision without new vertices: every cell is pulled at its vertex of least index (the cone from it over the
/// pulled facets that do not contain it). Neighbouring cells agree on common faces because the order of the vertices is
/// global. Source: Lee, Santos, Subdivisions and triangulations of polytopes (Handbook of Discrete and Computational
/// Geometry), pulling.
SimplicialMesh pulled_subdivision(const CellComplex& complex, const Strata* strata = nullptr);

/// The cells themselves, for n = 1 (edges) and n = 2 (convex polygons, corners in cyclic order). With strata,
/// point_data and cell_data "stratum". Throws InvalidInput for n >= 3, where a cell is no list of corners.
PolygonMesh polygon_mesh(const CellComplex& complex, const Strata* strata = nullptr);

/// One closed stratum of a mesh that was made with strata, as a mesh of its own: the points it uses, in their order.
/// For a stratum of dimension n, the simplices whose cell_data "stratum" is its number. point_data comes along. Throws
/// InvalidInput when the mesh has no such stratum.
SimplicialMesh stratum_mesh(const SimplicialMesh& mesh, int stratum);

}  // namespace whitney
