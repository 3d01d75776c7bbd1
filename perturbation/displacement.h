// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include <coxeter/lattice_vertex.h>
#include <coxeter/quality.h>
#include <coxeter/triangulation.h>

namespace whitney::perturbation {

/// The displacements u(v) of finitely many lattice vertices, in Cartesian coordinates (lengths); u = 0 elsewhere. With
/// a triangulation T it defines T~: the vertex v of T stands at x(v) + u(v), the combinatorics are those of T.
class DisplacementMap {
 public:
  /// Throws InvalidInput unless ambient_dim >= 1.
  explicit DisplacementMap(int ambient_dim);

  int ambient_dim() const { return ambient_dim_; }
  /// Number of vertices that were set.
  std::size_t size() const { return vertices_.size(); }
  /// The vertices that were set, in the order in which they first were.
  const std::vector<coxeter::LatticeVertex>& vertices() const { return vertices_; }

  /// Sets u(vertex), replacing what was there; displacement: d, finite. Throws InvalidInput on a wrong size or a value
  /// that is not finite.
  void set(const coxeter::LatticeVertex& vertex, std::span<const double> displacement);
  /// u(vertex): d doubles, or an empty span where none was set. Valid until the next call of set.
  std::span<const double> find(const coxeter::LatticeVertex& vertex) const;
  /// u of vertices()[i].
  std::span<const double> displacement(std::size_t i) const {
    const auto d = static_cast<std::size_t>(ambient_dim_);
    return {values_.data() + i * d, d};
  }

 private:
  int ambient_dim_;
  std::vector<coxeter::LatticeVertex> vertices_;
  std::vector<double> values_;  // d per vertex
  std::unordered_map<coxeter::LatticeVertex, std::size_t> index_;
};

/// x(v) + u(v): the position of a vertex of T~; d. Throws InvalidInput when the dimensions differ.
std::vector<double> position(const coxeter::Triangulation& triangulation, const DisplacementMap& displacements,
                             const coxeter::LatticeVertex& vertex);

/// The bound w (a length) of the embedding condition: if abs(u(v) - u(v')) < w over the edges of every simplex, then
/// x -> x + u(x), with u interpolated linearly, is the identity plus a contraction, hence a homeomorphism, and T~ is a
/// triangulation with the combinatorics of T. w is the width of the d-simplices, rounded down.
/// (BKW20, (2) and (6), allow displacements of 0.007 L at d = 3; this allows almost w / 2 = L / 4.)
double embedding_bound(const coxeter::Quality& quality);

enum class Embedding {
  kProven,     ///< abs(u(v) - u(v')) < bound for all edges v v', and abs(u(v)) < bound for all v
  kNotProven,  ///< the inequality fails for some edge, or rounding errors leave it open
};

struct EmbeddingCheck {
  Embedding verdict;
  /// An upper bound of all abs(u(v)) (a length).
  double largest_displacement;
  /// An upper bound of all abs(u(v) - u(v')) over the edges of T, and of all abs(u(v)) (a length). When
  /// 2 largest_displacement < bound suffices for the proof, it is that, and the edges are not visited.
  double largest_difference;
  /// The first edge found, in the order of vertices(), that breaks the inequality; twice the same vertex when
  /// abs(u(v)) does. Empty when proven.
  std::optional<std::pair<coxeter::LatticeVertex, coxeter::LatticeVertex>> witness;
};

/// Checks the embedding condition with every rounding outward, so kProven is a proof for the displacements as stored.
/// A vertex with a displacement is always compared with an undisplaced one too, whether it has such a neighbour or not.
/// O(number of vertices) when twice the largest displacement is below the bound; otherwise all edges between displaced
/// vertices, by pairs or by neighbours, whichever is less. Throws InvalidInput unless bound > 0.
EmbeddingCheck check_embedding(const DisplacementMap& displacements, double bound);

}  // namespace whitney::perturbation
