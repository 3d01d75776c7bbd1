// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <coxeter/simplex.h>

namespace whitney::coxeter {

// Closed-form counts. They are doubles: exact up to 2^53, correctly rounded up to a few ulps beyond, infinity where the
// number exceeds the range of double. S denotes the Stirling numbers of the second kind.

/// parts! S(elements, parts): ordered partitions of a set. 0 unless 1 <= parts <= elements, but 1 for the empty set in
/// 0 parts.
double num_ordered_partitions(int elements, int parts);

/// C(simplex_dim + 1, face_dim + 1): faces of a simplex. 0 unless 0 <= face_dim <= simplex_dim.
double num_faces(int simplex_dim, int face_dim);

/// Cofaces of a simplex: the sum, over all ways to cut its parts of sizes s_0 .. s_m into coface_dim + 1 pieces
/// together, j_0 .. j_m of them, of the product of j_q! S(s_q, j_q). 0 unless dim <= coface_dim <= ambient_dim.
double num_cofaces(const Simplex& simplex, int coface_dim);

/// m! S(d+1, m+1): the m-simplices with a given lattice vertex as base.
double num_simplices_per_base(int ambient_dim, int dim);

/// (m+1)! S(d+1, m+1): the m-simplices that contain a given lattice vertex.
double num_simplices_in_star(int ambient_dim, int dim);

}  // namespace whitney::coxeter
