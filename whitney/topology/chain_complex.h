// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <whitney/topology/incidence.h>

namespace whitney {

/// A complex is given by `facets`, one Incidence per dimension 0..n: facets[j][i] are the (j-1)-cells in the boundary
/// of the j-cell i; the lists of facets[0] are empty. It must be a regular CW complex: every cell is a ball, its
/// boundary a sphere made of its faces. Simplicial, cubical and polytopal complexes are.

/// signs[j][e] is +1 or -1, the incidence number of the entry facets[j].index[e]:
/// boundary(cell) = sum of sign x facet, and boundary(boundary(cell)) = 0.
using IncidenceSigns = std::vector<std::vector<std::int8_t>>;

/// Throws InvalidInput unless the lists are well formed: no facets of 0-cells, facet indices in range, no facet twice.
void require_well_formed(std::span<const Incidence> facets);

/// (-1)^k for the k-th facet: right when every k-th facet leaves out the k-th vertex, as in a FaceLattice.
IncidenceSigns simplicial_signs(std::span<const Incidence> facets);

/// Signs of a regular CW complex, carried inside each cell from facet to facet across the ridges between them: a ridge
/// lies in exactly two facets of the cell (the diamond property) and must cancel there. The first facet of a cell of
/// dimension >= 2 gets +1, an edge runs from its first to its second vertex.
/// Throws InvalidInput with the cell where the complex is not regular: an edge without two vertices, a cell with a
/// ridge in one or three of its facets, with a boundary that is not connected or not orientable, or a 3-cell with a
/// boundary that is not a sphere. (For cells of dimension >= 4 that a boundary of these properties is a sphere is not
/// tested.)
IncidenceSigns regular_cell_signs(std::span<const Incidence> facets);

/// Whether boundary(boundary(cell)) = 0 for every cell.
bool boundary_squared_is_zero(std::span<const Incidence> facets, const IncidenceSigns& signs);

}  // namespace whitney
