// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/trace.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <utility>

#include <coxeter/base/error.h>
#include <coxeter/faces/cofacet_step.h>
#include <coxeter/faces/short_partition.h>
#include <coxeter/tables/lattice_order.h>
#include <coxeter/tables/simplex_table.h>
#include <coxeter/tables/vertex_table.h>
#include <whitney/tracing/barycentric_kernel.h>
#include <whitney/tracing/boundary_trace.h>
#include <whitney/tracing/exact_pivot.h>
#include <whitney/tracing/seed_start.h>

namespace whitney {

using coxeter::canonical_order;
using coxeter::GrowingArray;
using coxeter::lexicographic_order;
using coxeter::permute_rows;
using coxeter::SimplexTable;
using coxeter::VertexTable;

namespace {

constexpr int kLanes = BarycentricKernel::kLanes;
constexpr std::size_t kBatch = 64;  // simplices whose cofacets are looked at together, so that f is asked in batches
// Neighbours in the queue have cofacets in common. A batch is every kStride-th simplex of a stretch of the queue, so
// that most cofacets are known to be crossed before their other side is looked at.
constexpr std::size_t kStride = 16;
constexpr std::size_t kAhead = 32;  // simplices looked up together, so that memory is waited for once

// How many d-simplices around a seed are searched for a boundary vertex when none holds one of the interior.
constexpr std::size_t kCornerSeedSimplices = 200;

// A split of a part with s elements into two non-empty ordered halves, 2^s - 2 of them, needs a flag; s <= n + 1.
constexpr int kMaxIntrinsicDim = 16;

}  // namespace

namespace {

/// What is known at compile time: the type of part numbers; d and k, or 0; whether ShortPartition fits.
template <class IndexType, bool kShortForm, int kAmbientDim = 0, int kNumEquations = 0>
struct Shape {
  using Index = IndexType;
  static constexpr bool kShort = kShortForm;
  static constexpr int kDim = kAmbientDim, kCodim = kNumEquations;
};

}  // namespace

/// The linear form of VertexTable at e(U), for every subset U of {0..d-1}, d <= 15, from two small tables.
class SubsetForms {
 public:
  SubsetForms() = default;
  SubsetForms(const std::uint64_t* weights, int dim) {
    for (int c = 0; c < dim; ++c) {
      std::uint64_t* half = c < 8 ? low_ : high_;
      const int bit = 1 << (c & 7);
      for (int u = 0; u < bit; ++u) half[bit | u] = half[u] + weights[c];
    }
  }
  std::uint64_t operator()(std::uint32_t subset) const { return low_[subset & 255] + high_[subset >> 8]; }

 private:
  std::uint64_t low_[256] = {}, high_[128] = {};
};

/// One run of the tracer.
///
/// Notation: sigma = (v_0; parts 0..k) a k-simplex; a cofacet tau arises when part q is split into A before B, which
/// adds the vertex w = v_q + e(A); as e(0) + .. + e(d) = 0, that is v_0 - e(B) when A holds the element d, and then w
/// is the base vertex of tau. A cofacet has a number: the splits of part 0, then those of part 1, ..; within a part, A
/// as a set of bits over the part's elements in increasing order, less 1.
///
/// Two forms of the same steps: ShortPartition where it fits, part lists otherwise.
///
/// With a domain, simplices that meet f = 0 outside it are entered like the others, but their cofacets are not crossed:
/// those that are marked were crossed from inside, and are the edges that leave the domain.
template <class Shape>
class Tracer : private LatticeValues {
  using Index = typename Shape::Index;
  static constexpr int kDim = Shape::kDim, kCodim = Shape::kCodim;
  static constexpr bool kShort = Shape::kShort;

 public:
  Tracer(const Function& f, const coxeter::Triangulation& triangulation, const TraceOptions& options)
      : f_(f),
        triangulation_(triangulation),
        options_(options),
        d_{f.ambient_dim()},
        k_{f.codim()},
        domain_(f.ambient_dim(), options.inequalities, options.box),
        num_given_(domain_.num_given()),
        mask_words_(domain_.num_words()),
        vertices_(d_, static_cast<int>(k_ + num_given_ + mask_words_)),
        simplices_(d_, flag_words(d_ - k_)),
        kernel_(k_),
        columns_(k_ + 1),
        mask_of_all_(mask_words_, 0) {
    if (!domain_.empty()) boundary_.emplace(domain_, static_cast<LatticeValues&>(*this), int{k_});
  }

  TraceResult run(std::span<const double> seed_points);

 private:
  // A simplex that waits for its cofacets to be crossed.
  struct Pending {
    std::uint32_t id;
    const std::uint32_t* vertices;  // k + 1 of them; one more on either side may be read
  };
  // A cofacet not yet crossed.
  struct Candidate {
    std::uint64_t form;     // of w
    std::uint32_t vertex;   // w
    std::uint32_t split;    // A, bits over the elements of part q; the long form only
    std::uint32_t special;  // its special half, bits over the coordinates; if d <= kMaxBitsDim
    std::uint32_t flag;     // number of the cofacet
    std::int32_t leaving;   // the vertex of sigma that is not in the simplex behind the cofacet
    std::uint16_t part;     // q
    std::uint8_t slot;      // of sigma in the batch
    bool new_base;          // w is the base vertex of the cofacet
  };
  // The simplex behind a cofacet.
  struct Step {
    std::uint64_t* key;
    std::uint64_t hash;
    int inserted, removed;  // positions among the vertices of the cofacet, see coxeter::CofacetStep
    std::uint32_t flag;     // number of the cofacet, seen from here
  };
  // Queues are flat: id, vertices, one word to spare.
  std::size_t queue_stride() const { return 1 + (k_ + 1) + 1; }

