// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <whitney/functions/function.h>
#include <whitney/topology/orientation.h>

namespace whitney {

/// The mesh of (part of) f = 0, oriented by f: in every orientable component, a positively ordered tangent basis
/// followed by the rows of Df is a positive basis of R^d. For a surface f = 0 in R^3, faces look towards f > 0. Decided
/// at the largest simplex of each component; a component whose largest simplex has no volume is left as orient() made
/// it. mesh.dim + f.codim() must be mesh.ambient_dim; throws InvalidInput otherwise, and as orient() does.
OrientedMesh orient_by_function(SimplicialMesh mesh, const Function& f);

}  // namespace whitney
