// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/homology.h>

#include <algorithm>
#include <limits>
#include <queue>

#include <coxeter/base/error.h>
#include <coxeter/base/run_watch.h>
#include <whitney/topology/smith_form.h>

namespace whitney {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// An acyclic matching of the cells with their facets. Cells are removed one after the other: a pair (facet, cell) when
/// the facet is all that is left of the boundary of the cell (a coreduction), or, when there is no such pair, a
/// critical cell of the lowest dimension left.
struct Matching {
  enum class Role : std::uint8_t { kLeft, kCritical, kMatchedUp, kMatchedDown };
  std::vector<std::vector<Role>> role;
  std::vector<std::vector<std::uint32_t>> time;  ///< of removal, increasing
  std::vector<std::vector<std::uint32_t>> mate;  ///< of a cell matched up: the cofacet
  std::vector<std::vector<std::uint32_t>> critical;
};

Matching match_by_coreductions(std::span<const Incidence> facets, RunWatch& watch) {
  using Role = Matching::Role;
  const std::size_t num_dims = facets.size();
  Matching matching;
  matching.role.resize(num_dims);
  matching.time.resize(num_dims);
  matching.mate.resize(num_dims);
  matching.critical.resize(num_dims);
  std::vector<Incidence> cofacets(num_dims);
  std::vector<std::vector<std::uint32_t>> facets_left(num_dims);
  for (std::size_t j = 0; j < num_dims; ++j) {
    const std::size_t count = facets[j].size();
    matching.role[j].assign(count, Role::kLeft);
    matching.time[j].assign(count, 0);
    matching.mate[j].assign(j + 1 < num_dims ? count : 0, kNone);
    if (j + 1 < num_dims) cofacets[j] = transposed(facets[j + 1], count);
    facets_left[j].resize(count);
    for (std::size_t i = 0; i < count; ++i) facets_left[j][i] = facets[j][i].size();
  }

  struct Cell {
    std::uint32_t dim, index;
  };
  std::queue<Cell> ready;
  std::uint32_t now = 0;
  const auto remove = [&](std::uint32_t j, std::uint32_t i, Role role) {
    watch.check();
    matching.role[j][i] = role;
    matching.time[j][i] = now++;
    if (j + 1 == num_dims) return;
    for (std::uint32_t above : cofacets[j][i]) {
      if (--facets_left[j + 1][above] == 1) ready.push({j + 1, above});
    }
  };
  for (std::uint32_t j = 0; j < num_dims; ++j) {
    for (std::uint32_t next = 0; next < facets[j].size(); ++next) {
      if (matching.role[j][next] != Role::kLeft) continue;
      matching.critical[j].push_back(next);
      remove(j, next, Role::kCritical);
      while (!ready.empty()) {
        const auto [dim, cell] = ready.front();
        ready.pop();
        if (matching.role[dim][cell] != Role::kLeft || facets_left[dim][cell] != 1) continue;
        const auto list = facets[dim][cell];
        const std::uint32_t facet =
            *std::find_if(list.begin(), list.end(), [&](auto f) { return matching.role[dim - 1][f] == Role::kLeft; });
        matching.mate[dim - 1][facet] = cell;
        remove(dim - 1, facet, Role::kMatchedUp);
        remove(dim, cell, Role::kMatchedDown);
      }
    }
  }
  return matching;
}

struct Overflow {};

void add(std::int64_t& sum, std::int64_t term, bool negative) {
  if (negative ? __builtin_sub_overflow(sum, term, &sum) : __builtin_add_overflow(sum, term, &sum)) throw Overflow{};
}
void add(Integer& sum, const Integer& term, bool negative) {
  if (negative) {
    sum -= term;
  } else {
    sum += term;
  }
}

/// The boundary of the critical j-cells in the Morse complex, j >= 2. In boundary(c), a facet `a` that is matched up
/// with a cell b is replaced by the other facets of b, which were removed before it, until only critical cells are
/// left; cells matched down contribute nothing.
template <class Number>
SparseIntegerMatrix morse_boundary(std::span<const Incidence> facets, const IncidenceSigns& signs,
                                   const Matching& matching, std::size_t j, RunWatch& watch) {
  using Role = Matching::Role;
  const std::vector<Role>& role = matching.role[j - 1];
  std::vector<std::uint32_t> row(facets[j - 1].size(), kNone);
  for (std::size_t r = 0; r < matching.critical[j - 1].size(); ++r) row[matching.critical[j - 1][r]] = r;

  SparseIntegerMatrix matrix;
  matrix.num_rows = matching.critical[j - 1].size();
  std::vector<Number> sum(facets[j - 1].size(), 0);
  std::vector<char> touched(facets[j - 1].size(), 0);
  std::priority_queue<std::pair<std::uint32_t, std::uint32_t>> latest;  // (time of removal, facet)
  std::vector<std::uint32_t> reached;                                   // critical
  const auto add_boundary = [&](std::uint32_t cell, const Number& factor, bool negative, std::uint32_t but) {
    for (std::uint32_t e = facets[j].offset[cell]; e < facets[j].offset[cell + 1]; ++e) {
      const std::uint32_t f = facets[j].index[e];
      if (f == but || role[f] == Role::kMatchedDown) continue;
      add(sum[f], factor, negative != (signs[j][e] < 0));
      if (touched[f]) continue;
      touched[f] = 1;
      if (role[f] == Role::kCritical) {
        reached.push_back(f);
      } else {
        latest.emplace(matching.time[j - 1][f], f);
      }
    }
  };
  for (std::uint32_t c : matching.critical[j]) {
    add_boundary(c, 1, false, kNone);
    while (!latest.empty()) {
      watch.check();
      const std::uint32_t a = latest.top().second;
      latest.pop();
      touched[a] = 0;
      const Number factor = std::move(sum[a]);
      sum[a] = 0;
      if (factor == 0) continue;
      const std::uint32_t b = matching.mate[j - 1][a];
      std::uint32_t e = facets[j].offset[b];
      while (facets[j].index[e] != a) ++e;
      add_boundary(b, factor, signs[j][e] > 0, a);
    }
    auto& column = matrix.columns.emplace_back();
    for (std::uint32_t f : reached) {
      touched[f] = 0;
      if (sum[f] != 0) column.push_back({row[f], Integer(sum[f])});
      sum[f] = 0;
    }
    reached.clear();
  }
  return matrix;
}

/// Throws InvalidInput as homology() does.
void require_complex(std::span<const Incidence> facets, const IncidenceSigns& signs) {
  require_well_formed(facets);
  if (signs.size() != facets.size()) throw InvalidInput("signs: one list per dimension is needed");
  for (std::size_t j = 0; j < facets.size(); ++j) {
    if (signs[j].size() != facets[j].index.size()) throw InvalidInput("signs: one sign per facet is needed");
  }
  if (facets.size() > 1) {
    for (std::size_t i = 0; i < facets[1].size(); ++i) {
      if (facets[1][i].size() != 2) {
        throw InvalidInput("facets: 1-cell " + std::to_string(i) + " must have two vertices");
      }
    }
  }
  std::size_t num_cells = 0;
  for (const Incidence& lists : facets) num_cells += lists.size();
  if (num_cells > kNone) throw InvalidInput("facets: more than 2^32 cells");
}

/// Bytes that match_by_coreductions takes.
std::uint64_t matching_bytes(std::span<const Incidence> facets) {
  constexpr std::uint64_t kPerCell = 17, kPerIncidence = 4;  // role, time, mate, offset of cofacets, facets left
  std::uint64_t bytes = 0;
  for (const Incidence& lists : facets) bytes += kPerCell * lists.size() + kPerIncidence * lists.index.size();
  return bytes;
}

/// Throws RunWatch::Stopped.
Homology compute_homology(std::span<const Incidence> facets, const IncidenceSigns& signs, RunWatch& watch) {
  require_complex(facets, signs);
  if (!watch.fits(matching_bytes(facets)) || watch.stopped_now()) throw RunWatch::Stopped{};
  const Matching matching = match_by_coreductions(facets, watch);
  // The critical vertices are one per component, so the Morse boundary of dimension 1 is zero.
  std::vector<SmithForm> forms(facets.size() + 1);
  for (std::size_t j = 2; j < facets.size(); ++j) {
    if (matching.critical[j].empty() || matching.critical[j - 1].empty()) continue;
    try {
      forms[j] = smith_form(morse_boundary<std::int64_t>(facets, signs, matching, j, watch), &watch);
    } catch (const Overflow&) {
      forms[j] = smith_form(morse_boundary<Integer>(facets, signs, matching, j, watch), &watch);
    }
  }
  Homology result;
  for (std::size_t j = 0; j < facets.size(); ++j) {
    result.critical_cells.push_back(matching.critical[j].size());
    HomologyGroup& group = result.groups.emplace_back();
    group.rank = matching.critical[j].size() - forms[j].rank - forms[j + 1].rank;
    for (const Integer& t : forms[j + 1].factors) group.torsion.push_back(t.str());
  }
  return result;
}

}  // namespace

std::string to_string(const HomologyGroup& group) {
  std::string text;
  if (group.rank > 0) text = group.rank == 1 ? "Z" : "Z^" + std::to_string(group.rank);
  for (const std::string& t : group.torsion) text += (text.empty() ? "Z/" : " + Z/") + t;
  return text.empty() ? "0" : text;
}

Homology homology(std::span<const Incidence> facets, const IncidenceSigns& signs, const RunControl& run) {
  RunWatch watch(run, "homology");
  Homology result;
  try {
    result = compute_homology(facets, signs, watch);
  } catch (const RunWatch::Stopped&) {
    result.stop_reason = watch.reason();
  }
  return result;
}

Homology homology(std::span<const Incidence> facets) { return homology(facets, regular_cell_signs(facets)); }

std::vector<std::size_t> betti_z2(std::span<const HomologyGroup> groups) {
  std::vector<std::size_t> betti;
  std::size_t even_below = 0;
  for (const HomologyGroup& group : groups) {
    const std::size_t even = std::count_if(group.torsion.begin(), group.torsion.end(),
                                           [](const std::string& t) { return (t.back() - '0') % 2 == 0; });
    betti.push_back(group.rank + even + even_below);
    even_below = even;
  }
  return betti;
}

}  // namespace whitney
