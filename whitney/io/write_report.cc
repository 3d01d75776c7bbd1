// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/write_report.h>

#include <string>
#include <sys/resource.h>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace whitney {
namespace {

using Json = nlohmann::ordered_json;

Json certificate_json(const CertificateSummary& c) {
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
  out["feet_source"] = c.feet_source;
  out["feet_place"] = c.feet_place;
  out["components"] = c.components;
  out["edge_length_over_reach"] = c.edge_length_over_reach;
  out["hausdorff_bound"] = c.hausdorff_bound ? Json(*c.hausdorff_bound) : Json(nullptr);
  out["away_from_boundary"] = c.cut;
  out["reason"] = c.reason.empty() ? Json(nullptr) : Json(c.reason);
  out["witness"] = c.witness ? Json(*c.witness) : Json(nullptr);
  return out;
}

Json strata_json(const BoundarySummary& boundary) {
  Json list = Json::array();
  for (std::size_t s = 0; s < boundary.strata.size(); ++s) {
    const BoundarySummary::Piece& piece = boundary.strata[s];
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

Json charts_json(const std::vector<ChartSummary>& charts) {
  Json list = Json::array();
  for (const ChartSummary& chart : charts) {
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

Json seams_json(const std::vector<SeamSummary>& seams) {
  Json list = Json::array();
  for (const SeamSummary& seam : seams) {
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

Json omissions_json(const std::vector<Omission>& left_out) {
  Json list = Json::array();
  for (const Omission& omission : left_out) {
    Json out;
    out["what"] = omission.what;
    out["reason"] = to_string(omission.reason);
    out["estimated_bytes"] = omission.estimated_bytes > 0 ? Json(omission.estimated_bytes) : Json(nullptr);
    list.push_back(std::move(out));
  }
  return list;
}

/// What `topology` says, as far as it was computed.
void add_topology(const Report& r, Json& out) {
  const Topology& t = r.topology;
  const bool counted = r.topology_level != TopologyLevel::kNone, linked = t.manifold != ManifoldKind::kNotChecked;
  out["topology"] = to_string(r.topology_level);
  out["f_vector"] = counted ? Json(t.f_vector) : Json(nullptr);
  out["euler_characteristic"] = counted ? Json(t.euler_characteristic) : Json(nullptr);
  out["components"] = counted ? Json(t.components) : Json(nullptr);
  out["boundary_components"] = r.boundary ? Json(r.boundary->boundary_components)
                               : counted  ? Json(t.boundary_components)
                                          : Json(nullptr);
  if (r.boundary) {
    out["cut_components"] = r.boundary->cut_components;
    out["strata"] = strata_json(*r.boundary);
    out["smallest_singular_value"] = r.boundary->smallest_singular_value;
    out["smallest_singular_point"] = r.boundary->smallest_singular_point;
    out["singular_points"] = r.boundary->singular_points;
  }
  out["interior_singular_value"] = r.interior_searched ? Json(r.interior_singular_value) : Json(nullptr);
  out["interior_singular_points"] = r.interior_searched ? Json(r.interior_singular_points) : Json(nullptr);
  if (!r.charts.empty()) {
    out["charts"] = charts_json(r.charts);
    out["seams"] = seams_json(r.seams);
  }
  out["is_closed_manifold"] = linked ? Json(t.is_closed_manifold()) : Json(nullptr);
  out["is_manifold"] = linked ? Json(t.is_manifold()) : Json(nullptr);
  if (t.witness) out["witness"] = {{"vertices", t.witness->face}, {"reason", t.witness->reason}};
  out["orientable"] = counted ? Json(t.orientable) : Json(nullptr);
  out["betti_z2"] = t.betti_z2 ? Json(*t.betti_z2) : Json(nullptr);
  out["homology_z"] = nullptr;
  if (!t.homology_z) return;
  Json groups = Json::array();
  for (const HomologyGroup& group : *t.homology_z) groups.push_back(to_string(group));
  out["homology_z"] = std::move(groups);
}

}  // namespace

std::string to_json(const Report& r) {
  Json out;
  out["ambient_dim"] = r.ambient_dim;
  out["intrinsic_dim"] = r.intrinsic_dim;
  out["edge_length"] = r.edge_length ? Json(*r.edge_length) : Json(nullptr);
  out["num_seeds_used"] = r.seeds.num_used;
  out["num_seeds_merged"] = r.seeds.num_merged;
  out["num_seeds_dropped"] = r.seeds.num_dropped;
  out["num_seeds_too_small"] = r.seeds.num_too_small;
  if (r.seeds.num_too_small > 0) {
    out["too_small_point"] = r.seeds.too_small_point;
    out["too_small_edge_length"] = r.seeds.finer_edge_length > 0 ? Json(r.seeds.finer_edge_length) : Json(nullptr);
  }
  out["seeds_searched"] = r.seeds.searched;
  Json per_dim = Json::object();
  for (const auto& [dim, count] : r.simplices_per_dim) per_dim[std::to_string(dim)] = count;
  out["simplices_per_dim"] = per_dim;
  add_topology(r, out);
  out["certificate"] = r.certificate ? certificate_json(*r.certificate) : Json(nullptr);
  out["quality"] = r.quality ? quality_json(*r.quality) : Json(nullptr);
  out["oracle_evaluations"] = r.oracle_evaluations;
  out["seed_evaluations"] = r.seed_evaluations;
  out["distinct_vertices"] = r.distinct_vertices;
  out["exact_decisions"] = r.exact_decisions;
  out["seconds"] = r.seconds;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  out["peak_rss_bytes"] = std::size_t(usage.ru_maxrss) * 1024;
  out["threads"] = 1;
  out["stop_reason"] = to_string(r.stop_reason);
  out["cut_short"] = r.cut_short;
  out["left_out"] = omissions_json(r.left_out);
  return out.dump(2) + "\n";
}

}  // namespace whitney