  static std::size_t flag_words(int intrinsic_dim) { return ((std::size_t{2} << intrinsic_dim) - 2 + 63) / 64; }

  // f, the given inequalities, the mask.
  double* value(std::uint32_t vertex) { return vertices_.values(vertex); }
  std::uint64_t* mask_at(std::uint32_t vertex) {
    return reinterpret_cast<std::uint64_t*>(value(vertex) + k_ + num_given_);
  }

  // LatticeValues.
  std::uint32_t vertex(std::span<const std::int32_t> z) override;
  void values(std::uint32_t vertex, double* out) const override;
  const std::uint64_t* mask(std::uint32_t vertex) const override { return const_cast<Tracer*>(this)->mask_at(vertex); }
  const std::uint64_t* mask_of_all() const override { return mask_of_all_.data(); }
  bool inside(const Pending& simplex);
  coxeter::Simplex simplex_of(std::uint32_t id);
  coxeter::Simplex cofacet_of(std::uint32_t id, std::uint32_t number);
  void add_exits();
  bool grow_boundary();
  void list_boundary(TraceResult& out);
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
  void evaluate_new_vertices();
  bool start_from(const Crossing& crossing);
  bool grow();
  void report_waiting(std::size_t first);
  void process(std::size_t first, std::size_t count, std::size_t stride);
  void list_cofacets_short(const Pending& simplex, std::size_t slot);
  void list_cofacets(const Pending& simplex, std::size_t slot);
  void look_up_vertices();
  void find_leaving(const Pending* simplex, int lanes);
  void prepare(const Pending& simplex, const Candidate& candidate, Step& step);
  void take(const Pending& simplex, const Candidate& candidate, const Step& step);
  void take_weights(const Pending& simplex, int lane);
  void report_point(const Pending& simplex);
  coxeter::PartLists part_lists(std::size_t slot) {
    return {&elements_[slot * (d_ + 1)], &starts_[slot * (k_ + 2)], &numbers_[slot * (k_ + 2)]};
  }
  bool box_holds(const double* x) const;
  bool should_stop();
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  TraceResult result();

  const Function& f_;
  const coxeter::Triangulation& triangulation_;
  const TraceOptions& options_;
  template <int kKnown>
  struct Size {
    int value;
    constexpr operator int() const { return kKnown > 0 ? kKnown : value; }
  };
  const Size<kDim> d_;
  const Size<kCodim> k_;

  const Domain domain_;
  const std::size_t num_given_, mask_words_;
  VertexTable vertices_;  // with value(); meaningless where unreachable_
  std::size_t evaluated_ = 0;
  GrowingArray<char> unreachable_;  // filled only when there is a box
  SimplexTable<Index, kDim> simplices_;
  GrowingArray<double> points_;  // d a simplex
  BarycentricKernel kernel_;

  GrowingArray<std::uint32_t> queue_, next_queue_;
  std::size_t evaluations_ = 0, exact_decisions_ = 0;
  bool cut_by_undefined_ = false;
  StopReason stop_ = StopReason::kNone;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  // The simplices of one batch, a slot each, and their candidates.
  std::vector<coxeter::ShortPartition<kDim, kCodim>> partitions_;
  std::vector<std::uint16_t> elements_, starts_;
  std::vector<std::uint32_t> numbers_;
  GrowingArray<Candidate> candidates_;
  std::size_t candidate_begin_[kBatch + 1];
  Pending batch_[kBatch];
  // Candidates of one group that are still to be crossed, by lane.
  GrowingArray<std::uint32_t> open_;
  std::size_t open_begin_[kLanes + 1];

  // Scratch.
  std::vector<std::uint64_t> keys_;
  Step steps_[kAhead];
  std::vector<const double*> columns_;
  std::vector<std::int32_t> z_;
  SubsetForms subset_forms_;
  std::vector<std::uint64_t> form_sums_;  // over the subsets of one part
  std::vector<std::uint32_t> bit_sums_;
  std::vector<double> x_, f_values_, g_values_, weights_, sums_, y_;
  mutable std::vector<double> point_;

