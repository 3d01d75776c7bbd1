// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include <whitney/topology/mesh.h>

namespace whitney::internal {

/// Simplicial curves or surfaces with boundary, the patches, being sewn together along their boundaries.
///
/// Each patch stays a simplicial complex of its own; sewing only records which vertices and which boundary edges are to
/// be the same. So the quotient may pass through states that are no simplicial complex (two edges between the same
/// vertices, an edge from a vertex to itself) until make_simplicial() refines it.
class Quilt {
 public:
  using Vertex = std::uint32_t;
  using Edge = std::pair<Vertex, Vertex>;

  /// dim: n, 1 or 2.
  Quilt(int dim, std::size_t ambient_dim) : dim_(dim), ambient_dim_(ambient_dim) {}

  /// Adds a patch and returns the number of its first vertex; its vertices keep their order. Throws InvalidInput when a
  /// vertex is out of range or twice in a simplex, and when more than two simplices have a common facet.
  Vertex add_patch(const SimplicialMesh& mesh);

  std::size_t num_vertices() const { return patch_of_.size(); }
  std::size_t num_simplices() const { return simplices_.size() / (dim_ + 1); }
  int patch_of(Vertex v) const { return patch_of_[v]; }
  int patch_of_simplex(std::size_t s) const { return patch_of_[simplices_[s * (dim_ + 1)]]; }
  std::span<const double> point(Vertex v) const { return {&points_[v * ambient_dim_], ambient_dim_}; }
  std::span<const Vertex> simplex(std::size_t s) const { return {&simplices_[s * (dim_ + 1)], std::size_t(dim_) + 1}; }

  /// The edges in exactly one triangle of their patch, in the order of the triangles; n = 2.
  std::vector<Edge> boundary_edges() const;
  /// How many edges have this vertex; n = 1.
  std::size_t degree(Vertex v) const { return degree_[v]; }

  /// Splits an edge at (1 - fraction) a + fraction b, and at the same fraction the one it is sewn to; each triangle
  /// with such an edge is bisected. Returns the new vertex on ab.
  Vertex split(Vertex a, Vertex b, double fraction);

  /// Makes two vertices the same.
  void unite(Vertex a, Vertex b);
  /// Sews boundary edge a to boundary edge b, first vertex to first vertex. n = 2; neither may be sewn yet.
  void sew(Edge a, Edge b);

  /// The vertex that stands for all that are united with v: of lowest patch, then lowest number.
  Vertex representative(Vertex v) const;

  /// Splits edges until the quotient is a simplicial complex: no edge from a vertex to itself, no two edges (or
  /// triangles) with the same vertices. Does nothing where that holds already.
  void make_simplicial();

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static std::uint64_t key(Vertex a, Vertex b) {
    return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
  }
  Vertex split_own(Vertex a, Vertex b, double fraction);
  void attach(Vertex a, Vertex b, std::uint32_t simplex);
  void replace(Vertex a, Vertex b, std::uint32_t old_simplex, std::uint32_t new_simplex);
  std::optional<Edge> sewn_to(Vertex a, Vertex b) const;
  std::vector<Edge> edges_to_split() const;

  int dim_;
  std::size_t ambient_dim_;
  int num_patches_ = 0;
  std::vector<double> points_;
  std::vector<int> patch_of_;
  std::vector<std::size_t> degree_;  ///< n = 1
  std::vector<Vertex> simplices_;
  std::unordered_map<std::uint64_t, std::array<std::uint32_t, 2>> around_;  ///< edge -> its simplices, or kNone
  std::unordered_map<std::uint64_t, Edge> sewn_;                            ///< (a, b), a < b -> where a and b go
  std::vector<Vertex> parent_;
};

}  // namespace whitney::internal
