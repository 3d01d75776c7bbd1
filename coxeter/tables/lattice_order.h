// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

namespace whitney::coxeter {

/// The order in which the rows of `coordinates` (num x dim) are lexicographically increasing, by radix sort: entry i is
/// the row that comes i-th.
std::vector<std::uint32_t> lexicographic_order(std::span<const std::int32_t> coordinates, int dim);

inline constexpr std::uint32_t kAheadOfSort = 16;  // keys on their way to the cache

/// The canonical order of `count` simplices: by the index base(i) < num_vertices of the base vertex, then by the `dim`
/// part numbers parts(i). Entry i is the simplex that comes i-th.
template <class Base, class Parts>
std::vector<std::uint32_t> canonical_order(std::size_t num_vertices, std::uint32_t count, int dim, Base&& base,
                                           Parts&& parts) {
  std::vector<std::uint32_t> begin(num_vertices + 1, 0), order(count);
  for (std::uint32_t i = 0; i < count; ++i) ++begin[base(i) + 1];
  for (std::size_t v = 0; v < num_vertices; ++v) begin[v + 1] += begin[v];
  for (std::uint32_t i = 0; i < count; ++i) order[begin[base(i)]++] = i;
  std::uint32_t first = 0;  // begin[v] is now the end of the simplices based at v
  constexpr int kLongestKey = sizeof(unsigned __int128);
  if (sizeof(*parts(0)) == 1 && dim <= kLongestKey) {
    // Part numbers fit one integer, so each is read once however many comparisons there are.
    std::vector<std::pair<unsigned __int128, std::uint32_t>> keys;
    for (std::size_t v = 0; v < num_vertices; ++v) {
      keys.clear();
      for (std::uint32_t i = first; i < begin[v]; ++i) {
        if (i + kAheadOfSort < count) __builtin_prefetch(parts(order[i + kAheadOfSort]));
        unsigned __int128 key = 0;
        const auto* p = parts(order[i]);
        for (int c = 0; c < dim; ++c) key = key << 8 | p[c];
        keys.push_back({key, order[i]});
      }
      std::sort(keys.begin(), keys.end());
      for (std::uint32_t i = first; i < begin[v]; ++i) order[i] = keys[i - first].second;
      first = begin[v];
    }
    return order;
  }
  for (std::size_t v = 0; v < num_vertices; ++v) {
    std::sort(order.begin() + first, order.begin() + begin[v], [&](std::uint32_t a, std::uint32_t b) {
      const auto *pa = parts(a), *pb = parts(b);
      return std::lexicographical_compare(pa, pa + dim, pb, pb + dim);
    });
    first = begin[v];
  }
  return order;
}

/// Rearranges `rows` (order.size() x width) in place so that row i becomes what row order[i] was: no second copy.
template <class T>
void permute_rows(T* rows, std::size_t width, std::span<const std::uint32_t> order) {
  std::vector<bool> done(order.size(), false);
  std::vector<T> held(width);
  const std::size_t bytes = width * sizeof(T);
  for (std::size_t start = 0; start < order.size(); ++start) {
    if (done[start] || order[start] == start) continue;
    std::memcpy(held.data(), rows + start * width, bytes);
    std::size_t to = start;
    for (;;) {
      done[to] = true;
      const std::size_t from = order[to];
      if (from == start) break;
      std::memcpy(rows + to * width, rows + from * width, bytes);
      to = from;
    }
    std::memcpy(rows + to * width, held.data(), bytes);
  }
}

}  // namespace whitney::coxeter
