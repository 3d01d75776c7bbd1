// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include <coxeter/base/matrix.h>
#include <whitney/manifolds/submanifold.h>

namespace whitney {

// Manifolds of small matrices (up to 8 x 8) in the Frobenius metric, with the foot by eigenvectors or by the polar
// factor. Bending is exact (Bending::Source::kProven), by Federer's formula (see closed_form_manifolds.h).

/// Gr(p, q): orthogonal projectors A (symmetric q x q, A^2 = A) of trace p, as points of R^d, d = q(q+1)/2 - 1:
/// coordinates of A - (p/q) I in an orthonormal basis of the symmetric matrices of trace 0 (see symmetric_coordinates).
/// Dimension n = p (q - p). p = 1 is the real projective space RP^(q-1). 1 <= p < q <= 8, else InvalidInput.
///
/// Foot: the projector on the eigenvectors of the p largest eigenvalues. Medial axis: lambda_p = lambda_(p+1).
/// Reach and curvature radius 1/sqrt(2), for all p and q: for projectors P, Q with principal angles t_i,
/// |Q - P|^2 = 2 sum s_i, s_i = sin^2 t_i, and the part of Q - P normal to T_P = {X: PXP = 0, (I-P)X(I-P) = 0} consists
/// of PQP - P and (I-P)Q(I-P), each of squared length sum s_i^2. Federer's quotient is
/// sum s_i / (sqrt(2) sqrt(sum s_i^2)) >= 1/sqrt(2), with equality whenever one angle alone is not 0, in the limit
/// t -> 0 too.
Submanifold grassmann(int p, int q);

/// Gr(1, 3): the real projective plane in R^5 (the Veronese surface, scaled to reach 1/sqrt(2)).
/// For p = 1 Federer's quotient is 1/sqrt(2) for *every* pair of points.
Submanifold projective_plane_projectors();

/// V(p, q): q x p matrices with orthonormal columns, in R^(q p), column after column. 1 <= p < q <= 8. Dimension
/// n = p q - p (p+1)/2. V(1, q) is the sphere S^(q-1), V(2, 3) = RP^3 the pairs (u, v) of `so3_vectors`.
///
/// Foot: the polar factor U V^T of X = U S V^T. Medial axis: rank X < p.
/// Reach and curvature radius 1: move P to (I; 0), and let Q = (A; B). |Q - P|^2 = 2 tr S with S = I - (A + A^T)/2, and
/// the part of Q - P normal to T_P is -S. As |A| <= 1, S has eigenvalues s_i >= 0; Federer's quotient is
/// sum s_i / sqrt(sum s_i^2) >= 1, with equality for S of rank 1 (one column turned out of the others' span).
Submanifold stiefel(int p, int q);

/// SO(q): q x q rotation matrices in R^(q q), column after column. 2 <= q <= 8. Dimension q (q-1)/2.
///
/// Foot: U diag(1, .., 1, det(U V^T)) V^T. Medial axis: s_(q-1) + s_q det(U V^T) = 0 for the two smallest singular
/// values. Reach and curvature radius sqrt(2): as for stiefel, but the eigenvalues of a rotation A come in pairs exp(i
/// t), exp(-i t) (-1 an even number of times, 1 besides), so the s_i = 1 - cos t do, and sum s_i / sqrt(sum s_i^2) =
/// sqrt(2) sum_pairs s_j / sqrt(sum_pairs s_j^2) >= sqrt(2), equality for turns in one plane.
Submanifold special_orthogonal(int q);

/// SO(3) in R^9: RP^3.
Submanifold so3_matrices();

/// Coordinates (q(q+1)/2 - 1) of the trace-free part of a symmetric q x q matrix A in an orthonormal basis: first
/// (A_11 + .. + A_kk - k A_(k+1)(k+1)) / sqrt(k (k+1)) for k = 1 .. q-1, then sqrt(2) A_ij for i < j, row by row.
std::vector<double> symmetric_coordinates(const Matrix& A);

/// The symmetric q x q matrix with these coordinates and this trace. Throws InvalidInput when the size is no
/// q(q+1)/2 - 1 for the given q >= 2.
Matrix symmetric_matrix(std::span<const double> coordinates, int q, double trace);

}  // namespace whitney
