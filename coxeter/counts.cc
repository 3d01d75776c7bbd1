// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/counts.h>

#include <algorithm>
#include <vector>

namespace whitney::coxeter {
namespace {

/// Entry j - 1 is j! S(elements, j), j = 1 .. elements.
std::vector<double> ordered_partitions(int elements) {
  std::vector<double> a(static_cast<std::size_t>(elements), 0.0);
  a[0] = 1;
  // From S(n, j) = j S(n-1, j) + S(n-1, j-1).
  for (std::size_t n = 2; n <= a.size(); ++n)
    for (std::size_t j = n; j >= 2; --j) a[j - 1] = double(j) * (a[j - 1] + a[j - 2]);
  return a;
}

}  // namespace

double num_ordered_partitions(int elements, int parts) {
  if (elements == 0 && parts == 0) return 1;
  if (parts < 1 || parts > elements) return 0;
  return ordered_partitions(elements)[static_cast<std::size_t>(parts) - 1];
}

double num_faces(int simplex_dim, int face_dim) {
  if (face_dim < 0 || face_dim > simplex_dim) return 0;
  // Pascal's triangle: sums only, so exact as long as the result is.
  std::vector<double> row(static_cast<std::size_t>(face_dim) + 2, 0.0);
  row[0] = 1;
  for (int n = 1; n <= simplex_dim + 1; ++n)
    for (std::size_t j = row.size() - 1; j >= 1; --j) row[j] += row[j - 1];
  return row.back();
}

double num_cofaces(const Simplex& simplex, int coface_dim) {
  const int extra = coface_dim - simplex.dim();
  if (extra < 0 || coface_dim > simplex.ambient_dim()) return 0;
  // Product of the generating functions of the parts, by the number of cuts, up to x^extra.
  std::vector<double> product{1};
  for (int q = 0; q <= simplex.dim(); ++q) {
    const std::vector<double> part = ordered_partitions(static_cast<int>(simplex.partition().part(q).size()));
    if (part.size() == 1) continue;
    std::vector<double> next(std::min(product.size() + part.size() - 1, static_cast<std::size_t>(extra) + 1), 0.0);
    for (std::size_t i = 0; i < product.size(); ++i)
      for (std::size_t j = 0; j < part.size() && i + j < next.size(); ++j) next[i + j] += product[i] * part[j];
    product = std::move(next);
  }
  return product[static_cast<std::size_t>(extra)];
}

double num_simplices_per_base(int ambient_dim, int dim) {
  return num_ordered_partitions(ambient_dim + 1, dim + 1) / (dim + 1);
}

double num_simplices_in_star(int ambient_dim, int dim) { return num_ordered_partitions(ambient_dim + 1, dim + 1); }

}  // namespace whitney::coxeter