  // The domain.
  std::optional<BoundaryTrace> boundary_;
  std::vector<std::uint64_t> mask_of_all_;
  std::vector<std::uint32_t> outside_;      // simplices that meet f = 0 outside the domain
  std::vector<std::uint64_t> exits_taken_;  // their cofacets that add_exits has seen, flag words each
};

template <class Shape>
void Tracer<Shape>::evaluate_new_vertices() {
  const std::size_t known = evaluated_, size = vertices_.size();
  if (known == size) return;
  const std::size_t count = size - known;
  x_.resize(count * d_);
  for (std::size_t i = 0; i < count; ++i)
    triangulation_.cartesian({vertices_.coordinates(static_cast<std::uint32_t>(known + i)), std::size_t(d_)},
                             {&x_[i * d_], std::size_t(d_)});
  f_values_.resize(count * k_);
  f_.evaluate(x_, f_values_);
  g_values_.resize(count * num_given_);
  if (num_given_ > 0) domain_.given()->evaluate(x_, g_values_);
  evaluations_ += count;
  evaluated_ = size;
  const bool boxed = domain_.box().has_value();
  for (std::size_t i = 0; i < count; ++i) {
    const auto vertex = static_cast<std::uint32_t>(known + i);
    const double *x = &x_[i * d_], *g = g_values_.data() + i * num_given_;
    double* values = value(vertex);
    if (!domain_.empty()) {
      for (std::size_t j = 0; j < num_given_; ++j) {
        if (!std::isfinite(g[j])) throw not_finite("inequality " + std::to_string(j), g[j], {x, std::size_t(d_)});
        values[k_ + j] = g[j];
      }
      std::uint64_t* mask = mask_at(vertex);
      domain_.set_mask(x, g, mask);
      for (std::size_t word = 0; word < mask_words_; ++word) mask_of_all_[word] |= mask[word];
    }
    if (boxed) unreachable_.push_back(false);
    for (int r = 0; r < k_; ++r) {
      const double component = f_values_[i * k_ + r];
      values[r] = component;
      if (std::isfinite(component)) continue;
      if (!boxed || box_holds(x))
        throw not_finite("component " + std::to_string(r + 1) + " of f", component, {x, std::size_t(d_)});
      unreachable_[vertex] = true;
    }
  }
}

template <class Shape>
bool Tracer<Shape>::box_holds(const double* x) const {
  for (int c = 0; c < d_; ++c)
    if (!(x[c] >= domain_.box()->lower[c] && x[c] <= domain_.box()->upper[c])) return false;
  return true;
}

template <class Shape>
std::uint32_t Tracer<Shape>::vertex(std::span<const std::int32_t> z) {
  const std::uint32_t vertex = vertices_.intern(z.data(), vertices_.form_of(z.data()));
  evaluate_new_vertices();
  return !unreachable_.empty() && unreachable_[vertex] ? kUnreachable : vertex;
}

template <class Shape>
void Tracer<Shape>::values(std::uint32_t vertex, double* out) const {
  const double* known = const_cast<Tracer*>(this)->value(vertex);
  for (std::size_t j = 0; j < num_given_; ++j) out[j] = -known[k_ + j];
  if (domain_.box()) {
    std::vector<double>& x = point_;
    triangulation_.cartesian({vertices_.coordinates(vertex), std::size_t(d_)}, x);
    for (int j = domain_.num_given(); j < domain_.num_inequalities(); ++j) out[j] = -domain_.box_value(j, x.data());
  }
  std::copy_n(known, int{k_}, out + domain_.num_inequalities());
}

// Whether a simplex meets f = 0 inside the domain.
template <class Shape>
bool Tracer<Shape>::inside(const Pending& simplex) {
  bool all_inside = true;
  for (std::size_t word = 0; word < mask_words_; ++word) {
    std::uint64_t some = 0, all = ~std::uint64_t{0};
    for (int q = 0; q <= k_; ++q) {
      const std::uint64_t mask = mask_at(simplex.vertices[q])[word];
      some |= mask;
      all &= mask;
    }
    if (all != 0) return false;
    all_inside = all_inside && some == 0;
  }
  return all_inside || boundary_->inside(std::span<const std::uint32_t>(simplex.vertices, std::size_t(k_ + 1)));
}

template <class Shape>
coxeter::Simplex Tracer<Shape>::simplex_of(std::uint32_t id) {
  std::vector<std::uint16_t> parts(simplices_.parts(id), simplices_.parts(id) + d_);
  parts.push_back(static_cast<std::uint16_t>(k_));
  return {coxeter::LatticeVertex(std::span(vertices_.coordinates(simplices_.base(id)), std::size_t(d_))),
          coxeter::OrderedPartition::from_part_indices(parts)};
}

// The cofacet of a simplex that has this number.
template <class Shape>
coxeter::Simplex Tracer<Shape>::cofacet_of(std::uint32_t id, std::uint32_t number) {
  const Index* parts = simplices_.parts(id);
  int q = 0;
  bool new_base = false;
  std::vector<char> special(d_, 0);  // the half that takes the number q, or goes before the base
  if constexpr (kShort) {
    coxeter::ShortPartition<kDim, kCodim> partition(parts, d_, k_);
    partition.cofacets();
    const auto split = partition.split(static_cast<int>(number));
    q = split.part;
    new_base = split.new_base;
    for (int c = 0; c < d_; ++c) special[c] = split.special >> c & 1;
  } else {
    const coxeter::PartLists lists = part_lists(0);
    coxeter::list_parts(parts, d_, k_, lists);
    while (q < k_ && lists.numbers[q + 1] <= number) ++q;
    const std::uint32_t split = number - lists.numbers[q] + 1;
    const int size = lists.size(q);
    new_base = q == k_ && (split >> (size - 1) & 1);
    for (int i = 0; i < size; ++i)
      if (lists.part(q)[i] < d_) special[lists.part(q)[i]] = (split >> i & 1) != new_base;
  }
  coxeter::LatticeVertex base(std::span(vertices_.coordinates(simplices_.base(id)), std::size_t(d_)));
  std::vector<std::uint16_t> of_cofacet(d_ + 1);
  for (int c = 0; c < d_; ++c) {
    of_cofacet[c] =
        static_cast<std::uint16_t>(special[c] ? (new_base ? 0 : q) : parts[c] + (new_base || parts[c] >= q));
    if (new_base && special[c]) --base[c];
  }
  of_cofacet[d_] = static_cast<std::uint16_t>(k_ + 1);
  return {std::move(base), coxeter::OrderedPartition::from_part_indices(of_cofacet)};
}

// Hands the edges that leave the domain to the boundary, each once.
template <class Shape>
void Tracer<Shape>::add_exits() {
  const std::size_t words = flag_words(d_ - k_);
  exits_taken_.resize(outside_.size() * words, 0);
  for (std::size_t i = 0; i < outside_.size(); ++i) {
    std::optional<coxeter::Simplex> outside;
    for (std::size_t word = 0; word < words; ++word) {
      std::uint64_t& taken = exits_taken_[i * words + word];
      std::uint64_t rest = simplices_.flags(outside_[i])[word] & ~taken;
      taken |= rest;
      for (; rest != 0; rest &= rest - 1) {
        if (!outside) outside = simplex_of(outside_[i]);
        boundary_->add_exit(cofacet_of(outside_[i], static_cast<std::uint32_t>(64 * word) + std::countr_zero(rest)),
                            *outside);
      }
    }
  }
}

// The boundary of what has been found, and whatever else of the manifold it leads to. False at a limit.
template <class Shape>
bool Tracer<Shape>::grow_boundary() {
  constexpr std::size_t kSteps = 256;
  for (;;) {
    add_exits();
    bool more = true;
    while (more) {
      if (should_stop()) {
        queue_.clear();
        report_waiting(0);
        return false;
      }
      more = boundary_->grow(kSteps, [&](const coxeter::Simplex& sigma) {
        Crossing crossing;
        crossing.base.assign(sigma.base().begin(), sigma.base().end());
        const auto parts = sigma.partition().part_indices();
        crossing.parts.assign(parts.data(), parts.data() + d_);
        start_from(crossing);
      });
    }
    if (next_queue_.empty()) return true;
    if (!grow()) return false;
  }
}

// Lists the cofacets not yet crossed of a simplex, with the form of the vertex each adds.
template <class Shape>
void Tracer<Shape>::list_cofacets_short(const Pending& simplex, std::size_t slot) {
  auto& partition = partitions_[slot];
  partition = {simplices_.parts(simplex.id), d_, k_};
  std::uint64_t rest = partition.cofacets() & ~*simplices_.flags(simplex.id);
  const std::size_t size = candidates_.size();
  Candidate* candidate = candidates_.extend(64);
  Candidate* const begin = candidate;
  for (; rest != 0; rest &= rest - 1, ++candidate) {
    const int number = std::countr_zero(rest);
    const auto split = partition.split(number);
    const std::uint64_t sum = subset_forms_(split.special);
    const std::uint64_t form =
        vertices_.form(simplex.vertices[split.new_base ? 0 : split.part]) + (split.new_base ? 0 - sum : sum);
    vertices_.prefetch(form);
    *candidate = {form,
                  0,
                  0,
                  split.special,
                  static_cast<std::uint32_t>(number),
                  0,
                  static_cast<std::uint16_t>(split.part),
                  static_cast<std::uint8_t>(slot),
                  split.new_base};
  }
  candidates_.truncate(size + (candidate - begin));
}

template <class Shape>
void Tracer<Shape>::list_cofacets(const Pending& simplex, std::size_t slot) {
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
      candidates_.push_back({form_sums_[split], 0, split,
                             bits_fit ? coxeter::special_half(bit_sums_[split], bit_sums_[whole], d_) : 0, flag, 0,
                             static_cast<std::uint16_t>(q), static_cast<std::uint8_t>(slot),
                             q == k_ && (split >> (size - 1) & 1)});
    }
  }
}

