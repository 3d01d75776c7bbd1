// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <whitney/construction/ambient_mesh.h>

namespace whitney {

/// The inside of a closed hypersurface K (n = d - 1, d <= 4) as a mesh of d-simplices of which K is the boundary: for a
/// surface in R^3, tetrahedra. A point is inside when paths from it to infinity cross K an odd number of times; between
/// nested components every second layer is.
///
/// The simplices of T~ that K crosses are cut as in ambient_mesh() and what lies inside is kept; a simplex of T~ inside
/// that shares an edge with a cut one is cut where they meet (see SplitFaces), all others are taken whole. Same points
/// and point_data as ambient_mesh().
///
/// The search runs over all lattice vertices in the box (in lattice coordinates) around K: O((size / L)^d) time, and a
/// byte each. Throws InvalidInput unless n = d - 1 and 2 <= d <= 4, when the dimensions differ, when K is not closed (a
/// trace that was cut short), and for a box of more than 2^31 vertices.
AmbientMesh inside_mesh(const CellComplex& complex, const coxeter::Triangulation& triangulation,
                        const perturbation::DisplacementMap& displacements);

}  // namespace whitney
