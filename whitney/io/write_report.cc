// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/write_report.h>

#include <sys/resource.h>

#include <nlohmann/json.hpp>

namespace whitney {
namespace {

using Json = nlohmann::ordered_json;

Json certificate_json(const CertificateStatistics& c) {
  Json out;
  out["verdict"] = c.verdict;
  out["margin_min"] = c.margin_min;
  out["margin_median"] = c.margin_median;
  out["displacement_max"] = c.displacement_max;
  out["rounds"] = c.rounds;
  out["vertices_near"] = c.vertices_near;
  out["vertices_moved"] = c.vertices_moved;
  out["reach"] = c.reach;
  out["curvature_radius"] = c.curvature_radius;
  out["reach_source"] = c.reach_source;
  out["edge_length_over_reach"] = c.edge_length_over_reach;
  out["hausdorff_bound"] = c.hausdorff_bound ? Json(*c.hausdorff_bound) : Json(nullptr);
  out["away_from_boundary"] = c.cut;
  out["reason"] = c.reason.empty() ? Json(nullptr) : Json(c.reason);
  out["witness"] = c.witness ? Json(*c.witness) : Json(nullptr);
  return out;
}

Json strata_json(const BoundaryStatistics& boundary) {
  Json list = Json::array();
  for (std::size_t s = 0; s < boundary.strata.size(); ++s) {
    const BoundaryStatistics::Piece& piece = boundary.strata[s];
    Json out;
    out["stratum"] = s;
    out["dim"] = piece.dim;
    out["inequalities"] = piece.inequalities;
    out["is_cut"] = piece.is_cut;
    out["cells"] = piece.num_cells;
    out["euler_characteristic"] = piece.euler_characteristic;
    out["faces"] = piece.faces;
    list.push_back(std::move(out));
  }
  return list;
}

Json charts_json(const std::vector<ChartStatistics>& charts) {
  Json list = Json::array();
  for (const ChartStatistics& chart : charts) {
    Json strata = Json::object(), out;
    for (const auto& [dim, count] : chart.strata_per_dim) strata[std::to_string(dim)] = count;
    out["name"] = chart.name;
    out["simplices"] = chart.simplices;
    out["strata_per_dim"] = strata;
    out["smallest_singular_value"] = chart.smallest_singular_value;
    out["singular_points"] = chart.singular_points;
    list.push_back(std::move(out));
  }
  return list;
}

Json seams_json(const std::vector<SeamStatistics>& seams) {
  Json list = Json::array();
  for (const SeamStatistics& seam : seams) {
    Json out;
    out["charts"] = {seam.first, seam.second};
    out["corners"] = seam.corners;
    out["arcs"] = seam.arcs;
    out["loops"] = seam.loops;
    out["worst_distance"] = seam.worst_distance;
    list.push_back(std::move(out));
  }
  return list;
}

Json quality_json(const ComplexQuality& q) {
  Json out;
  out["thickness_min"] = q.thickness_min;
  out["thickness_median"] = q.thickness_median;
  out["shortest_edge"] = q.shortest_edge;
  out["longest_edge"] = q.longest_edge;
  out["angle_max"] = q.angle_max;
  out["angle_median"] = q.angle_median;
  out["vertex_distance_max"] = q.vertex_distance_max;
  out["vertex_distance_median"] = q.vertex_distance_median;
  out["feet"] = q.feet;
  out["feet_missing"] = q.feet_missing;
  return out;
}

}  // namespace

std::string to_json(const Statistics& s) {
  const Topology& t = s.topology;
  Json out;
  out["ambient_dim"] = s.ambient_dim;
  out["intrinsic_dim"] = s.intrinsic_dim;
  out["edge_length"] = s.edge_length ? Json(*s.edge_length) : Json(nullptr);
  out["num_seeds_used"] = s.num_seeds_used;
  out["num_seeds_merged"] = s.num_seeds_merged;
  out["num_seeds_dropped"] = s.num_seeds_dropped;
  out["num_seeds_too_small"] = s.num_seeds_too_small;
  if (s.num_seeds_too_small > 0) {
    out["too_small_point"] = s.too_small_point;
    out["too_small_edge_length"] = s.too_small_edge_length > 0 ? Json(s.too_small_edge_length) : Json(nullptr);
  }
  Json per_dim = Json::object();
  for (const auto& [dim, count] : s.simplices_per_dim) per_dim[std::to_string(dim)] = count;
  out["simplices_per_dim"] = per_dim;
  out["f_vector"] = t.f_vector;
  out["euler_characteristic"] = t.euler_characteristic;
  out["components"] = t.components;
  out["boundary_components"] = s.boundary ? s.boundary->boundary_components : t.boundary_components;
  if (s.boundary) {
    out["cut_components"] = s.boundary->cut_components;
    out["strata"] = strata_json(*s.boundary);
    out["smallest_singular_value"] = s.boundary->smallest_singular_value;
    out["smallest_singular_point"] = s.boundary->smallest_singular_point;
    out["singular_points"] = s.boundary->singular_points;
  }
  out["interior_singular_value"] = s.interior_singular_value;
  out["interior_singular_points"] = s.interior_singular_points;
  if (!s.charts.empty()) {
    out["charts"] = charts_json(s.charts);
    out["seams"] = seams_json(s.seams);
  }
  out["is_closed_manifold"] = t.manifold == ManifoldKind::kNotChecked ? Json(nullptr) : Json(t.is_closed_manifold());
  out["is_manifold"] = t.manifold == ManifoldKind::kNotChecked ? Json(nullptr) : Json(t.is_manifold());
  if (t.witness) out["witness"] = {{"vertices", t.witness->face}, {"reason", t.witness->reason}};
  out["orientable"] = t.orientable;
  out["betti_z2"] = t.betti_z2 ? Json(*t.betti_z2) : Json(nullptr);
  if (t.homology_z) {
    Json groups = Json::array();
    for (const HomologyGroup& group : *t.homology_z) groups.push_back(to_string(group));
    out["homology_z"] = groups;
  } else {
    out["homology_z"] = nullptr;
  }
  out["certificate"] = s.certificate ? certificate_json(*s.certificate) : Json(nullptr);
  out["quality"] = s.quality ? quality_json(*s.quality) : Json(nullptr);
  out["oracle_evaluations"] = s.oracle_evaluations;
  out["seed_evaluations"] = s.seed_evaluations;
  out["distinct_vertices"] = s.distinct_vertices;
  out["exact_decisions"] = s.exact_decisions;
  out["seconds"] = s.seconds;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  out["peak_rss_bytes"] = std::size_t(usage.ru_maxrss) * 1024;
  out["threads"] = 1;
  out["stop_reason"] = s.stop_reason;
  return out.dump(2) + "\n";
}

}  // namespace whitney
