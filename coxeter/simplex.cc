// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/simplex.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include <coxeter/base/error.h>
#include <coxeter/base/hash_mix.h>
#include <coxeter/triangulation.h>

namespace whitney::coxeter {
namespace {

std::int32_t checked(std::int64_t coordinate) {
  if (coordinate < std::numeric_limits<std::int32_t>::min() || coordinate > std::numeric_limits<std::int32_t>::max())
    throw LatticeOverflow("a lattice coordinate leaves the range of int32");
  return static_cast<std::int32_t>(coordinate);
}

/// v + e(U), U the elements in the span.
LatticeVertex shifted(LatticeVertex v, std::span<const std::uint16_t> elements) {
  const int d = v.ambient_dim();
  for (const auto j : elements) {
    if (j < d) continue;
    for (int c = 0; c < d; ++c) v[c] = checked(std::int64_t{v[c]} - 1);
  }
  for (const auto j : elements)
    if (j < d) v[j] = checked(std::int64_t{v[j]} + 1);
  return v;
}

/// The parts from q on, then those before q.
OrderedPartition rotated(const OrderedPartition& partition, int q) {
  IndexArray indices = partition.part_indices();
  const int m = partition.num_parts();
  for (auto& index : indices) index = static_cast<std::uint16_t>(index >= q ? index - q : index - q + m);
  return OrderedPartition::from_part_indices({indices.data(), indices.size()});
}

}  // namespace

Simplex::Simplex(LatticeVertex vertex, OrderedPartition partition)
    : base_(std::move(vertex)), partition_(std::move(partition)) {
  const int d = base_.ambient_dim();
  if (partition_.num_elements() != d + 1)
    throw InvalidInput("partition must have d + 1 elements, d the ambient dimension of the vertex: expected " +
                       std::to_string(d + 1) + ", got " + std::to_string(partition_.num_elements()));
  const auto elements = partition_.elements();
  const auto position = std::ranges::find(elements, d) - elements.begin();
  const auto ends = partition_.ends();
  const int part = static_cast<int>(std::ranges::upper_bound(ends, position) - ends.begin());
  if (part != dim()) {
    // v + e(U) with d in U: one less in every coordinate outside U.
    for (std::size_t i = ends[static_cast<std::size_t>(part)]; i < elements.size(); ++i)
      base_[elements[i]] = checked(std::int64_t{base_[elements[i]]} - 1);
    partition_ = rotated(partition_, part + 1);
  }
  for (const auto j : partition_.elements().first(partition_.elements().size() - partition_.part(dim()).size()))
    if (base_[j] == std::numeric_limits<std::int32_t>::max())
      throw LatticeOverflow("a vertex of the simplex leaves the range of int32");
}

Simplex::Simplex(Representation representation)
    : Simplex(std::move(representation.vertex), std::move(representation.partition)) {}

void Simplex::assign_parts(const Simplex& other) {
  base_ = other.base_;
  partition_ = other.partition_;
}

Simplex Simplex::from_vertices(std::span<const LatticeVertex> vertices) {
  if (vertices.empty()) throw InvalidInput("vertices must not be empty");
  const int d = vertices[0].ambient_dim();
  const int m = static_cast<int>(vertices.size()) - 1;
  if (m > d) throw InvalidInput("vertices must be at most d + 1");
  std::vector<std::pair<std::int64_t, int>> order;
  for (int i = 0; i <= m; ++i) {
    const LatticeVertex& v = vertices[static_cast<std::size_t>(i)];
    if (v.ambient_dim() != d) throw InvalidInput("vertices must have one ambient dimension");
    order.emplace_back(std::accumulate(v.begin(), v.end(), std::int64_t{0}), i);
  }
  std::ranges::sort(order);
  auto sorted = [&](int i) -> const LatticeVertex& {
    return vertices[static_cast<std::size_t>(order[static_cast<std::size_t>(i)].second)];
  };
  IndexArray part_indices(static_cast<std::size_t>(d) + 1, static_cast<std::uint16_t>(m));
  for (int i = 1; i <= m; ++i) {
    bool grows = false;
    for (int c = 0; c < d; ++c) {
      const std::int64_t height = std::int64_t{sorted(i)[c]} - sorted(0)[c];
      auto& index = part_indices[static_cast<std::size_t>(c)];
      if (height == 1 && index == m) {
        index = static_cast<std::uint16_t>(i - 1);
        grows = true;
      } else if (height != (index < m ? 1 : 0)) {
        throw InvalidInput("vertices must span a simplex: a chain within one unit cube");
      }
    }
    if (!grows) throw InvalidInput("vertices must be distinct");
  }
  return Simplex(sorted(0), OrderedPartition::from_part_indices({part_indices.data(), part_indices.size()}));
}

LatticeVertex Simplex::vertex(int q) const {
  if (q < 0 || q > dim()) throw InvalidInput("q must be in 0 .. dim(), is " + std::to_string(q));
  return q == 0 ? base_
                : shifted(base_, partition_.elements().first(partition_.ends()[static_cast<std::size_t>(q) - 1]));
}

std::vector<LatticeVertex> Simplex::vertices() const {
  std::vector<LatticeVertex> result;
  result.reserve(static_cast<std::size_t>(dim()) + 1);
  for (int q = 0; q <= dim(); ++q) result.push_back(q == 0 ? base_ : shifted(result.back(), partition_.part(q - 1)));
  return result;
}

Representation Simplex::cyclic_shift(int q) const { return {vertex(q), rotated(partition_, q)}; }

bool Simplex::is_face_of(const Simplex& other) const {
  const int d = ambient_dim();
  if (other.ambient_dim() != d || dim() > other.dim()) return false;
  // Our base must be one of its vertices, w + e(first j parts).
  std::size_t raised = 0;
  for (int c = 0; c < d; ++c) {
    const std::int64_t height = std::int64_t{base_[c]} - other.base_[c];
    if (height < 0 || height > 1) return false;
    raised += static_cast<std::size_t>(height);
  }
  const auto its_elements = other.partition_.elements();
  const auto its_ends = other.partition_.ends();
  for (const auto c : its_elements.first(raised))
    if (c == d || base_[c] == other.base_[c]) return false;
  const std::size_t num_parts = its_ends.size();
  std::size_t j = 0;
  if (raised > 0) {
    const auto found = std::ranges::lower_bound(its_ends, raised);
    if (*found != raised) return false;
    j = static_cast<std::size_t>(found - its_ends.begin()) + 1;
  }
  // Its parts from the j-th on, cyclically, must fill ours one after the other.
  const IndexArray index = partition_.part_indices();
  const auto our_ends = partition_.ends();
  std::size_t ours = 0, filled = 0;
  for (std::size_t i = 0; i < num_parts; ++i) {
    const auto part = other.partition_.part(static_cast<int>((i + j) % num_parts));
    if (filled == our_ends[ours]) ++ours;
    for (const auto element : part)
      if (index[element] != ours) return false;
    filled += part.size();
  }
  return true;
}

std::strong_ordering operator<=>(const Simplex& a, const Simplex& b) {
  if (const auto order = a.base_ <=> b.base_; order != 0) return order;
  const IndexArray i = a.partition_.part_indices(), j = b.partition_.part_indices();
  // The last entry, of element d, is the dimension.
  return std::lexicographical_compare_three_way(i.begin(), i.end(), j.begin(), j.end());
}

std::uint64_t Simplex::hash() const {
  std::uint64_t state = base_.hash();
  for (const auto element : partition_.elements()) state = detail::hash_step(state, element);
  for (const auto end : partition_.ends()) state = detail::hash_step(state, end);
  return detail::hash_step(state, 0);
}

std::vector<double> barycentre(const Simplex& simplex, const Triangulation& triangulation) {
  const int d = simplex.ambient_dim(), m = simplex.dim();
  if (d != triangulation.ambient_dim())
    throw InvalidInput("simplex and triangulation must have the same ambient dimension");
  std::vector<double> z(static_cast<std::size_t>(d));
  for (int q = 0; q <= m; ++q)
    for (const auto c : simplex.partition().part(q))
      if (c < d) z[c] = simplex.base()[c] + double(m - q) / (m + 1);  // c is raised in the vertices q+1 .. m
  std::vector<double> x = multiply(triangulation.linear(), z);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += triangulation.offset()[i];
  return x;
}

}  // namespace whitney::coxeter