// Finds or enters the vertex w of every candidate: w = v_q + e(A), or v_0 - e(B) if that is below v_0.
template <class Shape>
void Tracer<Shape>::look_up_vertices() {
  for (Candidate& candidate : candidates_) candidate.vertex = vertices_.guess(candidate.form);
  for (Candidate& candidate : candidates_) {
    const std::uint32_t from = batch_[candidate.slot].vertices[candidate.new_base ? 0 : candidate.part];
    const std::int32_t step = candidate.new_base ? -1 : 1;
    const bool bits_fit = d_ <= coxeter::kMaxBitsDim;
    if (bits_fit && candidate.vertex != coxeter::HashSlots::kNone &&
        vertices_.template is_neighbour<kDim>(candidate.vertex, from, candidate.special, step))
      continue;
    const std::int32_t* z = vertices_.coordinates(from);
    if (bits_fit) {
      for (int c = 0; c < d_; ++c) z_[c] = z[c] + step * static_cast<std::int32_t>(candidate.special >> c & 1);
    } else {
      std::copy_n(z, int{d_}, z_.begin());
      const coxeter::PartLists lists = part_lists(candidate.slot);
      const std::uint16_t* part = lists.part(candidate.part);
      std::uint32_t half = candidate.split;
      if (candidate.new_base) half = ~half & ((std::uint32_t{1} << lists.size(candidate.part)) - 1);
      for (; half != 0; half &= half - 1) z_[part[std::countr_zero(half)]] += step;
    }
    candidate.vertex = vertices_.template intern<kDim>(z_.data(), candidate.form);
  }
}

