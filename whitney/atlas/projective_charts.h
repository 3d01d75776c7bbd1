// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include <whitney/atlas/chart_atlas.h>
#include <whitney/functions/homogeneous_equations.h>

namespace whitney {

struct ProjectiveOptions {
  Field field = Field::kComplex;
  /// a_0 .. a_N > 0; empty: fixed numbers from 1 to 1.5 in no simple ratio.
  std::vector<double> weights{};
};

/// The zero set of homogeneous equations in the projective space of z_0 .. z_N, cut into N+1 charts.
///
/// Chart c ("z_c = 1", the name of that variable) has the coordinates w_j = z_j / z_c, j != c in order, over C each
/// with its real part x and imaginary part y; so d = N over R, 2N over C. It is cut off where another coordinate wins:
///
///     a_c |z_c| >= a_j |z_j|,   inequality number j (j < c) or j-1 (j > c):  (a_c/a_j)^2 - |w_j|^2 >= 0.
///
/// The charts cover projective space and overlap on seams only, where w goes to w / w_b; all of N (N+1) / 2 seams are
/// listed. The box of a chart leaves a quarter of the domain's width on either side.
///
/// Weights: the level sets a_c |z_c| = a_b |z_b| should cut the manifold transversally. With equal weights they often
/// do not: on the Fermat curves 1 + u^m + v^m = 0 the level |u| = 1 crosses itself where v = 0. Hence the default.
///
/// Embedding: the projector z z* / |z|^2 onto the line, in R^D, D = (N+1)(N+2)/2 over R and (N+1)^2 over C: first its
/// diagonal, p_i_i, then for i < j sqrt(2) times its entry (over C: real part re_i_j, imaginary part im_i_j). So
/// distances are those of matrices, and the unitary group acts by isometries.
///
/// Throws InvalidInput as compile_affine_charts() does, and on weights that are not N+1 positive numbers.
ChartAtlas projective_charts(std::span<const std::string> variables, std::span<const std::string> equations,
                             const ProjectiveOptions& options = {});

}  // namespace whitney
