// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/memory_estimate.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include <coxeter/counts.h>

namespace whitney {
namespace {

// Rough sizes with room above. Seen with spheres in R^3, R^4 and R^5 and limits of 300 MB and 1.5 GB: a run that its
// memory limit stops has a peak of a quarter (n = 4) to three quarters (n = 2) of the limit.
constexpr double kBytesPerCell = 36;        ///< of a cell complex, and 2 d more
constexpr double kBytesPerIncidence = 36;   ///< likewise, with what is held while it is built
constexpr double kBytesPerMeshPoint = 18;   ///< and 8 d more
constexpr double kBytesPerMeshCorner = 15;  ///< with orientation
constexpr double kBytesPerFaceCorner = 40;  ///< of a face lattice
constexpr double kHomologyPerIncidence = 30;
constexpr double kLinksPerCorner = 60;

double binomial(int n, int k) {
  double value = 1;
  for (int i = 0; i < k; ++i) value = value * (n - i) / (i + 1);
  return value;
}

/// How many k-simplices of an m-simplex are met when it is met.
double vertices_of_cell(int m, int k) {
  double missed = 0;
  for (int i = 0; i < k; ++i) missed += binomial(m, i);
  return binomial(m + 1, k + 1) * std::exp2(-k) / (1 - missed * std::exp2(-m));
}

std::uint64_t to_bytes(double bytes) { return bytes < 0x1p63 ? static_cast<std::uint64_t>(bytes) : ~std::uint64_t{0}; }

double mesh_bytes(int d, int n, double points, double simplices) {
  return points * (kBytesPerMeshPoint + 8 * d) + simplices * (n + 1) * kBytesPerMeshCorner;
}

}  // namespace

double cells_per_simplex(int d, int k, int j) {
  const int m = k + j;
  const double cofaces =
      coxeter::num_simplices_per_base(d, m) / coxeter::num_simplices_per_base(d, k) * binomial(m + 1, k + 1);
  return j == 0 ? 1 : cofaces / vertices_of_cell(m, k);
}

double work_bytes_per_simplex(int d, int k, MeshKind kind) {
  const int n = d - k;
  double bytes = 8.0 * d, cells = 0, flags = 1;
  for (int j = 0; j <= n; ++j) {
    const double number = cells_per_simplex(d, k, j);
    cells += number;
    // A cell of dimension j with V vertices, each in j of its facets: a facet has about as many of them as in a simplex
    // of the triangulation one dimension down.
    const double facets = j == 0 ? 0 : k + j + 1;
    bytes += number * (kBytesPerCell + 2 * d + facets * kBytesPerIncidence);
    if (j > 0) flags *= j;
  }
  // Of a simple polytope, n! flags go through every vertex.
  const double vertices = cells_per_simplex(d, k, n) * vertices_of_cell(d, k);
  const double simplices = kind == MeshKind::kBarycentric ? flags * vertices : std::max(1.0, flags / 2) * vertices;
  return bytes + mesh_bytes(d, n, kind == MeshKind::kBarycentric ? cells : 1, simplices);
}

double work_bytes_per_top_simplex(int d, int k, MeshKind kind) {
  return work_bytes_per_simplex(d, k, kind) / cells_per_simplex(d, k, d - k);
}

std::uint64_t mesh_bytes(const CellComplex& complex, MeshKind kind) {
  // Simplices of every cell: all flags; or at most the pulled simplices of all facets but the j that contain the first
  // vertex of a simple j-cell.
  const bool all = kind == MeshKind::kBarycentric;
  const int n = complex.intrinsic_dim;
  std::vector<double> below(complex.num_cells(0), 1), of_facets;
  double points = static_cast<double>(complex.num_cells(0));
  for (int j = 1; j <= n; ++j) {
    std::vector<double> here(complex.num_cells(j), 0);
    if (all) points += static_cast<double>(here.size());
    for (std::size_t i = 0; i < here.size(); ++i) {
      of_facets.clear();
      for (const std::uint32_t f : complex.facets[j][i]) of_facets.push_back(below[f]);
      std::sort(of_facets.begin(), of_facets.end(), std::greater<>());
      const std::size_t left = all || of_facets.size() <= static_cast<std::size_t>(j) ? 0 : static_cast<std::size_t>(j);
      for (std::size_t f = 0; f + left < of_facets.size(); ++f) here[i] += of_facets[f];
    }
    below = std::move(here);
  }
  double simplices = 0;
  for (const double number : below) simplices += number;
  return to_bytes(mesh_bytes(complex.ambient_dim, n, points, simplices));
}

std::uint64_t face_bytes(const SimplicialMesh& mesh) {
  // A j-face lies in n - j + 1 simplices at least.
  const int n = mesh.dim;
  const auto simplices = static_cast<double>(mesh.num_simplices());
  double corners = static_cast<double>(mesh.num_points());
  for (int j = 1; j <= n; ++j) corners += simplices * binomial(n + 1, j + 1) / (j == n ? 1 : n - j + 1) * (j + 1);
  return to_bytes(corners * kBytesPerFaceCorner);
}

std::uint64_t homology_bytes(const std::vector<std::size_t>& f_vector) {
  double incidences = 0;
  for (std::size_t j = 0; j < f_vector.size(); ++j)
    incidences += static_cast<double>(f_vector[j]) * static_cast<double>(j + 1);
  return to_bytes(incidences * kHomologyPerIncidence);
}

std::uint64_t link_bytes(const std::vector<std::size_t>& f_vector) {
  double corners = 0;
  for (std::size_t j = 0; j < f_vector.size(); ++j)
    corners += static_cast<double>(f_vector[j]) * static_cast<double>(j + 1);
  return to_bytes(corners * kLinksPerCorner);
}

}  // namespace whitney
