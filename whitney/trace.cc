// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/trace.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

#include <coxeter/cofacet_step.h>
#include <coxeter/error.h>
#include <coxeter/simplex_table.h>
#include <coxeter/vertex_table.h>
#include <whitney/barycentric_kernel.h>
#include <whitney/exact_pivot.h>
#include <whitney/lattice_order.h>
#include <whitney/trace_seed.h>

namespace whitney {

using coxeter::GrowingArray;
using coxeter::SimplexTable;
using coxeter::VertexTable;

const char* to_string(StopReason reason) {
  switch (reason) {
    case StopReason::kNone:
      return "none";
    case StopReason::kBox:
      return "box";
    case StopReason::kMaxSimplices:
      return "max_simplices";
    case StopReason::kTimeLimit:
      return "time_limit";
    case StopReason::kCancelled:
      return "cancelled";
  }
  return "unknown";
}

namespace {

constexpr int kLanes = BarycentricKernel::kLanes;
constexpr std::size_t kBatch = 64;  // simplices whose cofacets are looked at together, so that f is asked in batches

// A split of a part with s elements into two non-empty ordered halves, 2^s - 2 of them, needs a flag; s <= n + 1.
constexpr int kMaxIntrinsicDim = 16;

}  // namespace

/// One run of the tracer.
///
/// Notation: sigma = (v_0; parts 0..k) a k-simplex; a cofacet tau arises when part q is split into A before B, which
/// adds the vertex w = v_q + e(A); as e(0) + .. + e(d) = 0, that is v_0 - e(B) when A holds the element d, and then w
/// is the base vertex of tau. A cofacet has a number: the splits of part 0, then those of part 1, ..; within a part, A
/// as a set of bits over the part's elements in increasing order, less 1.
///
/// kDim: d when known at compile time (every loop over coordinates is then straight code: measured: 10 to 15 % less
/// time), else 0.
template <class Index, int kDim>
class Tracer {
 public:
  Tracer(const Function& f, const coxeter::Triangulation& triangulation, const TraceOptions& options)
      : f_(f),
        triangulation_(triangulation),
        options_(options),
        d_{f.ambient_dim()},
        k_(f.codim()),
        vertices_(d_),
        simplices_(d_, flag_words(d_ - k_)),
        kernel_(k_),
        columns_(k_ + 1) {}

  TraceResult run(std::span<const double> seed_points);

 private:
  // A simplex that waits for its cofacets to be crossed.
  struct Pending {
    std::uint32_t id;
    std::uint64_t hash;
    std::uint32_t* vertices;  // k + 1 of them
  };
  struct Candidate {
    std::uint32_t part;     // q
    std::uint32_t split;    // A, bits over the elements of part q
    std::uint32_t special;  // its special half, bits over the coordinates; if d <= kMaxBitsDim
    std::uint32_t flag;     // number of the cofacet
    std::uint32_t vertex;   // w
    bool new_base;          // w is the base vertex of the cofacet
    std::uint64_t form;     // of w
  };
  // A cofacet being crossed.
  struct Step {
    const Candidate* candidate = nullptr;
    std::uint64_t* key = nullptr;  // of the simplex behind it
    std::uint64_t hash = 0;
    coxeter::CofacetStep over{};
  };
  // Queues are flat: id, hash (two words), vertices.
  std::size_t queue_stride() const { return 3 + k_ + 1; }

  static std::size_t flag_words(int intrinsic_dim) { return ((std::size_t{2} << intrinsic_dim) - 2 + 63) / 64; }

  double* value(std::uint32_t vertex) { return &values_[std::size_t{vertex} * k_]; }
  // Room for the k + 1 vertices of a simplex that joins the queue.
  std::uint32_t* enqueue(std::uint32_t id, std::uint64_t hash);
  Pending pending(std::size_t i);
  void evaluate_new_vertices();
  bool start_from(const Crossing& crossing);
  bool grow();
  void process(std::size_t first, std::size_t count);
  void list_cofacets(const Pending& simplex, std::size_t slot);
  void prepare(const Pending& simplex, std::size_t slot, const Candidate& candidate, int leaving, Step& step);
  void take(const Pending& simplex, const Step& step);
  void report_point(const Pending& simplex, int lane);
  coxeter::PartLists part_lists(std::size_t slot) {
    return {&elements_[slot * (d_ + 1)], &starts_[slot * (k_ + 2)], &numbers_[slot * (k_ + 2)]};
  }
  OracleError not_finite(int component, double value, const double* x) const;
  bool should_stop();
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  TraceResult result();

