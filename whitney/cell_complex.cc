// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/cell_complex.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include <coxeter/error.h>
#include <coxeter/simplex_table.h>
#include <coxeter/vertex_table.h>
#include <whitney/lattice_order.h>
#include <whitney/trace.h>

namespace whitney {
namespace {

using coxeter::HashSlots;
using coxeter::SimplexTable;
using coxeter::VertexTable;

Incidence transposed(const Incidence& incidence, std::size_t size) {
  Incidence out;
  out.offset.assign(size + 1, 0);
  out.index.resize(incidence.index.size());
  for (std::uint32_t i : incidence.index) ++out.offset[i + 1];
  for (std::size_t i = 0; i < size; ++i) out.offset[i + 1] += out.offset[i];
  std::vector<std::uint32_t> at(out.offset.begin(), out.offset.end() - 1);
  for (std::uint32_t i = 0; i < incidence.size(); ++i)
    for (std::uint32_t j : incidence[i]) out.index[at[j]++] = i;
  return out;
}

Incidence empty_lists(std::size_t size) {
  Incidence out;
  out.offset.assign(size + 1, 0);
  return out;
}

std::uint64_t hash_key(const std::uint64_t* key, std::size_t words) {
  std::uint64_t hash = 0;
  for (std::size_t i = 0; i < words; ++i) hash = coxeter::mix64(hash + key[i] * 0x9e3779b97f4a7c15ull);
  return hash;
}

/// Simplices of one dimension m, in canonical order: base vertices and part numbers.
template <class Index>
struct Level {
  std::vector<std::uint32_t> base;
  std::vector<Index> parts;
};

/// Finds the (m+1)-simplices around m-simplices.
template <class Index>
class Cofacets {
 public:
  Cofacets(int dim, const VertexTable& vertices) : d_(dim), vertices_(vertices) {}

  /// The cofacets of a level in canonical order, and the incidence: the cofacets of every simplex of the level, by
  /// their new indices. A cofacet whose base vertex is not in the table is skipped: a stopped trace never looked at it.
  std::pair<Level<Index>, Incidence> of(const Level<Index>& level, int num_parts) {
    SimplexTable<Index> table(d_, 0);
    Incidence around;
    around.offset.reserve(level.base.size() + 1);
    std::vector<std::uint64_t> key(table.key_words(), 0);
    Index* out = SimplexTable<Index>::parts_of(key.data());
    std::vector<int> elements(d_ + 1), starts(num_parts + 1), at(num_parts);
    std::vector<std::int32_t> z(d_);
    const std::uint64_t* weights = vertices_.weights();

    for (std::size_t i = 0; i < level.base.size(); ++i) {
      const Index* parts = &level.parts[i * d_];
      std::fill(starts.begin(), starts.end(), 0);
      for (int c = 0; c < d_; ++c) ++starts[parts[c] + 1];
      ++starts[num_parts];
      for (int p = 0; p < num_parts; ++p) starts[p + 1] += starts[p];
      std::copy(starts.begin(), starts.end() - 1, at.begin());
      for (int c = 0; c < d_; ++c) elements[at[parts[c]]++] = c;
      elements[d_] = d_;

      for (int q = 0; q < num_parts; ++q) {
        const int* part = &elements[starts[q]];
        const int size = starts[q + 1] - starts[q];
        if (size < 2) continue;
        const std::uint32_t all = (std::uint32_t{1} << size) - 1;
        const bool last = q == num_parts - 1;
        // Elements of part q get q (first half) or q + 1; in the last part with element d in the first half, the second
        // half becomes part 0 of a new base vertex and everything else moves up.
        for (std::uint32_t split = 1; split < all; ++split) {
          const bool new_base = last && (split >> (size - 1) & 1);
          std::uint32_t base = level.base[i];
          if (new_base) {
            std::copy_n(vertices_.coordinates(base), d_, z.begin());
            std::uint64_t form = vertices_.form(base);
            for (std::uint32_t rest = all & ~split; rest != 0; rest &= rest - 1) {
              const int c = part[std::countr_zero(rest)];
              --z[c];
              form -= weights[c];
            }
            base = vertices_.find(z.data(), form);
            if (base == HashSlots::kNone) continue;
            for (int c = 0; c < d_; ++c) out[c] = static_cast<Index>(parts[c] + 1);
            for (std::uint32_t rest = all & ~split; rest != 0; rest &= rest - 1) out[part[std::countr_zero(rest)]] = 0;
          } else {
            for (int c = 0; c < d_; ++c) out[c] = static_cast<Index>(parts[c] + (parts[c] >= q));
            for (std::uint32_t rest = split; rest != 0; rest &= rest - 1)
              out[part[std::countr_zero(rest)]] = static_cast<Index>(q);
          }
          SimplexTable<Index>::set_base(key.data(), base);
          around.index.push_back(table.intern(key.data(), hash_key(key.data(), key.size())));
        }
      }
      if (around.index.size() >= std::numeric_limits<std::uint32_t>::max())
        throw InvalidInput("cell_complex: more than 2^32 incidences; use a larger edge length");
      around.offset.push_back(static_cast<std::uint32_t>(around.index.size()));
    }
    table.release_index();

    const auto count = static_cast<std::uint32_t>(table.size());
    const std::vector<std::uint32_t> order = canonical_order(
        vertices_.size(), count, d_, [&](std::uint32_t s) { return table.base(s); },
        [&](std::uint32_t s) { return table.parts(s); });
    std::vector<std::uint32_t> rank(count);
    Level<Index> next{std::vector<std::uint32_t>(count), std::vector<Index>(std::size_t{count} * d_)};
    for (std::uint32_t s = 0; s < count; ++s) {
      rank[order[s]] = s;
      next.base[s] = table.base(order[s]);
      std::copy_n(table.parts(order[s]), d_, &next.parts[std::size_t{s} * d_]);
    }
    for (std::uint32_t& s : around.index) s = rank[s];
    return {std::move(next), std::move(around)};
  }

