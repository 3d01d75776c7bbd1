// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/face_lattice.h>

#include <algorithm>
#include <limits>
#include <string>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Numbers tuples of one length in the order of their first appearance. Open addressing; a slot holds 32 bits of the
/// hash beside the number, so that a tuple in memory is touched only when it is most likely the one sought.
class TupleTable {
 public:
  explicit TupleTable(int length) : length_(length), slots_(64, kEmpty) {}

  std::uint32_t intern(const std::uint32_t* tuple) {
    const std::uint64_t hash = hash_of(tuple);
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t at = hash & mask;; at = (at + 1) & mask) {
      if (slots_[at] == kEmpty) {
        const std::uint32_t number = count_++;
        slots_[at] = (hash & kTagMask) | number;
        tuples_.insert(tuples_.end(), tuple, tuple + length_);
        if (2 * std::size_t{count_} > slots_.size()) grow();
        return number;
      }
      if (((slots_[at] ^ hash) & kTagMask) == 0) {
        const auto number = static_cast<std::uint32_t>(slots_[at]);
        if (std::equal(tuple, tuple + length_, tuples_.data() + std::size_t{number} * length_)) return number;
      }
    }
  }

  std::size_t size() const { return count_; }
  std::vector<std::uint32_t> take_tuples() {
    tuples_.shrink_to_fit();
    return std::move(tuples_);
  }

 private:
  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
  static constexpr std::uint64_t kTagMask = 0xffffffff00000000u;

  std::uint64_t hash_of(const std::uint32_t* tuple) const {
    std::uint64_t hash = 0x243f6a8885a308d3u;
    for (int k = 0; k < length_; ++k) {
      hash = (hash ^ tuple[k]) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }

  void grow() {
    std::vector<std::uint64_t> slots(4 * slots_.size(), kEmpty);
    const std::size_t mask = slots.size() - 1;
    for (std::uint32_t number = 0; number < count_; ++number) {
      const std::uint64_t hash = hash_of(tuples_.data() + std::size_t{number} * length_);
      std::size_t at = hash & mask;
      while (slots[at] != kEmpty) at = (at + 1) & mask;
      slots[at] = (hash & kTagMask) | number;
    }
    slots_ = std::move(slots);
  }

  int length_;
  std::uint32_t count_ = 0;
  std::vector<std::uint32_t> tuples_;
  std::vector<std::uint64_t> slots_;
};

std::vector<std::uint32_t> sorted_simplices(int dim, std::span<const std::uint32_t> simplices,
                                            std::size_t num_vertices) {
  const std::size_t length = dim + 1;
  TupleTable table(dim + 1);
  std::vector<std::uint32_t> tuple(length);
  for (std::size_t i = 0; i < simplices.size() / length; ++i) {
    std::copy_n(simplices.begin() + i * length, length, tuple.begin());
    std::sort(tuple.begin(), tuple.end());
    if (tuple.back() >= num_vertices) {
      throw InvalidInput("simplices: simplex " + std::to_string(i) + " has vertex " + std::to_string(tuple.back()) +
                         ", but there are only " + std::to_string(num_vertices) + " points");
    }
    if (const auto twice = std::adjacent_find(tuple.begin(), tuple.end()); twice != tuple.end()) {
      throw InvalidInput("simplices: simplex " + std::to_string(i) + " has vertex " + std::to_string(*twice) +
                         " twice");
    }
    if (const std::uint32_t number = table.intern(tuple.data()); number != i) {
      throw InvalidInput("simplices: simplices " + std::to_string(number) + " and " + std::to_string(i) +
                         " have the same vertices");
    }
  }
  return table.take_tuples();
}

}  // namespace

FaceLattice face_lattice(int dim, std::span<const std::uint32_t> simplices, std::size_t num_vertices, int min_dim) {
  if (dim < 0) throw InvalidInput("dim: " + std::to_string(dim) + " must not be negative");
  if (simplices.size() % (dim + 1) != 0) {
    throw InvalidInput("simplices: " + std::to_string(simplices.size()) +
                       " indices are not a multiple of dim + 1 = " + std::to_string(dim + 1));
  }
  min_dim = std::clamp(min_dim, 0, dim);

  FaceLattice lattice;
  lattice.vertices.resize(dim + 1);
  lattice.facets.resize(dim + 1);
  lattice.vertices[dim] = sorted_simplices(dim, simplices, num_vertices);
  for (int j = dim; j > min_dim; --j) {
    const std::vector<std::uint32_t>& cells = lattice.vertices[j];
    if (cells.size() > kNone) throw InvalidInput("simplices: more than 2^32 incidences of faces");
    Incidence& facets = lattice.facets[j];
    facets.offset.resize(cells.size() / (j + 1) + 1);
    for (std::size_t i = 0; i < facets.offset.size(); ++i) facets.offset[i] = i * (j + 1);
    facets.index.resize(cells.size());
    if (j == 1) {
      // Vertices need no table: 0-faces are the vertices in use, in increasing order.
      std::vector<std::uint32_t> number(num_vertices, kNone);
      for (std::uint32_t v : cells) number[v] = 0;
      for (std::uint32_t v = 0; v < num_vertices; ++v) {
        if (number[v] == kNone) continue;
        number[v] = lattice.vertices[0].size();
        lattice.vertices[0].push_back(v);
      }
      for (std::size_t e = 0; e < cells.size(); e += 2) {
        facets.index[e] = number[cells[e + 1]];
        facets.index[e + 1] = number[cells[e]];
      }
    } else {
      TupleTable table(j);
      std::vector<std::uint32_t> facet(j);
      for (std::size_t i = 0; i < cells.size(); i += j + 1) {
        for (int k = 0; k <= j; ++k) {
          std::copy_n(cells.begin() + i, k, facet.begin());
          std::copy_n(cells.begin() + i + k + 1, j - k, facet.begin() + k);
          facets.index[i + k] = table.intern(facet.data());
        }
      }
      lattice.vertices[j - 1] = table.take_tuples();
    }
  }
  lattice.facets[min_dim].offset.assign(lattice.vertices[min_dim].size() / (min_dim + 1) + 1, 0);
  return lattice;
}

FaceLattice face_lattice(const SimplicialMesh& mesh, int min_dim) {
  if (mesh.ambient_dim > 0 && mesh.points.size() % mesh.ambient_dim != 0) {
    throw InvalidInput("points: " + std::to_string(mesh.points.size()) +
                       " coordinates are not a multiple of ambient_dim = " + std::to_string(mesh.ambient_dim));
  }
  return face_lattice(mesh.dim, mesh.simplices, mesh.num_points(), min_dim);
}

}  // namespace whitney
