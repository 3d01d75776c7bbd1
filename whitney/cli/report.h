// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <whitney/topology/topology.h>

namespace whitney::cli {

/// "closed orientable surface, 1 component, Euler characteristic -6" and the homology, a line each, for a person to
/// read.
std::string describe(const Topology& topology, int intrinsic_dim);

}  // namespace whitney::cli
