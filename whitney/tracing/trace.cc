// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/trace.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <coxeter/faces/short_partition.h>
#include <coxeter/tables/lattice_order.h>
#include <whitney/tracing/boundary_trace.h>
#include <whitney/tracing/interior_trace.h>
#include <whitney/tracing/lattice_values.h>
#include <whitney/tracing/seed_start.h>

namespace whitney {

using coxeter::canonical_order;
using coxeter::lexicographic_order;
using coxeter::permute_rows;

namespace {

// How many d-simplices around a seed are searched for a boundary vertex when none holds one of the interior.
constexpr std::size_t kCornerSeedSimplices = 200;

constexpr int kMaxIntrinsicDim = 16;  // a simplex has 2^(n+1) flags

}  // namespace

/// One run: from every seed the interior, then its boundary, which may lead to more of the interior, until neither
/// grows.
template <class Shape>
class Tracer {
 public:
  Tracer(const Function& f, const coxeter::Triangulation& triangulation, const TraceOptions& options)
      : f_(f),
        triangulation_(triangulation),
        options_(options),
        d_(f.ambient_dim()),
        k_(f.codim()),
        domain_(d_, options.inequalities, options.box),
        lattice_(f, triangulation, domain_),
        boundary_(domain_.empty() ? nullptr : std::make_unique<BoundaryTrace>(domain_, lattice_, k_)),
        interior_(triangulation, k_, lattice_, boundary_.get()) {}

  TraceResult run(std::span<const double> seed_points);

 private:
  bool grow() {
    return interior_.grow([this] { return should_stop(); });
  }
  bool grow_boundary();
  bool should_stop();
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  void judge_unseen(SeedReport& report, const TraceResult& traced, SeedStarter& starter);
  TraceResult result();
  void list_boundary(TraceResult& out);
  std::vector<std::uint32_t> list_vertices(TraceResult& out);
  void list_interior(TraceResult& out, const std::vector<std::uint32_t>& rank);

