// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/seed_search.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <unordered_set>
#include <utility>

#include <Eigen/QR>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/keyed_random.h>
#include <coxeter/locate.h>
#include <whitney/tracing/exact_pivot.h>

namespace whitney {
namespace {

constexpr std::int32_t kMoreStarts = 32;
constexpr std::uint64_t kStartsSeed = 1;

}  // namespace

SeedSearch::SeedSearch(const coxeter::Triangulation& triangulation, int codim, Evaluate evaluate)
    : triangulation_(triangulation),
      dim_(triangulation.ambient_dim()),
      codim_(codim),
      evaluate_(std::move(evaluate)),
      vertices_(dim_),
      ids_(dim_ + 1),
      kernel_(codim) {}

SeedSearch::FullSimplex SeedSearch::locate(std::span<const double> y) const {
  const coxeter::Simplex simplex = coxeter::locate_full_lattice(y);
  const auto elements = simplex.partition().elements();
  return {{simplex.base().begin(), simplex.base().end()}, {elements.begin(), elements.end() - 1}};
}

// Across the facet opposite vertex q two neighbouring elements of the cyclic order of {0..d} change places.
SeedSearch::FullSimplex SeedSearch::neighbour(const FullSimplex& simplex, int opposite) const {
  FullSimplex other = simplex;
  if (opposite == 0) {
    ++other.base[other.order.front()];
    std::rotate(other.order.begin(), other.order.begin() + 1, other.order.end());
  } else if (opposite == dim_) {
    --other.base[other.order.back()];
    std::rotate(other.order.begin(), other.order.end() - 1, other.order.end());
  } else {
    std::swap(other.order[opposite - 1], other.order[opposite]);
  }
  return other;
}

std::vector<double> SeedSearch::barycentre(const FullSimplex& simplex) const {
  std::vector<double> y(simplex.base.begin(), simplex.base.end());
  for (int q = 0; q < dim_; ++q) y[simplex.order[q]] += double(dim_ - q) / (dim_ + 1);
  return y;
}

// Asks for f at the vertices of the simplex; false when one of them is out of bounds.
bool SeedSearch::load(const FullSimplex& simplex) {
  std::vector<std::int32_t> z = simplex.base;
  bool all_inside = true;
  for (int q = 0; q <= dim_; ++q) {
    if (q > 0) ++z[simplex.order[q - 1]];
    const std::uint32_t id = vertices_.intern(z.data(), vertices_.form_of(z.data()));
    if (id == inside_.size()) {
      values_.resize(values_.size() + codim_);
      inside_.push_back(evaluate_(z.data(), &values_[std::size_t{id} * codim_]));
      evaluations_ += inside_.back();
    }
    ids_[q] = id;
    all_inside = all_inside && inside_[id];
  }
  return all_inside;
}

// Looks for a k-face of the simplex loaded last that is hit.
bool SeedSearch::hit_face(const FullSimplex& simplex, Crossing& found) {
  auto value = [&](int q) { return &values_[std::size_t{ids_[q]} * codim_]; };
  for (int r = 0; r < codim_; ++r) {
    bool positive = false, other = false;
    for (int q = 0; q <= dim_; ++q) (value(q)[r] > 0 ? positive : other) = true;
    if (!positive || !other) return false;  // one component keeps its sign (zero counts as negative)
  }
  // All k-faces, kLanes at a time, in lexicographic order of their vertices.
  constexpr int kLanes = BarycentricKernel::kLanes;
  std::vector<int> next(codim_ + 1);
  std::vector<std::vector<int>> batch;
  std::vector<const double*> columns(codim_ + 1);
  std::iota(next.begin(), next.end(), 0);
  bool more = true;
  while (more) {
    batch.clear();
    while (more && batch.size() < kLanes) {
      for (int q = 0; q <= codim_; ++q) kernel_.set_vertex(static_cast<int>(batch.size()), q, value(next[q]));
      batch.push_back(next);
      int i = codim_;
      while (i >= 0 && next[i] == dim_ - codim_ + i) --i;
      more = i >= 0;
      if (more) ++next[i];
      for (int j = i + 1; more && j <= codim_; ++j) next[j] = next[j - 1] + 1;
    }
    kernel_.factor();
    for (int lane = 0; lane < static_cast<int>(batch.size()); ++lane) {
      double lowest = std::numeric_limits<double>::infinity();
      for (int q = 0; q <= codim_; ++q) lowest = std::min(lowest, kernel_.weight(lane, q));
      const double error = 2 * kernel_.weight_error(lane);
      for (int q = 0; q <= codim_; ++q) columns[q] = value(batch[lane][q]);
      // The weights of the kernel mean something for a simplex that is hit; for one equation only then.
      const bool decided = codim_ > 1 && kernel_.reliable(lane) && std::abs(lowest) > error;
      if (!(decided ? lowest > 0 : exactly_hit(columns))) continue;
      describe(simplex, batch[lane], found);
      if (!accept_ || accept_(found)) return true;
      any_rejected_ = true;
    }
  }
  return false;
}

// The k-face of a d-simplex with these vertices.
void SeedSearch::describe(const FullSimplex& simplex, const std::vector<int>& face, Crossing& found) const {
  found.base = simplex.base;
  for (int q = 0; q < face[0]; ++q) ++found.base[simplex.order[q]];
  found.parts.assign(dim_, codim_);
  for (int p = 0; p < codim_; ++p)
    for (int q = face[p]; q < face[p + 1]; ++q) found.parts[simplex.order[q]] = p;
}

// Newton's method on the interpolant from a point, in lattice coordinates: exact as soon as it stays in one simplex.
// Counts the simplices it examines.
bool SeedSearch::newton(const std::vector<double>& from, Crossing& found, std::size_t& examined) {
  const auto start = as_eigen(from);
  Eigen::VectorXd y = start;
  for (int step = 0; step < 12; ++step) {
    const FullSimplex simplex = locate(as_span(y));
    if (!load(simplex)) return false;
    ++examined;
    if (hit_face(simplex, found)) return true;
    Eigen::MatrixXd gradient(codim_, dim_);
    auto value = [&](int q) {
      return Eigen::Map<const Eigen::VectorXd>(&values_[std::size_t{ids_[q]} * codim_], codim_);
    };
    Eigen::VectorXd f = value(0);
    for (int q = 0; q < dim_; ++q) {
      const int c = simplex.order[q];
      gradient.col(c) = value(q + 1) - value(q);
      f += (y[c] - simplex.base[c]) * gradient.col(c);
    }
    // Rows scaled to one size, so that the units of f do not matter to the rank decision.
    for (int r = 0; r < codim_; ++r) {
      const double size = gradient.row(r).lpNorm<Eigen::Infinity>();
      if (size > 0) {
        gradient.row(r) /= size;
        f[r] /= size;
      }
    }
    const Eigen::VectorXd move = gradient.completeOrthogonalDecomposition().solve(f);
    if (!move.allFinite() || (y - move - start).norm() > 4 + dim_) return false;
    y -= move;
  }
  return false;
}

bool SeedSearch::search(std::span<const double> x, std::size_t limit, Crossing& found, std::string& reason) {
  const std::vector<double> z = triangulation_.lattice_coordinates(x);
  std::size_t examined = 0;
  if (newton(z, found, examined)) return true;

  bool any_inside = false, is_found = false;
  any_rejected_ = false;
  for_each_around(z, limit - std::min(limit, examined), [&](const FullSimplex& simplex) {
    ++examined;
    if (!load(simplex)) return true;
    any_inside = true;
    is_found = hit_face(simplex, found);
    return !is_found;
  });
  if (is_found) return true;
  // In high dimension the simplices around a point are too many to be looked at; from other points nearby Newton's
  // method comes by others.
  for (std::int32_t attempt = 0; any_inside && attempt < kMoreStarts; ++attempt) {
    coxeter::KeyedRandom random(kStartsSeed, std::span(&attempt, 1));
    std::vector<double> other = z;
    for (double& c : other) c += random.uniform() - 0.5;
    if (newton(other, found, examined)) return true;
  }
  const std::string around = "none of the " + std::to_string(examined) + " simplices around it ";
  if (!any_inside)
    reason = "it lies outside the box";
  else if (any_rejected_)
    reason = around + "meets the zero set inside the domain of the inequalities and the box";
  else
    reason =
        around + "meets the zero set: the point is far from the manifold, or the edge length is too large to see it";
  return false;
}

bool SeedSearch::search_full(std::span<const double> x, std::size_t limit,
                             const std::function<bool(const coxeter::Simplex&)>& found) {
  bool is_found = false;
  for_each_around(triangulation_.lattice_coordinates(x), limit, [&](const FullSimplex& simplex) {
    if (!load(simplex)) return true;
    std::vector<std::uint16_t> parts(dim_ + 1, static_cast<std::uint16_t>(dim_));
    for (int q = 0; q < dim_; ++q) parts[simplex.order[q]] = static_cast<std::uint16_t>(q);
    is_found = found({coxeter::LatticeVertex(simplex.base), coxeter::OrderedPartition::from_part_indices(parts)});
    return !is_found;
  });
  return is_found;
}

// Visits the d-simplices around a point, given in lattice coordinates, nearest barycentre first, until visit is false.
void SeedSearch::for_each_around(std::span<const double> start, std::size_t limit,
                                 const std::function<bool(const FullSimplex&)>& visit) {
  struct Entry {
    double distance;
    std::size_t number;  // breaks ties, so that the order is the same everywhere
    FullSimplex simplex;
    bool operator<(const Entry& other) const {
      return std::pair(distance, number) > std::pair(other.distance, other.number);
    }
  };
  auto key_of = [](const FullSimplex& simplex) {
    std::u32string key(simplex.base.begin(), simplex.base.end());
    key.append(simplex.order.begin(), simplex.order.end());
    return key;
  };
  std::unordered_set<std::u32string> seen;
  std::priority_queue<Entry> queue;
  auto push = [&](FullSimplex simplex) {
    if (!seen.insert(key_of(simplex)).second) return;
    const std::vector<double> centre = barycentre(simplex);
    const Eigen::VectorXd away = as_eigen(triangulation_.linear()) * (as_eigen(centre) - as_eigen(start));
    queue.push({away.norm(), seen.size(), std::move(simplex)});
  };
  push(locate(start));
  for (std::size_t visited = 0; !queue.empty() && visited < limit; ++visited) {
    const FullSimplex simplex = queue.top().simplex;
    queue.pop();
    if (!visit(simplex)) return;
    for (int q = 0; q <= dim_; ++q) push(neighbour(simplex, q));
  }
}

}  // namespace whitney
