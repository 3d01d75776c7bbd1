// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include <coxeter/simplex.h>
#include <coxeter/tables/simplex_table.h>
#include <coxeter/tables/vertex_table.h>
#include <coxeter/triangulation.h>
#include <perturbation/certificate.h>
#include <perturbation/displacement.h>
#include <perturbation/foot_oracle.h>

namespace whitney::perturbation {

/// What is known of one d-simplex at the present positions of its vertices.
struct Evaluation {
  /// The margin of the best foot tried (certified above 1), without the conditions on its neighbours. A lower bound
  /// where it is above what was enough.
  float margin = 0;
  float separation = 0, transversality = 0;  ///< (A+) and (B) of that foot
  /// Facets that the tangent plane of the best foot hits: bit q for the one opposite to v_q.
  std::uint32_t hit_facets = 0;
  /// The best foot, see PerturbedTriangulation::foot; kNoFoot when every one failed.
  std::uint16_t candidate = kNoFoot;
  std::uint16_t tried = 0;  ///< how many feet were tried

  static constexpr std::uint16_t kNoFoot = 0xffff;
  bool is_hit() const { return hit_facets != 0; }
};

/// The perturbed triangulation T~ where it was looked at: lattice vertices with their displacements and positions, and
/// d-simplices with their neighbours and margins. Grows as it is asked; vertices and simplices are known by their
/// index (order of first appearance). What is remembered of a simplex is recomputed when a vertex of it has moved.
///
/// The feet tried for a simplex, in order: that of its barycentre, those of its vertices (remembered per vertex), and,
/// when asked for, those of the midpoints of its edges. So the outcome is a function of the positions of its vertices
/// alone.
class PerturbedTriangulation {
 public:
  /// Keeps references to both arguments. Throws InvalidInput when their dimensions differ, or as Certificate does.
  PerturbedTriangulation(const coxeter::Triangulation& triangulation, const FootOracle& oracle);
  PerturbedTriangulation(const PerturbedTriangulation&) = delete;
  PerturbedTriangulation& operator=(const PerturbedTriangulation&) = delete;

  int ambient_dim() const { return d_; }
  int codim() const { return certificate_.codim(); }
  const coxeter::Triangulation& triangulation() const { return triangulation_; }
  const FootOracle& oracle() const { return oracle_; }

  // Vertices.
  std::size_t num_vertices() const { return vertices_.size(); }
  std::span<const std::int32_t> lattice_vertex(std::uint32_t v) const {
    return {vertices_.coordinates(v), static_cast<std::size_t>(d_)};
  }
  /// Where v stands in T~; d. Invalidated when a vertex is added.
  const double* position(std::uint32_t v) const { return &positions_[std::size_t{v} * d_]; }
  const double* displacement(std::uint32_t v) const { return &displacements_[std::size_t{v} * d_]; }
  /// Moves v to x(v) + u; u: d.
  void set_displacement(std::uint32_t v, std::span<const double> u);
  /// Sets the displacements of all vertices of the map.
  void displace(const DisplacementMap& displacements);
  /// What set_displacement replaced can be put back, with the version it had then.
  std::uint64_t version(std::uint32_t v) const { return version_[v]; }
  void restore(std::uint32_t v, std::span<const double> u, std::uint64_t version);

  // Simplices.
  std::size_t num_simplices() const { return simplices_.size(); }
  /// Its vertices v_0 .. v_d, d + 1 indices. Invalidated when a simplex is added.
  const std::uint32_t* corners(std::uint32_t s) const { return &corners_[std::size_t{s} * (d_ + 1)]; }
  /// The part of the ordered partition that coordinate c of simplex s is in, 0 <= c < d; see coxeter::Simplex.
  int part(std::uint32_t s, int c) const { return simplices_.parts(s)[c]; }
  std::uint32_t base(std::uint32_t s) const { return simplices_.base(s); }
  coxeter::Simplex simplex(std::uint32_t s) const;
  /// The d-simplex of T (undisplaced) that contains x.
  std::uint32_t locate(std::span<const double> x);
  /// The d-simplex on the other side of the facet opposite to v_q.
  std::uint32_t neighbour(std::uint32_t s, int q);
  /// The simplices seen so far that have the vertex v.
  const std::vector<std::uint32_t>& star(std::uint32_t v) const { return stars_[v]; }

  /// Margins of simplex s: feet are tried until one has a margin of at least `enough`; with_midpoints: also those of
  /// the midpoints of edges.
  const Evaluation& evaluate(std::uint32_t s, double enough, bool with_midpoints = false);
  /// Drops all that is remembered of simplices: what evaluate says next does not depend on what was asked before.
  void forget();
  /// What evaluate said of s, remembered as holding for the present positions (they were put back).
  void remember(std::uint32_t s, const Evaluation& evaluation);
  /// The certificate evaluated for simplex s at one of its feet; false when that foot does not exist. The certificate()
  /// then tells the details. enough, useless: see Certificate::evaluate.
  bool evaluate_at(std::uint32_t s, std::uint16_t candidate, Margins& margins,
                   double enough = std::numeric_limits<double>::infinity(), double useless = -1);
  Certificate& certificate() { return certificate_; }
  /// The foot of a candidate for s: 0 the barycentre, 1 + i the vertex v_i, then the midpoints of the edges in
  /// lexicographic order. False when the oracle has none. The view lives until the next call of a member.
  bool foot(std::uint32_t s, std::uint16_t candidate, FootView& view);

  /// Number of calls of the oracle so far.
  std::size_t oracle_calls() const { return oracle_calls_; }

 private:
  std::uint32_t enter_vertex(const std::int32_t* z, std::uint64_t form);
  std::uint32_t enter_simplex(std::uint32_t base, const std::uint8_t* order);
  bool project(const double* x, double* point, double* frame, FootErrors& errors);
  std::uint64_t stamp(std::uint32_t s) const;

  const coxeter::Triangulation& triangulation_;
  const FootOracle& oracle_;
  int d_;
  Certificate certificate_;
  std::size_t oracle_calls_ = 0;

  coxeter::VertexTable vertices_;
  std::vector<double> positions_, displacements_;  // d per vertex
  std::vector<std::uint64_t> version_;             // changes whenever the vertex moves
  std::uint64_t last_version_ = 0;
  std::vector<double> feet_;  // per vertex: point d, frame d x d
  std::vector<FootErrors> foot_errors_;
  std::vector<std::uint64_t> foot_version_;  // 0: none yet
  std::vector<char> foot_exists_;
  std::vector<std::vector<std::uint32_t>> stars_;

  coxeter::SimplexTable<std::uint8_t> simplices_;
  std::vector<std::uint32_t> corners_, neighbours_;  // d + 1 per simplex
  std::vector<Evaluation> evaluations_;
  std::vector<std::uint64_t> evaluation_stamp_;

  std::vector<double> own_foot_, scratch_;
  std::vector<const double*> corner_positions_;
  std::vector<std::uint64_t> key_;
  std::vector<std::int32_t> coordinates_;
};

}  // namespace whitney::perturbation