 private:
  int d_;
  const VertexTable& vertices_;
};

/// Keeps the rows of a level and of its facet lists for which keep is set; the new index of each, or kNone.
template <class Index>
std::vector<std::uint32_t> keep_rows(Level<Index>& level, Incidence& facets, int dim, const std::vector<char>& keep) {
  std::vector<std::uint32_t> renamed(keep.size(), HashSlots::kNone);
  Incidence kept;
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    renamed[i] = next;
    level.base[next] = level.base[i];
    std::copy_n(&level.parts[std::size_t{i} * dim], dim, &level.parts[std::size_t{next} * dim]);
    const auto list = facets[i];
    kept.index.insert(kept.index.end(), list.begin(), list.end());
    kept.offset.push_back(static_cast<std::uint32_t>(kept.index.size()));
    ++next;
  }
  level.base.resize(next);
  level.parts.resize(std::size_t{next} * dim);
  facets = std::move(kept);
  return renamed;
}

void rename(Incidence& incidence, const std::vector<std::uint32_t>& renamed) {
  for (std::uint32_t& i : incidence.index) i = renamed[i];
}

/// Whether the facets found of a cell are all it has. An edge has two ends. The boundary of a polytope of dimension 2
/// or more is a sphere, which is connected: if some but not all facets are there, some ridge is in only one of them.
bool is_complete(std::span<const std::uint32_t> cell_facets, int cell_dim, const Incidence& ridges) {
  if (cell_dim == 1) return cell_facets.size() == 2;
  std::vector<std::uint32_t> all;
  for (std::uint32_t f : cell_facets) all.insert(all.end(), ridges[f].begin(), ridges[f].end());
  std::sort(all.begin(), all.end());
  if (all.size() % 2) return false;
  for (std::size_t i = 0; i < all.size(); i += 2)
    if (all[i] != all[i + 1]) return false;
  return true;
}

template <class Index>
CellComplex build(const CrossedSimplices& crossed, std::span<const Index> parts) {
  const int d = crossed.ambient_dim, n = d - crossed.codim;
  const std::size_t num_simplices = crossed.base.size();
  CellComplex complex;
  complex.ambient_dim = d;
  complex.intrinsic_dim = n;
  complex.vertex_coordinates.assign(crossed.vertex_coordinates.begin(), crossed.vertex_coordinates.end());

  VertexTable vertices(d);
  for (std::size_t at = 0; at < crossed.vertex_coordinates.size(); at += d) {
    const std::int32_t* z = crossed.vertex_coordinates.data() + at;
    vertices.intern(z, vertices.form_of(z));
  }

  std::vector<Level<Index>> levels(n + 1);
  levels[0].base.assign(crossed.base.begin(), crossed.base.end());
  levels[0].parts.assign(parts.begin(), parts.end());
  complex.facets.push_back(empty_lists(num_simplices));

  const bool whole = crossed.whole;
  Cofacets<Index> cofacets(d, vertices);
  for (int j = 0; j < n; ++j) {
    auto [next, around] = cofacets.of(levels[j], crossed.codim + j + 1);
    Incidence facets = transposed(around, next.base.size());
    if (!whole) {
      std::vector<char> keep(next.base.size());
      for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = is_complete(facets[i], j + 1, complex.facets[j]);
      complex.num_dropped += std::count(keep.begin(), keep.end(), 0);
      keep_rows(next, facets, d, keep);
    }
    levels[j + 1] = std::move(next);
    complex.facets.push_back(std::move(facets));
  }

  std::vector<std::uint32_t> point_of(num_simplices);
  for (std::uint32_t i = 0; i < point_of.size(); ++i) point_of[i] = i;
  if (!whole) {
    for (int j = n - 1; j >= 0; --j) {
      std::vector<char> keep(levels[j].base.size(), 0);
      for (std::uint32_t i : complex.facets[j + 1].index) keep[i] = 1;
      complex.num_dropped += std::count(keep.begin(), keep.end(), 0);
      const auto renamed = keep_rows(levels[j], complex.facets[j], d, keep);
      rename(complex.facets[j + 1], renamed);
      if (j > 0) continue;
      point_of.clear();
      for (std::uint32_t i = 0; i < keep.size(); ++i)
        if (keep[i]) point_of.push_back(i);
    }
  }

  complex.points.resize(point_of.size() * d);
  for (std::size_t i = 0; i < point_of.size(); ++i) {
    std::copy_n(&crossed.points[std::size_t{point_of[i]} * d], d, &complex.points[i * d]);
  }
  for (int j = 0; j <= n; ++j) {
    complex.cofacets.push_back(j < n ? transposed(complex.facets[j + 1], levels[j].base.size())
                                     : empty_lists(levels[n].base.size()));
    complex.simplices.push_back({std::move(levels[j].base), {levels[j].parts.begin(), levels[j].parts.end()}});
    levels[j] = {};
  }
  return complex;
}

}  // namespace

