// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/orientation.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include <coxeter/base/error.h>
#include <whitney/topology/face_lattice.h>

namespace whitney {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

bool all(const std::vector<bool>& flags) { return std::find(flags.begin(), flags.end(), false) == flags.end(); }

/// Union-find in which every element knows its sign relative to the representative of its class.
class SignedUnionFind {
 public:
  explicit SignedUnionFind(std::size_t count) : parent_(count), sign_(count, 1) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  std::pair<std::uint32_t, std::int8_t> find(std::uint32_t x) {
    std::int8_t sign = 1;
    while (parent_[x] != x) {
      const std::uint32_t up = parent_[x];
      sign_[x] *= sign_[up];  // the representative has sign +1
      parent_[x] = parent_[up];
      sign *= sign_[x];
      x = parent_[x];
    }
    return {x, sign};
  }

  /// Demands sign(a) = relation * sign(b). Returns whether that is consistent with the demands before it.
  bool unite(std::uint32_t a, std::uint32_t b, std::int8_t relation) {
    const auto [root_a, sign_a] = find(a);
    const auto [root_b, sign_b] = find(b);
    if (root_a == root_b) return sign_a == relation * sign_b;
    const std::uint32_t low = std::min(root_a, root_b);
    const std::uint32_t high = std::max(root_a, root_b);
    parent_[high] = low;
    sign_[high] = relation * sign_a * sign_b;
    return true;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::int8_t> sign_;
};

}  // namespace

bool CellOrientation::all_orientable() const { return all(orientable); }
bool OrientedMesh::all_orientable() const { return all(orientable); }

CellOrientation orient_cells(const Incidence& facets, std::span<const std::int8_t> signs, std::size_t num_facets) {
  if (signs.size() != facets.index.size()) throw InvalidInput("signs: one sign per facet is needed");
  struct Side {
    std::uint32_t cell = kNone;
    std::int8_t sign = 0;
  };
  struct Sides {
    Side first, second;
    std::uint8_t count = 0;  // 3 stands for more than two
  };
  std::vector<Sides> sides(num_facets);
  for (std::size_t i = 0; i < facets.size(); ++i) {
    for (std::uint32_t e = facets.offset[i]; e < facets.offset[i + 1]; ++e) {
      const std::uint32_t f = facets.index[e];
      if (f >= num_facets) throw InvalidInput("facets: facet " + std::to_string(f) + " does not exist");
      const Side side{static_cast<std::uint32_t>(i), signs[e]};
      if (sides[f].count == 0) sides[f].first = side;
      if (sides[f].count == 1) sides[f].second = side;
      if (sides[f].count < 3) ++sides[f].count;
    }
  }

  SignedUnionFind classes(facets.size());
  std::vector<std::uint32_t> contradictions;
  for (const auto& [first, second, count] : sides) {
    if (count == 2 && !classes.unite(first.cell, second.cell, -first.sign * second.sign)) {
      contradictions.push_back(first.cell);
    }
  }
  CellOrientation result;
  result.component.resize(facets.size());
  result.sign.resize(facets.size());
  std::uint32_t num_components = 0;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    // The representative is the least cell of its class, so it has been met.
    const auto [root, sign] = classes.find(i);
    result.component[i] = root == i ? num_components++ : result.component[root];
    result.sign[i] = sign;
  }
  result.orientable.assign(num_components, true);
  for (std::uint32_t cell : contradictions) result.orientable[result.component[cell]] = false;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (!result.orientable[result.component[i]]) result.sign[i] = 1;
  }
  return result;
}

std::vector<std::int8_t> sorting_signs(std::span<const std::uint32_t> simplices, int length) {
  std::vector<std::int8_t> signs(simplices.size() / length, 1);
  for (std::size_t i = 0; i < signs.size(); ++i) {
    const auto simplex = simplices.subspan(i * length, length);
    for (int a = 0; a < length; ++a) {
      for (int b = a + 1; b < length; ++b) {
        if (simplex[a] > simplex[b]) signs[i] = -signs[i];
      }
    }
  }
  return signs;
}

OrientedMesh orient(SimplicialMesh mesh) {
  OrientedMesh result;
  const int n = mesh.dim;
  const FaceLattice lattice = face_lattice(mesh, n - 1);
  const std::vector<std::int8_t> sorting = sorting_signs(mesh.simplices, n + 1);
  std::vector<std::int8_t> signs(lattice.facets[n].index.size());
  for (std::size_t e = 0; e < signs.size(); ++e) {
    signs[e] = (e % (n + 1) % 2 == 0 ? 1 : -1) * sorting[e / (n + 1)];
  }
  CellOrientation cells = orient_cells(lattice.facets[n], signs, n > 0 ? lattice.num_faces(n - 1) : 0);
  result.mesh = std::move(mesh);
  for (std::size_t i = 0; i < cells.sign.size(); ++i) {
    std::uint32_t* const last = result.mesh.simplices.data() + (i + 1) * (n + 1) - 1;
    if (cells.sign[i] < 0) std::swap(last[-1], last[0]);
  }
  result.component = std::move(cells.component);
  result.orientable = std::move(cells.orientable);
  return result;
}

}  // namespace whitney
