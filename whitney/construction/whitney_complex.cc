// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/whitney_complex.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <coxeter/tables/lattice_order.h>
#include <whitney/cells/crossed_simplices.h>

namespace whitney {
namespace {

using coxeter::canonical_order;
using coxeter::lexicographic_order;
using perturbation::HitWalk;
using perturbation::Margins;
using perturbation::PerturbedTriangulation;
using perturbation::VertexSubsets;

/// The coordinate form of face f of simplex s as a permutahedral simplex: its part numbers.
void write_parts(const PerturbedTriangulation& near, std::uint32_t s, const std::uint8_t* face, std::uint8_t* parts) {
  const int d = near.ambient_dim(), k = near.codim();
  for (int c = 0; c < d; ++c) {
    // Coordinate c moves v_q to v_(q+1), q its part in s; in the face it belongs to the last vertex not after v_q.
    const int q = near.part(s, c);
    int part = k;
    while (part > 0 && face[part] > q) --part;
    parts[c] = static_cast<std::uint8_t>(q < face[0] ? k : part);
  }
}

/// How far the hull of the points may be from M as the best foot of simplex s sees it; see WhitneyComplex.
double distance_bound(PerturbedTriangulation& near, std::uint32_t s, std::span<const std::uint32_t> cells,
                      const std::vector<double>& points) {
  const int d = near.ambient_dim(), n = d - near.codim();
  const double radius = near.oracle().curvature_radius();
  perturbation::FootView foot{};
  const std::uint16_t candidate = near.evaluate(s, 0).candidate;
  if (candidate == perturbation::Evaluation::kNoFoot || !near.foot(s, candidate, foot))
    return std::numeric_limits<double>::infinity();
  double tangential = 0, normal = 0;
  for (const std::uint32_t cell : cells) {
    double along = 0, off = 0;
    for (int row = 0; row < d; ++row) {
      double sum = 0;
      for (int c = 0; c < d; ++c) sum += foot.frame[row * d + c] * (points[std::size_t{cell} * d + c] - foot.point[c]);
      (row < n ? along : off) += sum * sum;
    }
    tangential = std::max(tangential, along);
    normal = std::max(normal, off);
  }
  if (!(tangential < radius * radius)) return std::numeric_limits<double>::infinity();
  const double errors = 2 * foot.errors.point + 2 * foot.errors.angle * std::sqrt(tangential + normal);
  return std::sqrt(normal) + tangential / (radius + std::sqrt(radius * radius - tangential)) + errors;
}

}  // namespace

WhitneyComplex whitney_complex(PerturbedTriangulation& near, const HitWalk& trace, bool whole) {
  const int d = near.ambient_dim(), k = near.codim();
  const VertexSubsets& faces = near.certificate().hit_candidates();

  // The vertices of the trace, in lexicographic order.
  std::vector<std::uint32_t> rank(near.num_vertices(), 0), used;
  for (const std::uint32_t s : trace.simplices)
    for (int q = 0; q <= d; ++q)
      if (const std::uint32_t v = near.corners(s)[q]; !rank[v]) {
        rank[v] = 1;
        used.push_back(v);
      }
  std::vector<std::int32_t> coordinates;
  for (const std::uint32_t v : used) {
    const auto z = near.lattice_vertex(v);
    coordinates.insert(coordinates.end(), z.begin(), z.end());
  }
  const std::vector<std::uint32_t> order = lexicographic_order(coordinates, d);
  std::vector<std::int32_t> sorted;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const auto z = near.lattice_vertex(used[order[i]]);
    sorted.insert(sorted.end(), z.begin(), z.end());
    rank[used[order[i]]] = i;
  }

  // The hit k-faces as permutahedral simplices, each once, with the point of the first simplex that has it.
  WhitneyComplex result;
  coxeter::SimplexTable<std::uint8_t> table(d, 0);
  std::vector<double> points;
  std::vector<std::uint64_t> key(table.key_words());
  Incidence cells;  // of every simplex of the trace
  for (const std::uint32_t s : trace.simplices) {
    Margins margins;
    if (near.evaluate_at(s, near.evaluate(s, 0).candidate, margins) && margins.single_sheet) {
      for (std::size_t f = 0; f < faces.num(); ++f) {
        if (!near.certificate().face_is_hit(f)) continue;
        std::fill(key.begin(), key.end(), 0);
        table.set_base(key.data(), rank[near.corners(s)[faces[f][0]]]);
        write_parts(near, s, faces[f], table.parts_of(key.data()));
        std::uint64_t hash = 0;
        for (const std::uint64_t word : key) hash = coxeter::mix64(hash + word * 0x9e3779b97f4a7c15ull);
        const std::uint32_t cell = table.intern(key.data(), hash);
        cells.index.push_back(cell);
        if (std::size_t{cell} * d < points.size()) continue;
        points.resize(points.size() + d, 0.0);
        const double* lambda = near.certificate().hit_coordinates(f);
        for (int j = 0; j <= k; ++j) {
          const double* v = near.position(near.corners(s)[faces[f][j]]);
          for (int c = 0; c < d; ++c) points[std::size_t{cell} * d + c] += lambda[j] * v[c];
        }
      }
    } else {
      result.distance_bound = std::numeric_limits<double>::infinity();
    }
    cells.offset.push_back(static_cast<std::uint32_t>(cells.index.size()));
  }
  for (std::size_t i = 0; i < trace.simplices.size(); ++i)
    result.distance_bound =
        std::max(result.distance_bound, distance_bound(near, trace.simplices[i], cells[i], points) * (1 + 1e-12));

  const auto count = static_cast<std::uint32_t>(table.size());
  const std::vector<std::uint32_t> canonical = canonical_order(
      used.size(), count, d, [&](std::uint32_t i) { return table.base(i); },
      [&](std::uint32_t i) { return table.parts(i); });
  std::vector<std::uint32_t> base;
  std::vector<std::uint8_t> parts;
  std::vector<double> sorted_points;
  for (const std::uint32_t i : canonical) {
    base.push_back(table.base(i));
    parts.insert(parts.end(), table.parts(i), table.parts(i) + d);
    sorted_points.insert(sorted_points.end(), &points[std::size_t{i} * d], &points[std::size_t{i} * d] + d);
  }
  CrossedSimplices crossed;
  crossed.ambient_dim = d;
  crossed.codim = k;
  crossed.vertex_coordinates = sorted;
  crossed.base = base;
  crossed.parts = parts;
  crossed.points = sorted_points;
  crossed.whole = whole;
  // Cells of simplices that the trace did not enter may have all their 0-cells in it.
  std::set<coxeter::Simplex> entered;
  if (trace.region) {
    for (const std::uint32_t s : trace.simplices) {
      entered.insert(near.simplex(s));
      const std::uint32_t hit = near.evaluate(s, 0).hit_facets;
      for (int q = 0; q <= d && !result.cut; ++q)
        result.cut = (hit >> q & 1) && !trace.region(near, near.neighbour(s, q));
    }
    crossed.keep_top = [&](const coxeter::Simplex& simplex) { return entered.contains(simplex); };
    crossed.whole = whole && !result.cut;
  }
  result.complex = cell_complex(crossed);
  return result;
}

}  // namespace whitney
