// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace whitney {

/// A number or a vector for every vertex (or cell) of a mesh, carried into the formats that can hold it.
struct NamedArray {
  std::string name;
  int components = 1;
  std::vector<double> values;  ///< count x components
};

/// A stratum of a manifold with boundary, as a subcomplex of a mesh of the whole: a piece of the boundary, an edge, a
/// corner.
struct MeshStratum {
  int stratum = 0;                       ///< its number, see Strata
  int dim = 0;                           ///< of its simplices, below that of the mesh
  std::vector<std::uint32_t> simplices;  ///< num_simplices x (dim+1), indices of points of the mesh
};

/// A pure simplicial complex of dimension `dim` in R^d: vertices and top simplices.
/// The order of the vertices of a simplex is its orientation.
struct SimplicialMesh {
  int ambient_dim = 0;                   ///< d
  int dim = 0;                           ///< n, the dimension of the simplices
  std::vector<double> points;            ///< num_points x d
  std::vector<std::uint32_t> simplices;  ///< num_simplices x (n+1)
  std::vector<NamedArray> point_data{};  ///< one value per point
  std::vector<NamedArray> cell_data{};   ///< one value per simplex
  std::vector<MeshStratum> strata{};     ///< of lower dimension; formats that cannot hold them leave them out

  std::size_t num_points() const { return ambient_dim > 0 ? points.size() / ambient_dim : 0; }
  std::size_t num_simplices() const { return simplices.size() / (dim + 1); }
};

/// A surface (or curve) whose cells are convex polygons (or edges), vertices listed in cyclic order.
struct PolygonMesh {
  int ambient_dim = 0;                    ///< d
  int dim = 2;                            ///< 1 (edges) or 2 (polygons)
  std::vector<double> points;             ///< num_points x d
  std::vector<std::uint32_t> offsets{0};  ///< polygon i is corners[offsets[i]] .. corners[offsets[i+1]-1]
  std::vector<std::uint32_t> corners;
  std::vector<NamedArray> point_data{};
  std::vector<NamedArray> cell_data{};

  std::size_t num_points() const { return ambient_dim > 0 ? points.size() / ambient_dim : 0; }
  std::size_t num_cells() const { return offsets.size() - 1; }
};

}  // namespace whitney
