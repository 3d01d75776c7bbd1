// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <coxeter/growing_array.h>
#include <coxeter/triangulation.h>
#include <whitney/domain.h>
#include <whitney/function.h>

namespace whitney {

struct TraceProgress {
  std::size_t simplices = 0;    ///< simplices found so far
  std::size_t evaluations = 0;  ///< evaluations of f so far
  double seconds = 0;           ///< since the trace began
};

struct TraceOptions {
  /// g: R^d -> R^m: only the part of the manifold in g >= 0 is traced, with its boundary, edges and corners. g is
  /// interpolated as f is. Both are evaluated at the vertices of all simplices that the boundary passes through, so up
  /// to one edge length outside.
  std::optional<Function> inequalities{};
  /// The same as 2d further inequalities, see Domain. Where f has no finite value at a vertex outside the box, the
  /// simplices around that vertex are left out instead.
  std::optional<Box> box{};
  /// The trace stops when it has found this many k-simplices, those of the boundary included. About 150 bytes each.
  std::size_t max_simplices = 50'000'000;
  /// The trace stops after this many seconds.
  double time_limit = std::numeric_limits<double>::infinity();
  /// How many d-simplices are examined around one seed before it is dropped.
  std::size_t max_seed_simplices = 2000;
  /// Called every few hundred simplices; returning false stops the trace.
  std::function<bool(const TraceProgress&)> progress;
};

/// Why a trace ended.
enum class StopReason {
  kNone,          ///< nothing was left to do: every cofacet of every simplex found has been crossed
  kBox,           ///< likewise, but the manifold reached the box and was cut there: see TraceResult::boundary
  kMaxSimplices,  ///< stopped by TraceOptions::max_simplices
  kTimeLimit,     ///< stopped by TraceOptions::time_limit
  kCancelled      ///< stopped by TraceOptions::progress
};

/// "none", "box", "max_simplices", "time_limit", "cancelled".
const char* to_string(StopReason reason);

/// What became of a seed point.
struct SeedReport {
  enum class Outcome {
    kUsed,    ///< a trace started from it
    kMerged,  ///< the simplex found near it had been traced already
    kDropped  ///< no simplex near it meets the zero set of the interpolant; `reason` says what was tried
  };
  Outcome outcome = Outcome::kDropped;
  std::string reason;
};

/// The simplices that carry the vertices of one stratum, or of several with the same inequalities: where the
/// interpolants of f and of g_I vanish and all others are positive.
struct BoundarySimplices {
  std::vector<int> inequalities;    ///< I, increasing, not empty; numbers as in Domain
  std::vector<std::uint32_t> base;  ///< per simplex: index of its base vertex among TraceResult::vertex_coordinates()
  /// num_simplices x d: the part of the ordered partition that each coordinate is in, 0..k+|I|.
  std::vector<std::uint16_t> parts;
  std::vector<double> points;  ///< num_simplices x d

  std::size_t size() const { return base.size(); }
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
  static constexpr int kFirstWideCodim = 255;
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

/// Traces the isomanifold f = 0 through a Coxeter-Freudenthal-Kuhn triangulation, starting near the seed points: SoCG
/// 2021, Algorithm 1, by pivoting from facet to facet.
///
/// f: R^d -> R^k, 1 <= k < d; the isomanifold has dimension n = d - k >= 1. seed_points: m x d, one after the other; a
/// seed need not lie on the manifold: the neighbourhood is searched for a simplex that meets the zero set. f is
/// evaluated once at each lattice vertex looked at. Zeros of f at lattice vertices need no care by the caller: the
/// target is (eps, .., eps^k) for an infinitely small eps (see exact_pivot.h), and no decision depends on rounding
/// errors of the tracer.
///
/// With inequalities, the manifold is the part of that zero set in which the interpolants of g are >= 0, and a lattice
/// vertex with g = 0 counts as inside: see BoundaryTrace. Each connected component of it that a seed leads to is found
/// whole, however the boundary cuts the simplices.
///
/// Throws InvalidInput on sizes that do not fit or values that are not finite in the arguments, OracleError when f or g
/// returns NaN or an infinite value (but see TraceOptions::box), LatticeOverflow when an unbounded manifold runs out of
/// lattice coordinates.
TraceResult trace(const Function& f, const coxeter::Triangulation& triangulation, std::span<const double> seed_points,
                  const TraceOptions& options = {});

}  // namespace whitney
