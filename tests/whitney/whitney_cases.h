// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include <Eigen/LU>

#include <whitney/construction/triangulate.h>
#include <whitney/io/read_problem.h>
#include <whitney/manifolds/catalogue.h>
#include <whitney/topology/mesh.h>

namespace whitney {

/// A named submanifold, the triangulation in general position that was used, and Whitney's complex.
struct WhitneyCase {
  Submanifold manifold;
  coxeter::Triangulation triangulation;
  TriangulateResult result;
};

inline WhitneyCase whitney_case(const std::string& name, double edge_length,
                                const std::map<std::string, double>& parameters = {},
                                const TriangulateOptions& options = {}) {
  Submanifold manifold = named_submanifold(name, parameters);
  TriangulationSpec spec;
  spec.rotation = TriangulationSpec::Rotation::kRandom;
  coxeter::Triangulation triangulation = make_triangulation(spec, manifold.ambient_dim(), edge_length);
  TriangulateResult result = triangulate(manifold, *manifold.bending(), triangulation, manifold.seed_points(), options);
  return {std::move(manifold), std::move(triangulation), std::move(result)};
}

/// The volume of d-simplices in R^d, negative ones counted as such.
inline double volume(const SimplicialMesh& mesh) {
  const int d = mesh.ambient_dim;
  double sum = 0, factorial = 1;
  for (int i = 2; i <= d; ++i) factorial *= i;
  Eigen::MatrixXd edges(d, d);
  for (std::size_t s = 0; s < mesh.num_simplices(); ++s) {
    const std::uint32_t* v = &mesh.simplices[s * (d + 1)];
    for (int q = 0; q < d; ++q)
      for (int c = 0; c < d; ++c)
        edges(c, q) = mesh.points[std::size_t{v[q + 1]} * d + c] - mesh.points[std::size_t{v[0]} * d + c];
    sum += edges.determinant() / factorial;
  }
  return sum;
}

}  // namespace whitney
