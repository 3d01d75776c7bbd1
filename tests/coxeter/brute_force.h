// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <coxeter/simplex.h>

/// Simplices as sets of vertices, straight from the definition of the triangulation, without permutahedral
/// representations: the second route for the tests of this folder.
namespace whitney::coxeter::testing {

using VertexSet = std::set<LatticeVertex>;

inline VertexSet vertex_set(const Simplex& simplex) {
  const auto vertices = simplex.vertices();
  return {vertices.begin(), vertices.end()};
}

/// Whether b - a or a - b is in {0,1}^d, and not 0. The triangulation is the flag complex of this graph.
inline bool adjacent(const LatticeVertex& a, const LatticeVertex& b) {
  bool up = true, down = true;
  for (int c = 0; c < a.ambient_dim(); ++c) {
    up = up && (b[c] - a[c] == 0 || b[c] - a[c] == 1);
    down = down && (a[c] - b[c] == 0 || a[c] - b[c] == 1);
  }
  return a != b && (up || down);
}

/// All z != centre that are adjacent to it.
inline std::vector<LatticeVertex> neighbours(const LatticeVertex& centre) {
  const int d = centre.ambient_dim();
  std::vector<LatticeVertex> result;
  for (int sign : {-1, 1})
    for (int mask = 1; mask < 1 << d; ++mask) {
      LatticeVertex v = centre;
      for (int c = 0; c < d; ++c) v[c] += (mask >> c & 1) * sign;
      result.push_back(v);
    }
  return result;
}

/// All cliques of size `size` that contain `clique`.
inline void grow_cliques(const VertexSet& clique, const std::vector<LatticeVertex>& candidates, std::size_t first,
                         std::size_t size, std::set<VertexSet>& result) {
  if (clique.size() == size) {
    result.insert(clique);
    return;
  }
  for (std::size_t i = first; i < candidates.size(); ++i) {
    const LatticeVertex& v = candidates[i];
    if (!std::ranges::all_of(clique, [&](const LatticeVertex& u) { return adjacent(u, v); })) continue;
    VertexSet larger = clique;
    larger.insert(v);
    grow_cliques(larger, candidates, i + 1, size, result);
  }
}

inline std::set<VertexSet> brute_force_cofaces(const VertexSet& simplex, int coface_dim) {
  std::set<VertexSet> result;
  grow_cliques(simplex, neighbours(*simplex.begin()), 0, static_cast<std::size_t>(coface_dim) + 1, result);
  return result;
}

inline std::set<VertexSet> brute_force_faces(const VertexSet& simplex, int face_dim) {
  const std::vector<LatticeVertex> vertices(simplex.begin(), simplex.end());
  std::set<VertexSet> result;
  for (unsigned mask = 0; mask < 1u << vertices.size(); ++mask) {
    VertexSet face;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (mask >> i & 1) face.insert(vertices[i]);
    if (face.size() == static_cast<std::size_t>(face_dim) + 1) result.insert(face);
  }
  return result;
}

/// A random m-simplex with base coordinates in [-range, range].
template <class Generator>
Simplex random_simplex(int d, int m, Generator& gen, int range = 1000) {
  LatticeVertex v(d);
  for (int c = 0; c < d; ++c) v[c] = static_cast<std::int32_t>(gen() % static_cast<unsigned>(2 * range + 1)) - range;
  // A random order of 0 .. d and m random cuts give a partition; the constructor turns it into canonical form.
  std::vector<int> order(static_cast<std::size_t>(d) + 1);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  for (std::size_t i = order.size(); i-- > 1;) std::swap(order[i], order[gen() % (i + 1)]);
  std::vector<bool> cut(static_cast<std::size_t>(d), false);
  for (int i = 0; i < m;) {
    const std::size_t at = gen() % static_cast<std::size_t>(d);
    if (!cut[at]) cut[at] = true, ++i;
  }
  std::vector<std::vector<int>> parts(1);
  for (std::size_t i = 0; i < order.size(); ++i) {
    parts.back().push_back(order[i]);
    if (i < cut.size() && cut[i]) parts.emplace_back();
  }
  return Simplex(v, OrderedPartition::from_parts(parts));
}

/// Whether the arrays of the simplex are in canonical form.
inline bool is_canonical(const Simplex& simplex) {
  const auto& p = simplex.partition();
  if (p.num_elements() != simplex.base().ambient_dim() + 1) return false;
  for (int q = 0; q < p.num_parts(); ++q) {
    const auto part = p.part(q);
    if (part.empty() || !std::ranges::is_sorted(part)) return false;
  }
  const auto last = p.part(p.num_parts() - 1);
  return last.back() == simplex.ambient_dim() && p.ends().back() == p.num_elements();
}

}  // namespace whitney::coxeter::testing
