// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <coxeter/simplex.h>
#include <whitney/cells/crossed_simplices.h>
#include <whitney/topology/incidence.h>

namespace whitney {

/// The piecewise-linear isomanifold as a complex of convex polytopes, with its Hasse diagram.
///
/// A j-cell is the intersection of a (k+j)-simplex of the triangulation with the zero set of the interpolant: a simple
/// polytope with interior points in the simplex's interior, so faces of cells are the cells of faces of simplices. The
/// complex is a strongly regular CW complex, and without a boundary when the trace ran to its end. Cells of each
/// dimension are in the canonical order of their simplices.
///
/// With inequalities, cells are cut off where one of them vanishes, and the cuts are cells too: a j-cell with the set I
/// of inequalities is the part with g >= 0 of the (k+|I|+j)-simplex in which f and g_I vanish. Such cells make the
/// strata: the interior (I empty) and the pieces of the boundary. Cells of each dimension come set by set.
///
/// Where f vanishes at lattice vertices, cells are those of f = (eps, .., eps^k) for an infinitely small eps: the
/// combinatorics are those of a manifold, while the points of several 0-cells may coincide.
struct CellComplex {
  int ambient_dim = 0;              ///< d
  int intrinsic_dim = 0;            ///< n
  std::vector<Incidence> facets;    ///< facets[j], 0 <= j <= n: the (j-1)-faces of every j-cell; empty lists for j = 0
  std::vector<Incidence> cofacets;  ///< cofacets[j]: the (j+1)-cells around every j-cell; empty lists for j = n
  std::vector<double> points;       ///< num_cells(0) x d: the 0-cells
  std::vector<CarrierSimplices> simplices;  ///< simplices[j]: the (k+|I|+j)-simplex of every j-cell
  /// The sets of inequalities that vanish on cells, increasing numbers as in Domain; the first is empty.
  std::vector<std::vector<int>> inequality_sets{{}};
  /// set_begin[j][s] .. set_begin[j][s+1]: the j-cells with inequality_sets[s]; one entry more than there are sets.
  std::vector<std::vector<std::uint32_t>> set_begin;
  int num_given = 0;  ///< inequalities below this number are the caller's, the others are sides of the box
  std::vector<std::int32_t> vertex_coordinates;  ///< lattice vertices that base indices refer to, num x d
  std::size_t num_dropped = 0;  ///< cells that a stopped trace left incomplete, or that bound no n-cell

  std::size_t num_cells(int dim) const { return facets[dim].size(); }
  /// The index in inequality_sets of the set that belongs to cell i of dimension j.
  std::size_t set_of(int j, std::size_t i) const;
  /// The (k+|I|+j)-simplex of the triangulation that carries cell i of dimension j.
  coxeter::Simplex simplex(int j, std::size_t i) const;
};

/// Builds the cell complex of crossed simplices: every coface of a simplex that is hit is hit, so the (j+1)-cells are
/// the cofacets of the j-cells (and, with inequalities, a (sigma, I) is a face of (sigma, I - i) for every i in I).
///
/// When they are not the whole, cells of which a face is missing are left out, then those that are
/// faces of no n-cell. Throws InvalidInput when there are more than 2^32 - 2 cells or incidences of one dimension.
CellComplex cell_complex(const CrossedSimplices& crossed);

}  // namespace whitney
