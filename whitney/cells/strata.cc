// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/cells/strata.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include <coxeter/base/disjoint_sets.h>
#include <coxeter/base/error.h>

namespace whitney {
namespace {

/// A partition of all cells of a complex. They are numbered from the last one down: the representative of a class, its
/// least number, is its last cell, one of the highest dimension.
class CellPartition {
 public:
  explicit CellPartition(const CellComplex& complex) : first_{0} {
    for (int j = 0; j <= complex.intrinsic_dim; ++j) first_.push_back(first_.back() + complex.num_cells(j));
    if (first_.back() > std::numeric_limits<std::uint32_t>::max()) throw InvalidInput("more than 2^32 cells");
    classes_.reset(first_.back());
  }

  std::size_t cell(int j, std::size_t i) const { return first_[j] + i; }
  std::size_t find(std::size_t cell) { return first_.back() - 1 - classes_.find(number(cell)); }
  void join(std::size_t a, std::size_t b) { classes_.unite(number(a), number(b)); }

 private:
  std::uint32_t number(std::size_t cell) const { return static_cast<std::uint32_t>(first_.back() - 1 - cell); }

  std::vector<std::size_t> first_;
  DisjointSets classes_;
};

/// Calls visit(j, cell, its set, facet, the set of the facet) for every cell and facet.
template <class Visit>
void for_each_incidence(const CellComplex& complex, Visit&& visit) {
  for (int j = 1; j <= complex.intrinsic_dim; ++j)
    for (std::size_t s = 0; s + 1 < complex.set_begin[j].size(); ++s)
      for (std::uint32_t i = complex.set_begin[j][s]; i < complex.set_begin[j][s + 1]; ++i)
        for (std::uint32_t f : complex.facets[j][i]) visit(j, i, s, f, complex.set_of(j - 1, f));
}

std::size_t count_components(const CellComplex& complex, const std::vector<char>& counted) {
  if (std::find(counted.begin(), counted.end(), 1) == counted.end()) return 0;
  CellPartition partition(complex);
  for_each_incidence(complex, [&](int j, std::uint32_t i, std::size_t s, std::uint32_t f, std::size_t t) {
    if (counted[s] && counted[t]) partition.join(partition.cell(j, i), partition.cell(j - 1, f));
  });
  std::size_t components = 0;
  for (int j = 0; j <= complex.intrinsic_dim; ++j)
    for (std::size_t i = 0; i < complex.num_cells(j); ++i)
      components += counted[complex.set_of(j, i)] && partition.find(partition.cell(j, i)) == partition.cell(j, i);
  return components;
}

}  // namespace

Strata strata_of(const CellComplex& complex) {
  const int n = complex.intrinsic_dim;
  CellPartition partition(complex);
  for_each_incidence(complex, [&](int j, std::uint32_t i, std::size_t s, std::uint32_t f, std::size_t t) {
    if (s == t) partition.join(partition.cell(j, i), partition.cell(j - 1, f));
  });

  Strata out;
  std::vector<std::uint32_t> number(partition.cell(n, complex.num_cells(n)), 0);  // by representative
  const auto& sets = complex.inequality_sets;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const int dim = n - static_cast<int>(sets[s].size());
    if (dim < 0) continue;
    const auto& begin = complex.set_begin[dim];
    for (std::uint32_t i = begin[s]; i < begin[s + 1]; ++i) {
      const std::size_t representative = partition.find(partition.cell(dim, i));
      std::uint32_t& stratum = number[representative];
      if (stratum == 0) {
        out.strata.push_back({dim, sets[s], false, {}, {}});
        for (int inequality : sets[s]) out.strata.back().is_cut |= inequality >= complex.num_given;
        stratum = static_cast<std::uint32_t>(out.strata.size());
      }
      out.strata[stratum - 1].cells.push_back(i);
    }
  }
  out.stratum_of.resize(n + 1);
  for (int j = 0; j <= n; ++j)
    for (std::size_t i = 0; i < complex.num_cells(j); ++i)
      out.stratum_of[j].push_back(number[partition.find(partition.cell(j, i))] - 1);

  for_each_incidence(complex, [&](int j, std::uint32_t i, std::size_t s, std::uint32_t f, std::size_t t) {
    if (s != t) out.strata[out.stratum_of[j][i]].faces.push_back(out.stratum_of[j - 1][f]);
  });
  for (Stratum& stratum : out.strata) {
    std::sort(stratum.faces.begin(), stratum.faces.end());
    stratum.faces.erase(std::unique(stratum.faces.begin(), stratum.faces.end()), stratum.faces.end());
  }

  std::vector<char> given, cut;
  for (const std::vector<int>& set : sets) {
    auto is_given = [&](int inequality) { return inequality < complex.num_given; };
    given.push_back(std::any_of(set.begin(), set.end(), is_given));
    cut.push_back(!std::all_of(set.begin(), set.end(), is_given));
  }
  out.boundary_components = count_components(complex, given);
  out.cut_components = count_components(complex, cut);
  return out;
}

}  // namespace whitney
