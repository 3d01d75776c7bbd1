// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/cells/cell_complex.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <coxeter/base/error.h>
#include <coxeter/tables/lattice_order.h>
#include <coxeter/tables/simplex_table.h>
#include <coxeter/tables/vertex_table.h>

namespace whitney {
namespace {

using coxeter::canonical_order;
using coxeter::HashSlots;
using coxeter::SimplexTable;
using coxeter::VertexTable;

void check_size(const Incidence& incidence) {
  if (incidence.index.size() >= std::numeric_limits<std::uint32_t>::max())
    throw InvalidInput("cell_complex: more than 2^32 incidences; use a larger edge length");
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

/// Collects simplices of one dimension, each once, and puts them into canonical order.
template <class Index>
class Collection {
 public:
  explicit Collection(int dim, const VertexTable& vertices)
      : d_(dim), vertices_(vertices), table_(dim, 0), key_(table_.key_words(), 0) {}

  /// Part numbers of the simplex to be entered next.
  Index* parts() { return SimplexTable<Index>::parts_of(key_.data()); }
  /// Enters it; its index until sort().
  std::uint32_t enter(std::uint32_t base) {
    SimplexTable<Index>::set_base(key_.data(), base);
    return table_.intern(key_.data(), hash_key(key_.data(), key_.size()));
  }
  /// All of them; rank[i] is the new index of i.
  Level<Index> sort(std::vector<std::uint32_t>& rank) {
    table_.release_index();
    const auto count = static_cast<std::uint32_t>(table_.size());
    const std::vector<std::uint32_t> order = canonical_order(
        vertices_.size(), count, d_, [&](std::uint32_t s) { return table_.base(s); },
        [&](std::uint32_t s) { return table_.parts(s); });
    rank.resize(count);
    Level<Index> level{std::vector<std::uint32_t>(count), std::vector<Index>(std::size_t{count} * d_)};
    for (std::uint32_t s = 0; s < count; ++s) {
      rank[order[s]] = s;
      level.base[s] = table_.base(order[s]);
      std::copy_n(table_.parts(order[s]), d_, &level.parts[std::size_t{s} * d_]);
    }
    return level;
  }

 private:
  int d_;
  const VertexTable& vertices_;
  SimplexTable<Index> table_;
  std::vector<std::uint64_t> key_;
};

/// Finds the (m+1)-simplices around m-simplices.
template <class Index>
class Cofacets {
 public:
  Cofacets(int dim, const VertexTable& vertices) : d_(dim), vertices_(vertices) {}

  /// The cofacets of simplices first .. last-1 of a level, entered into a collection: their indices there. One whose
  /// base vertex is not in the table is skipped: a stopped trace never looked at it.
  Incidence enter(const Level<Index>& level, std::uint32_t first, std::uint32_t last, int num_parts,
                  Collection<Index>& collection) {
    Incidence around;
    around.offset.reserve(last - first + 1);
    Index* out = collection.parts();
    std::vector<int> elements(d_ + 1), starts(num_parts + 1), at(num_parts);
    std::vector<std::int32_t> z(d_);
    const std::uint64_t* weights = vertices_.weights();

    for (std::uint32_t i = first; i < last; ++i) {
      const Index* parts = &level.parts[std::size_t{i} * d_];
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
        const bool last_part = q == num_parts - 1;
        // Elements of part q get q (first half) or q + 1; in the last part with element d in the first half, the second
        // half becomes part 0 of a new base vertex and everything else moves up.
        for (std::uint32_t split = 1; split < all; ++split) {
          const bool new_base = last_part && (split >> (size - 1) & 1);
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
          around.index.push_back(collection.enter(base));
        }
      }
      check_size(around);
      around.offset.push_back(static_cast<std::uint32_t>(around.index.size()));
    }
    return around;
  }

 private:
  int d_;
  const VertexTable& vertices_;
};

/// The sets of inequalities of the strata whose closures hold the given ones: all their subsets, by size, then
/// lexicographically; and for each its subsets with one element less.
struct Sets {
  std::vector<std::vector<int>> sets;
  std::vector<std::vector<std::uint32_t>> released;

