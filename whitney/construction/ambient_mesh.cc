// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/ambient_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmpxx.h>

#include <coxeter/base/error.h>
#include <whitney/construction/split_faces.h>

namespace whitney {
namespace {

constexpr int kMaxDim = SplitFaces::kMaxDim;

/// Determinant of the rows given, by expansion along the first one; columns: the bit set of those left.
template <class Number>
Number determinant(const Number* rows, int d, int row, unsigned columns) {
  if (row == d) return Number(1);
  Number sum(0);
  bool negative = false;
  for (int c = 0; c < d; ++c) {
    if (!(columns >> c & 1)) continue;
    const Number term(rows[row * d + c] * determinant(rows, d, row + 1, columns & ~(1u << c)));
    sum = negative ? Number(sum - term) : Number(sum + term);
    negative = !negative;
  }
  return sum;
}

bool is_positive(const SimplicialMesh& mesh, const std::uint32_t* simplex) {
  const int d = mesh.ambient_dim;
  std::array<double, kMaxDim * kMaxDim> rows;
  const double* origin = &mesh.points[std::size_t{simplex[0]} * d];
  double bound = 32 * std::numeric_limits<double>::epsilon();  // generous, times a bound of the permanent
  for (int r = 0; r < d; ++r) {
    double sum = 0;
    for (int c = 0; c < d; ++c) {
      rows[r * d + c] = mesh.points[std::size_t{simplex[r + 1]} * d + c] - origin[c];
      sum += std::abs(rows[r * d + c]);
    }
    bound *= sum;
  }
  const double value = determinant(rows.data(), d, 0, (1u << d) - 1);
  if (std::abs(value) > bound && bound > std::numeric_limits<double>::min()) return value > 0;
  std::vector<mpq_class> exact(static_cast<std::size_t>(d) * d);
  for (int r = 0; r < d; ++r)
    for (int c = 0; c < d; ++c)
      exact[r * d + c] = mpq_class(mesh.points[std::size_t{simplex[r + 1]} * d + c]) - mpq_class(origin[c]);
  return sgn(determinant(exact.data(), d, 0, (1u << d) - 1)) > 0;
}

}  // namespace

AmbientMesh ambient_mesh(const CellComplex& complex, const coxeter::Triangulation& triangulation,
                         const perturbation::DisplacementMap& displacements) {
  SplitFaces faces(complex, triangulation, displacements);
  const int n = complex.intrinsic_dim;
  for (std::size_t i = 0; i < complex.num_cells(n); ++i) faces.subdivide(complex.simplex(n, i).vertices(), 0);
  AmbientMesh result;
  result.num_complex_points = faces.num_complex_points();
  result.mesh = faces.take_mesh();
  result.not_positive = count_not_positive(result.mesh);
  return result;
}

bool is_subcomplex(const SimplicialMesh& part, const SimplicialMesh& whole) {
  if (part.ambient_dim != whole.ambient_dim || part.points.size() > whole.points.size() || part.dim > whole.dim ||
      !std::equal(part.points.begin(), part.points.end(), whole.points.begin()))
    return false;
  // The simplices of `part`, ticked off as faces of `whole` with points of `part` only.
  const int size = part.dim + 1, size_whole = whole.dim + 1;
  using Face = std::vector<std::uint32_t>;
  std::vector<Face> wanted;
  for (std::size_t s = 0; s < part.num_simplices(); ++s) {
    wanted.emplace_back(&part.simplices[s * size], &part.simplices[s * size] + size);
    std::sort(wanted.back().begin(), wanted.back().end());
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  std::vector<char> found(wanted.size(), 0);
  Face own, face(size);
  std::vector<char> chosen;
  for (std::size_t s = 0; s < whole.num_simplices(); ++s) {
    own.clear();
    for (int q = 0; q < size_whole; ++q)
      if (const std::uint32_t v = whole.simplices[s * size_whole + q]; v < part.num_points()) own.push_back(v);
    if (static_cast<int>(own.size()) < size) continue;
    std::sort(own.begin(), own.end());
    chosen.assign(own.size(), 0);
    std::fill(chosen.begin(), chosen.begin() + size, 1);
    do {
      face.clear();
      for (std::size_t q = 0; q < own.size(); ++q)
        if (chosen[q]) face.push_back(own[q]);
      const auto at = std::lower_bound(wanted.begin(), wanted.end(), face);
      if (at != wanted.end() && *at == face) found[static_cast<std::size_t>(at - wanted.begin())] = 1;
    } while (std::prev_permutation(chosen.begin(), chosen.end()));
  }
  return std::find(found.begin(), found.end(), 0) == found.end();
}

std::size_t count_not_positive(const SimplicialMesh& mesh) {
  const int d = mesh.ambient_dim;
  if (d < 1 || d > kMaxDim || mesh.dim != d)
    throw InvalidInput("count_not_positive: wants d-simplices in R^d, 1 <= d <= 4");
  std::size_t count = 0;
  for (std::size_t s = 0; s < mesh.num_simplices(); ++s) count += !is_positive(mesh, &mesh.simplices[s * (d + 1)]);
  return count;
}

}  // namespace whitney