  const Function& f_;
  const coxeter::Triangulation& triangulation_;
  const TraceOptions& options_;
  struct Dim {
    int value;
    constexpr operator int() const { return kDim > 0 ? kDim : value; }
  };
  const Dim d_;
  const int k_;

  VertexTable vertices_;
  GrowingArray<double> values_;  // f, k a vertex; meaningless where outside_
  GrowingArray<char> outside_;   // filled only when there is a box
  SimplexTable<Index> simplices_;
  GrowingArray<double> points_;  // d a simplex
  BarycentricKernel kernel_;

  GrowingArray<std::uint32_t> queue_, next_queue_;
  std::size_t evaluations_ = 0, exact_decisions_ = 0;
  bool cut_by_box_ = false;
  StopReason stop_ = StopReason::kNone;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  // Part lists of the simplices of one batch, a slot each.
  std::vector<std::uint16_t> elements_, starts_;
  std::vector<std::uint32_t> numbers_;
  std::vector<Candidate> candidates_;
  std::vector<std::size_t> candidate_begin_;

  // Scratch.
  std::vector<std::uint64_t> keys_;
  Step steps_[kLanes];
  std::vector<const double*> columns_;
  std::vector<std::int32_t> z_;
  std::vector<std::uint64_t> form_sums_;  // over the subsets of one part
  std::vector<std::uint32_t> bit_sums_;
  std::vector<double> x_, f_values_, weights_, sums_, y_;
};

template <class Index, int kDim>
std::uint32_t* Tracer<Index, kDim>::enqueue(std::uint32_t id, std::uint64_t hash) {
  std::uint32_t* entry = next_queue_.extend(queue_stride());
  entry[0] = id;
  std::memcpy(entry + 1, &hash, sizeof hash);
  return entry + 3;
}

template <class Index, int kDim>
typename Tracer<Index, kDim>::Pending Tracer<Index, kDim>::pending(std::size_t i) {
  std::uint32_t* entry = queue_.data() + i * queue_stride();
  Pending simplex{entry[0], 0, entry + 3};
  std::memcpy(&simplex.hash, entry + 1, sizeof simplex.hash);
  return simplex;
}

template <class Index, int kDim>
OracleError Tracer<Index, kDim>::not_finite(int component, double value, const double* x) const {
  std::string at;
  char number[32];
  for (int c = 0; c < d_; ++c) {
    std::snprintf(number, sizeof number, "%s%.17g", c ? ", " : "", x[c]);
    at += number;
  }
  return OracleError("component " + std::to_string(component + 1) + " of f is " +
                     (std::isnan(value) ? "NaN" : "infinite") + " at (" + at + ")");
}

template <class Index, int kDim>
void Tracer<Index, kDim>::evaluate_new_vertices() {
  const std::size_t known = values_.size() / k_, size = vertices_.size();
  if (known == size) return;
  const std::size_t count = size - known;
  x_.resize(count * d_);
  std::size_t asked = 0;
  for (std::size_t i = 0; i < count; ++i) {
    double* x = &x_[asked * d_];
    triangulation_.cartesian({vertices_.coordinates(static_cast<std::uint32_t>(known + i)), std::size_t(d_)},
                             {x, std::size_t(d_)});
    bool inside = true;
    if (options_.box)
      for (int c = 0; c < d_; ++c) inside = inside && x[c] >= options_.box->lower[c] && x[c] <= options_.box->upper[c];
    if (options_.box) outside_.push_back(!inside);
    asked += inside;
  }
  f_values_.resize(asked * k_);
  f_.evaluate({x_.data(), asked * d_}, f_values_);
  evaluations_ += asked;
  double* values = values_.extend(count * k_);
  std::size_t read = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (options_.box && outside_[known + i]) {
      std::fill_n(values + i * k_, k_, 0.0);
      continue;
    }
    for (int r = 0; r < k_; ++r) {
      const double value = f_values_[read * k_ + r];
      if (!std::isfinite(value)) throw not_finite(r, value, &x_[read * d_]);
      values[i * k_ + r] = value;
    }
    ++read;
  }
}

