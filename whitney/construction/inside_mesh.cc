// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/inside_mesh.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <coxeter/base/error.h>
#include <whitney/construction/split_faces.h>

namespace whitney {
namespace {

using coxeter::LatticeVertex;

/// The lattice vertices of a box, and on which side of K each is.
class Sides {
 public:
  Sides(const CellComplex& complex, const SplitFaces& faces) : d_(complex.ambient_dim), faces_(faces) {
    const int n = complex.intrinsic_dim;
    std::vector<LatticeVertex> near;
    for (std::size_t i = 0; i < complex.num_cells(n); ++i)
      for (LatticeVertex& v : complex.simplex(n, i).vertices()) near.push_back(std::move(v));
    // One more layer all round: it lies outside.
    std::uint64_t total = 1;
    for (int c = 0; c < d_; ++c) {
      std::int64_t low = std::numeric_limits<std::int32_t>::max(), high = std::numeric_limits<std::int32_t>::min();
      for (const LatticeVertex& v : near) {
        low = std::min<std::int64_t>(low, v[c]);
        high = std::max<std::int64_t>(high, v[c]);
      }
      low_[c] = low - 1;
      size_[c] = near.empty() ? 1 : high - low + 3;
      stride_[c] = total;
      total *= static_cast<std::uint64_t>(size_[c]);
      if (total > std::uint64_t{1} << 31) throw InvalidInput("inside_mesh: the box around the complex is too large");
    }
    side_.assign(total, kUnknown);
    for (const LatticeVertex& v : near) side_[index(v)] = kUnknownNear;
    flood();
  }

  bool is_inside(const LatticeVertex& v) const { return side_[index(v)] == kInside; }
  /// Calls visit(v) for every vertex inside, in lexicographic order from the last coordinate on.
  template <class Visit>
  void for_each_inside(Visit visit) const {
    for (std::size_t i = 0; i < side_.size(); ++i)
      if (side_[i] == kInside) visit(vertex(i));
  }

 private:
  enum Side : std::uint8_t { kUnknown, kUnknownNear, kOutside, kInside };

  bool in_box(const LatticeVertex& v) const {
    for (int c = 0; c < d_; ++c)
      if (v[c] < low_[c] || v[c] >= low_[c] + size_[c]) return false;
    return true;
  }
  std::size_t index(const LatticeVertex& v) const {
    std::size_t i = 0;
    for (int c = 0; c < d_; ++c) i += static_cast<std::size_t>(v[c] - low_[c]) * stride_[c];
    return i;
  }
  LatticeVertex vertex(std::size_t i) const {
    LatticeVertex v(d_);
    for (int c = 0; c < d_; ++c)
      v[c] = static_cast<std::int32_t>(low_[c] + static_cast<std::int64_t>(i / stride_[c]) % size_[c]);
    return v;
  }

  void flood() {
    // An edge changes sides when K crosses it, and only vertices of cut simplices have such edges.
    std::vector<char> is_near(side_.size());
    for (std::size_t i = 0; i < side_.size(); ++i) is_near[i] = side_[i] == kUnknownNear;
    std::vector<std::size_t> open{0};
    side_[0] = kOutside;
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      const LatticeVertex v = vertex(i);
      for (int direction = -1; direction <= 1; direction += 2)
        for (unsigned axes = 1; axes < 1u << d_; ++axes) {
          LatticeVertex w = v;
          for (int c = 0; c < d_; ++c)
            if (axes >> c & 1) w[c] += direction;
          if (!in_box(w)) continue;
          const std::size_t j = index(w);
          const bool crossed = is_near[i] && is_near[j] && faces_.is_crossed(v, w);
          const Side side = (side_[i] == kInside) != crossed ? kInside : kOutside;
          if (side_[j] == kUnknown || side_[j] == kUnknownNear) {
            side_[j] = side;
            open.push_back(j);
          } else if (side_[j] != side) {
            throw InvalidInput("inside_mesh: the complex is not closed, so it has no inside");
          }
        }
    }
  }

  int d_;
  const SplitFaces& faces_;
  std::array<std::int64_t, SplitFaces::kMaxDim> low_{}, size_{};
  std::array<std::uint64_t, SplitFaces::kMaxDim> stride_{};
  std::vector<Side> side_;
};

}  // namespace

AmbientMesh inside_mesh(const CellComplex& complex, const coxeter::Triangulation& triangulation,
                        const perturbation::DisplacementMap& displacements) {
  const int d = complex.ambient_dim, n = complex.intrinsic_dim;
  if (n != d - 1) throw InvalidInput("inside_mesh: only a hypersurface (n = d - 1) has an inside");
  SplitFaces faces(complex, triangulation, displacements);
  const Sides sides(complex, faces);
  for (std::size_t i = 0; i < complex.num_cells(n); ++i) {
    const std::vector<LatticeVertex> vertices = complex.simplex(n, i).vertices();
    std::uint32_t outside = 0;
    for (int q = 0; q <= d; ++q)
      if (!sides.is_inside(vertices[q])) outside |= 1u << q;
    faces.subdivide(vertices, outside);
  }
  // K crosses no simplex whose vertices are all inside.
  std::vector<LatticeVertex> vertices(d + 1);
  std::array<int, SplitFaces::kMaxDim> axis;
  sides.for_each_inside([&](const LatticeVertex& base) {
    std::iota(axis.begin(), axis.begin() + d, 0);
    do {
      vertices[0] = base;
      bool all = true;
      for (int q = 0; q < d && all; ++q) {
        vertices[q + 1] = vertices[q];
        ++vertices[q + 1][axis[q]];
        all = sides.is_inside(vertices[q + 1]);
      }
      if (all) faces.subdivide(vertices, 0);
    } while (std::next_permutation(axis.begin(), axis.begin() + d));
  });
  AmbientMesh result;
  result.num_complex_points = faces.num_complex_points();
  result.mesh = faces.take_mesh();
  result.not_positive = count_not_positive(result.mesh);
  return result;
}

}  // namespace whitney
