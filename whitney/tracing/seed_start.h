// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <coxeter/triangulation.h>
#include <whitney/functions/domain.h>
#include <whitney/functions/function.h>
#include <whitney/tracing/seed_search.h>

namespace whitney {

/// Where a trace may start for one seed point.
struct SeedStart {
  std::vector<Crossing> crossings;  ///< none, one, or two: near the seed point, and near its foot
  std::string reason;               ///< why there is none
  /// The seed's foot on f = 0 (d numbers), when f = 0 passes there regularly and in the domain but no simplex that
  /// meets the zero set of the interpolant was found to do so within kNear edge lengths: unless the trace comes by
  /// there all the same, the seed lies on a part of the manifold that is too small, or too close to another one, for
  /// this edge length. Else empty.
  std::vector<double> unseen;
};

/// Finds simplices from which to start a trace, and says which seed points lie on a part that the triangulation is too
/// coarse to see.
class SeedStarter {
 public:
  /// Whether a crossing is inside the domain, by the values at its k + 1 vertices: for each, -g_j for every inequality,
  /// then f.
  using Inside = std::function<bool(std::span<const double> rows)>;

  /// inside: asked only when the domain has inequalities.
  SeedStarter(const Function& f, const Domain& domain, const coxeter::Triangulation& triangulation, Inside inside);

  /// limit: how many d-simplices are examined around a point. Throws OracleError where f or an inequality is not finite
  /// inside the box.
  SeedStart find(std::span<const double> seed, std::size_t limit);

  /// A trace that sees the part of f = 0 at a point of it passes within so many edge lengths.
  static constexpr double kNear = 1.25;

  /// The largest edge length of those halved from the triangulation's at which a simplex that meets the zero set of the
  /// interpolant is found near a foot; 0 when none is: 30 are tried, 8 where d > 6.
  double finer_edge_length(std::span<const double> foot);

  /// See SeedSearch::search_full.
  bool find_full(std::span<const double> seed, std::size_t limit,
                 const std::function<bool(const coxeter::Simplex&)>& found);

  std::size_t evaluations() const { return search_.evaluations() + other_evaluations_; }

 private:
  bool value(const coxeter::Triangulation& triangulation, const std::int32_t* z, double* values) const;
  bool crossing_inside(const coxeter::Triangulation& triangulation, const Crossing& crossing);
  std::vector<double> point_of(const coxeter::Triangulation& triangulation, const Crossing& crossing);
  bool near(const coxeter::Triangulation& triangulation, const Crossing& crossing, std::span<const double> foot);
  bool find_near(const coxeter::Triangulation& triangulation, std::span<const double> foot, std::size_t limit,
                 Crossing& found);
  std::vector<double> foot_of(std::span<const double> x);
  bool box_holds(std::span<const double> x, double slack) const;
  bool claims(std::span<const double> foot);

  const Function& f_;
  const Domain& domain_;
  const coxeter::Triangulation& triangulation_;
  Inside inside_;
  SeedSearch search_;
  std::size_t other_evaluations_ = 0;
  std::vector<std::pair<std::vector<double>, double>> unseen_;  // and the finer edge length
};

}  // namespace whitney
