// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include <coxeter/base/run_control.h>
#include <coxeter/triangulation.h>
#include <whitney/functions/domain.h>
#include <whitney/functions/function.h>
#include <whitney/tracing/trace_result.h>

namespace whitney {

struct TraceOptions {
  /// g: R^d -> R^m: only the part of the manifold in g >= 0 is traced, with its boundary, edges and corners. g is
  /// interpolated as f is. Both are evaluated at the vertices of all simplices that the boundary passes through, so up
  /// to one edge length outside.
  std::optional<Function> inequalities{};
  /// The same as 2d further inequalities, see Domain. Where f has no finite value at a vertex outside the box, the
  /// simplices around that vertex are left out instead.
  std::optional<Box> box{};
  /// How many d-simplices are examined around one seed before it is dropped.
  std::size_t max_seed_simplices = 2000;
  /// Limits, asked every few hundred simplices. max_simplices counts k-simplices, those of the boundary included, about
  /// 150 bytes each.
  RunControl run{.max_simplices = 50'000'000};
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