// For the open candidates of a group of simplices, which vertex leaves. Reports the points of the simplices by the way.
template <class Shape>
void Tracer<Shape>::find_leaving(const Pending* simplex, int lanes) {
  if (k_ == 1) {
    for (int lane = 0; lane < lanes; ++lane) {
      const double first = *value(simplex[lane].vertices[0]);
      weights_[1] = SignKernel::second_weight(first, *value(simplex[lane].vertices[1]));
      weights_[0] = 1 - weights_[1];
      report_point(simplex[lane]);
      for (std::size_t i = open_begin_[lane]; i < open_begin_[lane + 1]; ++i) {
        Candidate& candidate = candidates_[open_[i]];
        candidate.leaving = SignKernel::leaving(first, *value(candidate.vertex));
      }
    }
    return;
  }
  static_assert(BarycentricKernel::kSlack <= VertexTable::kSlackWords);
  const double* values[kLanes];
  for (int q = 0; q <= k_; ++q) {
    // Lanes to spare repeat the first simplex.
    for (int lane = 0; lane < kLanes; ++lane) values[lane] = value(simplex[lane < lanes ? lane : 0].vertices[q]);
    kernel_.set_vertices(q, values);
  }
  kernel_.factor();
  std::size_t rounds = 0;
  for (int lane = 0; lane < lanes; ++lane) {
    take_weights(simplex[lane], lane);
    report_point(simplex[lane]);
    rounds = std::max(rounds, open_begin_[lane + 1] - open_begin_[lane]);
  }
  for (std::size_t round = 0; round < rounds; ++round) {
    Candidate* current[kLanes] = {};
    for (int lane = 0; lane < lanes; ++lane) {
      const std::size_t i = open_begin_[lane] + round;
      if (i >= open_begin_[lane + 1]) continue;
      current[lane] = &candidates_[open_[i]];
      values[lane] = value(current[lane]->vertex);
    }
    kernel_.set_candidates(values);
    kernel_.pivot();
    for (int lane = 0; lane < lanes; ++lane) {
      if (current[lane] == nullptr) continue;
      int leaving = kernel_.leaving(lane);
      if (leaving == BarycentricKernel::kUndecided) {
        for (int q = 0; q <= k_; ++q) columns_[q] = value(simplex[lane].vertices[q]);
        leaving = exactly_leaving(columns_, value(current[lane]->vertex));
        ++exact_decisions_;
      }
      current[lane]->leaving = leaving;
    }
  }
}

// From sigma over the cofacet to its other k-face that is hit, the one without vertex `leaving` of sigma: everything
// about it but whether it is known.
template <class Shape>
void Tracer<Shape>::prepare(const Pending& simplex, const Candidate& candidate, Step& step) {
  Index* out = SimplexTable<Index>::parts_of(step.key);
  if constexpr (kShort) {
    const auto over =
        partitions_[candidate.slot].step({candidate.part, candidate.special, candidate.new_base}, candidate.leaving);
    std::memcpy(out, &over.parts, sizeof over.parts);
    step.inserted = over.inserted;
    step.removed = over.removed;
    step.flag = static_cast<std::uint32_t>(over.number);
  } else {
    const coxeter::CofacetStep over =
        coxeter::step_over_cofacet(simplices_.parts(simplex.id), part_lists(candidate.slot), d_, k_, candidate.part,
                                   candidate.split, candidate.leaving, out);
    step.inserted = over.inserted;
    step.removed = over.removed;
    step.flag = over.number;
  }
  const bool base_leaves = candidate.leaving == 0;
  const std::uint32_t base = step.inserted <= int{base_leaves} ? candidate.vertex : simplex.vertices[base_leaves];
  SimplexTable<Index>::set_base(step.key, base);
  step.hash = simplices_.hash_of(step.key);
  simplices_.prefetch(step.hash);
}

