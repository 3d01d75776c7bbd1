// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/quilt.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>

#include <coxeter/base/error.h>

namespace whitney::internal {

Quilt::Vertex Quilt::add_patch(const SimplicialMesh& mesh) {
  const Vertex first = static_cast<Vertex>(num_vertices());
  const std::size_t corners = dim_ + 1;
  points_.insert(points_.end(), mesh.points.begin(), mesh.points.end());
  patch_of_.resize(first + mesh.num_points(), num_patches_++);
  degree_.resize(patch_of_.size(), 0);
  parent_.resize(patch_of_.size());
  std::iota(parent_.begin() + first, parent_.end(), first);
  around_.reserve(around_.size() + mesh.num_simplices() * (dim_ == 1 ? 1 : 2));
  for (std::size_t s = 0; s < mesh.num_simplices(); ++s) {
    const std::uint32_t number = static_cast<std::uint32_t>(num_simplices());
    for (std::size_t i = 0; i < corners; ++i) {
      const std::uint32_t v = mesh.simplices[s * corners + i];
      const std::string which = "simplex " + std::to_string(s) + ", vertex " + std::to_string(v);
      if (v >= mesh.num_points()) throw InvalidInput(which + ": there is no such point");
      for (std::size_t j = 0; j < i; ++j) {
        if (mesh.simplices[s * corners + j] == v) throw InvalidInput(which + ": twice in the simplex");
      }
      simplices_.push_back(first + v);
    }
    for (std::size_t i = 0; i < corners; ++i) {
      const Vertex v = simplices_[number * corners + i];
      if (dim_ == 1 && ++degree_[v] > 2) {
        throw InvalidInput("vertex " + std::to_string(v - first) + " is in more than two edges");
      }
      for (std::size_t j = i + 1; j < corners; ++j) attach(v, simplices_[number * corners + j], number);
    }
  }
  return first;
}

void Quilt::attach(Vertex a, Vertex b, std::uint32_t simplex) {
  auto& list = around_.try_emplace(key(a, b), std::array{kNone, kNone}).first->second;
  if (list[0] != kNone && (dim_ == 1 || list[1] != kNone)) {
    const auto local = [&](Vertex v) {
      const auto first = std::find(patch_of_.begin(), patch_of_.end(), patch_of_[v]) - patch_of_.begin();
      return std::to_string(v - first);
    };
    throw InvalidInput("the edge of vertices " + local(a) + " and " + local(b) +
                       (dim_ == 1 ? " is there twice" : " is in more than two triangles"));
  }
  (list[0] == kNone ? list[0] : list[1]) = simplex;
}

void Quilt::replace(Vertex a, Vertex b, std::uint32_t old_simplex, std::uint32_t new_simplex) {
  auto& list = around_.at(key(a, b));
  (list[0] == old_simplex ? list[0] : list[1]) = new_simplex;
}

std::vector<Quilt::Edge> Quilt::boundary_edges() const {
  std::vector<Edge> edges;
  for (std::size_t s = 0; s < num_simplices(); ++s) {
    const auto v = simplex(s);
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Vertex a = v[i], b = v[(i + 1) % v.size()];
      if (around_.at(key(a, b))[1] == kNone) edges.emplace_back(a, b);
    }
  }
  return edges;
}

Quilt::Vertex Quilt::split_own(Vertex a, Vertex b, double fraction) {
  const Vertex m = static_cast<Vertex>(num_vertices());
  for (std::size_t i = 0; i < ambient_dim_; ++i) {
    points_.push_back((1 - fraction) * points_[a * ambient_dim_ + i] + fraction * points_[b * ambient_dim_ + i]);
  }
  patch_of_.push_back(patch_of_[a]);
  degree_.push_back(2);
  parent_.push_back(m);
  const std::array<std::uint32_t, 2> around = around_.at(key(a, b));
  around_.erase(key(a, b));
  for (const std::uint32_t old : around) {
    if (old == kNone) continue;
    const std::uint32_t added = static_cast<std::uint32_t>(num_simplices());
    for (int i = 0; i <= dim_; ++i) {
      Vertex& v = simplices_[old * (dim_ + 1) + i];
      const Vertex before = v;
      if (before == b) v = m;
      simplices_.push_back(before == a ? m : before);
      if (before != a && before != b) {
        replace(b, before, old, added);
        attach(m, before, old);
        attach(m, before, added);
      }
    }
    attach(a, m, old);
    attach(m, b, added);
  }
  return m;
}