coxeter::Simplex CellComplex::simplex(int j, std::size_t i) const {
  const std::int32_t* z = &vertex_coordinates[std::size_t{simplices[j].base[i]} * ambient_dim];
  const std::uint16_t* first = &simplices[j].parts[i * ambient_dim];
  std::vector<std::uint16_t> part_indices(first, first + ambient_dim);
  // Element d is in the last part: alone there, or with the coordinates of the highest number. The dimension tells.
  part_indices.push_back(static_cast<std::uint16_t>(ambient_dim - intrinsic_dim + j));
  return {coxeter::LatticeVertex(std::span(z, std::size_t(ambient_dim))),
          coxeter::OrderedPartition::from_part_indices(part_indices)};
}

CellComplex cell_complex(const CrossedSimplices& crossed) {
  if (!crossed.wide_parts.empty()) return build<std::uint16_t>(crossed, crossed.wide_parts);
  // Part numbers go up to d here.
  if (crossed.ambient_dim < TraceResult::kFirstWideCodim) return build<std::uint8_t>(crossed, crossed.parts);
  const std::vector<std::uint16_t> wide(crossed.parts.begin(), crossed.parts.end());
  return build<std::uint16_t>(crossed, wide);
}

CellComplex cell_complex(const TraceResult& trace) {
  CrossedSimplices crossed;
  crossed.ambient_dim = trace.ambient_dim();
  crossed.codim = trace.codim();
  crossed.vertex_coordinates = trace.vertex_coordinates();
  std::vector<std::uint32_t> base(trace.num_simplices());
  for (std::size_t i = 0; i < base.size(); ++i) base[i] = trace.base(i);
  crossed.base = base;
  if (trace.has_wide_parts())
    crossed.wide_parts = trace.parts<std::uint16_t>();
  else
    crossed.parts = trace.parts<std::uint8_t>();
  crossed.points = trace.points();
  crossed.whole = trace.stop_reason == StopReason::kNone;
  return cell_complex(crossed);
}

}  // namespace whitney
