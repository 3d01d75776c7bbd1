// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/split_faces.h>

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

#include <Eigen/LU>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <coxeter/base/hash_slots.h>
#include <whitney/cells/subdivide.h>

namespace whitney {

std::size_t SplitFaces::FaceHash::operator()(const Face& face) const {
  std::uint64_t hash = 0;
  for (const std::uint32_t v : face) hash = coxeter::mix64(hash * 0x9e3779b97f4a7c15ull + v);
  return hash;
}

std::uint64_t SplitFaces::edge_key(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

SplitFaces::SplitFaces(const CellComplex& complex, const coxeter::Triangulation& triangulation,
                       const perturbation::DisplacementMap& displacements)
    : triangulation_(triangulation),
      displacements_(displacements),
      d_(complex.ambient_dim),
      reversed_(as_eigen(triangulation.linear()).determinant() < 0) {
  if (d_ < 2 || d_ > kMaxDim)
    throw InvalidInput("the ambient mesh is made for 2 <= d <= 4, not for d = " + std::to_string(d_));
  if (triangulation.ambient_dim() != d_ || displacements.ambient_dim() != d_)
    throw InvalidInput("the complex, the triangulation and the displacements have different ambient dimensions");
  const int n = complex.intrinsic_dim, k = d_ - n;
  const SimplicialMesh subdivision = barycentric_subdivision(complex);
  num_complex_points_ = subdivision.num_points();
  mesh_ = SimplicialMesh{d_, d_, subdivision.points, {}};
  mesh_.point_data = {{"complex_point", 1, {}}, {"face_dim", 1, {}}};

  std::uint32_t point = 0;
  for (int j = 0; j <= n; ++j)
    for (std::size_t i = 0; i < complex.num_cells(j); ++i, ++point) {
      Face face;
      face.fill(kNone);
      std::size_t at = 0;
      for (const auto& v : complex.simplex(j, i).vertices()) face[at++] = number_of(v);
      std::sort(face.begin(), face.end());
      points_.emplace(face, point);
      mesh_.point_data[0].values.push_back(point);
      mesh_.point_data[1].values.push_back(k + j);
      if (k + j == 1) crossed_edges_.insert(edge_key(face[0], face[1]));
      if (j < n) continue;
      for (int a = 0; a <= d_; ++a)
        for (int b = a + 1; b <= d_; ++b) split_edges_.insert(edge_key(face[a], face[b]));
    }
}

std::uint32_t SplitFaces::number_of(const coxeter::LatticeVertex& vertex) {
  const auto [entry, is_new] = numbers_.try_emplace(vertex, static_cast<std::uint32_t>(numbers_.size()));
  if (is_new) {
    const std::vector<double> x = perturbation::position(triangulation_, displacements_, vertex);
    positions_.insert(positions_.end(), x.begin(), x.end());
  }
  return entry->second;
}

bool SplitFaces::is_crossed(const coxeter::LatticeVertex& a, const coxeter::LatticeVertex& b) const {
  const auto at = numbers_.find(a), bt = numbers_.find(b);
  return at != numbers_.end() && bt != numbers_.end() && crossed_edges_.contains(edge_key(at->second, bt->second));
}

std::uint32_t SplitFaces::add_point(std::span<const double> x, int face_dim) {
  if (mesh_.num_points() >= kNone) throw InvalidInput("the ambient mesh has more than 2^32 - 1 points");
  mesh_.points.insert(mesh_.points.end(), x.begin(), x.end());
  mesh_.point_data[0].values.push_back(-1);
  mesh_.point_data[1].values.push_back(face_dim);
  return static_cast<std::uint32_t>(mesh_.num_points() - 1);
}

std::uint32_t SplitFaces::point_of(const std::uint32_t* numbers, std::uint32_t mask) {
  Face face;
  face.fill(kNone);
  std::size_t size = 0;
  for (int q = 0; q <= d_; ++q)
    if (mask >> q & 1) face[size++] = numbers[q];
  std::sort(face.begin(), face.end());
  const auto known = points_.find(face);
  if (known != points_.end()) return known->second;
  // In the order of the sorted numbers, so that the bytes do not depend on which simplex asks first.
  std::array<double, kMaxDim> x{};
  for (std::size_t i = 0; i < size; ++i)
    for (int c = 0; c < d_; ++c) x[c] += positions_[std::size_t{face[i]} * d_ + c];
  for (int c = 0; c < d_; ++c) x[c] /= double(size);
  const std::uint32_t point = add_point({x.data(), std::size_t(d_)}, static_cast<int>(size) - 1);
  points_.emplace(face, point);
  return point;
}

void SplitFaces::subdivide(std::span<const coxeter::LatticeVertex> vertices, std::uint32_t outside) {
  std::array<std::uint32_t, kMaxDim + 1> numbers;
  for (int q = 0; q <= d_; ++q) numbers[q] = number_of(vertices[q]);
  const std::uint32_t whole = (1u << (d_ + 1)) - 1;
  std::uint32_t split = 0;  // bit m: the face with the vertices in mask m is split
  for (int a = 0; a <= d_; ++a)
    for (int b = a + 1; b <= d_; ++b)
      if (split_edges_.contains(edge_key(numbers[a], numbers[b])))
        for (std::uint32_t mask = 1; mask <= whole; ++mask)
          if (mask >> a & mask >> b & 1) split |= 1u << mask;

  // v_(q+1) - v_q are the unit vectors in some order (for the last ones of the simplex, e_d left out): its sign.
  std::array<int, kMaxDim> axis{};
  for (int q = 0; q < d_; ++q)
    for (int c = 0; c < d_; ++c)
      if (vertices[q + 1][c] != vertices[q][c]) axis[q] = c;
  bool negative = reversed_;
  for (int a = 0; a < d_; ++a)
    for (int b = a + 1; b < d_; ++b) negative ^= axis[a] > axis[b];

  std::array<std::uint32_t, 32> point;
  point.fill(kNone);
  const auto resolve = [&](std::uint32_t mask) {
    if (point[mask] == kNone) point[mask] = point_of(numbers.data(), mask);
    return point[mask];
  };
  std::array<std::uint32_t, kMaxDim + 1> chain;  // the split faces above, largest first
  std::array<int, kMaxDim + 1> removed;
  const auto descend = [&](auto& self, std::uint32_t mask, int depth) -> void {
    if (depth < kMaxDim && (split >> mask & 1)) {
      chain[depth] = mask;
      for (int q = 0; q <= d_; ++q)
        if (mask >> q & 1) {
          removed[depth] = q;
          self(self, mask & ~(1u << q), depth + 1);
        }
      return;
    }
    if (mask & outside) return;
    std::array<int, kMaxDim + 1> order;
    std::array<std::uint32_t, kMaxDim + 1> simplex;
    int size = 0;
    for (int q = 0; q <= d_; ++q)
      if (mask >> q & 1) {
        simplex[size] = resolve(1u << q);
        order[size++] = q;
      }
    for (int level = depth - 1; level >= 0; --level) {
      simplex[size] = resolve(chain[level]);
      order[size++] = removed[level];
    }
    // Each point has a positive coordinate at the vertex of its place in the order, none at later ones.
    bool flip = negative;
    for (int a = 0; a <= d_; ++a)
      for (int b = a + 1; b <= d_; ++b) flip ^= order[a] > order[b];
    if (flip) std::swap(simplex[d_ - 1], simplex[d_]);
    mesh_.simplices.insert(mesh_.simplices.end(), simplex.begin(), simplex.begin() + d_ + 1);
  };
  descend(descend, whole, 0);
}

SimplicialMesh SplitFaces::take_mesh() { return std::move(mesh_); }

}  // namespace whitney