std::optional<Quilt::Edge> Quilt::sewn_to(Vertex a, Vertex b) const {
  const auto found = sewn_.find(key(a, b));
  if (found == sewn_.end()) return std::nullopt;
  const Edge& image = found->second;
  return a < b ? image : Edge(image.second, image.first);
}

void Quilt::sew(Edge a, Edge b) {
  const auto record = [this](Edge from, Edge to) {
    if (from.first > from.second) {
      std::swap(from.first, from.second);
      std::swap(to.first, to.second);
    }
    sewn_[key(from.first, from.second)] = to;
  };
  record(a, b);
  record(b, a);
  unite(a.first, b.first);
  unite(a.second, b.second);
}

Quilt::Vertex Quilt::split(Vertex a, Vertex b, double fraction) {
  const std::optional<Edge> other = sewn_to(a, b);
  const Vertex m = split_own(a, b, fraction);
  if (!other) return m;
  sewn_.erase(key(a, b));
  sewn_.erase(key(other->first, other->second));
  const Vertex n = split_own(other->first, other->second, fraction);
  sew({a, m}, {other->first, n});
  sew({m, b}, {n, other->second});
  return m;
}

Quilt::Vertex Quilt::representative(Vertex v) const {
  while (parent_[v] != v) v = parent_[v];
  return v;
}

void Quilt::unite(Vertex a, Vertex b) {
  a = representative(a);
  b = representative(b);
  if (a == b) return;
  if (std::pair(patch_of_[b], b) < std::pair(patch_of_[a], a)) std::swap(a, b);
  parent_[b] = a;
}

std::vector<Quilt::Edge> Quilt::edges_to_split() const {
  std::vector<char> united(num_vertices(), 0);
  for (Vertex v = 0; v < num_vertices(); ++v) {
    if (representative(v) != v) united[v] = united[representative(v)] = 1;
  }
  // Of edges that became parallel, one may stay: best a sewn one, as splitting it costs four triangles.
  struct Candidate {
    Vertex low, high;
    bool not_sewn;
    Edge edge;
    auto order() const { return std::tuple(low, high, not_sewn, edge); }
  };
  std::vector<Candidate> candidates;
  using Triple = std::array<Vertex, 3>;
  std::vector<std::pair<Triple, std::uint32_t>> triples;
  for (std::uint32_t s = 0; s < num_simplices(); ++s) {
    const auto v = simplex(s);
    bool touches = false;
    for (int i = 0; i <= dim_; ++i) {
      touches = touches || united[v[i]];
      for (int j = i + 1; j <= dim_; ++j) {
        if (!united[v[i]] && !united[v[j]]) continue;
        const Edge edge = std::minmax(v[i], v[j]);
        const auto other = sewn_to(edge.first, edge.second);
        if (around_.at(key(edge.first, edge.second))[0] != s) continue;
        if (other && key(other->first, other->second) < key(edge.first, edge.second)) continue;
        const Edge ends = std::minmax({representative(v[i]), representative(v[j])});
        candidates.push_back({ends.first, ends.second, !other, edge});
      }
    }
    if (dim_ == 2 && touches) {
      Triple triple{representative(v[0]), representative(v[1]), representative(v[2])};
      std::sort(triple.begin(), triple.end());
      triples.emplace_back(triple, s);
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.order() < b.order(); });
  std::vector<Edge> result;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& c = candidates[i];
    const bool parallel = i > 0 && c.low == candidates[i - 1].low && c.high == candidates[i - 1].high;
    if (parallel || c.low == c.high) result.push_back(c.edge);
  }
  if (!result.empty()) return result;
  // With simple edges, only the two triangles of a component that has no others can have the same vertices.
  std::sort(triples.begin(), triples.end());
  for (std::size_t i = 1; i < triples.size(); ++i) {
    if (triples[i].first != triples[i - 1].first) continue;
    const auto v = simplex(triples[i].second);
    result.emplace_back(v[0], v[1]);
  }
  return result;
}

void Quilt::make_simplicial() {
  constexpr int kRounds = 64;  // a handful is enough for two triangles that make a closed surface
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Edge> edges = edges_to_split();
    if (edges.empty()) return;
    for (const Edge& edge : edges) {
      if (around_.contains(key(edge.first, edge.second))) split(edge.first, edge.second, 0.5);
    }
  }
  throw std::logic_error("Quilt: splitting edges did not make the quotient a simplicial complex");
}

}  // namespace whitney::internal
