// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <coxeter/simplex.h>

namespace whitney {

/// Part numbers of k-simplices need 16 bits from this k on; below, 8 are enough.
inline constexpr int kFirstWideCodim = 255;

/// The simplices of the triangulation that carry the cells of one dimension.
struct CarrierSimplices {
  std::vector<std::uint32_t> base;  ///< index of the base vertex among CellComplex::vertex_coordinates
  /// num_cells x d: the part (0..m) that each coordinate 0..d-1 is in; m the dimension of the simplex.
  std::vector<std::uint16_t> parts;
};

/// The simplices that carry the vertices of one stratum, or of several with the same inequalities: where the
/// interpolants of f and of g_I vanish and all others are positive.
struct BoundarySimplices {
  std::vector<int> inequalities;    ///< I, increasing, not empty; numbers as in Domain
  std::vector<std::uint32_t> base;  ///< per simplex: index of its base vertex among the lattice vertices listed
  /// num_simplices x d: the part of the ordered partition that each coordinate is in, 0..k+|I|.
  std::vector<std::uint16_t> parts;
  std::vector<double> points;  ///< num_simplices x d

  std::size_t size() const { return base.size(); }
};

/// k-simplices of the triangulation that a manifold crosses, each in one point: what a cell complex is made from.
struct CrossedSimplices {
  int ambient_dim = 0, codim = 0;
  std::span<const std::int32_t> vertex_coordinates;  ///< num x d, distinct lattice vertices, lexicographically sorted
  std::span<const std::uint32_t> base;               ///< per simplex: the index of its base vertex
  /// num_simplices x d: the part of the ordered partition that each coordinate is in, 0..k; in the canonical order.
  /// One of the two: uint16_t when codim >= kFirstWideCodim.
  std::span<const std::uint8_t> parts;
  std::span<const std::uint16_t> wide_parts;
  std::span<const double> points;  ///< num_simplices x d
  /// Those of the boundary, with 0-cells cut out by inequalities, by number of inequalities, then
  /// lexicographically.
  std::span<const BoundarySimplices> boundary{};
  int num_given = 0;  ///< see CellComplex
  bool whole = true;  ///< all simplices that the manifold crosses are there
  /// Unless empty, and the complex is not whole: n-cells for whose d-simplex this is false are left out.
  std::function<bool(const coxeter::Simplex&)> keep_top{};
};

}  // namespace whitney
