// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/cli/report.h>

namespace whitney::cli {

std::string describe(const Topology& t, int n) {
  auto plural = [](std::size_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
  };
  const std::string noun = n == 1 ? "curve" : n == 2 ? "surface" : std::to_string(n) + "-manifold";
  std::string text;
  switch (t.manifold) {
    case ManifoldKind::kClosed:
      text = "closed " + std::string(t.orientable ? "orientable " : "non-orientable ") + noun;
      break;
    case ManifoldKind::kWithBoundary:
      text = std::string(t.orientable ? "orientable " : "non-orientable ") + noun + " with " +
             plural(t.boundary_components, "boundary component");
      break;
    case ManifoldKind::kSingular:
      text = "not a manifold (" + std::to_string(t.singular_vertices) + " singular " +
             (t.singular_vertices == 1 ? "vertex" : "vertices") + ")";
      break;
    case ManifoldKind::kNotChecked:
      text = noun + ", links not checked";
      break;
  }
  text += ", " + plural(t.components, "component") + ", Euler characteristic " + std::to_string(t.euler_characteristic);
  if (t.manifold == ManifoldKind::kClosed && n == 2 && t.components == 1)
    text += t.orientable ? ", genus " + std::to_string((2 - t.euler_characteristic) / 2) : "";
  text += "\n";
  if (t.is_manifold() && !t.links_proved)
    text += "  (some vertex links are only known to have the homology of a sphere or ball)\n";
  if (t.witness) {
    text += "  at vertices";
    for (std::uint32_t v : t.witness->face) text += " " + std::to_string(v);
    text += ": " + t.witness->reason + "\n";
  }
  text += "cells by dimension:";
  for (std::size_t count : t.f_vector) text += " " + std::to_string(count);
  text += "\n";
  if (t.homology_z) {
    text += "homology:";
    for (std::size_t j = 0; j < t.homology_z->size(); ++j)
      text += (j ? ", H" : " H") + std::to_string(j) + " = " + to_string((*t.homology_z)[j]);
    text += "\n";
  }
  if (t.unused_points > 0) text += plural(t.unused_points, "point") + " not used by any simplex\n";
  return text;
}

}  // namespace whitney::cli
