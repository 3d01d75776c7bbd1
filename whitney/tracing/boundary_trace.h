// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include <coxeter/simplex.h>
#include <whitney/functions/domain.h>
#include <whitney/tracing/crossing_point.h>
#include <whitney/tracing/lattice_values.h>

namespace whitney {

/// The boundary of a traced manifold: f = 0, g >= 0.
///
/// Notation: h_j = -g_j, so that the domain is h_j <= 0. For a set I of inequalities F_I = (h_I, f), |I| + k
/// components, interpolated on the triangulation; the target is (eps, eps^2, ..), the inequalities first, by their
/// numbers, then f. So one generic position serves all sets at once, a lattice vertex with h_j = 0 lies inside, and no
/// two decisions contradict each other (see exact_pivot.h).
///
/// A *stratum point* (sigma, I) is a (k+|I|)-simplex sigma in which F_I takes its target, at a point with all other h_j
/// below theirs: a vertex of the piecewise-linear manifold with boundary. (sigma, {}) are the simplices of the interior
/// tracer, (sigma, {j}) the paper's boundary simplices. Its edges:
///   - for every cofacet tau of sigma, the segment of F_I in tau. It ends in the other facet of tau that is hit, or
///     before that at the first other inequality j, in (tau, I + j);
///   - for every i in I, the segment of F_{I - i} in sigma, to the inside of i. It ends in a facet of sigma, or before
///     that in (sigma, I - i + j).
/// These are the paper's three rules, for any number of inequalities (SoCG 2021, Sect. 3.5).
///
/// What is followed: the interior tracer finds all (sigma, {}), and with them the points (tau, {j}) behind every edge
/// that leaves the domain. Where no second inequality is near, that is all: inside one cell a single inequality cuts
/// off a connected set of vertices. Around the others, edges are followed one by one, and may lead to new simplices of
/// the interior.
class BoundaryTrace {
 public:
  /// The simplices that carry one stratum, or several with the same inequalities.
  struct Stratum {
    std::vector<int> inequalities;                // I, increasing, not empty
    std::unordered_set<coxeter::Simplex> points;  // the sigma of (sigma, I)
  };
  using InteriorVisitor = std::function<void(const coxeter::Simplex& sigma)>;

  BoundaryTrace(const Domain& domain, LatticeValues& lattice, int codim);

  /// Whether (sigma, {}) lies inside the domain; sigma, a k-simplex that meets f = 0, by its vertices.
  bool inside(std::span<const std::uint32_t> vertices);
  /// The same from values: m + k numbers a vertex, laid out as in LatticeValues::values.
  bool inside(std::span<const double> values);

  /// An edge that leaves the domain: tau a (k+1)-simplex that meets f = 0, `outside` its facet in which it does so
  /// outside.
  void add_exit(const coxeter::Simplex& tau, const coxeter::Simplex& outside);
  /// Looks for a stratum point with I not empty in a d-simplex; adds it.
  bool find_in(const coxeter::Simplex& full);
  /// Follows edges for a while; `interior` is called for simplices of the interior that they reach, known or not.
  /// Returns whether anything is left to do.
  bool grow(std::size_t steps, const InteriorVisitor& interior);

  const std::map<std::vector<int>, Stratum>& strata() const { return strata_; }
  std::size_t size() const { return size_; }
  /// Whether edges were given up because f has no value somewhere behind them.
  bool cut_by_undefined() const { return cut_by_undefined_; }
  std::size_t exact_decisions() const;

  /// The barycentric coordinates of a stratum point in its simplex.
  std::vector<double> weights(const coxeter::Simplex& sigma, const std::vector<int>& inequalities);

 private:
  using Set = std::vector<int>;
  struct Task {
    coxeter::Simplex simplex;
    const Set* set;
    bool from_exit;
  };
  // The vertices of one simplex, and which inequalities are violated at some of them; after load_rows also the values,
  // a row a vertex.
  struct Corners {
    std::vector<std::uint32_t> ids;
    std::vector<std::uint64_t> any;
    std::vector<double> rows;
  };

  bool load(const coxeter::Simplex& simplex, Corners& corners);
  void load_rows(Corners& corners);
  bool only_in(const std::uint64_t* mask, const Set& set) const;
  CrossingPoint& solver(int codim);
  // Loads F_I on the vertices of the corners but number `removed` (-1: on all).
  CrossingPoint& load_map(const Corners& corners, const Set& set, int removed);
  bool below(CrossingPoint& point, const Corners& corners, const Set& set, int removed, int inequality);
  void follow(const coxeter::Simplex& tau, Corners& corners, const Set& set, int removed, bool from_exit,
              const InteriorVisitor* interior);
  void insert(const coxeter::Simplex& simplex, Set set, bool from_exit, const InteriorVisitor* interior);
  bool others_near(const coxeter::Simplex& simplex, const Corners& corners, const Set& set);
  void process(const Task& task, const InteriorVisitor& interior);
  std::vector<int> bits(const std::vector<std::uint64_t>& mask) const;

  const Domain& domain_;
  LatticeValues& lattice_;
  int codim_, num_inequalities_;
  std::size_t row_;  // numbers a vertex
  std::map<Set, Stratum> strata_;
  std::deque<Task> tasks_;
  std::map<int, std::unique_ptr<CrossingPoint>> solvers_;
  std::vector<double> columns_;
  std::vector<const double*> column_pointers_;
  std::size_t size_ = 0;
  bool cut_by_undefined_ = false;
};

}  // namespace whitney
