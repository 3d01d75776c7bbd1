// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <coxeter/lattice_vertex.h>
#include <coxeter/triangulation.h>
#include <perturbation/displacement.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/topology/mesh.h>

namespace whitney {

/// Subdivides d-simplices of T~, d <= 4, so that Whitney's complex K is a subcomplex and neighbours agree.
///
/// An edge is split when it belongs to a d-simplex that carries a cell of K, a face of higher dimension when one of its
/// edges is. A split face is the cone from one point in its interior over its subdivided facets, a face that is not
/// split stays whole; as that is a matter of the face alone, the result is conforming. In a d-simplex that carries a
/// cell all faces are split: it becomes (d+1)! simplices, one for every chain of its faces, see BKW20, Sect. 2.2.
class SplitFaces {
 public:
  static constexpr int kMaxDim = 4;

  /// Keeps references to the triangulation and the displacements. Throws InvalidInput unless 2 <= d <= 4 and the
  /// dimensions agree.
  SplitFaces(const CellComplex& complex, const coxeter::Triangulation& triangulation,
             const perturbation::DisplacementMap& displacements);

  /// Appends the simplices of the subdivision of a d-simplex; only those whose least face lies inside. vertices: d + 1
  /// vertices of T in the order of coxeter::Simplex::vertices; outside: bit q for v_q. All come out positively
  /// oriented, by combinatorics (the embedding of T~ makes it so for the coordinates).
  void subdivide(std::span<const coxeter::LatticeVertex> vertices, std::uint32_t outside);
  /// Whether K crosses this edge of T~ (codimension 1).
  bool is_crossed(const coxeter::LatticeVertex& a, const coxeter::LatticeVertex& b) const;

  /// The simplices so far. The first points are those of barycentric_subdivision(complex), in its order; then come
  /// vertices of T~ and barycentres of faces. point_data: "complex_point", the index in
  /// barycentric_subdivision(complex) or -1, and "face_dim", the dimension of the face of T~ that the point lies in the
  /// interior of.
  SimplicialMesh take_mesh();
  std::size_t num_complex_points() const { return num_complex_points_; }

 private:
  /// Sorted vertex numbers, filled up with kNone.
  using Face = std::array<std::uint32_t, kMaxDim + 1>;
  struct FaceHash {
    std::size_t operator()(const Face& face) const;
  };
  static constexpr std::uint32_t kNone = 0xffffffff;
  static std::uint64_t edge_key(std::uint32_t a, std::uint32_t b);

  std::uint32_t number_of(const coxeter::LatticeVertex& vertex);
  std::uint32_t point_of(const std::uint32_t* numbers, std::uint32_t mask);
  std::uint32_t add_point(std::span<const double> x, int face_dim);

  const coxeter::Triangulation& triangulation_;
  const perturbation::DisplacementMap& displacements_;
  int d_;
  bool reversed_;  // the determinant of the triangulation is negative
  std::unordered_map<coxeter::LatticeVertex, std::uint32_t> numbers_;
  std::vector<double> positions_;  // d per vertex number
  std::unordered_map<Face, std::uint32_t, FaceHash> points_;
  std::unordered_set<std::uint64_t> split_edges_, crossed_edges_;
  SimplicialMesh mesh_;
  std::size_t num_complex_points_;
};

}  // namespace whitney