// Lists the cofacets not yet crossed of a simplex, with the form of the vertex each adds.
template <class Index, int kDim>
void Tracer<Index, kDim>::list_cofacets(const Pending& simplex, std::size_t slot) {
  const coxeter::PartLists lists = part_lists(slot);
  coxeter::list_parts(simplices_.parts(simplex.id), d_, k_, lists);
  const std::uint64_t* weights = vertices_.weights();
  const std::uint64_t* flags = simplices_.flags(simplex.id);
  for (int q = 0; q <= k_; ++q) {
    const int size = lists.size(q);
    if (size < 2) continue;
    const std::uint16_t* part = lists.part(q);
    const std::uint32_t whole = (std::uint32_t{1} << size) - 1;
    const bool bits_fit = d_ <= coxeter::kMaxBitsDim;
    // Sums over all subsets of the part, each from a smaller one.
    form_sums_[0] = vertices_.form(simplex.vertices[q]);
    bit_sums_[0] = 0;
    for (std::uint32_t split = 1; split <= whole; ++split) {
      const std::uint32_t rest = split & (split - 1);
      const std::uint16_t element = part[std::countr_zero(split)];
      form_sums_[split] = form_sums_[rest] + weights[element];
      if (bits_fit) bit_sums_[split] = bit_sums_[rest] | std::uint32_t{1} << element;
    }
    std::uint32_t flag = lists.numbers[q];
    for (std::uint32_t split = 1; split < whole; ++split, ++flag) {
      if (flags[flag / 64] >> (flag % 64) & 1) continue;
      vertices_.prefetch(form_sums_[split]);
      candidates_.push_back({static_cast<std::uint32_t>(q), split,
                             bits_fit ? coxeter::special_half(bit_sums_[split], bit_sums_[whole], d_) : 0, flag, 0,
                             q == k_ && (split >> (size - 1) & 1), form_sums_[split]});
    }
  }
}

// From sigma over the cofacet to its other k-face that is hit, the one without vertex `leaving` of sigma: everything
// about it but whether it is known.
template <class Index, int kDim>
void Tracer<Index, kDim>::prepare(const Pending& simplex, std::size_t slot, const Candidate& candidate, int leaving,
                                  Step& step) {
  step.candidate = &candidate;
  Index* out = SimplexTable<Index>::parts_of(step.key);
  step.over =
      coxeter::step_over_cofacet(simplices_.parts(simplex.id), part_lists(slot), d_, k_,
                                 static_cast<int>(candidate.part), candidate.split, candidate.special, leaving, out);
  const std::uint32_t* v = simplex.vertices;
  std::uint32_t base = step.over.inserted == 0 ? candidate.vertex : v[0];
  if (step.over.removed == 0) base = step.over.inserted == 1 ? candidate.vertex : v[1];
  SimplexTable<Index>::set_base(step.key, base);
  step.hash = simplex.hash + coxeter::mix64(candidate.form) - coxeter::mix64(vertices_.form(v[leaving]));
  simplices_.prefetch(step.hash);
}

template <class Index, int kDim>
void Tracer<Index, kDim>::take(const Pending& simplex, const Step& step) {
  const std::size_t known = simplices_.size();
  const std::uint32_t id = simplices_.intern(step.key, step.hash);
  if (id == known) {
    std::uint32_t* out = enqueue(id, step.hash);
    const std::uint32_t* v = simplex.vertices;
    for (int position = 0; position <= k_ + 1; ++position) {
      const std::uint32_t vertex = position == step.over.inserted ? step.candidate->vertex : *v++;
      if (position != step.over.removed) *out++ = vertex;
    }
  }
  simplices_.set_flag(simplex.id, step.candidate->flag);
  simplices_.set_flag(id, step.over.number);
}

// x = b + Lambda (sum_q lambda_q v_q), where coordinate c of the sum is v_0[c] plus the weights of the vertices after
// its part.
template <class Index, int kDim>
void Tracer<Index, kDim>::report_point(const Pending& simplex, int lane) {
  if (kernel_.reliable(lane)) {
    for (int q = 0; q <= k_; ++q) weights_[q] = std::max(kernel_.weight(lane, q), 0.0);
  } else {
    for (int q = 0; q <= k_; ++q) columns_[q] = value(simplex.vertices[q]);
    weights_ = exact_weights(columns_);
  }
  double total = 0;
  for (int q = k_; q >= 0; --q) {
    sums_[q] = total;
    total += weights_[q];
  }
  const Index* parts = simplices_.parts(simplex.id);
  const std::int32_t* base = vertices_.coordinates(simplex.vertices[0]);
  for (int q = 0; q <= k_; ++q) sums_[q] /= total;
  for (int c = 0; c < d_; ++c) y_[c] = base[c] + sums_[parts[c]];
  double* x = &points_[std::size_t{simplex.id} * d_];
  const Eigen::MatrixXd& linear = triangulation_.linear();
  for (int r = 0; r < d_; ++r) x[r] = triangulation_.offset()[r];
  for (int c = 0; c < d_; ++c) {
    const double* column = linear.data() + std::size_t(c) * d_;
    const double y = y_[c];
    for (int r = 0; r < d_; ++r) x[r] += y * column[r];
  }
}

