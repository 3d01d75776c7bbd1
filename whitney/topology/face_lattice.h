// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <whitney/topology/incidence.h>
#include <whitney/topology/mesh.h>

namespace whitney {

/// All faces of a simplicial mesh, each once. The faces of one dimension are numbered in the order in which the list of
/// simplices meets them, 0-faces by increasing vertex index; points that no simplex uses are not faces.
struct FaceLattice {
  /// vertices[j]: num_faces(j) x (j+1) vertex indices of the mesh, ascending in every face.
  /// The top faces keep the order of the simplices of the mesh.
  std::vector<std::vector<std::uint32_t>> vertices;
  /// facets[j][i]: the (j-1)-faces of j-face i; the k-th leaves out its k-th vertex, so its standard sign is (-1)^k.
  /// Empty lists for j = 0.
  std::vector<Incidence> facets;

  std::size_t num_faces(int j) const { return facets[j].size(); }
};

/// The faces of dimension `min_dim` to dim of `num_simplices x (dim+1)` vertex indices below `num_vertices`; entries of
/// the result below `min_dim` stay empty, and so do the lists of facets[min_dim].
/// Throws InvalidInput: an index out of range, a simplex with a repeated vertex, two simplices with the same vertices.
FaceLattice face_lattice(int dim, std::span<const std::uint32_t> simplices, std::size_t num_vertices, int min_dim = 0);

/// The same for a mesh.
FaceLattice face_lattice(const SimplicialMesh& mesh, int min_dim = 0);

}  // namespace whitney
