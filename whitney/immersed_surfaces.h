// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <whitney/submanifold.h>

namespace whitney {

// Two closed surfaces that do not embed in R^3, in R^4: neither is orientable, so neither is a regular zero set.

/// ((2 + cos v) cos u, (2 + cos v) sin u, sin v cos(u/2), sin v sin(u/2)), u and v in [0, 2 pi]: the Klein bottle.
/// chi 0, H_1 = Z + Z/2. Its parametrization has period 4 pi in u and covers it twice.
Submanifold klein_bottle();

/// (x y, x z, y^2 - z^2, 2 y z) for x^2 + y^2 + z^2 = 1: the projective plane. chi 1, H_1 = Z/2.
Submanifold projective_plane();

}  // namespace whitney