template <class Shape>
void Tracer<Shape>::take(const Pending& simplex, const Candidate& candidate, const Step& step) {
  const std::size_t known = simplices_.size();
  const std::uint32_t id = simplices_.intern(step.key, step.hash);
  if (id == known) {
    std::uint32_t* out = enqueue(id);
    const std::uint32_t* v = simplex.vertices;
    // Straight selections, no jumps: position j of the cofacet is w or, but for that, a vertex of sigma.
    for (int i = 0; i <= k_; ++i) {
      const std::uint32_t before = v[i - 1], here = v[i], after = v[i + 1];
      const int j = i + (i >= step.removed);
      const std::uint32_t old =
          i >= step.removed ? (j > step.inserted ? here : after) : (j > step.inserted ? before : here);
      out[i] = j == step.inserted ? candidate.vertex : old;
    }
  }
  simplices_.set_flag(simplex.id, candidate.flag);
  simplices_.set_flag(id, step.flag);
}

// lambda of a simplex that the kernel has factored.
template <class Shape>
void Tracer<Shape>::take_weights(const Pending& simplex, int lane) {
  if (kernel_.reliable(lane)) {
    for (int q = 0; q <= k_; ++q) weights_[q] = std::max(kernel_.weight(lane, q), 0.0);
  } else {
    for (int q = 0; q <= k_; ++q) columns_[q] = value(simplex.vertices[q]);
    weights_ = exact_weights(columns_);
  }
}

// x = b + Lambda (sum_q lambda_q v_q), where coordinate c of the sum is v_0[c] plus the weights of the vertices after
// its part.
template <class Shape>
void Tracer<Shape>::report_point(const Pending& simplex) {
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
  const Matrix& linear = triangulation_.linear();
  for (int r = 0; r < d_; ++r) x[r] = triangulation_.offset()[r];
  for (int c = 0; c < d_; ++c) {
    const double* column = linear.data() + std::size_t(c) * d_;
    const double y = y_[c];
    for (int r = 0; r < d_; ++r) x[r] += y * column[r];
  }
}

template <class Shape>
void Tracer<Shape>::process(std::size_t first, std::size_t count, std::size_t stride) {
  candidates_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    candidate_begin_[i] = candidates_.size();
    batch_[i] = pending(first + i * stride);
    if (boundary_ && !inside(batch_[i])) {
      outside_.push_back(batch_[i].id);
      continue;
    }
    if constexpr (kShort)
      list_cofacets_short(batch_[i], i);
    else
      list_cofacets(batch_[i], i);
  }
  candidate_begin_[count] = candidates_.size();
  look_up_vertices();
  evaluate_new_vertices();
  points_.extend(simplices_.size() * d_ - points_.size());
  const bool boxed = !unreachable_.empty();

  for (std::size_t group = 0; group < count; group += kLanes) {
    const int lanes = static_cast<int>(std::min<std::size_t>(kLanes, count - group));
    const Pending* const simplex = batch_ + group;
    open_.clear();
    std::uint32_t* const open = open_.extend(candidate_begin_[group + lanes] - candidate_begin_[group]);
    std::size_t num_open = 0;
    for (int lane = 0; lane < lanes; ++lane) {
      open_begin_[lane] = num_open;
      const std::uint64_t* const flags = simplices_.flags(simplex[lane].id);
      for (std::size_t j = candidate_begin_[group + lane]; j < candidate_begin_[group + lane + 1]; ++j) {
        const Candidate& candidate = candidates_[j];
        const bool unreachable = boxed && unreachable_[candidate.vertex];
        cut_by_undefined_ |= unreachable;
        open[num_open] = static_cast<std::uint32_t>(j);
        // Another simplex of this batch may have crossed the same cofacet from its other side.
        num_open += !unreachable & !(flags[candidate.flag / 64] >> (candidate.flag % 64) & 1);
      }
    }
    open_begin_[lanes] = num_open;
    find_leaving(simplex, lanes);
    for (std::size_t begin = 0; begin < num_open; begin += kAhead) {
      const std::size_t end = std::min(begin + kAhead, num_open);
      for (std::size_t i = begin; i < end; ++i) {
        const Candidate& candidate = candidates_[open[i]];
        prepare(batch_[candidate.slot], candidate, steps_[i - begin]);
      }
      for (std::size_t i = begin; i < end; ++i) (void)simplices_.guess(steps_[i - begin].hash);
      for (std::size_t i = begin; i < end; ++i) {
        const Candidate& candidate = candidates_[open[i]];
        const Pending& from = batch_[candidate.slot];
        if (!simplices_.flag(from.id, candidate.flag)) take(from, candidate, steps_[i - begin]);
      }
    }
  }
}

// The first simplex of a trace. False when it is known already.
template <class Shape>
bool Tracer<Shape>::start_from(const Crossing& crossing) {
  std::vector<std::int32_t> z = crossing.base;
  std::vector<std::uint32_t> ids(k_ + 1);
  std::uint64_t* key = steps_[0].key;
  std::fill_n(key, simplices_.key_words(), 0);
  for (int c = 0; c < d_; ++c) SimplexTable<Index>::parts_of(key)[c] = static_cast<Index>(crossing.parts[c]);
  for (int q = 0; q <= k_; ++q) {
    const std::uint64_t form = vertices_.form_of(z.data());
    ids[q] = vertices_.intern(z.data(), form);
    for (int c = 0; c < d_; ++c) z[c] += crossing.parts[c] == q;
  }
  SimplexTable<Index>::set_base(key, ids[0]);
  evaluate_new_vertices();
  const std::size_t known = simplices_.size();
  const std::uint32_t id = simplices_.intern(key, simplices_.hash_of(key));
  if (id < known) return false;
  std::copy(ids.begin(), ids.end(), enqueue(id));
  return true;
}

