// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <whitney/problem/report.h>
#include <whitney/problem/triangulate_problem.h>

// Reports for a person to read: lines, each ending in a newline.

namespace whitney::cli {

/// "closed orientable surface, 1 component, Euler characteristic -6" and the homology; what was left out is not there.
std::string describe_topology(const Report& report);

/// How many strata of which dimension, how they fit together, where the boundary is singular.
std::string describe_boundary(const BoundarySummary& boundary);

/// Seams, and where the boundary of a chart is singular.
std::string describe_seams(const Report& report);
std::string describe_singular_charts(const Report& report);

/// Where the zero set is singular.
std::string describe_singular_points(const Report& report);

/// Whether seeds were searched for, which were dropped.
std::string describe_seeds(const Report& report);

/// The verdict with what it rests on, and what to try next.
std::string describe_certificate(const Report& report);

std::string describe_quality(const ComplexQuality& quality);

/// Which limit stopped the run, what that makes of the mesh, and what was left out.
std::string describe_stop(const Report& report);

}  // namespace whitney::cli
