// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <whitney/atlas/chart_atlas.h>
#include <whitney/io/formats/problem_entry.h>

namespace whitney::io {

/// The value of the key "projective".
ChartAtlas read_projective(const Entry& entry);

/// The keys "variables", "charts" and "seams" of a problem file.
ChartAtlas read_charts(const Entry& root);

}  // namespace whitney::io
