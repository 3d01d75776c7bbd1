// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/cli/describe.h>

#include <cstdio>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>

namespace whitney::cli {
namespace {

std::string plural(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// "1.5 GB".
std::string bytes_text(std::uint64_t bytes) {
  char text[32];
  const auto value = static_cast<double>(bytes);
  if (value >= 1e9)
    std::snprintf(text, sizeof text, "%.1f GB", value / 1e9);
  else
    std::snprintf(text, sizeof text, "%.0f MB", value / 1e6);
  return text;
}

std::string kind_of(const Topology& t, int n) {
  const std::string noun = n == 1 ? "curve" : n == 2 ? "surface" : std::to_string(n) + "-manifold";
  switch (t.manifold) {
    case ManifoldKind::kClosed:
      return "closed " + std::string(t.orientable ? "orientable " : "non-orientable ") + noun;
    case ManifoldKind::kWithBoundary:
      return std::string(t.orientable ? "orientable " : "non-orientable ") + noun + " with " +
             plural(t.boundary_components, "boundary component");
    case ManifoldKind::kSingular:
      return "not a manifold (" + std::to_string(t.singular_vertices) + " singular " +
             (t.singular_vertices == 1 ? "vertex" : "vertices") + ")";
    case ManifoldKind::kNotChecked:
      break;
  }
  return "complex of dimension " + std::to_string(n) + ", links not checked";
}

/// What of M the complex is homeomorphic to.
std::string proved_part(const CertificateSummary& c) {
  std::string part = c.components == "connected_by_definition" ? "the manifold"
                     : c.components == "seeds_searched"
                         ? "the components of the manifold that the seeds lie on (searched for: likely all, not proved)"
                         : "the components of the manifold that the seeds lie on";
  if (c.cut) part = "the part of " + part + " in its simplices, which end just beyond the inequalities";
  return part;
}

/// What the verdict rests on beyond what is proved: ", if .. and ..", or nothing.
std::string conditions(const CertificateSummary& c) {
  std::ostringstream text;
  text.precision(4);
  const bool given = c.reach_source == "caller", estimated = c.reach_source == "estimated";
  if (given) text << "if the reach is at least " << c.reach << " as the caller says";
  if (estimated) text << "if the reach is at least " << c.reach << ", an estimate";
  if (c.feet_source == "modelled")
    text << (given || estimated ? " and " : "if ") << "the errors of the feet are at most what a model says";
  return text.str();
}

}  // namespace

std::string describe_topology(const Report& report) {
  if (report.topology_level == TopologyLevel::kNone) return "";
  const Topology& t = report.topology;
  const int n = report.intrinsic_dim;
  std::string text = kind_of(t, n) + ", " + plural(t.components, "component") + ", Euler characteristic " +
                     std::to_string(t.euler_characteristic);
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

std::string describe_boundary(const BoundarySummary& boundary) {
  std::map<int, std::size_t, std::greater<>> per_dim;
  for (const auto& piece : boundary.strata) ++per_dim[piece.dim];
  std::string text = "strata:";
  for (const auto& [dim, count] : per_dim)
    text += " " + std::to_string(count) + " of dimension " + std::to_string(dim) + ",";
  text.back() = ';';
  text += " boundary components: " + std::to_string(boundary.boundary_components) + " of the inequalities";
  if (boundary.cut_components > 0) text += ", " + std::to_string(boundary.cut_components) + " where the box cuts";
  text += "\n";
  constexpr std::size_t kMaxListed = 24;
  for (std::size_t s = 0; s < boundary.strata.size() && boundary.strata.size() <= kMaxListed; ++s) {
    const auto& piece = boundary.strata[s];
    text += "  " + std::to_string(s) + ": dimension " + std::to_string(piece.dim);
    for (std::size_t i = 0; i < piece.inequalities.size(); ++i)
      text += (i == 0 ? ", on " : " and ") + piece.inequalities[i];
    text += (piece.is_cut ? " (cut by the box)" : "") + std::string(", ") + plural(piece.num_cells, "cell");
    if (!piece.faces.empty()) text += ", bounded by";
    for (std::uint32_t face : piece.faces) text += " " + std::to_string(face);
    text += "\n";
  }
  if (!boundary.smallest_singular_point.empty())
    text += "least singular value along the boundary: " + number(boundary.smallest_singular_value) + " at " +
            point_text(boundary.smallest_singular_point) + "\n";
  for (const std::vector<double>& point : boundary.singular_points)
    text += "the boundary is SINGULAR at " + point_text(point) +
            ": it crosses or touches itself there, and the mesh is one resolution of it among several\n";
  return text;
}

std::string describe_seams(const Report& report) {
  std::ostringstream text;
  for (const SeamSummary& seam : report.seams)
    text << "  seam of " << seam.first << " and " << seam.second << ": " << seam.corners << " corners, " << seam.arcs
         << " arcs, " << seam.loops << " loops, at most " << seam.worst_distance << " apart\n";
  return text.str();
}

std::string describe_singular_charts(const Report& report) {
  std::string text;
  for (const ChartSummary& chart : report.charts)
    for (const auto& point : chart.singular_points)
      text += "the boundary of chart " + chart.name + " is SINGULAR at " + point_text(point) +
              ": what was glued there is one resolution of it among several\n";
  return text;
}

std::string describe_seeds(const Report& report) {
  const SeedSummary& seeds = report.seeds;
  std::string text;
  if (seeds.searched)
    text = "seeds: searched for (" + std::to_string(seeds.num_starts) + " starts), " + std::to_string(seeds.num_used) +
           " used; that every component was found is likely, not proved\n";
  for (const std::string& seed : seeds.dropped) text += seed + "\n";
  if (seeds.num_too_small == 0) return text;
  char finer[32];
  std::snprintf(finer, sizeof finer, "%.3g", seeds.finer_edge_length);
  return text + std::to_string(seeds.num_too_small) + (seeds.num_too_small == 1 ? " seed lies" : " seeds lie") +
         " on parts too small for this edge length, e.g. at " + point_text(seeds.too_small_point) +
         (seeds.finer_edge_length > 0 ? ": try L <= " + std::string(finer) : "") + "\n";
}

std::string describe_singular_points(const Report& report) {
  std::string text;
  for (const auto& point : report.interior_singular_points)
    text += report.charts.empty()
                ? "the zero set is SINGULAR at " + point_text(point) +
                      ": it crosses or touches itself or has a tip there, and the mesh is one "
                      "resolution of it among several\n"
                : "the zero set of a chart is SINGULAR at " + point_text(point) + ", in the chart's coordinates\n";
  return text;
}

std::string describe_certificate(const Report& report) {
  const CertificateSummary& c = *report.certificate;
  const double edge_length = *report.edge_length;
  std::ostringstream text;
  text.precision(4);
  const std::string rest = conditions(c);
  text << c.verdict << (c.cut ? " away from the boundary" : "");
  if (c.verdict == "certified") {
    text << (rest.empty() ? ": " : ", " + rest + ": ") << "the complex is homeomorphic to " << proved_part(c);
    if (c.reach_source == "proven") text << ", given its reach " << c.reach << " (proven)";
    text << "\n  margins: worst " << c.margin_min << ", median " << c.margin_median;
    if (c.hausdorff_bound) text << "; Hausdorff distance at most " << *c.hausdorff_bound;
    text << "\n";
  } else {
    text << ": " << c.reason << "\n  margins: worst " << c.margin_min << ", median " << c.margin_median
         << "; above 1 is certified\n";
    if (!c.reach_contradicted) text << "  next: --edge-length " << edge_length / 2 << ", or --auto-refine\n";
  }
  text << "  edge length / reach " << c.edge_length_over_reach << ", " << report.simplices_met << " simplices of R^"
       << report.ambient_dim << " meet the manifold, " << c.vertices_moved << " of " << c.vertices_near
       << " vertices moved, by at most " << c.displacement_max << " edge lengths\n";
  return text.str();
}

std::string describe_quality(const ComplexQuality& quality) {
  const double degrees = 180 / std::numbers::pi;
  std::ostringstream text;
  text.precision(3);
  text << "quality: thickness worst " << quality.thickness_min << ", median " << quality.thickness_median
       << "; angle with the tangent spaces worst " << quality.angle_max * degrees << ", median "
       << quality.angle_median * degrees << " degrees; edges " << quality.shortest_edge << " to "
       << quality.longest_edge << "\n";
  return text.str();
}

std::string describe_stop(const Report& report) {
  std::string text;
  if (report.stop_reason == StopReason::kBox)
    text += std::string("the manifold reaches the box and was cut there") +
            (report.whole_cells ? "" : ", at whole simplices where f has no value outside it") + "\n";
  if (report.cut_short)
    text += std::string("stopped early (") + to_string(report.stop_reason) + "): the mesh is part of the manifold" +
            (report.charts.empty() ? "" : ", the pieces are not glued") + "\n";
  for (const Omission& omission : report.left_out) {
    text += "left out: " + omission.what + " (" + to_string(omission.reason);
    if (omission.estimated_bytes > 0) text += ", would take about " + bytes_text(omission.estimated_bytes);
    text += ")\n";
  }
  return text;
}

}  // namespace whitney::cli
