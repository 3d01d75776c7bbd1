// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <whitney/cells/cell_complex.h>
#include <whitney/problem/report.h>
#include <whitney/topology/mesh.h>

namespace whitney {

// What the phases of a run take, in bytes beyond what is held when they begin. Estimates with room above, no bounds:
// numbers of cells from the averages over the triangulation, times rough sizes in bytes (memory_estimate.cc).

/// Cells of dimension j that a k-simplex met gives rise to, on average over the triangulation of R^d. Of the
/// m-simplices around it, m = k + j, each is shared by the k-simplices of it that are met: C(m+1, k+1) 2^-k / P of
/// them, where 1 - P = 2^-m sum_{i<k} C(m, i) is the chance that m + 1 random points of R^k do not have 0 in their hull
/// (Wendel 1962).
double cells_per_simplex(int ambient_dim, int codim, int cell_dim);

/// Cell complex, mesh and its orientation, per k-simplex met.
double work_bytes_per_simplex(int ambient_dim, int codim, MeshKind kind);

/// The same per d-simplex met.
double work_bytes_per_top_simplex(int ambient_dim, int codim, MeshKind kind);

/// The mesh of a complex and its orientation.
std::uint64_t mesh_bytes(const CellComplex& complex, MeshKind kind);

/// The faces of a mesh and their counts.
std::uint64_t face_bytes(const SimplicialMesh& mesh);

/// Homology of a complex with so many cells of each dimension.
std::uint64_t homology_bytes(const std::vector<std::size_t>& f_vector);

/// The links of the vertices of a simplicial complex with so many faces of each dimension.
std::uint64_t link_bytes(const std::vector<std::size_t>& f_vector);

}  // namespace whitney
