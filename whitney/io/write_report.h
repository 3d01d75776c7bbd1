// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <whitney/problem/report.h>

namespace whitney {

/// A report as JSON text, one key a line, ending in a newline; what was not computed is null. Adds peak_rss_bytes of
/// this process.
std::string to_json(const Report& report);

}  // namespace whitney
