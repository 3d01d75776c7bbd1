// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/boundary_summary.h>

#include <cstdio>
#include <string>
#include <utility>

#include <whitney/cells/subdivide.h>
#include <whitney/topology/topology.h>

namespace whitney {
namespace {

std::string inequality_text(int j, const Problem& problem) {
  const int m = problem.inequalities ? problem.inequalities->codim() : 0;
  if (j < m) return problem.inequality_texts[j] + " = 0";
  const int side = j - m, c = side / 2;
  char bound[32];
  std::snprintf(bound, sizeof bound, "%.6g", problem.box[c][side % 2]);
  return problem.variables[c] + " = " + bound;
}

}  // namespace

BoundarySummary summarize_boundary(const Strata& strata, const SimplicialMesh& mesh, const CutRegularity& regularity,
                                   const Problem& problem) {
  BoundarySummary out;
  out.boundary_components = strata.boundary_components;
  out.cut_components = strata.cut_components;
  TopologyOptions counts_only;
  counts_only.links = counts_only.homology = false;
  for (std::size_t s = 0; s < strata.strata.size(); ++s) {
    const Stratum& stratum = strata.strata[s];
    BoundarySummary::Piece piece;
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

}  // namespace whitney
