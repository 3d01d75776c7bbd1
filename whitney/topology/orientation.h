// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <whitney/topology/incidence.h>
#include <whitney/topology/mesh.h>

namespace whitney {

/// How the top cells of a complex fit together. Cells are neighbours when a facet lies in these two top cells and no
/// other: a facet in three or more connects and constrains nothing, so that each sheet is oriented by itself.
struct CellOrientation {
  std::vector<std::uint32_t> component;  ///< of each top cell; numbered by their first cells
  std::vector<std::int8_t> sign;         ///< of each top cell: with it, neighbours cancel in their common facet
  std::vector<bool> orientable;          ///< of each component; if not, its signs are +1
  bool all_orientable() const;
};

/// Orients the top cells with the given facets and signs (see chain_complex.h). The first cell of a component is +1.
/// Throws InvalidInput when a facet is not below num_facets, or there is not one sign per facet.
CellOrientation orient_cells(const Incidence& facets, std::span<const std::int8_t> signs, std::size_t num_facets);

/// A mesh, oriented component by component.
struct OrientedMesh {
  SimplicialMesh mesh;
  std::vector<std::uint32_t> component;  ///< of each simplex, as in CellOrientation
  std::vector<bool> orientable;          ///< of each component; if not, its simplices are left as they were
  bool all_orientable() const;
};

/// The mesh with the last two vertices swapped in some simplices, so that in every orientable component two simplices
/// with a common facet induce opposite orientations on it. The first simplex of a component keeps its order, so the
/// result depends on the mesh only, and an oriented mesh comes back as it was.
/// Throws InvalidInput as face_lattice() does.
OrientedMesh orient(SimplicialMesh mesh);

/// +1 or -1 for each `length` indices of `simplices`: the sign of the permutation that sorts them.
std::vector<std::int8_t> sorting_signs(std::span<const std::uint32_t> simplices, int length);

}  // namespace whitney
