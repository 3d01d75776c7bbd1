// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace whitney::io {

/// Stops of the colour scale, evenly spaced over [0, 1], sRGB in [0, 1]: dark blue over green-blue to yellow, ever
/// lighter, so that it can be read in grey and by the colour-blind too.
inline constexpr std::array<std::array<double, 3>, 6> kColorStops = {{{0.21, 0.18, 0.49},
                                                                      {0.20, 0.36, 0.62},
                                                                      {0.16, 0.54, 0.63},
                                                                      {0.30, 0.71, 0.54},
                                                                      {0.66, 0.83, 0.36},
                                                                      {0.98, 0.89, 0.30}}};

/// The colour of t in [0, 1], sRGB in [0, 1].
inline std::array<double, 3> color_of(double t) {
  const double position = std::clamp(t, 0.0, 1.0) * (kColorStops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(position), kColorStops.size() - 2);
  const double s = position - static_cast<double>(i);
  std::array<double, 3> color{};
  for (std::size_t k = 0; k < 3; ++k) color[k] = (1 - s) * kColorStops[i][k] + s * kColorStops[i + 1][k];
  return color;
}

}  // namespace whitney::io
