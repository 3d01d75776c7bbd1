// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <coxeter/simplex.h>
#include <coxeter/tables/vertex_table.h>
#include <coxeter/triangulation.h>
#include <whitney/tracing/barycentric_kernel.h>

namespace whitney {

/// A k-simplex that meets the zero set of the interpolant: its base vertex and the part (0..k) of every coordinate
/// 0..d-1.
struct Crossing {
  std::vector<std::int32_t> base;
  std::vector<int> parts;
};

/// Searches for a simplex to start a trace from, around points near the manifold.
///
/// The d-simplex that holds a point of M need not meet the zero set of the interpolant (at d = 10 and coarse edges, one
/// in four does not). So: Newton's method on the interpolant, from simplex to simplex; then the d-simplices around the
/// point, by distance, until one has a k-face that is hit. Remembers f at the vertices it has seen.
class SeedSearch {
 public:
  /// f at one lattice vertex, k values; false: the vertex is outside the region where f may be asked.
  using Evaluate = std::function<bool(const std::int32_t* z, double* values)>;

  SeedSearch(const coxeter::Triangulation& triangulation, int codim, Evaluate evaluate);

  /// From now on only crossings for which this is true are found.
  void accept_only(std::function<bool(const Crossing&)> accept) { accept_ = std::move(accept); }

  /// A crossing near x (d numbers, finite), or nothing and the reason in `reason`. Looks at `limit` d-simplices at
  /// most.
  bool search(std::span<const double> x, std::size_t limit, Crossing& found, std::string& reason);

  /// The d-simplices around x with f at all vertices, nearest first, `limit` of them at most, until `found` is true.
  bool search_full(std::span<const double> x, std::size_t limit,
                   const std::function<bool(const coxeter::Simplex&)>& found);

  std::size_t evaluations() const { return evaluations_; }

 private:
  /// A d-simplex: vertices base, base + e(order[0]), base + e(order[0]) + e(order[1]), ..
  struct FullSimplex {
    std::vector<std::int32_t> base;
    std::vector<int> order;  // a permutation of 0..d-1
  };

  FullSimplex locate(std::span<const double> y) const;
  FullSimplex neighbour(const FullSimplex& simplex, int opposite) const;
  bool load(const FullSimplex& simplex);
  bool newton(const std::vector<double>& start, Crossing& found, std::size_t& examined);
  bool hit_face(const FullSimplex& simplex, Crossing& found);
  void describe(const FullSimplex& simplex, const std::vector<int>& face, Crossing& found) const;
  std::vector<double> barycentre(const FullSimplex& simplex) const;
  void for_each_around(std::span<const double> y, std::size_t limit,
                       const std::function<bool(const FullSimplex&)>& visit);

  const coxeter::Triangulation& triangulation_;
  int dim_, codim_;
  Evaluate evaluate_;
  std::function<bool(const Crossing&)> accept_;
  bool any_rejected_ = false;
  coxeter::VertexTable vertices_;
  std::vector<double> values_;      // k a vertex
  std::vector<char> inside_;        // whether f may be asked there
  std::vector<std::uint32_t> ids_;  // vertices of the simplex loaded last
  BarycentricKernel kernel_;
  std::size_t evaluations_ = 0;
};

}  // namespace whitney
