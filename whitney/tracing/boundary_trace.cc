// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/boundary_trace.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include <coxeter/faces/cofaces.h>
#include <coxeter/faces/faces.h>

namespace whitney {

using coxeter::Simplex;

namespace {

Simplex without_vertex(const Simplex& simplex, int removed) {
  // Facets are visited in the order of the vertices they leave out: 1, 2, .., and last 0.
  int left = removed == 0 ? simplex.dim() : removed - 1;
  Simplex facet;
  coxeter::for_each_facet(simplex, [&](const Simplex& visited) {
    if (left-- > 0) return true;
    facet = visited;
    return false;
  });
  return facet;
}

int position_in(const std::vector<int>& set, int inequality) {
  return static_cast<int>(std::lower_bound(set.begin(), set.end(), inequality) - set.begin());
}

bool contains(const std::vector<int>& set, int inequality) {
  return std::binary_search(set.begin(), set.end(), inequality);
}

std::vector<int> with(std::vector<int> set, int inequality) {
  set.insert(set.begin() + position_in(set, inequality), inequality);
  return set;
}

}  // namespace

BoundaryTrace::BoundaryTrace(const Domain& domain, LatticeValues& lattice, int codim)
    : domain_(domain),
      lattice_(lattice),
      codim_(codim),
      num_inequalities_(domain.num_inequalities()),
      row_(std::size_t(num_inequalities_) + codim) {}

CrossingPoint& BoundaryTrace::solver(int codim) {
  auto& solver = solvers_[codim];
  if (!solver) solver = std::make_unique<CrossingPoint>(codim);
  return *solver;
}

std::size_t BoundaryTrace::exact_decisions() const {
  std::size_t sum = 0;
  for (const auto& [codim, solver] : solvers_) sum += solver->exact_decisions();
  return sum;
}

std::vector<int> BoundaryTrace::bits(const std::vector<std::uint64_t>& mask) const {
  std::vector<int> list;
  for (std::size_t word = 0; word < mask.size(); ++word)
    for (std::uint64_t rest = mask[word]; rest != 0; rest &= rest - 1)
      list.push_back(static_cast<int>(64 * word) + std::countr_zero(rest));
  return list;
}

// False when f has no value at some vertex.
bool BoundaryTrace::load(const Simplex& simplex, Corners& corners) {
  const int num = simplex.dim() + 1;
  corners.ids.resize(num);
  coxeter::LatticeVertex z = simplex.base();
  for (int q = 0; q < num; ++q) {
    if (q > 0)
      for (std::uint16_t c : simplex.partition().part(q - 1)) ++z[c];
    corners.ids[q] = lattice_.vertex(z);
    if (corners.ids[q] == LatticeValues::kUnreachable) {
      cut_by_undefined_ = true;
      return false;
    }
  }
  corners.rows.clear();
  corners.any.assign(domain_.num_words(), 0);
  for (std::uint32_t id : corners.ids) {
    const std::uint64_t* mask = lattice_.mask(id);
    for (std::size_t word = 0; word < corners.any.size(); ++word) corners.any[word] |= mask[word];
  }
  return true;
}

void BoundaryTrace::load_rows(Corners& corners) {
  if (!corners.rows.empty()) return;
  corners.rows.resize(corners.ids.size() * row_);
  for (std::size_t q = 0; q < corners.ids.size(); ++q) lattice_.values(corners.ids[q], &corners.rows[q * row_]);
}

// Whether a mask has no inequalities but those of a set.
bool BoundaryTrace::only_in(const std::uint64_t* mask, const Set& set) const {
  for (std::size_t word = 0; word < domain_.num_words(); ++word) {
    std::uint64_t rest = mask[word];
    for (int i : set)
      if (i / 64 == static_cast<int>(word)) rest &= ~(std::uint64_t{1} << (i % 64));
    if (rest != 0) return false;
  }
  return true;
}

CrossingPoint& BoundaryTrace::load_map(const Corners& corners, const Set& set, int removed) {
  const int num = static_cast<int>(corners.rows.size() / row_), codim = codim_ + static_cast<int>(set.size());
  columns_.resize(std::size_t(num) * codim);
  column_pointers_.clear();
  for (int q = 0; q < num; ++q) {
    if (q == removed) continue;
    const double* row = &corners.rows[q * row_];
    double* column = &columns_[std::size_t(q) * codim];
    column_pointers_.push_back(column);
    for (int j : set) *column++ = row[j];
    std::copy_n(row + num_inequalities_, codim_, column);
  }
  CrossingPoint& point = solver(codim);
  point.load(column_pointers_);
  return point;
}

// Whether the domain of one more inequality holds the point that was loaded from the same corners.
bool BoundaryTrace::below(CrossingPoint& point, const Corners& corners, const Set& set, int removed, int inequality) {
  const int num = static_cast<int>(corners.rows.size() / row_);
  std::vector<double> component;
  bool all_inside = true, all_outside = true;
  for (int q = 0; q < num; ++q) {
    if (q == removed) continue;
    component.push_back(corners.rows[q * row_ + inequality]);
    (component.back() > 0 ? all_inside : all_outside) = false;
  }
  if (all_inside || all_outside) return all_inside;
  return point.below(component, position_in(set, inequality));
}

bool BoundaryTrace::inside(std::span<const double> values) {
  Corners corners;
  corners.rows.assign(values.begin(), values.end());
  CrossingPoint* point = nullptr;
  for (int j = 0; j < num_inequalities_; ++j) {
    bool all_inside = true;
    for (std::size_t at = j; at < values.size(); at += row_) all_inside = all_inside && values[at] <= 0;
    if (all_inside) continue;
    if (point == nullptr) point = &load_map(corners, {}, -1);
    if (!below(*point, corners, {}, -1, j)) return false;
  }
  return true;
}

bool BoundaryTrace::inside(std::span<const std::uint32_t> vertices) {
  std::vector<double> rows(vertices.size() * row_);
  for (std::size_t q = 0; q < vertices.size(); ++q) lattice_.values(vertices[q], &rows[q * row_]);
  return inside(rows);
}

void BoundaryTrace::insert(const Simplex& simplex, Set set, bool from_exit, const InteriorVisitor* interior) {
  if (set.empty()) {
    if (interior != nullptr) (*interior)(simplex);
    return;
  }
  auto entry = strata_.try_emplace(set).first;
  entry->second.inequalities = entry->first;
  if (!entry->second.points.insert(simplex).second) return;
  ++size_;
  tasks_.push_back({simplex, &entry->first, from_exit});
}

// From a point inside the domain along the segment of F_I in tau, whose far end is in the facet without vertex
// `removed`.
void BoundaryTrace::follow(const Simplex& tau, Corners& corners, const Set& set, int removed, bool from_exit,
                           const InteriorVisitor* interior) {
  std::vector<int> violated;
  load_rows(corners);
  CrossingPoint* far = nullptr;
  for (int j : bits(corners.any)) {
    if (contains(set, j)) continue;
    if (far == nullptr) far = &load_map(corners, set, removed);
    if (!below(*far, corners, set, removed, j)) violated.push_back(j);
  }
  if (violated.empty()) return insert(without_vertex(tau, removed), set, from_exit, interior);
  for (int j : violated) {
    Set next = with(set, j);
    bool first = true;
    if (violated.size() > 1) {
      CrossingPoint& point = load_map(corners, next, -1);
      for (int other : violated) first = first && (other == j || below(point, corners, next, -1, other));
    }
    if (first) return insert(tau, std::move(next), from_exit, interior);
  }
  throw std::logic_error("BoundaryTrace: a segment leaves the domain nowhere");
}

void BoundaryTrace::add_exit(const Simplex& tau, const Simplex& outside) {
  Corners corners, facet;
  if (!load(tau, corners)) return;
  const std::vector<int> near = bits(corners.any);
  if (near.size() == 1) return insert(tau, near, true, nullptr);
  if (!load(outside, facet)) return;
  int removed = 0;
  while (removed < static_cast<int>(facet.ids.size()) && corners.ids[removed] == facet.ids[removed]) ++removed;
  follow(tau, corners, {}, removed, true, nullptr);
}

// Whether a further inequality cuts a simplex around (sigma, {i}).
bool BoundaryTrace::others_near(const Simplex& simplex, const Corners& corners, const Set& set) {
  if (only_in(lattice_.mask_of_all(), set)) return false;
  if (!only_in(corners.any.data(), set)) return true;
  if (simplex.codim() == 0) return false;
  return !coxeter::for_each_cofacet(simplex, [&](const Simplex& tau) {
    coxeter::LatticeVertex z = tau.base();
    for (int q = 0; q <= tau.dim(); ++q) {
      if (q > 0)
        for (std::uint16_t c : tau.partition().part(q - 1)) ++z[c];
      const std::uint32_t id = lattice_.vertex(z);
      if (id != LatticeValues::kUnreachable && !only_in(lattice_.mask(id), set)) return false;
    }
    return true;
  });
}

void BoundaryTrace::process(const Task& task, const InteriorVisitor& interior) {
  const Set& set = *task.set;
  if (task.from_exit && set.size() == 1 && only_in(lattice_.mask_of_all(), set)) return;
  Corners corners;
  if (!load(task.simplex, corners)) return;
  const bool near = set.size() > 1 || others_near(task.simplex, corners, set);
  if (!near && task.from_exit) return;
  load_rows(corners);

  // To the inside of every inequality: of the two facets in which F_{I-i} takes its target, one is there. An exit came
  // from there.
  for (int i : set) {
    if (task.from_exit) break;
    Set released = set;
    released.erase(released.begin() + position_in(set, i));
    // Only if no facet is certain to be it, those that floating point cannot tell are decided exactly.
    bool found = false;
    for (const bool exactly : {false, true}) {
      for (int removed = 0; removed <= task.simplex.dim() && !found; ++removed) {
        CrossingPoint& point = load_map(corners, released, removed);
        if (!point.quick_hit().value_or(exactly && point.hit())) continue;
        found = below(point, corners, released, removed, i);
        if (found) follow(task.simplex, corners, released, removed, false, &interior);
      }
    }
  }
  if (!near || task.simplex.codim() == 0) return;

  // Over every cofacet, but those in whose cell (sigma, {i}) is alone with its inequality.
  struct Cofacet {
    Simplex simplex;
    Corners corners;
    int added, removed;
  };
  std::vector<Cofacet> cofacets;
  Corners around;
  coxeter::for_each_cofacet(task.simplex, [&](const Simplex& tau) {
    if (!load(tau, around) || (set.size() == 1 && only_in(around.any.data(), set))) return;
    load_rows(around);
    int added = 0;
    while (added < static_cast<int>(corners.ids.size()) && around.ids[added] == corners.ids[added]) ++added;
    cofacets.push_back({tau, around, added, 0});
  });
  if (cofacets.empty()) return;
  CrossingPoint& point = load_map(corners, set, -1);
  std::vector<double> value;
  for (Cofacet& cofacet : cofacets) {
    const double* row = &cofacet.corners.rows[cofacet.added * row_];
    value.clear();
    for (int j : set) value.push_back(row[j]);
    value.insert(value.end(), row + num_inequalities_, row + row_);
    const int leaving = point.leaving(value.data());
    cofacet.removed = leaving + (leaving >= cofacet.added);
  }
  for (Cofacet& cofacet : cofacets) follow(cofacet.simplex, cofacet.corners, set, cofacet.removed, false, &interior);
}

bool BoundaryTrace::grow(std::size_t steps, const InteriorVisitor& interior) {
  for (; steps > 0 && !tasks_.empty(); --steps) {
    const Task task = std::move(tasks_.front());
    tasks_.pop_front();
    process(task, interior);
  }
  return !tasks_.empty();
}

bool BoundaryTrace::find_in(const Simplex& full) {
  Corners corners;
  if (!load(full, corners)) return false;
  const std::vector<int> near = bits(corners.any);
  const int n = full.ambient_dim() - codim_;
  // All sets of one, two, .. n inequalities that are violated somewhere in the simplex.
  std::vector<Set> sets{{}};
  for (int size = 1; size <= n; ++size) {
    std::vector<Set> larger;
    for (const Set& set : sets)
      for (int j : near)
        if (set.empty() || j > set.back()) larger.push_back(with(set, j));
    sets = std::move(larger);
    for (const Set& set : sets) {
      Corners face_corners;
      const bool none = coxeter::for_each_face(full, codim_ + size, [&](const Simplex& face) {
        if (!load(face, face_corners)) return true;
        load_rows(face_corners);
        CrossingPoint& point = load_map(face_corners, set, -1);
        if (!point.hit()) return true;
        for (int j : near)
          if (!contains(set, j) && !below(point, face_corners, set, -1, j)) return true;
        insert(face, set, false, nullptr);
        return false;
      });
      if (!none) return true;
    }
  }
  return false;
}

std::vector<double> BoundaryTrace::weights(const Simplex& sigma, const std::vector<int>& inequalities) {
  Corners corners;
  load(sigma, corners);
  load_rows(corners);
  return load_map(corners, inequalities, -1).weights();
}

}  // namespace whitney
