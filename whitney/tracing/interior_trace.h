// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <coxeter/base/growing_array.h>
#include <coxeter/simplex.h>
#include <coxeter/tables/simplex_table.h>
#include <coxeter/triangulation.h>
#include <whitney/tracing/barycentric_kernel.h>
#include <whitney/tracing/boundary_trace.h>
#include <whitney/tracing/cofacet_lists.h>
#include <whitney/tracing/lattice_values.h>
#include <whitney/tracing/seed_search.h>

namespace whitney {

/// The k-simplices that meet the zero set, found by pivoting from facet to facet, breadth first.
///
/// With a domain, simplices that meet f = 0 outside it are entered like the others, but their cofacets are not crossed:
/// those that are marked were crossed from inside, and are the edges that leave the domain.
///
/// Shape: a TraceShape; the definitions are in interior_trace.cc, for the shapes listed there.
template <class Shape>
class InteriorTrace {
 public:
  using Index = typename Shape::Index;
  static constexpr int kDim = Shape::kDim, kCodim = Shape::kCodim;
  using Table = coxeter::SimplexTable<Index, kDim>;

  /// boundary: null when there is no domain. All must outlive this.
  InteriorTrace(const coxeter::Triangulation& triangulation, int codim, LatticeValues& lattice,
                BoundaryTrace* boundary);

  /// Enters a simplex to go on from. False when it is known already.
  bool start_from(const Crossing& crossing);
  /// Until nothing is left (true), or should_stop says so; it is asked for every batch of simplices. Points of
  /// simplices that still wait then are filled in.
  bool grow(const std::function<bool()>& should_stop);
  bool idle() const { return next_queue_.empty(); }
  /// To be called when a limit is met outside grow().
  void stop() {
    queue_.clear();
    report_waiting(0);
  }

  /// Hands the edges that leave the domain to the boundary, each once.
  void add_exits();

  /// Simplices found inside the domain.
  std::size_t size() const { return simplices_.size() - outside_.size(); }
  /// The simplices found, by number, those outside the domain included; d coordinates of its point for each.
  Table& simplices() { return simplices_; }
  coxeter::GrowingArray<double>& points() { return points_; }
  const std::vector<std::uint32_t>& outside() const { return outside_; }
  std::size_t exact_decisions() const { return exact_decisions_; }
  /// Whether cofacets were not crossed because f has no value somewhere behind them.
  bool cut_by_undefined() const { return cut_by_undefined_; }
  /// Frees what only the search needs.
  void release() {
    queue_.release();
    next_queue_.release();
    simplices_.release_index();
  }

 private:
  static constexpr int kLanes = BarycentricKernel::kLanes;
  using Pending = PendingSimplex;
  using Candidate = CofacetCandidate;
  struct Step {
    std::uint64_t* key;
    std::uint64_t hash;
    CofacetCrossing over;
  };
  // Queues are flat: id, vertices, one word to spare.
  std::size_t queue_stride() const { return 1 + (k_ + 1) + 1; }
  // A split of a part with s elements into two non-empty ordered halves, 2^s - 2 of them, needs a flag; s <= n + 1.
  static std::size_t flag_words(int intrinsic_dim) { return ((std::size_t{2} << intrinsic_dim) - 2 + 63) / 64; }

  // Room for the k + 1 vertices of a simplex that joins the queue.
  std::uint32_t* enqueue(std::uint32_t id) {
    std::uint32_t* entry = next_queue_.extend(queue_stride());
    entry[0] = id;
    return entry + 1;
  }
  Pending pending(std::size_t i) const {
    const std::uint32_t* entry = queue_.data() + i * queue_stride();
    return {entry[0], entry + 1};
  }
  bool inside(const Pending& simplex);
  coxeter::Simplex simplex_of(std::uint32_t id);
  coxeter::Simplex cofacet_of(std::uint32_t id, std::uint32_t number);
  void report_waiting(std::size_t first);
  void process(std::size_t first, std::size_t count, std::size_t stride);
  std::size_t list_open(const Pending* simplex, std::size_t group, int lanes);
  void look_up_vertices();
  void find_leaving(const Pending* simplex, int lanes);
  void prepare(const Pending& simplex, const Candidate& candidate, Step& step);
  void take(const Pending& simplex, const Candidate& candidate, const Step& step);
  void take_weights(const Pending& simplex, int lane);
  void report_point(const Pending& simplex);
  double* value(std::uint32_t vertex) { return vertices_.values(vertex); }

  const coxeter::Triangulation& triangulation_;
  const KnownInt<kDim> d_;
  const KnownInt<kCodim> k_;
  LatticeValues& lattice_;
  coxeter::VertexTable& vertices_;
  BoundaryTrace* boundary_;
  Table simplices_;
  coxeter::GrowingArray<double> points_;
  BarycentricKernel kernel_;
  CofacetLists<Shape> cofacets_;

  coxeter::GrowingArray<std::uint32_t> queue_, next_queue_;
  std::size_t exact_decisions_ = 0;
  bool cut_by_undefined_ = false;

  // The simplices of one batch and their candidates.
  coxeter::GrowingArray<Candidate> candidates_;
  std::size_t candidate_begin_[kTraceBatch + 1];
  Pending batch_[kTraceBatch];
  // Candidates of one group that are still to be crossed, by lane.
  coxeter::GrowingArray<std::uint32_t> open_;
  std::size_t open_begin_[kLanes + 1];

  // Scratch.
  std::vector<std::uint64_t> keys_;
  Step steps_[kTraceAhead];
  std::vector<const double*> columns_;
  std::vector<double> weights_, sums_, y_;

  std::vector<std::uint32_t> outside_;      // simplices that meet f = 0 outside the domain
  std::vector<std::uint64_t> exits_taken_;  // their cofacets that add_exits has seen, flag words each
};

}  // namespace whitney
