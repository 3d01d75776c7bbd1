// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/whitney_complex.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <coxeter/tables/lattice_order.h>
#include <whitney/cells/crossed_simplices.h>
#include <whitney/construction/distance_bound.h>

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

/// The vertices of a trace: in lexicographic order, and the place of each in it.
struct TraceVertices {
  std::vector<std::int32_t> coordinates;  ///< num x d
  std::vector<std::uint32_t> rank;        ///< by their number in the perturbed triangulation
  std::size_t num = 0;
};

TraceVertices vertices_of(const PerturbedTriangulation& near, const HitWalk& trace) {
  const int d = near.ambient_dim();
  TraceVertices vertices;
  vertices.rank.resize(near.num_vertices(), 0);
  std::vector<std::uint32_t> used;
  for (const std::uint32_t s : trace.simplices)
    for (int q = 0; q <= d; ++q)
      if (const std::uint32_t v = near.corners(s)[q]; !vertices.rank[v]) {
        vertices.rank[v] = 1;
        used.push_back(v);
      }
  std::vector<std::int32_t> coordinates;
  for (const std::uint32_t v : used) {
    const auto z = near.lattice_vertex(v);
    coordinates.insert(coordinates.end(), z.begin(), z.end());
  }
  const std::vector<std::uint32_t> order = lexicographic_order(coordinates, d);
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const auto z = near.lattice_vertex(used[order[i]]);
    vertices.coordinates.insert(vertices.coordinates.end(), z.begin(), z.end());
    vertices.rank[used[order[i]]] = i;
  }
  vertices.num = used.size();
  return vertices;
}

/// The hit k-faces as permutahedral simplices, each once, with the point of the first simplex that has it.
class HitFaces {
 public:
  HitFaces(PerturbedTriangulation& near, const TraceVertices& vertices)
      : near_(near),
        vertices_(vertices),
        faces_(near.certificate().hit_candidates()),
        table_(near.ambient_dim(), 0),
        key_(table_.key_words()) {}

  /// Adds those of one d-simplex, as its best foot sees them: a row of `cells()`. False when there is no foot for that.
  bool add(std::uint32_t s) {
    Margins margins;
    const bool is_seen = near_.evaluate_at(s, near_.evaluate(s, 0).candidate, margins) && margins.single_sheet;
    for (std::size_t f = 0; is_seen && f < faces_.num(); ++f)
      if (near_.certificate().face_is_hit(f)) add_face(s, f);
    cells_.offset.push_back(static_cast<std::uint32_t>(cells_.index.size()));
    return is_seen;
  }

  const Incidence& cells() const { return cells_; }  ///< of every simplex added
  const coxeter::SimplexTable<std::uint8_t>& table() const { return table_; }
  const std::vector<double>& points() const { return points_; }

 private:
  void add_face(std::uint32_t s, std::size_t f) {
    const int d = near_.ambient_dim(), k = near_.codim();
    std::fill(key_.begin(), key_.end(), 0);
    table_.set_base(key_.data(), vertices_.rank[near_.corners(s)[faces_[f][0]]]);
    write_parts(near_, s, faces_[f], table_.parts_of(key_.data()));
    std::uint64_t hash = 0;
    for (const std::uint64_t word : key_) hash = coxeter::mix64(hash + word * 0x9e3779b97f4a7c15ull);
    const std::uint32_t cell = table_.intern(key_.data(), hash);
    cells_.index.push_back(cell);
    if (std::size_t{cell} * d < points_.size()) return;
    points_.resize(points_.size() + d, 0.0);
    const double* lambda = near_.certificate().hit_coordinates(f);
    for (int j = 0; j <= k; ++j) {
      const double* v = near_.position(near_.corners(s)[faces_[f][j]]);
      for (int c = 0; c < d; ++c) points_[std::size_t{cell} * d + c] += lambda[j] * v[c];
    }
  }

  PerturbedTriangulation& near_;
  const TraceVertices& vertices_;
  const VertexSubsets& faces_;
  coxeter::SimplexTable<std::uint8_t> table_;
  std::vector<std::uint64_t> key_;
  std::vector<double> points_;
  Incidence cells_;
};

/// See WhitneyComplex::distance_bound, for one simplex and its 0-cells.
std::optional<double> distance_bound(PerturbedTriangulation& near, std::uint32_t s, const HitFaces& hit,
                                     std::span<const std::uint32_t> cells) {
  const int d = near.ambient_dim();
  const Bending bending{near.oracle().reach(), near.oracle().curvature_radius(), {}};
  std::vector<double> points;
  for (const std::uint32_t cell : cells)
    points.insert(points.end(), &hit.points()[std::size_t{cell} * d], &hit.points()[std::size_t{cell} * d] + d);
  const auto seen_from = [&](std::uint16_t candidate) -> std::optional<double> {
    perturbation::FootView foot{};
    if (candidate == perturbation::Evaluation::kNoFoot || !near.foot(s, candidate, foot)) return std::nullopt;
    return distance_from_manifold(points, d, d - near.codim(), foot, bending);
  };
  std::optional<double> bound = seen_from(near.evaluate(s, 0).candidate);
  const auto num_feet = static_cast<std::uint16_t>(d + 2 + d * (d + 1) / 2);
  for (std::uint16_t candidate = 0; !bound && candidate < num_feet; ++candidate) bound = seen_from(candidate);
  return bound;
}

