// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/displacement.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <coxeter/base/error.h>

namespace whitney::perturbation {
namespace {

using coxeter::LatticeVertex;

/// The next double above: an upper bound of the exact result of which x is the rounded one.
double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

/// An upper bound of abs(a - b).
double difference_above(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = up(std::abs(a[i] - b[i]));
    sum = up(sum + up(difference * difference));
  }
  return up(std::sqrt(sum));
}

/// Whether b - a or a - b is in {0,1}^d.
bool adjacent(const LatticeVertex& a, const LatticeVertex& b) {
  bool higher = true, lower = true;
  for (int c = 0; c < a.ambient_dim() && (higher || lower); ++c) {
    const std::int64_t step = std::int64_t{b[c]} - a[c];
    higher = higher && (step == 0 || step == 1);
    lower = lower && (step == 0 || step == -1);
  }
  return higher || lower;
}

/// Calls visit(w) for all w > v adjacent to v: v + e(U), U a nonempty subset of {0 .. d-1}, d < 64. A vertex that
/// leaves the range of int32 has no displacement, so it is left out.
template <class Visitor>
void for_each_upper_neighbour(const LatticeVertex& v, Visitor visit) {
  const int d = v.ambient_dim();
  LatticeVertex w = v;
  for (std::uint64_t mask = 1; mask < std::uint64_t{1} << d; ++mask) {
    bool in_range = true;
    for (int c = 0; c < d; ++c) {
      const bool raised = mask >> c & 1;
      in_range = in_range && !(raised && v[c] == std::numeric_limits<std::int32_t>::max());
      if (in_range) w[c] = v[c] + raised;
    }
    if (in_range) visit(w);
  }
}

}  // namespace

DisplacementMap::DisplacementMap(int ambient_dim) : ambient_dim_(ambient_dim) {
  if (ambient_dim < 1) throw InvalidInput("ambient_dim must be at least 1");
}

void DisplacementMap::set(const LatticeVertex& vertex, std::span<const double> displacement) {
  if (vertex.ambient_dim() != ambient_dim_) throw InvalidInput("vertex must have the ambient dimension of the map");
  if (displacement.size() != static_cast<std::size_t>(ambient_dim_))
    throw InvalidInput("displacement must have as many entries as the ambient dimension");
  for (const double c : displacement)
    if (!std::isfinite(c)) throw InvalidInput("displacement must have finite entries");
  const auto [entry, is_new] = index_.try_emplace(vertex, vertices_.size());
  if (is_new) {
    vertices_.push_back(vertex);
    values_.resize(values_.size() + displacement.size());
  }
  std::ranges::copy(displacement, values_.begin() + static_cast<std::ptrdiff_t>(entry->second * displacement.size()));
}

std::span<const double> DisplacementMap::find(const LatticeVertex& vertex) const {
  const auto entry = index_.find(vertex);
  if (entry == index_.end()) return {};
  return displacement(entry->second);
}

std::vector<double> position(const coxeter::Triangulation& triangulation, const DisplacementMap& displacements,
                             const LatticeVertex& vertex) {
  const int d = triangulation.ambient_dim();
  if (displacements.ambient_dim() != d)
    throw InvalidInput("triangulation and displacements must have the same ambient dimension");
  std::vector<double> x(static_cast<std::size_t>(d));
  triangulation.cartesian(vertex, x);
  const auto u = displacements.find(vertex);
  for (std::size_t c = 0; c < u.size(); ++c) x[c] += u[c];
  return x;
}

double embedding_bound(const coxeter::Quality& quality) {
  // The closed form takes fewer than ten operations, each with a relative error of at most half an epsilon. The
  // rounding of Lambda changes the width by at most epsilon times its condition number, at most sqrt(d+1), times
  // sqrt(d).
  return quality.width * (1 - (8 + 2.0 * (quality.ambient_dim + 1)) * std::numeric_limits<double>::epsilon());
}

EmbeddingCheck check_embedding(const DisplacementMap& displacements, double bound) {
  if (!(bound > 0)) throw InvalidInput("bound must be positive");
  const std::size_t n = displacements.size();
  const auto d = static_cast<std::size_t>(displacements.ambient_dim());
  const std::vector<double> zero(d, 0.0);
  EmbeddingCheck check{Embedding::kProven, 0, 0, std::nullopt};
  auto compare = [&](double difference, const LatticeVertex& a, const LatticeVertex& b) {
    check.largest_difference = std::max(check.largest_difference, difference);
    if (difference < bound || check.witness) return;
    check.verdict = Embedding::kNotProven;
    check.witness.emplace(a, b);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const LatticeVertex& v = displacements.vertices()[i];
    const double length = difference_above(displacements.displacement(i), zero);
    check.largest_displacement = std::max(check.largest_displacement, length);
    compare(length, v, v);
  }
  if (2 * check.largest_displacement < bound) {
    check.largest_difference = 2 * check.largest_displacement;
    return check;
  }
  const bool by_neighbours = d < 40 && (std::uint64_t{1} << d) < n;
  for (std::size_t i = 0; i < n; ++i) {
    const LatticeVertex& v = displacements.vertices()[i];
    const auto u = displacements.displacement(i);
    if (by_neighbours) {
      for_each_upper_neighbour(v, [&](const LatticeVertex& w) {
        if (const auto other = displacements.find(w); !other.empty()) compare(difference_above(u, other), v, w);
      });
    } else {
      for (std::size_t j = 0; j < i; ++j) {
        const LatticeVertex& w = displacements.vertices()[j];
        if (adjacent(v, w)) compare(difference_above(u, displacements.displacement(j)), w, v);
      }
    }
  }
  return check;
}

}  // namespace whitney::perturbation