template <class Index, int kDim>
void Tracer<Index, kDim>::process(std::size_t first, std::size_t count) {
  candidates_.clear();
  candidate_begin_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    candidate_begin_.push_back(candidates_.size());
    list_cofacets(pending(first + i), i);
  }
  candidate_begin_.push_back(candidates_.size());

  for (std::size_t i = 0; i < count; ++i) {
    const Pending simplex = pending(first + i);
    const coxeter::PartLists lists = part_lists(i);
    for (std::size_t j = candidate_begin_[i]; j < candidate_begin_[i + 1]; ++j) {
      Candidate& candidate = candidates_[j];
      // w = v_q + e(A), or v_0 - e(B) if that is below v_0.
      const std::int32_t* z = vertices_.coordinates(simplex.vertices[candidate.new_base ? 0 : candidate.part]);
      const std::int32_t step = candidate.new_base ? -1 : 1;
      if (d_ <= coxeter::kMaxBitsDim) {
        for (int c = 0; c < d_; ++c) z_[c] = z[c] + step * static_cast<std::int32_t>(candidate.special >> c & 1);
      } else {
        std::copy_n(z, int{d_}, z_.begin());
        const std::uint16_t* part = lists.part(static_cast<int>(candidate.part));
        std::uint32_t half = candidate.split;
        if (candidate.new_base) half = ~half & ((std::uint32_t{1} << lists.size(static_cast<int>(candidate.part))) - 1);
        for (; half != 0; half &= half - 1) z_[part[std::countr_zero(half)]] += step;
      }
      candidate.vertex = vertices_.template intern<kDim>(z_.data(), candidate.form);
    }
  }
  evaluate_new_vertices();
  points_.extend(simplices_.size() * d_ - points_.size());

  for (std::size_t group = 0; group < count; group += kLanes) {
    const int lanes = static_cast<int>(std::min<std::size_t>(kLanes, count - group));
    Pending simplex[kLanes];
    std::size_t next[kLanes];
    for (int lane = 0; lane < lanes; ++lane) {
      simplex[lane] = pending(first + group + lane);
      next[lane] = candidate_begin_[group + lane];
      for (int q = 0; q <= k_; ++q) kernel_.set_vertex(lane, q, value(simplex[lane].vertices[q]));
    }
    kernel_.factor();
    for (int lane = 0; lane < lanes; ++lane) report_point(simplex[lane], lane);

    for (;;) {
      const Candidate* current[kLanes] = {};
      bool any = false;
      for (int lane = 0; lane < lanes; ++lane) {
        for (std::size_t& j = next[lane]; j < candidate_begin_[group + lane + 1]; ++j) {
          const Candidate& candidate = candidates_[j];
          if (!outside_.empty() && outside_[candidate.vertex]) {
            cut_by_box_ = true;
            continue;
          }
          // Another simplex of this batch may have crossed the same cofacet from its other side.
          if (simplices_.flag(simplex[lane].id, candidate.flag)) continue;
          current[lane] = &candidate;
          kernel_.set_candidate(lane, value(candidate.vertex));
          any = true;
          ++j;
          break;
        }
      }
      if (!any) break;
      kernel_.pivot();
      for (int lane = 0; lane < lanes; ++lane) {
        if (current[lane] == nullptr) continue;
        int leaving = kernel_.leaving(lane);
        if (leaving == BarycentricKernel::kUndecided) {
          for (int q = 0; q <= k_; ++q) columns_[q] = value(simplex[lane].vertices[q]);
          leaving = exactly_leaving(columns_, value(current[lane]->vertex));
          ++exact_decisions_;
        }
        prepare(simplex[lane], group + lane, *current[lane], leaving, steps_[lane]);
      }
      for (int lane = 0; lane < lanes; ++lane)
        if (current[lane] != nullptr && !simplices_.flag(simplex[lane].id, current[lane]->flag))
          take(simplex[lane], steps_[lane]);
    }
  }
}