  explicit Sets(std::span<const BoundarySimplices> boundary) {
    std::set<std::vector<int>> all{{}};
    std::vector<std::vector<int>> open;
    for (const BoundarySimplices& stratum : boundary) open.push_back(stratum.inequalities);
    while (!open.empty()) {
      const std::vector<int> set = std::move(open.back());
      open.pop_back();
      if (!all.insert(set).second) continue;
      for (std::size_t i = 0; i < set.size(); ++i) {
        open.push_back(set);
        open.back().erase(open.back().begin() + i);
      }
    }
    sets.assign(all.begin(), all.end());
    std::stable_sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    std::map<std::vector<int>, std::uint32_t> number;
    for (std::uint32_t s = 0; s < sets.size(); ++s) number[sets[s]] = s;
    for (const std::vector<int>& set : sets) {
      released.emplace_back();
      for (std::size_t i = 0; i < set.size(); ++i) {
        std::vector<int> smaller = set;
        smaller.erase(smaller.begin() + i);
        released.back().push_back(number.at(smaller));
      }
    }
  }
  std::size_t size() const { return sets.size(); }
};

/// The cells of one dimension, set by set: those with set s are begin[s] .. begin[s+1].
template <class Index>
struct Cells {
  Level<Index> level;
  std::vector<std::uint32_t> begin;
};

/// The cells one dimension up, and for every cell those around it: its cofacets with the same set, then one cell for
/// every inequality of its set.
template <class Index>
std::pair<Cells<Index>, Incidence> cells_around(const Cells<Index>& cells, const Sets& sets, int num_parts, int d,
                                                const VertexTable& vertices) {
  const Level<Index>& level = cells.level;
  Cofacets<Index> cofacets(d, vertices);
  std::vector<Incidence> same(sets.size());
  std::vector<std::vector<std::vector<std::uint32_t>>> larger(sets.size());
  Cells<Index> next;
  next.begin.push_back(0);
  std::vector<std::uint32_t> rank;
  for (std::uint32_t s = 0; s < sets.size(); ++s) {
    Collection<Index> collection(d, vertices);
    same[s] = cofacets.enter(level, cells.begin[s], cells.begin[s + 1],
                             num_parts + static_cast<int>(sets.sets[s].size()), collection);
    std::vector<std::vector<std::uint32_t>*> entered{&same[s].index};
    for (std::uint32_t t = s + 1; t < sets.size(); ++t) {
      if (std::find(sets.released[t].begin(), sets.released[t].end(), s) == sets.released[t].end()) continue;
      larger[t].reserve(sets.released[t].size());
      std::vector<std::uint32_t>& around = larger[t].emplace_back();
      for (std::uint32_t i = cells.begin[t]; i < cells.begin[t + 1]; ++i) {
        std::copy_n(&level.parts[std::size_t{i} * d], d, collection.parts());
        around.push_back(collection.enter(level.base[i]));
      }
      entered.push_back(&around);
    }
    Level<Index> sorted = collection.sort(rank);
    const std::uint32_t first = next.begin.back();
    for (std::vector<std::uint32_t>* around : entered)
      for (std::uint32_t& i : *around) i = first + rank[i];
    if (first == 0) {
      next.level = std::move(sorted);
    } else {
      next.level.base.insert(next.level.base.end(), sorted.base.begin(), sorted.base.end());
      next.level.parts.insert(next.level.parts.end(), sorted.parts.begin(), sorted.parts.end());
    }
    next.begin.push_back(static_cast<std::uint32_t>(next.level.base.size()));
  }
  if (sets.size() == 1) return {std::move(next), std::move(same[0])};

  Incidence around;
  around.offset.reserve(level.base.size() + 1);
  for (std::uint32_t s = 0; s < sets.size(); ++s)
    for (std::uint32_t i = 0; i < same[s].size(); ++i) {
      around.index.insert(around.index.end(), same[s][i].begin(), same[s][i].end());
      for (const auto& list : larger[s]) around.index.push_back(list[i]);
      check_size(around);
      around.offset.push_back(static_cast<std::uint32_t>(around.index.size()));
    }
  return {std::move(next), std::move(around)};
}

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

/// The simplex with these part numbers of the coordinates 0..d-1.
template <class Index>
coxeter::Simplex simplex_of(const std::vector<std::int32_t>& vertex_coordinates, std::uint32_t base, const Index* parts,
                            int ambient_dim, int dim) {
  const std::int32_t* z = &vertex_coordinates[std::size_t{base} * ambient_dim];
  std::vector<std::uint16_t> part_indices(parts, parts + ambient_dim);
  // Element d is in the last part: alone there, or with the coordinates of the highest number. The dimension tells.
  part_indices.push_back(static_cast<std::uint16_t>(dim));
  return {coxeter::LatticeVertex(std::span(z, std::size_t(ambient_dim))),
          coxeter::OrderedPartition::from_part_indices(part_indices)};
}

/// How many of the rows that are kept come before the old row numbers in `begin`.
std::vector<std::uint32_t> kept_before(const std::vector<std::uint32_t>& begin, const std::vector<char>& keep) {
  std::vector<std::uint32_t> count{0};
  for (std::size_t s = 0; s + 1 < begin.size(); ++s)
    count.push_back(count.back() +
                    static_cast<std::uint32_t>(std::count(keep.begin() + begin[s], keep.begin() + begin[s + 1], 1)));
  return count;
}

template <class Index>
CellComplex build(const CrossedSimplices& crossed, std::span<const Index> parts) {
  const int d = crossed.ambient_dim, n = d - crossed.codim;
  const Sets sets(crossed.boundary);
  CellComplex complex;
  complex.ambient_dim = d;
  complex.intrinsic_dim = n;
  complex.num_given = crossed.num_given;
  complex.inequality_sets = sets.sets;
  complex.vertex_coordinates.assign(crossed.vertex_coordinates.begin(), crossed.vertex_coordinates.end());

  VertexTable vertices(d);
  for (std::size_t at = 0; at < crossed.vertex_coordinates.size(); at += d) {
    const std::int32_t* z = crossed.vertex_coordinates.data() + at;
    vertices.intern(z, vertices.form_of(z));
  }

  std::vector<Cells<Index>> cells(n + 1);
  std::vector<std::span<const double>> points{crossed.points};
  Level<Index>& vertex_level = cells[0].level;
  vertex_level.base.assign(crossed.base.begin(), crossed.base.end());
  vertex_level.parts.assign(parts.begin(), parts.end());
  cells[0].begin = {0, static_cast<std::uint32_t>(crossed.base.size())};
  for (std::size_t s = 1, b = 0; s < sets.size(); ++s) {
    if (b < crossed.boundary.size() && crossed.boundary[b].inequalities == sets.sets[s]) {
      const BoundarySimplices& stratum = crossed.boundary[b++];
      vertex_level.base.insert(vertex_level.base.end(), stratum.base.begin(), stratum.base.end());
      vertex_level.parts.insert(vertex_level.parts.end(), stratum.parts.begin(), stratum.parts.end());
      points.push_back(stratum.points);
    }
    cells[0].begin.push_back(static_cast<std::uint32_t>(vertex_level.base.size()));
  }
  complex.facets.push_back(empty_lists(vertex_level.base.size()));

  const bool whole = crossed.whole;
  for (int j = 0; j < n; ++j) {
    auto [next, around] = cells_around(cells[j], sets, crossed.codim + j + 1, d, vertices);
    Incidence facets = transposed(around, next.level.base.size());
    if (!whole) {
      std::vector<char> keep(next.level.base.size());
      for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = is_complete(facets[i], j + 1, complex.facets[j]);
      if (j + 1 == n && crossed.keep_top)
        for (std::size_t i = 0; i < keep.size(); ++i)
          keep[i] = keep[i] && crossed.keep_top(simplex_of(complex.vertex_coordinates, next.level.base[i],
                                                           &next.level.parts[i * d], d, d));
      complex.num_dropped += std::count(keep.begin(), keep.end(), 0);
      next.begin = kept_before(next.begin, keep);
      keep_rows(next.level, facets, d, keep);
    }
    cells[j + 1] = std::move(next);
    complex.facets.push_back(std::move(facets));
  }

  for (std::span<const double> list : points) complex.points.insert(complex.points.end(), list.begin(), list.end());
  if (!whole) {
    for (int j = n - 1; j >= 0; --j) {
      std::vector<char> keep(cells[j].level.base.size(), 0);
      for (std::uint32_t i : complex.facets[j + 1].index) keep[i] = 1;
      complex.num_dropped += std::count(keep.begin(), keep.end(), 0);
      cells[j].begin = kept_before(cells[j].begin, keep);
      const auto renamed = keep_rows(cells[j].level, complex.facets[j], d, keep);
      rename(complex.facets[j + 1], renamed);
      if (j > 0) continue;
      std::size_t count = 0;
      for (std::size_t i = 0; i < keep.size(); ++i)
        if (keep[i]) std::copy_n(&complex.points[i * d], d, &complex.points[d * count++]);
      complex.points.resize(count * d);
    }
  }

  for (int j = 0; j <= n; ++j) {
    Level<Index>& level = cells[j].level;
    complex.cofacets.push_back(j < n ? transposed(complex.facets[j + 1], level.base.size())
                                     : empty_lists(level.base.size()));
    complex.simplices.push_back({std::move(level.base), {level.parts.begin(), level.parts.end()}});
    complex.set_begin.push_back(std::move(cells[j].begin));
    level = {};
  }
  return complex;
}

}  // namespace

std::size_t CellComplex::set_of(int j, std::size_t i) const {
  const auto& begin = set_begin[j];
  return std::upper_bound(begin.begin(), begin.end(), i) - begin.begin() - 1;
}

coxeter::Simplex CellComplex::simplex(int j, std::size_t i) const {
  const int codim = ambient_dim - intrinsic_dim, cut = static_cast<int>(inequality_sets[set_of(j, i)].size());
  return simplex_of(vertex_coordinates, simplices[j].base[i], &simplices[j].parts[i * ambient_dim], ambient_dim,
                    codim + cut + j);
}

CellComplex cell_complex(const CrossedSimplices& crossed) {
  if (!crossed.wide_parts.empty()) return build<std::uint16_t>(crossed, crossed.wide_parts);
  // Part numbers go up to d here.
  if (crossed.ambient_dim < kFirstWideCodim) return build<std::uint8_t>(crossed, crossed.parts);
  const std::vector<std::uint16_t> wide(crossed.parts.begin(), crossed.parts.end());
  return build<std::uint16_t>(crossed, wide);
}

}  // namespace whitney
