// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/interior_trace.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

#include <whitney/tracing/exact_pivot.h>

namespace whitney {
namespace {

constexpr std::size_t kBatch =
    kTraceBatch;  // simplices whose cofacets are looked at together, so that f is asked in batches
// Neighbours in the queue have cofacets in common. A batch is every kStride-th simplex of a stretch of the queue, so
// that most cofacets are known to be crossed before their other side is looked at.
constexpr std::size_t kStride = 16;
constexpr std::size_t kAhead = kTraceAhead;  // simplices looked up together, so that memory is waited for once

}  // namespace

template <class Shape>
InteriorTrace<Shape>::InteriorTrace(const coxeter::Triangulation& triangulation, int codim, LatticeValues& lattice,
                                    BoundaryTrace* boundary)
    : triangulation_(triangulation),
      d_{triangulation.ambient_dim()},
      k_{codim},
      lattice_(lattice),
      vertices_(lattice.table()),
      boundary_(boundary),
      simplices_(d_, flag_words(d_ - k_)),
      kernel_(k_),
      cofacets_(d_, k_, vertices_),
      columns_(k_ + 1),
      weights_(k_ + 1),
      sums_(k_ + 1),
      y_(d_) {
  const std::size_t key_room = simplices_.key_words() + 3;  // the short form writes 16 part numbers
  keys_.assign(kAhead * key_room, 0);
  for (std::size_t i = 0; i < kAhead; ++i) steps_[i].key = &keys_[i * key_room];
}

// Whether a simplex meets f = 0 inside the domain.
template <class Shape>
bool InteriorTrace<Shape>::inside(const Pending& simplex) {
  bool all_inside = true;
  for (std::size_t word = 0; word < lattice_.mask_words(); ++word) {
    std::uint64_t some = 0, all = ~std::uint64_t{0};
    for (int q = 0; q <= k_; ++q) {
      const std::uint64_t mask = lattice_.mask(simplex.vertices[q])[word];
      some |= mask;
      all &= mask;
    }
    if (all != 0) return false;
    all_inside = all_inside && some == 0;
  }
  return all_inside || boundary_->inside(std::span<const std::uint32_t>(simplex.vertices, std::size_t(k_ + 1)));
}

template <class Shape>
coxeter::Simplex InteriorTrace<Shape>::simplex_of(std::uint32_t id) {
  std::vector<std::uint16_t> parts(simplices_.parts(id), simplices_.parts(id) + d_);
  parts.push_back(static_cast<std::uint16_t>(k_));
  return {coxeter::LatticeVertex(std::span(vertices_.coordinates(simplices_.base(id)), std::size_t(d_))),
          coxeter::OrderedPartition::from_part_indices(parts)};
}

// The cofacet of a simplex that has this number.
template <class Shape>
coxeter::Simplex InteriorTrace<Shape>::cofacet_of(std::uint32_t id, std::uint32_t number) {
  return cofacets_.cofacet(
      simplices_.parts(id),
      coxeter::LatticeVertex(std::span(vertices_.coordinates(simplices_.base(id)), std::size_t(d_))), number);
}

template <class Shape>
void InteriorTrace<Shape>::add_exits() {
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

template <class Shape>
void InteriorTrace<Shape>::look_up_vertices() {
  for (Candidate& candidate : candidates_) candidate.vertex = vertices_.guess(candidate.form);
  for (Candidate& candidate : candidates_) cofacets_.find_vertex(batch_[candidate.slot], candidate);
}

// For the open candidates of a group of simplices, which vertex leaves. Reports the points of the simplices by the way.
template <class Shape>
void InteriorTrace<Shape>::find_leaving(const Pending* simplex, int lanes) {
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
void InteriorTrace<Shape>::prepare(const Pending& simplex, const Candidate& candidate, Step& step) {
  step.over = cofacets_.cross(simplices_.parts(simplex.id), candidate, Table::parts_of(step.key));
  const bool base_leaves = candidate.leaving == 0;
  const std::uint32_t base = step.over.inserted <= int{base_leaves} ? candidate.vertex : simplex.vertices[base_leaves];
  Table::set_base(step.key, base);
  step.hash = simplices_.hash_of(step.key);
  simplices_.prefetch(step.hash);
}

template <class Shape>
void InteriorTrace<Shape>::take(const Pending& simplex, const Candidate& candidate, const Step& step) {
  const std::size_t known = simplices_.size();
  const std::uint32_t id = simplices_.intern(step.key, step.hash);
  if (id == known) {
    std::uint32_t* out = enqueue(id);
    const std::uint32_t* v = simplex.vertices;
    // Straight selections, no jumps: position j of the cofacet is w or, but for that, a vertex of sigma.
    for (int i = 0; i <= k_; ++i) {
      const std::uint32_t before = v[i - 1], here = v[i], after = v[i + 1];
      const int j = i + (i >= step.over.removed);
      const std::uint32_t old =
          i >= step.over.removed ? (j > step.over.inserted ? here : after) : (j > step.over.inserted ? before : here);
      out[i] = j == step.over.inserted ? candidate.vertex : old;
    }
  }
  simplices_.set_flag(simplex.id, candidate.flag);
  simplices_.set_flag(id, step.over.flag);
}

// lambda of a simplex that the kernel has factored.
template <class Shape>
void InteriorTrace<Shape>::take_weights(const Pending& simplex, int lane) {
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
void InteriorTrace<Shape>::report_point(const Pending& simplex) {
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

// The candidates of a group of simplices that are still to be crossed, by lane.
template <class Shape>
std::size_t InteriorTrace<Shape>::list_open(const Pending* simplex, std::size_t group, int lanes) {
  const bool boxed = lattice_.boxed();
  open_.clear();
  std::uint32_t* const open = open_.extend(candidate_begin_[group + lanes] - candidate_begin_[group]);
  std::size_t num_open = 0;
  for (int lane = 0; lane < lanes; ++lane) {
    open_begin_[lane] = num_open;
    const std::uint64_t* const flags = simplices_.flags(simplex[lane].id);
    for (std::size_t j = candidate_begin_[group + lane]; j < candidate_begin_[group + lane + 1]; ++j) {
      const Candidate& candidate = candidates_[j];
      const bool unreachable = boxed && lattice_.unreachable(candidate.vertex);
      cut_by_undefined_ |= unreachable;
      open[num_open] = static_cast<std::uint32_t>(j);
      // Another simplex of this batch may have crossed the same cofacet from its other side.
      num_open += !unreachable & !(flags[candidate.flag / 64] >> (candidate.flag % 64) & 1);
    }
  }
  open_begin_[lanes] = num_open;
  return num_open;
}

template <class Shape>
void InteriorTrace<Shape>::process(std::size_t first, std::size_t count, std::size_t stride) {
  candidates_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    candidate_begin_[i] = candidates_.size();
    batch_[i] = pending(first + i * stride);
    if (boundary_ && !inside(batch_[i])) {
      outside_.push_back(batch_[i].id);
      continue;
    }
    cofacets_.list(batch_[i], simplices_.parts(batch_[i].id), simplices_.flags(batch_[i].id), i, candidates_);
  }
  candidate_begin_[count] = candidates_.size();
  look_up_vertices();
  lattice_.evaluate_new();
  points_.extend(simplices_.size() * d_ - points_.size());

  for (std::size_t group = 0; group < count; group += kLanes) {
    const int lanes = static_cast<int>(std::min<std::size_t>(kLanes, count - group));
    const Pending* const simplex = batch_ + group;
    const std::size_t num_open = list_open(simplex, group, lanes);
    const std::uint32_t* const open = open_.data();
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
bool InteriorTrace<Shape>::start_from(const Crossing& crossing) {
  std::vector<std::int32_t> z = crossing.base;
  std::vector<std::uint32_t> ids(k_ + 1);
  std::uint64_t* key = steps_[0].key;
  std::fill_n(key, simplices_.key_words(), 0);
  for (int c = 0; c < d_; ++c) Table::parts_of(key)[c] = static_cast<Index>(crossing.parts[c]);
  for (int q = 0; q <= k_; ++q) {
    const std::uint64_t form = vertices_.form_of(z.data());
    ids[q] = vertices_.intern(z.data(), form);
    for (int c = 0; c < d_; ++c) z[c] += crossing.parts[c] == q;
  }
  Table::set_base(key, ids[0]);
  lattice_.evaluate_new();
  const std::size_t known = simplices_.size();
  const std::uint32_t id = simplices_.intern(key, simplices_.hash_of(key));
  if (id < known) return false;
  std::copy(ids.begin(), ids.end(), enqueue(id));
  return true;
}

// Breadth first until nothing is left, or a limit. Points of simplices still waiting at a limit are filled in as well.
template <class Shape>
bool InteriorTrace<Shape>::grow(const std::function<bool()>& should_stop) {
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
void InteriorTrace<Shape>::report_waiting(std::size_t first) {
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

// Loops over d and k are straight code where these are given.
template class InteriorTrace<TraceShape<std::uint16_t, false>>;
template class InteriorTrace<TraceShape<std::uint8_t, false>>;
template class InteriorTrace<TraceShape<std::uint8_t, true>>;
template class InteriorTrace<TraceShape<std::uint8_t, true, 3, 1>>;
template class InteriorTrace<TraceShape<std::uint8_t, true, 4, 2>>;
template class InteriorTrace<TraceShape<std::uint8_t, true, 6, 3>>;
template class InteriorTrace<TraceShape<std::uint8_t, true, 8, 6>>;
template class InteriorTrace<TraceShape<std::uint8_t, true, 10, 8>>;

}  // namespace whitney