/// The largest of them.
std::optional<double> distance_bound(PerturbedTriangulation& near, const HitWalk& trace, const HitFaces& hit) {
  double largest = 0;
  for (std::size_t i = 0; i < trace.simplices.size(); ++i) {
    const std::optional<double> bound = distance_bound(near, trace.simplices[i], hit, hit.cells()[i]);
    if (!bound) return std::nullopt;
    largest = std::max(largest, *bound);
  }
  return largest;
}

/// Whether M goes on across a facet that the region of the trace ends at.
bool is_cut(PerturbedTriangulation& near, const HitWalk& trace) {
  if (!trace.region) return false;
  for (const std::uint32_t s : trace.simplices) {
    const std::uint32_t hit = near.evaluate(s, 0).hit_facets;
    for (int q = 0; q <= near.ambient_dim(); ++q)
      if ((hit >> q & 1) && !trace.region(near, near.neighbour(s, q))) return true;
  }
  return false;
}

}  // namespace

WhitneyComplex whitney_complex(PerturbedTriangulation& near, const HitWalk& trace, bool whole,
                               const std::function<bool()>& keep_going) {
  const int d = near.ambient_dim();
  const TraceVertices vertices = vertices_of(near, trace);
  HitFaces hit(near, vertices);
  WhitneyComplex result;
  bool all_seen = true, complete = true;
  for (std::size_t i = 0; i < trace.simplices.size() && complete; ++i) {
    all_seen = hit.add(trace.simplices[i]) && all_seen;
    complete = i % 64 != 63 || !keep_going || keep_going();
  }
  if (all_seen && complete) result.distance_bound = distance_bound(near, trace, hit);

  const auto count = static_cast<std::uint32_t>(hit.table().size());
  const std::vector<std::uint32_t> canonical = canonical_order(
      vertices.num, count, d, [&](std::uint32_t i) { return hit.table().base(i); },
      [&](std::uint32_t i) { return hit.table().parts(i); });
  std::vector<std::uint32_t> base;
  std::vector<std::uint8_t> parts;
  std::vector<double> points;
  for (const std::uint32_t i : canonical) {
    base.push_back(hit.table().base(i));
    parts.insert(parts.end(), hit.table().parts(i), hit.table().parts(i) + d);
    const double* point = &hit.points()[std::size_t{i} * d];
    points.insert(points.end(), point, point + d);
  }
  CrossedSimplices crossed;
  crossed.ambient_dim = d;
  crossed.codim = near.codim();
  crossed.vertex_coordinates = vertices.coordinates;
  crossed.base = base;
  crossed.parts = parts;
  crossed.points = points;
  result.cut = is_cut(near, trace);
  crossed.whole = whole && complete && !result.cut;
  // Cells of simplices that the trace did not enter may have all their 0-cells in it.
  std::set<coxeter::Simplex> entered;
  if (trace.region) {
    for (const std::uint32_t s : trace.simplices) entered.insert(near.simplex(s));
    crossed.keep_top = [&](const coxeter::Simplex& simplex) { return entered.contains(simplex); };
  }
  result.complex = cell_complex(crossed);
  return result;
}

std::uint64_t whitney_complex_bytes(int ambient_dim, int codim, std::size_t num_simplices) {
  // faces[m] = (m-1)! S(d+1, m), by S(i+1, m) = m S(i, m) + S(i, m-1).
  std::vector<double> faces(ambient_dim + 2, 0.0);
  faces[0] = 1;
  for (int i = 0; i <= ambient_dim; ++i) {
    for (int m = i + 1; m >= 1; --m) faces[m] = m * faces[m] + faces[m - 1];
    faces[0] = 0;
  }
  double factorial = 1, bytes = 0;
  for (int m = 1; m <= ambient_dim + 1; ++m) {
    if (m > 2) factorial *= m - 1;
    // Its base, parts and facets, in the table, sorted, and in the complex.
    if (m > codim) bytes += 3 * factorial * faces[m] * (4 + 2 * ambient_dim + 4 * m);
  }
  return static_cast<std::uint64_t>(std::min(1e18, bytes / factorial * static_cast<double>(num_simplices)));
}

}  // namespace whitney
