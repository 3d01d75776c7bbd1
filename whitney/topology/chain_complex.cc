// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/chain_complex.h>

#include <limits>
#include <string>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

[[noreturn]] void reject(std::size_t dim, std::size_t cell, const std::string& reason) {
  throw InvalidInput("facets: " + std::to_string(dim) + "-cell " + std::to_string(cell) + " " + reason);
}

}  // namespace

void require_well_formed(std::span<const Incidence> facets) {
  for (std::size_t j = 0; j < facets.size(); ++j) {
    const Incidence& lists = facets[j];
    if (lists.offset.empty() || lists.offset.front() != 0 || lists.offset.back() != lists.index.size()) {
      throw InvalidInput("facets: the offsets of dimension " + std::to_string(j) + " do not span its indices");
    }
    for (std::size_t i = 0; i < lists.size(); ++i) {
      if (lists.offset[i] > lists.offset[i + 1]) {
        throw InvalidInput("facets: the offsets of dimension " + std::to_string(j) + " decrease");
      }
    }
    if (j == 0) {
      if (!lists.index.empty()) throw InvalidInput("facets: a 0-cell has facets");
      continue;
    }
    std::vector<std::uint32_t> last_cell(facets[j - 1].size(), kNone);
    for (std::size_t i = 0; i < lists.size(); ++i) {
      for (std::uint32_t f : lists[i]) {
        if (f >= last_cell.size()) reject(j, i, "has facet " + std::to_string(f) + ", which does not exist");
        if (last_cell[f] == i) reject(j, i, "has facet " + std::to_string(f) + " twice");
        last_cell[f] = i;
      }
    }
  }
}

IncidenceSigns simplicial_signs(std::span<const Incidence> facets) {
  IncidenceSigns signs(facets.size());
  for (std::size_t j = 1; j < facets.size(); ++j) {
    signs[j].resize(facets[j].index.size());
    for (std::size_t e = 0; e < signs[j].size(); ++e) signs[j][e] = e % (j + 1) % 2 == 0 ? 1 : -1;
  }
  return signs;
}

IncidenceSigns regular_cell_signs(std::span<const Incidence> facets) {
  require_well_formed(facets);
  IncidenceSigns signs(facets.size());
  for (std::size_t j = 1; j < facets.size(); ++j) signs[j].assign(facets[j].index.size(), 0);
  if (facets.size() > 1) {
    for (std::size_t i = 0; i < facets[1].size(); ++i) {
      if (facets[1][i].size() != 2) reject(1, i, "must have two vertices");
      signs[1][2 * i] = -1;
      signs[1][2 * i + 1] = 1;
    }
  }
  std::vector<std::uint32_t> stack;
  for (std::size_t j = 2; j < facets.size(); ++j) {
    // For the ridges of the current cell: how many of its facets contain the ridge, and the xor of their positions,
    // which gives from one of two the other.
    std::vector<std::uint32_t> times(facets[j - 2].size(), 0);
    std::vector<std::uint32_t> other(facets[j - 2].size(), 0);
    std::vector<std::uint32_t> vertex_seen(j == 3 ? facets[0].size() : 0, kNone);
    const Incidence& ridges = facets[j - 1];
    for (std::size_t i = 0; i < facets[j].size(); ++i) {
      const auto cell = facets[j][i];
      if (cell.empty()) reject(j, i, "has no facets");
      std::size_t num_ridges = 0;
      for (std::uint32_t p = 0; p < cell.size(); ++p) {
        for (std::uint32_t r : ridges[cell[p]]) {
          num_ridges += times[r] == 0;
          ++times[r];
          other[r] ^= p;
        }
      }
      if (j == 3) {
        // A connected orientable surface, perhaps pinched, of Euler characteristic 2 is a sphere.
        std::ptrdiff_t num_vertices = 0;
        for (std::uint32_t f : cell) {
          for (std::uint32_t r : ridges[f]) {
            for (std::uint32_t v : facets[1][r]) {
              num_vertices += vertex_seen[v] != i;
              vertex_seen[v] = i;
            }
          }
        }
        const std::ptrdiff_t chi = num_vertices + std::ptrdiff_t(cell.size()) - std::ptrdiff_t(num_ridges);
        if (chi != 2) reject(j, i, "has a boundary of Euler characteristic " + std::to_string(chi) + ", not a sphere");
      }

      std::int8_t* const sign = signs[j].data() + facets[j].offset[i];
      std::size_t num_signed = 1;
      sign[0] = 1;
      stack.assign(1, 0);
      while (!stack.empty()) {
        const std::uint32_t p = stack.back();
        stack.pop_back();
        const std::uint32_t begin = ridges.offset[cell[p]];
        for (std::uint32_t e = begin; e < ridges.offset[cell[p] + 1]; ++e) {
          const std::uint32_t r = ridges.index[e];
          if (times[r] != 2) {
            reject(j, i,
                   "has " + std::to_string(times[r]) + " facets around its ridge " + std::to_string(r) + ", not 2");
          }
          const std::uint32_t q = other[r] ^ p;
          std::uint32_t back = ridges.offset[cell[q]];
          while (ridges.index[back] != r) ++back;
          const std::int8_t wanted = -sign[p] * signs[j - 1][e] * signs[j - 1][back];
          if (sign[q] == 0) {
            sign[q] = wanted;
            ++num_signed;
            stack.push_back(q);
          } else if (sign[q] != wanted) {
            reject(j, i, "has a boundary that is not orientable");
          }
        }
      }
      if (num_signed != cell.size()) reject(j, i, "has a boundary that is not connected");
      for (std::uint32_t f : cell) {
        for (std::uint32_t r : ridges[f]) times[r] = other[r] = 0;
      }
    }
  }
  return signs;
}

bool boundary_squared_is_zero(std::span<const Incidence> facets, const IncidenceSigns& signs) {
  for (std::size_t j = 2; j < facets.size(); ++j) {
    std::vector<int> sum(facets[j - 2].size(), 0);
    const Incidence& ridges = facets[j - 1];
    for (std::size_t i = 0; i < facets[j].size(); ++i) {
      bool zero = true;
      for (std::uint32_t e = facets[j].offset[i]; e < facets[j].offset[i + 1]; ++e) {
        const std::uint32_t f = facets[j].index[e];
        for (std::uint32_t r = ridges.offset[f]; r < ridges.offset[f + 1]; ++r) {
          sum[ridges.index[r]] += signs[j][e] * signs[j - 1][r];
        }
      }
      for (std::uint32_t f : facets[j][i]) {
        for (std::uint32_t r : ridges[f]) {
          zero = zero && sum[r] == 0;
          sum[r] = 0;
        }
      }
      if (!zero) return false;
    }
  }
  return true;
}

}  // namespace whitney
