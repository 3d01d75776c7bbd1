// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/orientation.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include <coxeter/base/disjoint_sets.h>
#include <coxeter/base/error.h>
#include <whitney/topology/face_lattice.h>

namespace whitney {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

bool all(const std::vector<bool>& flags) { return std::find(flags.begin(), flags.end(), false) == flags.end(); }

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

  // Every cell twice, as it is (2 i) and turned over (2 i + 1): what two neighbours demand of each other unites two
  // pairs of them. A class then is a component with the signs relative to its first cell, and a component that demands
  // both signs of a cell is one class, not two. The representative is the least of a class.
  if (facets.size() > kNone / 2) throw InvalidInput("facets: more than 2^31 cells");
  DisjointSets classes(2 * facets.size());
  for (const auto& [first, second, count] : sides) {
    if (count != 2) continue;
    const std::uint32_t turn = first.sign == second.sign ? 1 : 0;
    classes.unite(2 * first.cell, 2 * second.cell + turn);
    classes.unite(2 * first.cell + 1, 2 * second.cell + 1 - turn);
  }
  CellOrientation result;
  result.component.resize(facets.size());
  result.sign.resize(facets.size());
  for (std::uint32_t i = 0; i < facets.size(); ++i) {
    const std::uint32_t root = classes.find(2 * i), first_cell = root / 2;
    if (first_cell == i) {
      result.component[i] = static_cast<std::uint32_t>(result.orientable.size());
      result.orientable.push_back(root != classes.find(2 * i + 1));
    } else {
      result.component[i] = result.component[first_cell];
    }
    result.sign[i] = root % 2 == 0 ? 1 : -1;
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