  const Function& f_;
  const coxeter::Triangulation& triangulation_;
  const TraceOptions& options_;
  const int d_, k_;
  const Domain domain_;
  LatticeValues lattice_;
  std::unique_ptr<BoundaryTrace> boundary_;  // when there is a domain
  InteriorTrace<Shape> interior_;
  StopReason stop_ = StopReason::kNone;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

template <class Shape>
bool Tracer<Shape>::should_stop() {
  const double now = seconds();
  if (interior_.size() + (boundary_ ? boundary_->size() : 0) >= options_.run.max_simplices)
    stop_ = StopReason::kMaxSimplices;
  else if (now > options_.run.time_limit)
    stop_ = StopReason::kTimeLimit;
  else if (options_.run.progress && !options_.run.progress({"trace", interior_.size(), lattice_.evaluations(), now}))
    stop_ = StopReason::kCancelled;
  return stop_ != StopReason::kNone;
}

// The boundary of what has been found, and whatever else of the manifold it leads to. False at a limit.
template <class Shape>
bool Tracer<Shape>::grow_boundary() {
  constexpr std::size_t kSteps = 256;
  for (;;) {
    interior_.add_exits();
    bool more = true;
    while (more) {
      if (should_stop()) {
        interior_.stop();
        return false;
      }
      more = boundary_->grow(kSteps, [&](const coxeter::Simplex& sigma) {
        Crossing crossing;
        crossing.base.assign(sigma.base().begin(), sigma.base().end());
        const auto parts = sigma.partition().part_indices();
        crossing.parts.assign(parts.data(), parts.data() + d_);
        interior_.start_from(crossing);
      });
    }
    if (interior_.idle()) return true;
    if (!grow()) return false;
  }
}

template <class Shape>
TraceResult Tracer<Shape>::run(std::span<const double> seed_points) {
  SeedStarter starter(f_, domain_, triangulation_,
                      [&](std::span<const double> rows) { return boundary_->inside(rows); });
  TraceResult out;
  for (std::size_t i = 0; i + d_ <= seed_points.size() && stop_ == StopReason::kNone; i += d_) {
    const std::span<const double> seed = seed_points.subspan(i, d_);
    SeedStart start = starter.find(seed, options_.max_seed_simplices);
    SeedReport report{SeedReport::Outcome::kDropped, std::move(start.reason), std::move(start.unseen), 0};
    bool started = false, found = !start.crossings.empty();
    for (const Crossing& crossing : start.crossings) started = interior_.start_from(crossing) || started;
    if (!found && boundary_) {
      const std::size_t known = boundary_->size();
      found = starter.find_full(seed, std::min(options_.max_seed_simplices, kCornerSeedSimplices),
                                [&](const coxeter::Simplex& full) { return boundary_->find_in(full); });
      started = boundary_->size() > known;
    }
    if (found) {
      report.outcome = started ? SeedReport::Outcome::kUsed : SeedReport::Outcome::kMerged;
      report.reason.clear();
      if (grow() && boundary_) grow_boundary();
    }
    out.seeds.push_back(std::move(report));
  }
  while (out.seeds.size() * d_ < seed_points.size())
    out.seeds.push_back({.outcome = SeedReport::Outcome::kDropped, .reason = "the trace was stopped before its turn"});
  TraceResult traced = result();
  traced.seeds = std::move(out.seeds);
  for (SeedReport& report : traced.seeds) judge_unseen(report, traced, starter);
  traced.seed_evaluations = starter.evaluations();
  traced.seconds = seconds();
  return traced;
}

// What becomes of a seed at whose foot the search found nothing, now that the whole trace is there to be looked at.
template <class Shape>
void Tracer<Shape>::judge_unseen(SeedReport& report, const TraceResult& traced, SeedStarter& starter) {
  if (report.unseen.empty()) return;
  const double reach = SeedStarter::kNear * triangulation_.edge_length();
  const auto passes = [&](std::span<const double> points) {
    for (std::size_t at = 0; at < points.size(); at += d_) {
      double squared = 0;
      for (int c = 0; c < d_; ++c) {
        const double t = (points[at + c] - report.unseen[c]) / reach;
        squared += t * t;
      }
      if (squared <= 1) return true;
    }
    return false;
  };
  bool met = passes(traced.points());
  for (const BoundarySimplices& stratum : traced.boundary) met = met || passes(stratum.points);
  if (met && report.outcome == SeedReport::Outcome::kDropped) {
    report.outcome = SeedReport::Outcome::kMerged;
    report.reason.clear();
  }
  // A trace that was stopped may not have come there yet.
  const bool ended = traced.stop_reason == StopReason::kNone || traced.stop_reason == StopReason::kBox;
  if (met || !ended) {
    report.unseen.clear();
    return;
  }
  report.outcome = SeedReport::Outcome::kTooSmall;
  report.reason = "f = 0 passes there, but the part of it is too small for this edge length";
  report.finer_edge_length = starter.finer_edge_length(report.unseen);
}

// Puts everything into canonical order.
template <class Shape>
TraceResult Tracer<Shape>::result() {
  TraceResult out;
  out.ambient_dim_ = d_;
  out.codim_ = k_;
  out.evaluations = lattice_.evaluations();
  out.exact_decisions = interior_.exact_decisions();
  out.domain = domain_;
  out.stop_reason = stop_;
  bool undefined = interior_.cut_by_undefined();
  if (boundary_) {
    out.exact_decisions += boundary_->exact_decisions();
    undefined = undefined || boundary_->cut_by_undefined();
    bool cut = undefined;
    for (const auto& [inequalities, stratum] : boundary_->strata())
      for (int j : inequalities) cut = cut || domain_.is_box_side(j);
    if (cut && stop_ == StopReason::kNone) out.stop_reason = StopReason::kBox;
    list_boundary(out);
  }
  out.whole = stop_ == StopReason::kNone && !undefined;
  interior_.release();
  list_interior(out, list_vertices(out));
  return out;
}

// The vertices in lexicographic order; the new number of each.
template <class Shape>
std::vector<std::uint32_t> Tracer<Shape>::list_vertices(TraceResult& out) {
  coxeter::VertexTable& vertices = lattice_.table();
  vertices.release_index();
  const auto num_vertices = static_cast<std::uint32_t>(vertices.size());
  std::int32_t* coordinates = out.vertex_coordinates_.extend(std::size_t{num_vertices} * d_);
  for (std::uint32_t i = 0; i < num_vertices; ++i)
    std::copy_n(vertices.coordinates(i), d_, coordinates + std::size_t{i} * d_);
  const std::vector<std::uint32_t> vertex_order = lexicographic_order(out.vertex_coordinates_, d_);
  std::vector<std::uint32_t> rank(vertex_order.size());
  for (std::size_t i = 0; i < vertex_order.size(); ++i) rank[vertex_order[i]] = static_cast<std::uint32_t>(i);
  permute_rows(out.vertex_coordinates_.data(), d_, vertex_order);
  double* values = out.vertex_values_.extend(std::size_t{num_vertices} * k_);
  for (std::uint32_t i = 0; i < num_vertices; ++i)
    std::copy_n(lattice_.value(vertex_order[i]), k_, values + std::size_t{i} * k_);
  for (BoundarySimplices& stratum : out.boundary)
    for (std::uint32_t& base : stratum.base) base = rank[base];
  vertices.release();
  return rank;
}

template <class Shape>
void Tracer<Shape>::list_interior(TraceResult& out, const std::vector<std::uint32_t>& rank) {
  using Index = typename Shape::Index;
  auto& simplices = interior_.simplices();
  coxeter::GrowingArray<double>& points = interior_.points();
  // The simplices inside, in the order in which they were found.
  const auto found = static_cast<std::uint32_t>(simplices.size());
  std::vector<std::uint32_t> inside(found);
  for (std::uint32_t id : interior_.outside()) inside[id] = 1;
  std::uint32_t count = 0;
  for (std::uint32_t id = 0; id < found; ++id)
    if (inside[id] == 0) inside[count++] = id;
  if (count < found)
    for (std::uint32_t i = 0; i < count; ++i)
      std::copy_n(&points[std::size_t{inside[i]} * d_], d_, &points[std::size_t{i} * d_]);
  points.truncate(std::size_t{count} * d_);

  std::vector<std::uint32_t> order = canonical_order(
      rank.size(), count, d_, [&](std::uint32_t i) { return rank[simplices.base(inside[i])]; },
      [&](std::uint32_t i) { return simplices.parts(inside[i]); });
  permute_rows(points.data(), d_, order);
  for (std::uint32_t& i : order) i = inside[i];
  std::uint32_t* base = out.simplex_base_.extend(count);
  Index* parts;
  if constexpr (sizeof(Index) == 1)
    parts = out.parts_.extend(std::size_t{count} * d_);
  else
    parts = out.wide_parts_.extend(std::size_t{count} * d_);
  for (std::uint32_t i = 0; i < count; ++i) {
    base[i] = rank[simplices.base(order[i])];
    std::copy_n(simplices.parts(order[i]), d_, parts + std::size_t{i} * d_);
  }
  out.points_ = std::move(points);
}

// The strata of the boundary, in canonical order but for the numbers of the vertices.
template <class Shape>
void Tracer<Shape>::list_boundary(TraceResult& out) {
  std::vector<double> y(d_);
  for (const auto& [inequalities, stratum] : boundary_->strata()) {
    BoundarySimplices listed;
    listed.inequalities = inequalities;
    std::vector<coxeter::Simplex> simplices(stratum.points.begin(), stratum.points.end());
    std::sort(simplices.begin(), simplices.end());
    for (const coxeter::Simplex& sigma : simplices) {
      listed.base.push_back(lattice_.vertex(sigma.base()));
      const auto parts = sigma.partition().part_indices();
      listed.parts.insert(listed.parts.end(), parts.data(), parts.data() + d_);
      const std::vector<double> weights = boundary_->weights(sigma, inequalities);
      double total = 0, after = 0;
      for (double weight : weights) total += weight;
      for (int c = 0; c < d_; ++c) y[c] = sigma.base()[c];
      for (int q = sigma.dim(); q > 0; --q) {
        after += weights[q];
        for (std::uint16_t c : sigma.partition().part(q - 1)) y[c] += after / total;
      }
      const Eigen::VectorXd x = as_eigen(triangulation_.offset()) +
                                as_eigen(triangulation_.linear()) * Eigen::Map<const Eigen::VectorXd>(y.data(), d_);
      listed.points.insert(listed.points.end(), x.data(), x.data() + d_);
    }
    out.boundary.push_back(std::move(listed));
  }
  std::sort(out.boundary.begin(), out.boundary.end(), [](const BoundarySimplices& a, const BoundarySimplices& b) {
    return std::pair(a.inequalities.size(), a.inequalities) < std::pair(b.inequalities.size(), b.inequalities);
  });
}

namespace {

void check_arguments(const Function& f, const coxeter::Triangulation& triangulation,
                     std::span<const double> seed_points) {
  const int d = f.ambient_dim(), k = f.codim();
  if (triangulation.ambient_dim() != d)
    throw InvalidInput("trace: f is defined on R^" + std::to_string(d) + ", the triangulation is one of R^" +
                       std::to_string(triangulation.ambient_dim()));
  if (k >= d)
    throw InvalidInput("trace: " + std::to_string(k) + " equations in R^" + std::to_string(d) +
                       " leave no manifold of dimension 1 or more");
  if (d - k > kMaxIntrinsicDim)
    throw InvalidInput("trace: intrinsic dimension " + std::to_string(d - k) + " is beyond the largest supported, " +
                       std::to_string(kMaxIntrinsicDim));
  if (seed_points.size() % d != 0)
    throw InvalidInput("trace: " + std::to_string(seed_points.size()) +
                       " numbers are not a whole number of seed points in R^" + std::to_string(d));
  for (std::size_t i = 0; i < seed_points.size(); ++i)
    if (!std::isfinite(seed_points[i]))
      throw InvalidInput("trace: coordinate " + std::to_string(i % d + 1) + " of seed point " +
                         std::to_string(i / d + 1) + " is not finite");
}

}  // namespace

TraceResult trace(const Function& f, const coxeter::Triangulation& triangulation, std::span<const double> seed_points,
                  const TraceOptions& options) {
  check_arguments(f, triangulation, seed_points);
  auto run = [&]<class Shape>() { return Tracer<Shape>(f, triangulation, options).run(seed_points); };
  const int d = f.ambient_dim(), k = f.codim();
  if (k >= kFirstWideCodim) return run.template operator()<TraceShape<std::uint16_t, false>>();
  if (d > coxeter::kMaxShortDim || d - k > coxeter::kMaxShortExcess)
    return run.template operator()<TraceShape<std::uint8_t, false>>();
  // See interior_trace.cc.
  if (d == 3 && k == 1) return run.template operator()<TraceShape<std::uint8_t, true, 3, 1>>();
  if (d == 4 && k == 2) return run.template operator()<TraceShape<std::uint8_t, true, 4, 2>>();
  if (d == 6 && k == 3) return run.template operator()<TraceShape<std::uint8_t, true, 6, 3>>();
  if (d == 8 && k == 6) return run.template operator()<TraceShape<std::uint8_t, true, 8, 6>>();
  if (d == 10 && k == 8) return run.template operator()<TraceShape<std::uint8_t, true, 10, 8>>();
  return run.template operator()<TraceShape<std::uint8_t, true>>();
}

}  // namespace whitney