// The first simplex of a trace. False when it is known already.
template <class Index, int kDim>
bool Tracer<Index, kDim>::start_from(const Crossing& crossing) {
  std::vector<std::int32_t> z = crossing.base;
  std::vector<std::uint32_t> ids(k_ + 1);
  std::uint64_t hash = 0;
  std::uint64_t* key = steps_[0].key;
  std::fill_n(key, simplices_.key_words(), 0);
  for (int c = 0; c < d_; ++c) SimplexTable<Index>::parts_of(key)[c] = static_cast<Index>(crossing.parts[c]);
  for (int q = 0; q <= k_; ++q) {
    const std::uint64_t form = vertices_.form_of(z.data());
    ids[q] = vertices_.intern(z.data(), form);
    hash += coxeter::mix64(form);
    for (int c = 0; c < d_; ++c) z[c] += crossing.parts[c] == q;
  }
  SimplexTable<Index>::set_base(key, ids[0]);
  evaluate_new_vertices();
  const std::size_t known = simplices_.size();
  const std::uint32_t id = simplices_.intern(key, hash);
  if (id < known) return false;
  std::copy(ids.begin(), ids.end(), enqueue(id, hash));
  return true;
}

template <class Index, int kDim>
bool Tracer<Index, kDim>::should_stop() {
  const double now = seconds();
  if (simplices_.size() >= options_.max_simplices)
    stop_ = StopReason::kMaxSimplices;
  else if (now > options_.time_limit)
    stop_ = StopReason::kTimeLimit;
  else if (options_.progress && !options_.progress({simplices_.size(), evaluations_, now}))
    stop_ = StopReason::kCancelled;
  return stop_ != StopReason::kNone;
}

// Breadth first until nothing is left, or a limit. Points of simplices still waiting at a limit are filled in as well.
template <class Index, int kDim>
bool Tracer<Index, kDim>::grow() {
  while (!next_queue_.empty()) {
    queue_.swap(next_queue_);
    next_queue_.clear();
    const std::size_t count = queue_.size() / queue_stride();
    for (std::size_t first = 0; first < count; first += kBatch) {
      if (should_stop()) {
        // What waits is part of what was found: it has its points, but its cofacets are not crossed.
        const std::size_t left = count - first;
        next_queue_.append(&queue_[first * queue_stride()], left * queue_stride());
        queue_.swap(next_queue_);
        points_.extend(simplices_.size() * d_ - points_.size());
        for (std::size_t i = 0; i < queue_.size() / queue_stride(); ++i) {
          const Pending simplex = pending(i);
          for (int q = 0; q <= k_; ++q) kernel_.set_vertex(0, q, value(simplex.vertices[q]));
          kernel_.factor();
          report_point(simplex, 0);
        }
        return false;
      }
      process(first, std::min(kBatch, count - first));
    }
  }
  return true;
}

template <class Index, int kDim>
TraceResult Tracer<Index, kDim>::run(std::span<const double> seed_points) {
  elements_.resize(kBatch * (d_ + 1));
  starts_.resize(kBatch * (k_ + 2));
  numbers_.resize(kBatch * (k_ + 2));
  const std::size_t key_room = simplices_.key_words() + coxeter::kStepSlack * sizeof(Index) / 8 + 2;
  keys_.assign(kLanes * key_room, 0);
  for (int lane = 0; lane < kLanes; ++lane) steps_[lane].key = &keys_[lane * key_room];
  form_sums_.resize(std::size_t{2} << (d_ - k_));
  bit_sums_.resize(std::size_t{2} << (d_ - k_));
  z_.resize(d_);
  weights_.resize(k_ + 1);
  sums_.resize(k_ + 1);
  y_.resize(d_);

  std::vector<double> x(d_);
  SeedSearch search(triangulation_, k_, [&](const std::int32_t* z, double* values) {
    triangulation_.cartesian({z, std::size_t(d_)}, x);
    if (options_.box)
      for (int c = 0; c < d_; ++c)
        if (!(x[c] >= options_.box->lower[c] && x[c] <= options_.box->upper[c])) return false;
    f_.evaluate(x, {values, std::size_t(k_)});
    for (int r = 0; r < k_; ++r) {
      if (!std::isfinite(values[r])) throw not_finite(r, values[r], x.data());
    }
    return true;
  });

  TraceResult out;
  for (std::size_t i = 0; i + d_ <= seed_points.size() && stop_ == StopReason::kNone; i += d_) {
    SeedReport report;
    Crossing crossing;
    if (search.search(seed_points.subspan(i, d_), options_.max_seed_simplices, crossing, report.reason)) {
      report.outcome = start_from(crossing) ? SeedReport::Outcome::kUsed : SeedReport::Outcome::kMerged;
      grow();
    }
    out.seeds.push_back(std::move(report));
  }
  while (out.seeds.size() * d_ < seed_points.size())
    out.seeds.push_back({SeedReport::Outcome::kDropped, "the trace was stopped before its turn"});
  TraceResult traced = result();
  traced.seeds = std::move(out.seeds);
  traced.seed_evaluations = search.evaluations();
  traced.seconds = seconds();
  return traced;
}

