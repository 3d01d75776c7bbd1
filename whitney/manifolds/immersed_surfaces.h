// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <whitney/manifolds/submanifold.h>

namespace whitney {

// Two closed surfaces that do not embed in R^3, in R^4: neither is orientable, so neither is a regular zero set.
//
// Their bending is measured, not proved (kEstimated): Federer's quotient on 10^7 pairs of points, one of each pair up
// to symmetry, and descents from the least, found nothing below the values given by more than 1e-12. That the reach is
// not larger is clear: the surfaces contain plane circles of these radii whose centres lie on the normals.

/// ((2 + cos v) cos u, (2 + cos v) sin u, sin v cos(u/2), sin v sin(u/2)), u and v in [0, 2 pi]: the Klein bottle.
/// chi 0, H_1 = Z + Z/2. Turning u by s and the last two coordinates by s/2 takes it to itself.
/// Reach and curvature radius 1: attained on every circle u = const.
Submanifold klein_bottle();

/// (x y, x z, y^2 - z^2, 2 y z) for x^2 + y^2 + z^2 = 1: the projective plane. chi 1, H_1 = Z/2.
/// Reach and curvature radius 1/2: attained on the image of every great circle through (1, 0, 0).
Submanifold projective_plane();

}  // namespace whitney
