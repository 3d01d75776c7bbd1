// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/complex_quality.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

using Matrix = Eigen::MatrixXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// d x n: the edges from the first vertex.
Matrix edges_of(const SimplicialMesh& mesh, std::size_t s) {
  const int d = mesh.ambient_dim, n = mesh.dim;
  const std::uint32_t* v = &mesh.simplices[s * (n + 1)];
  Matrix edges(d, n);
  for (int q = 0; q < n; ++q)
    for (int c = 0; c < d; ++c)
      edges(c, q) = mesh.points[std::size_t{v[q + 1]} * d + c] - mesh.points[std::size_t{v[0]} * d + c];
  return edges;
}

struct EdgeRange {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
};

EdgeRange edge_range(const Matrix& edges) {
  EdgeRange range;
  const auto add = [&](double length) {
    range.shortest = std::min(range.shortest, length);
    range.longest = std::max(range.longest, length);
  };
  for (int a = 0; a < edges.cols(); ++a) {
    add(edges.col(a).norm());
    for (int b = 0; b < a; ++b) add((edges.col(a) - edges.col(b)).norm());
  }
  return range;
}

double thickness_of(const Matrix& edges, double longest) {
  if (edges.cols() == 0) return 1;
  if (!(longest > 0)) return 0;
  // Row i of the pseudo-inverse is the gradient of the barycentric coordinate i + 1: 1 / its length is the altitude.
  const Eigen::ColPivHouseholderQR<Matrix> qr(edges);
  if (qr.rank() < edges.cols()) return 0;
  const Matrix gradients = qr.solve(Matrix::Identity(edges.rows(), edges.rows()));
  const double steepest = std::max(gradients.rowwise().norm().maxCoeff(), gradients.colwise().sum().norm());
  return 1 / (steepest * longest);
}

/// Of a symmetric positive semidefinite matrix; with full relative accuracy.
double largest_eigenvalue(const Matrix& a) {
  if (a.rows() == 1) return std::max(0.0, a(0, 0));
  if (a.rows() == 2) return (a(0, 0) + a(1, 1) + std::hypot(a(0, 0) - a(1, 1), 2 * a(0, 1))) / 2;
  return std::max(0.0, Eigen::SelfAdjointEigenSolver<Matrix>(a, Eigen::EigenvaluesOnly).eigenvalues()(a.rows() - 1));
}

double angle_of(const Matrix& edges, const double* frame) {
  const auto d = edges.rows(), n = edges.cols();
  const Eigen::ColPivHouseholderQR<Matrix> qr(edges);
  if (qr.rank() < n) return std::numbers::pi / 2;
  const Matrix basis = qr.householderQ() * Matrix::Identity(d, n);
  const Eigen::Map<const RowMajor> rows(frame, d, d);
  const Matrix off = rows.bottomRows(d - n) * basis;
  const double sine = std::sqrt(largest_eigenvalue(off.transpose() * off));
  if (sine < 0.9) return std::asin(sine);
  // There the sine loses its digits.
  const double cosine = Matrix(rows.topRows(n) * basis).jacobiSvd().singularValues()(n - 1);
  return std::atan2(sine, cosine);
}

double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

}  // namespace

double thickness(const SimplicialMesh& mesh, std::size_t s) {
  const Matrix edges = edges_of(mesh, s);
  return thickness_of(edges, edge_range(edges).longest);
}

double tangent_angle(const SimplicialMesh& mesh, std::size_t s, const double* frame) {
  return angle_of(edges_of(mesh, s), frame);
}

ComplexQuality complex_quality(const SimplicialMesh& mesh, const Submanifold& manifold, std::size_t max_feet) {
  const int d = mesh.ambient_dim, n = mesh.dim;
  if (manifold.ambient_dim() != d || manifold.intrinsic_dim() != n)
    throw InvalidInput("complex_quality: the mesh and the manifold have different dimensions");
  if (max_feet < 1) throw InvalidInput("complex_quality: max_feet must be at least 1");
  ComplexQuality quality;
  std::vector<double> thicknesses, angles, distances, x(d), point(d), frame(static_cast<std::size_t>(d) * d);
  std::vector<char> used(mesh.num_points(), 0);
  const auto step = [&](std::size_t count) { return count <= max_feet ? 1 : (count - 1) / max_feet + 1; };
  const std::size_t simplex_step = step(mesh.num_simplices()), vertex_step = step(mesh.num_points());
  EdgeRange range;
  FootErrors errors;
  for (std::size_t s = 0; s < mesh.num_simplices(); ++s) {
    const Matrix edges = edges_of(mesh, s);
    const EdgeRange own = edge_range(edges);
    range.shortest = std::min(range.shortest, own.shortest);
    range.longest = std::max(range.longest, own.longest);
    thicknesses.push_back(thickness_of(edges, own.longest));
    std::fill(x.begin(), x.end(), 0.0);
    for (int q = 0; q <= n; ++q) {
      const std::uint32_t v = mesh.simplices[s * (n + 1) + q];
      used[v] = 1;
      for (int c = 0; c < d; ++c) x[c] += mesh.points[std::size_t{v} * d + c] / (n + 1);
    }
    if (s % simplex_step != 0) continue;
    ++quality.feet;
    if (manifold.project(x, point, frame, errors))
      angles.push_back(angle_of(edges, frame.data()));
    else
      ++quality.feet_missing;
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v] || v % vertex_step != 0) continue;
    ++quality.feet;
    const std::span<const double> at(&mesh.points[v * d], std::size_t(d));
    if (!manifold.project(at, point, frame, errors)) {
      ++quality.feet_missing;
      continue;
    }
    double squares = 0;
    for (int c = 0; c < d; ++c) squares += (at[c] - point[c]) * (at[c] - point[c]);
    distances.push_back(std::sqrt(squares));
  }
  if (!thicknesses.empty()) {
    quality.thickness_min = *std::min_element(thicknesses.begin(), thicknesses.end());
    quality.shortest_edge = range.shortest;
    quality.longest_edge = range.longest;
  }
  quality.thickness_median = median(thicknesses);
  quality.angle_max = largest(angles);
  quality.angle_median = median(angles);
  quality.vertex_distance_max = largest(distances);
  quality.vertex_distance_median = median(distances);
  return quality;
}

}  // namespace whitney
