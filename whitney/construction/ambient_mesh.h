// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include <coxeter/triangulation.h>
#include <perturbation/displacement.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/topology/mesh.h>

namespace whitney {

/// A mesh of d-simplices in R^d of which K = barycentric_subdivision(complex) is a subcomplex.
struct AmbientMesh {
  /// dim = ambient_dim = d. The first num_complex_points points are those of K, bit for bit, in its order: a simplex of
  /// K has the same indices here. point_data: "complex_point", the index in K or -1, and "face_dim", the dimension of
  /// the face of T~ that holds the point in its interior.
  SimplicialMesh mesh;
  std::size_t num_complex_points = 0;
  /// Simplices with a determinant that is not positive, decided exactly for the coordinates as stored. All simplices
  /// are positively oriented by combinatorics, so 0 unless rounding has folded one.
  std::size_t not_positive = 0;
};

/// The ambient mesh around M: every d-simplex of T~ that M meets, cut into (d+1)! simplices, one for every chain of its
/// faces. A face that M meets is represented by its vertex of K, any other by the barycentre of its displaced vertices.
/// Source: BKW20, Sect. 2.2.
///
/// Triangulation and displacements: those that `complex` came from (TriangulateResult::displacements). The complex of a
/// trace will do too, without displacements; where f vanishes at lattice vertices, simplices are degenerate.
/// (d+1)! simplices of d + 1 indices for every n-cell: O(that) time and memory.
/// Throws InvalidInput unless 2 <= d <= 4 and the dimensions agree.
AmbientMesh ambient_mesh(const CellComplex& complex, const coxeter::Triangulation& triangulation,
                         const perturbation::DisplacementMap& displacements);

/// Whether every simplex of `part` is a face of a simplex of `whole`, which has the same points (bit for bit) under the
/// same indices.
bool is_subcomplex(const SimplicialMesh& part, const SimplicialMesh& whole);

/// The number of d-simplices in R^d whose determinant det(p_1 - p_0, .., p_d - p_0) is not positive. Exact, 1 <= d <=
/// 4, else InvalidInput.
std::size_t count_not_positive(const SimplicialMesh& mesh);

}  // namespace whitney