template <class Shape>
bool Tracer<Shape>::should_stop() {
  const double now = seconds();
  if (simplices_.size() - outside_.size() + (boundary_ ? boundary_->size() : 0) >= options_.run.max_simplices)
    stop_ = StopReason::kMaxSimplices;
  else if (now > options_.run.time_limit)
    stop_ = StopReason::kTimeLimit;
  else if (options_.run.progress &&
           !options_.run.progress({"trace", simplices_.size() - outside_.size(), evaluations_, now}))
    stop_ = StopReason::kCancelled;
  return stop_ != StopReason::kNone;
}

// Breadth first until nothing is left, or a limit. Points of simplices still waiting at a limit are filled in as well.
template <class Shape>
bool Tracer<Shape>::grow() {
  while (!next_queue_.empty()) {
    queue_.swap(next_queue_);
    next_queue_.clear();
    const std::size_t count = queue_.size() / queue_stride();
    for (std::size_t first = 0; first < count; first += kStride * kBatch) {
      const std::size_t stretch = std::min(kStride * kBatch, count - first);
      const std::size_t stride = (stretch + kBatch - 1) / kBatch;
      for (std::size_t i = 0; i < stride; ++i) {
        if (should_stop()) {
          report_waiting(first);
          return false;
        }
        process(first + i, (stretch - i + stride - 1) / stride, stride);
      }
    }
  }
  return true;
}

// At a limit: what waits in the queue, from `first` on, is part of what was found. It gets its points, though its
// cofacets are not crossed. (Some may have theirs already.)
template <class Shape>
void Tracer<Shape>::report_waiting(std::size_t first) {
  next_queue_.append(&queue_[first * queue_stride()], queue_.size() - first * queue_stride());
  queue_.swap(next_queue_);
  points_.extend(simplices_.size() * d_ - points_.size());
  open_begin_[0] = open_begin_[1] = 0;
  for (std::size_t i = 0; i < queue_.size() / queue_stride(); ++i) {
    const Pending simplex = pending(i);
    find_leaving(&simplex, 1);
    if (boundary_ && !inside(simplex)) outside_.push_back(simplex.id);
  }
}

template <class Shape>
TraceResult Tracer<Shape>::run(std::span<const double> seed_points) {
  partitions_.resize(kShort ? kBatch : 0);
  subset_forms_ = SubsetForms(vertices_.weights(), kShort ? int{d_} : 0);
  elements_.resize(kBatch * (d_ + 1));
  starts_.resize(kBatch * (k_ + 2));
  numbers_.resize(kBatch * (k_ + 2));
  const std::size_t key_room = simplices_.key_words() + 3;  // the short form writes 16 part numbers
  keys_.assign(kAhead * key_room, 0);
  for (std::size_t i = 0; i < kAhead; ++i) steps_[i].key = &keys_[i * key_room];
  form_sums_.resize(std::size_t{2} << (d_ - k_));
  bit_sums_.resize(std::size_t{2} << (d_ - k_));
  z_.resize(d_);
  weights_.resize(k_ + 1);
  sums_.resize(k_ + 1);
  y_.resize(d_);
  point_.resize(d_);

  SeedStarter starter(f_, domain_, triangulation_,
                      [&](std::span<const double> rows) { return boundary_->inside(rows); });
  TraceResult out;
  for (std::size_t i = 0; i + d_ <= seed_points.size() && stop_ == StopReason::kNone; i += d_) {
    const std::span<const double> seed = seed_points.subspan(i, d_);
    SeedStart start = starter.find(seed, options_.max_seed_simplices);
    SeedReport report{SeedReport::Outcome::kDropped, std::move(start.reason), std::move(start.unseen),
                      start.finer_edge_length};
    bool started = false, found = !start.crossings.empty();
    for (const Crossing& crossing : start.crossings) started = start_from(crossing) || started;
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
    if (!report.unseen.empty()) {
      report.outcome = SeedReport::Outcome::kTooSmall;
      report.reason = "f = 0 passes there, but the part of it is too small for this edge length";
    }
    out.seeds.push_back(std::move(report));
  }
  while (out.seeds.size() * d_ < seed_points.size())
    out.seeds.push_back({.outcome = SeedReport::Outcome::kDropped, .reason = "the trace was stopped before its turn"});
  TraceResult traced = result();
  traced.seeds = std::move(out.seeds);
  traced.seed_evaluations = starter.evaluations();
  traced.seconds = seconds();
  return traced;
}