// Puts everything into canonical order.
template <class Index, int kDim>
TraceResult Tracer<Index, kDim>::result() {
  TraceResult out;
  out.ambient_dim_ = d_;
  out.codim_ = k_;
  out.evaluations = evaluations_;
  out.exact_decisions = exact_decisions_;
  out.stop_reason = stop_ == StopReason::kNone && cut_by_box_ ? StopReason::kBox : stop_;
  queue_.release();
  next_queue_.release();
  simplices_.release_index();

  out.vertex_coordinates_ = vertices_.take_coordinates();
  const std::vector<std::uint32_t> vertex_order = lexicographic_order(out.vertex_coordinates_, d_);
  std::vector<std::uint32_t> rank(vertex_order.size());
  for (std::size_t i = 0; i < vertex_order.size(); ++i) rank[vertex_order[i]] = static_cast<std::uint32_t>(i);
  permute_rows(out.vertex_coordinates_.data(), d_, vertex_order);
  permute_rows(values_.data(), k_, vertex_order);
  out.vertex_values_ = std::move(values_);

  const auto count = static_cast<std::uint32_t>(simplices_.size());
  const std::vector<std::uint32_t> order = canonical_order(
      rank.size(), count, d_, [&](std::uint32_t i) { return rank[simplices_.base(i)]; },
      [&](std::uint32_t i) { return simplices_.parts(i); });
  std::uint32_t* base = out.simplex_base_.extend(count);
  Index* parts;
  if constexpr (sizeof(Index) == 1)
    parts = out.parts_.extend(std::size_t{count} * d_);
  else
    parts = out.wide_parts_.extend(std::size_t{count} * d_);
  for (std::uint32_t i = 0; i < count; ++i) {
    base[i] = rank[simplices_.base(order[i])];
    std::copy_n(simplices_.parts(order[i]), d_, parts + std::size_t{i} * d_);
  }
  permute_rows(points_.data(), d_, order);
  out.points_ = std::move(points_);
  return out;
}

namespace {

void check_arguments(const Function& f, const coxeter::Triangulation& triangulation,
                     std::span<const double> seed_points, const TraceOptions& options) {
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
  if (!options.box) return;
  if (options.box->lower.size() != std::size_t(d) || options.box->upper.size() != std::size_t(d))
    throw InvalidInput("trace: the box must have " + std::to_string(d) + " lower and upper bounds");
  for (int c = 0; c < d; ++c)
    if (!(options.box->lower[c] < options.box->upper[c]))
      throw InvalidInput("trace: the box is empty along coordinate " + std::to_string(c + 1));
}

}  // namespace

TraceResult trace(const Function& f, const coxeter::Triangulation& triangulation, std::span<const double> seed_points,
                  const TraceOptions& options) {
  check_arguments(f, triangulation, seed_points, options);
  auto run = [&]<class Index, int kDim>() { return Tracer<Index, kDim>(f, triangulation, options).run(seed_points); };
  if (f.codim() >= TraceResult::kFirstWideCodim) return run.template operator()<std::uint16_t, 0>();
  switch (f.ambient_dim()) {
    case 3:
      return run.template operator()<std::uint8_t, 3>();
    case 4:
      return run.template operator()<std::uint8_t, 4>();
    case 5:
      return run.template operator()<std::uint8_t, 5>();
    case 6:
      return run.template operator()<std::uint8_t, 6>();
    case 8:
      return run.template operator()<std::uint8_t, 8>();
    case 10:
      return run.template operator()<std::uint8_t, 10>();
    default:
      return run.template operator()<std::uint8_t, 0>();
  }
}

}  // namespace whitney
