// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/report.h>

#include <algorithm>
#include <cstdio>

namespace whitney {

bool Report::singular() const {
  return !interior_singular_points.empty() || (boundary && !boundary->singular_points.empty()) ||
         std::any_of(charts.begin(), charts.end(), [](const auto& chart) { return !chart.singular_points.empty(); });
}

std::string point_text(const std::vector<double>& point) {
  std::string text = "(";
  for (std::size_t c = 0; c < point.size(); ++c) {
    char number[32];
    std::snprintf(number, sizeof number, "%.6g", point[c]);
    text.append(c > 0 ? ", " : "").append(number);
  }
  return text + ")";
}

const char* to_string(TopologyLevel level) {
  switch (level) {
    case TopologyLevel::kNone:
      return "none";
    case TopologyLevel::kEuler:
      return "euler";
    case TopologyLevel::kFull:
      return "full";
  }
  return "unknown";
}

}  // namespace whitney
