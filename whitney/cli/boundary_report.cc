// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/cli/boundary_report.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>
#include <whitney/topology/topology.h>

namespace whitney::cli {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string inequality_text(int j, const Problem& problem) {
  const int m = problem.inequalities ? problem.inequalities->codim() : 0;
  if (j < m) return problem.inequality_texts[j] + " = 0";
  const int side = j - m, c = side / 2;
  return problem.variables[c] + " = " + number(problem.box[c][side % 2]);
}

}  // namespace

std::string point_text(const std::vector<double>& point) {
  std::string text = "(";
  for (std::size_t c = 0; c < point.size(); ++c) text += (c ? ", " : "") + number(point[c]);
  return text + ")";
}

BoundaryStatistics boundary_statistics(const Strata& strata, const SimplicialMesh& mesh,
                                       const CutRegularity& regularity, const Problem& problem) {
  BoundaryStatistics out;
  out.boundary_components = strata.boundary_components;
  out.cut_components = strata.cut_components;
  TopologyOptions counts_only;
  counts_only.links = counts_only.homology = false;
  for (std::size_t s = 0; s < strata.strata.size(); ++s) {
    const Stratum& stratum = strata.strata[s];
    BoundaryStatistics::Piece piece;
    piece.dim = stratum.dim;
    for (int j : stratum.inequalities) piece.inequalities.push_back(inequality_text(j, problem));
    piece.is_cut = stratum.is_cut;
    piece.num_cells = stratum.cells.size();
    piece.euler_characteristic = topology_of(stratum_mesh(mesh, static_cast<int>(s)), counts_only).euler_characteristic;
    piece.faces = stratum.faces;
    out.strata.push_back(std::move(piece));
  }
  out.smallest_singular_value = regularity.smallest_singular_value;
  out.smallest_singular_point = regularity.point;
  for (const SingularCut& cut : regularity.singular) out.singular_points.push_back(cut.point);
  return out;
}

std::string describe(const BoundaryStatistics& boundary) {
  std::map<int, std::size_t, std::greater<>> per_dim;
  for (const auto& piece : boundary.strata) ++per_dim[piece.dim];
  std::string text = "strata:";
  for (const auto& [dim, count] : per_dim)
    text += " " + std::to_string(count) + " of dimension " + std::to_string(dim) + ",";
  text.back() = ';';
  text += " boundary components: " + std::to_string(boundary.boundary_components) + " of the inequalities";
  if (boundary.cut_components > 0) text += ", " + std::to_string(boundary.cut_components) + " where the box cuts";
  text += "\n";
  if (boundary.strata.size() <= 24) {
    for (std::size_t s = 0; s < boundary.strata.size(); ++s) {
      const auto& piece = boundary.strata[s];
      text += "  " + std::to_string(s) + ": dimension " + std::to_string(piece.dim);
      for (std::size_t i = 0; i < piece.inequalities.size(); ++i)
        text += (i == 0 ? ", on " : " and ") + piece.inequalities[i];
      text += (piece.is_cut ? " (cut by the box)" : "") + std::string(", ") + std::to_string(piece.num_cells) +
              (piece.num_cells == 1 ? " cell" : " cells");
      if (!piece.faces.empty()) text += ", bounded by";
      for (std::uint32_t face : piece.faces) text += " " + std::to_string(face);
      text += "\n";
    }
  }
  if (!boundary.smallest_singular_point.empty())
    text += "least singular value along the boundary: " + number(boundary.smallest_singular_value) + " at " +
            point_text(boundary.smallest_singular_point) + "\n";
  for (const std::vector<double>& point : boundary.singular_points)
    text += "the boundary is SINGULAR at " + point_text(point) +
            ": it crosses or touches itself there, and the mesh is one resolution of it among several\n";
  return text;
}

void check_strata_format(const std::string& pattern, int intrinsic_dim) {
  for (int dim = 0; dim < intrinsic_dim; ++dim) {
    try {
      return check_mesh_format(pattern, dim);
    } catch (const InvalidInput&) {
    }
  }
  check_mesh_format(pattern, intrinsic_dim);
}

std::vector<std::string> write_strata(const std::string& pattern, const SimplicialMesh& mesh, std::size_t num_strata,
                                      const MeshWriteOptions& options, std::string& failed) {
  const std::filesystem::path path(pattern);
  std::vector<std::string> written;
  for (std::size_t s = 0; s < num_strata; ++s) {
    const SimplicialMesh piece = stratum_mesh(mesh, static_cast<int>(s));
    const std::string name =
        (path.parent_path() / (path.stem().string() + "_" + std::to_string(s) + path.extension().string())).string();
    try {
      check_mesh_format(name, piece.dim);
    } catch (const InvalidInput&) {
      continue;
    }
    try {
      write_mesh(name, piece, options);
      written.push_back(name);
    } catch (const std::exception& error) {
      failed += (failed.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  return written;
}

}  // namespace whitney::cli
