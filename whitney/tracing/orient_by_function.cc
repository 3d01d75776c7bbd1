// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/orient_by_function.h>

#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include <coxeter/base/error.h>

namespace whitney {

OrientedMesh orient_by_function(SimplicialMesh input, const Function& f) {
  const int d = input.ambient_dim, n = input.dim, k = f.codim();
  if (f.ambient_dim() != d || n + k != d)
    throw InvalidInput("orient_by_function: the dimensions of the mesh and of f do not fit");
  OrientedMesh oriented = orient(std::move(input));
  SimplicialMesh& mesh = oriented.mesh;
  auto edges = [&](std::size_t s) {
    const std::uint32_t* corner = &mesh.simplices[s * (n + 1)];
    Eigen::MatrixXd E(d, n);
    const Eigen::Map<const Eigen::VectorXd> origin(&mesh.points[std::size_t{corner[0]} * d], d);
    for (int q = 0; q < n; ++q)
      E.col(q) = Eigen::Map<const Eigen::VectorXd>(&mesh.points[std::size_t{corner[q + 1]} * d], d) - origin;
    return E;
  };

  const std::size_t components = oriented.orientable.size();
  std::vector<double> largest(components, 0.0);
  std::vector<std::size_t> widest(components, 0);
  for (std::size_t s = 0; s < mesh.num_simplices(); ++s) {
    const Eigen::MatrixXd E = edges(s);
    const double volume = (E.transpose() * E).determinant();
    if (volume > largest[oriented.component[s]]) {
      largest[oriented.component[s]] = volume;
      widest[oriented.component[s]] = s;
    }
  }
  std::vector<char> flip(components, 0);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J(k, d);
  for (std::size_t c = 0; c < components; ++c) {
    if (largest[c] == 0 || !oriented.orientable[c]) continue;
    const Eigen::MatrixXd E = edges(widest[c]);
    const std::uint32_t* corner = &mesh.simplices[widest[c] * (n + 1)];
    const Eigen::VectorXd x =
        Eigen::Map<const Eigen::VectorXd>(&mesh.points[std::size_t{corner[0]} * d], d) + E.rowwise().sum() / (n + 1);
    f.jacobian({x.data(), std::size_t(d)}, {J.data(), std::size_t(k) * d}, E.colwise().norm().maxCoeff());
    Eigen::MatrixXd basis(d, d);
    basis << E.colwise().normalized(), J.rowwise().normalized().transpose();
    flip[c] = basis.determinant() < 0;
  }
  for (std::size_t s = 0; s < mesh.num_simplices(); ++s)
    if (flip[oriented.component[s]]) std::swap(mesh.simplices[s * (n + 1)], mesh.simplices[s * (n + 1) + 1]);
  return oriented;
}

}  // namespace whitney
