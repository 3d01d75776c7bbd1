// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <coxeter/base/growing_array.h>
#include <coxeter/base/run_control.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/cells/crossed_simplices.h>
#include <whitney/functions/domain.h>

namespace whitney {

/// What became of a seed point.
struct SeedReport {
  enum class Outcome {
    kUsed,     ///< a trace started from it
    kMerged,   ///< the simplex found near it had been traced already
    kDropped,  ///< no simplex near it meets the zero set of the interpolant; `reason` says what was tried
    /// f = 0 passes regularly within two edge lengths of it, in the domain, but no simplex within 1.25 edge lengths of
    /// that place meets the zero set of the interpolant: that part of the manifold is too small for this edge length
    /// and was not traced. (A simplex farther away may have been, and a trace started there.)
    kTooSmall
  };
  Outcome outcome = Outcome::kDropped;
  std::string reason{};          ///< of kDropped and kTooSmall
  std::vector<double> unseen{};  ///< kTooSmall: where f = 0 passes, d numbers
  double finer_edge_length = 0;  ///< kTooSmall: an edge length at which that part would be met; 0: not known
};

/// The k-simplices of a triangulation that meet the zero set of the piecewise-linear interpolant of f inside the
/// domain, and the points where they do; with inequalities, also the simplices of the boundary.
///
/// Sorted: vertices lexicographically by lattice coordinates; simplices by base vertex, then by the part numbers of
/// their coordinates. So the result depends on f, the triangulation and the components found, not on the order of
/// discovery.
class TraceResult {
 public:
  int ambient_dim() const { return ambient_dim_; }
  int codim() const { return codim_; }
  int intrinsic_dim() const { return ambient_dim_ - codim_; }

  /// The lattice vertices at which f was evaluated: every vertex of every cofacet of a simplex found.
  std::size_t num_vertices() const { return vertex_coordinates_.size() / ambient_dim_; }
  /// num_vertices x d.
  std::span<const std::int32_t> vertex_coordinates() const { return vertex_coordinates_; }
  /// num_vertices x k: f there, as it was returned.
  std::span<const double> vertex_values() const { return vertex_values_; }

  std::size_t num_simplices() const { return simplex_base_.size(); }
  /// Index of the base vertex v_0 of simplex i.
  std::uint32_t base(std::size_t i) const { return simplex_base_[i]; }
  /// The part of the ordered partition that coordinate c (0 <= c < d) of simplex i is in, 0..k. Element d is in part k.
  int part(std::size_t i, int c) const {
    const std::size_t at = i * ambient_dim_ + c;
    return has_wide_parts() ? wide_parts_[at] : parts_[at];
  }
  /// All part numbers, num_simplices x d, in the type they are stored in: uint16_t when has_wide_parts(), else uint8_t.
  bool has_wide_parts() const { return codim_ >= kFirstWideCodim; }
  template <class Index>
  std::span<const Index> parts() const {
    if constexpr (sizeof(Index) == 1)
      return parts_;
    else
      return wide_parts_;
  }
  /// num_simplices x d: where simplex i meets the zero set of the interpolant.
  std::span<const double> points() const { return points_; }
  std::span<const double> point(std::size_t i) const {
    return {points_.data() + i * ambient_dim_, std::size_t(ambient_dim_)};
  }

  Domain domain;  ///< of the options
  /// By number of inequalities, then lexicographically; simplices in canonical order. Empty where the manifold does not
  /// reach the boundary of the domain.
  std::vector<BoundarySimplices> boundary;
  /// All stratum points found: num_simplices() and those of the boundary.
  std::size_t num_points() const;
  bool whole = true;  ///< nothing is missing: no limit stopped the trace, and f had a value wherever it was asked for

  std::vector<SeedReport> seeds;     ///< one for each seed point given
  std::size_t evaluations = 0;       ///< evaluations of f by the trace: exactly num_vertices()
  std::size_t seed_evaluations = 0;  ///< those of the search around the seeds, apart
  std::size_t exact_decisions = 0;   ///< pivots that floating point could not prove and exact arithmetic decided
  StopReason stop_reason = StopReason::kNone;
  double seconds = 0;

 private:
  template <class Shape>
  friend class Tracer;

  int ambient_dim_ = 0, codim_ = 0;
  coxeter::GrowingArray<std::int32_t> vertex_coordinates_;
  coxeter::GrowingArray<double> vertex_values_;
  coxeter::GrowingArray<std::uint32_t> simplex_base_;
  coxeter::GrowingArray<std::uint8_t> parts_;        // num_simplices x d, unless has_wide_parts()
  coxeter::GrowingArray<std::uint16_t> wide_parts_;  // likewise, when has_wide_parts()
  coxeter::GrowingArray<double> points_;
};

/// The cell complex of a trace: see cells/cell_complex.h.
CellComplex cell_complex(const TraceResult& trace);

}  // namespace whitney
