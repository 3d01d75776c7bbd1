// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <whitney/topology/chain_complex.h>
#include <whitney/topology/incidence.h>

namespace whitney {

/// Betti numbers over Z/2 by elimination on the full boundary matrices: slow, but shares nothing with homology().
/// Throws InvalidInput when facets are not well formed.
inline std::vector<std::size_t> betti_z2_by_elimination(std::span<const Incidence> facets) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  require_well_formed(facets);
  std::vector<std::size_t> rank(facets.size() + 1, 0);
  // The facet of a pivot is a cycle already known to bound: its own column needs no reduction (Chen, Kerber 2011).
  std::vector<char> cleared;
  for (std::size_t j = facets.size(); j-- > 1;) {
    std::vector<std::uint32_t> column_of_pivot(facets[j - 1].size(), kNone);
    std::vector<std::vector<std::uint32_t>> columns(facets[j].size());
    std::vector<char> facet_cleared(facets[j - 1].size(), 0);
    std::vector<std::uint32_t> sum;
    for (std::size_t i = 0; i < facets[j].size(); ++i) {
      if (!cleared.empty() && cleared[i]) continue;
      std::vector<std::uint32_t>& column = columns[i];
      column.assign(facets[j][i].begin(), facets[j][i].end());
      std::sort(column.begin(), column.end());
      while (!column.empty() && column_of_pivot[column.back()] != kNone) {
        const std::vector<std::uint32_t>& pivot = columns[column_of_pivot[column.back()]];
        sum.clear();
        std::set_symmetric_difference(column.begin(), column.end(), pivot.begin(), pivot.end(),
                                      std::back_inserter(sum));
        std::swap(column, sum);
      }
      if (column.empty()) continue;
      column_of_pivot[column.back()] = i;
      facet_cleared[column.back()] = 1;
      ++rank[j];
    }
    cleared = std::move(facet_cleared);
  }
  std::vector<std::size_t> betti;
  for (std::size_t j = 0; j < facets.size(); ++j) betti.push_back(facets[j].size() - rank[j] - rank[j + 1]);
  return betti;
}

}  // namespace whitney