// Puts everything into canonical order.
template <class Shape>
TraceResult Tracer<Shape>::result() {
  TraceResult out;
  out.ambient_dim_ = d_;
  out.codim_ = k_;
  out.evaluations = evaluations_;
  out.exact_decisions = exact_decisions_;
  out.domain = domain_;
  out.stop_reason = stop_;
  if (boundary_) {
    out.exact_decisions += boundary_->exact_decisions();
    cut_by_undefined_ = cut_by_undefined_ || boundary_->cut_by_undefined();
    bool cut = cut_by_undefined_;
    for (const auto& [inequalities, stratum] : boundary_->strata())
      for (int j : inequalities) cut = cut || domain_.is_box_side(j);
    if (cut && stop_ == StopReason::kNone) out.stop_reason = StopReason::kBox;
    list_boundary(out);
  }
  out.whole = stop_ == StopReason::kNone && !cut_by_undefined_;
  queue_.release();
  next_queue_.release();
  simplices_.release_index();

  vertices_.release_index();
  const auto num_vertices = static_cast<std::uint32_t>(vertices_.size());
  std::int32_t* coordinates = out.vertex_coordinates_.extend(std::size_t{num_vertices} * d_);
  for (std::uint32_t i = 0; i < num_vertices; ++i)
    std::copy_n(vertices_.coordinates(i), int{d_}, coordinates + std::size_t{i} * d_);
  const std::vector<std::uint32_t> vertex_order = lexicographic_order(out.vertex_coordinates_, d_);
  std::vector<std::uint32_t> rank(vertex_order.size());
  for (std::size_t i = 0; i < vertex_order.size(); ++i) rank[vertex_order[i]] = static_cast<std::uint32_t>(i);
  permute_rows(out.vertex_coordinates_.data(), d_, vertex_order);
  double* values = out.vertex_values_.extend(std::size_t{num_vertices} * k_);
  for (std::uint32_t i = 0; i < num_vertices; ++i)
    std::copy_n(value(vertex_order[i]), int{k_}, values + std::size_t{i} * k_);
  for (BoundarySimplices& stratum : out.boundary)
    for (std::uint32_t& base : stratum.base) base = rank[base];
  vertices_.release();

  // The simplices inside, in the order in which they were found.
  const auto found = static_cast<std::uint32_t>(simplices_.size());
  std::vector<std::uint32_t> inside(found);
  for (std::uint32_t id : outside_) inside[id] = 1;
  std::uint32_t count = 0;
  for (std::uint32_t id = 0; id < found; ++id)
    if (inside[id] == 0) inside[count++] = id;
  if (count < found)
    for (std::uint32_t i = 0; i < count; ++i)
      std::copy_n(&points_[std::size_t{inside[i]} * d_], int{d_}, &points_[std::size_t{i} * d_]);
  points_.truncate(std::size_t{count} * d_);

  std::vector<std::uint32_t> order = canonical_order(
      rank.size(), count, d_, [&](std::uint32_t i) { return rank[simplices_.base(inside[i])]; },
      [&](std::uint32_t i) { return simplices_.parts(inside[i]); });
  permute_rows(points_.data(), d_, order);
  for (std::uint32_t& i : order) i = inside[i];
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
  out.points_ = std::move(points_);
  return out;
}

// The strata of the boundary, in canonical order but for the numbers of the vertices.
template <class Shape>
void Tracer<Shape>::list_boundary(TraceResult& out) {
  for (const auto& [inequalities, stratum] : boundary_->strata()) {
    BoundarySimplices listed;
    listed.inequalities = inequalities;
    std::vector<coxeter::Simplex> simplices(stratum.points.begin(), stratum.points.end());
    std::sort(simplices.begin(), simplices.end());
    for (const coxeter::Simplex& sigma : simplices) {
      listed.base.push_back(vertex(sigma.base()));
      const auto parts = sigma.partition().part_indices();
      listed.parts.insert(listed.parts.end(), parts.data(), parts.data() + d_);
      const std::vector<double> weights = boundary_->weights(sigma, inequalities);
      double total = 0, after = 0;
      for (double weight : weights) total += weight;
      for (int c = 0; c < d_; ++c) y_[c] = sigma.base()[c];
      for (int q = sigma.dim(); q > 0; --q) {
        after += weights[q];
        for (std::uint16_t c : sigma.partition().part(q - 1)) y_[c] += after / total;
      }
      std::vector<double> x = multiply(triangulation_.linear(), {y_.data(), std::size_t(d_)});
      for (int c = 0; c < d_; ++c) x[c] += triangulation_.offset()[c];
      listed.points.insert(listed.points.end(), x.begin(), x.end());
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
  if (k >= kFirstWideCodim) return run.template operator()<Shape<std::uint16_t, false>>();
  if (d > coxeter::kMaxShortDim || d - k > coxeter::kMaxShortExcess)
    return run.template operator()<Shape<std::uint8_t, false>>();
  // Loops over d and k are straight code for these.
  if (d == 3 && k == 1) return run.template operator()<Shape<std::uint8_t, true, 3, 1>>();
  if (d == 4 && k == 2) return run.template operator()<Shape<std::uint8_t, true, 4, 2>>();
  if (d == 6 && k == 3) return run.template operator()<Shape<std::uint8_t, true, 6, 3>>();
  if (d == 8 && k == 6) return run.template operator()<Shape<std::uint8_t, true, 8, 6>>();
  if (d == 10 && k == 8) return run.template operator()<Shape<std::uint8_t, true, 10, 8>>();
  return run.template operator()<Shape<std::uint8_t, true>>();
}

}  // namespace whitney
