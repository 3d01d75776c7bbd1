// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/perturbed_triangulation.h>

#include <algorithm>
#include <array>

#include <coxeter/base/error.h>
#include <coxeter/locate.h>

namespace whitney::perturbation {
namespace {

using coxeter::mix64;

constexpr std::uint32_t kUnknown = 0xffffffff;

}  // namespace

PerturbedTriangulation::PerturbedTriangulation(const coxeter::Triangulation& triangulation, const FootOracle& oracle)
    : triangulation_(triangulation),
      oracle_(oracle),
      d_(triangulation.ambient_dim()),
      certificate_(oracle.ambient_dim(), oracle.intrinsic_dim(), oracle.reach(), oracle.curvature_radius()),
      vertices_(d_),
      simplices_(d_, 0),
      own_foot_(d_ + d_ * d_),
      scratch_(d_),
      corner_positions_(d_ + 1),
      key_(simplices_.key_words()),
      coordinates_(d_) {
  if (oracle.ambient_dim() != d_) throw InvalidInput("triangulation and oracle must have the same ambient dimension");
}

std::uint32_t PerturbedTriangulation::enter_vertex(const std::int32_t* z, std::uint64_t form) {
  const std::uint32_t v = vertices_.intern(z, form);
  if (v < version_.size()) return v;
  const std::size_t at = positions_.size();
  positions_.resize(at + d_);
  displacements_.resize(at + d_, 0.0);
  triangulation_.cartesian({z, static_cast<std::size_t>(d_)}, {&positions_[at], static_cast<std::size_t>(d_)});
  version_.push_back(++last_version_);
  feet_.resize(feet_.size() + d_ + d_ * d_);
  foot_errors_.emplace_back();
  foot_version_.push_back(0);
  foot_exists_.push_back(0);
  stars_.emplace_back();
  return v;
}

void PerturbedTriangulation::set_displacement(std::uint32_t v, std::span<const double> u) {
  restore(v, u, ++last_version_);
}

void PerturbedTriangulation::displace(const DisplacementMap& displacements) {
  for (std::size_t i = 0; i < displacements.size(); ++i) {
    const std::int32_t* z = displacements.vertices()[i].data();
    set_displacement(enter_vertex(z, vertices_.form_of(z)), displacements.displacement(i));
  }
}

void PerturbedTriangulation::restore(std::uint32_t v, std::span<const double> u, std::uint64_t version) {
  double* x = &positions_[std::size_t{v} * d_];
  triangulation_.cartesian(lattice_vertex(v), {x, static_cast<std::size_t>(d_)});
  for (int c = 0; c < d_; ++c) {
    displacements_[std::size_t{v} * d_ + c] = u[c];
    x[c] += u[c];
  }
  version_[v] = version;
}

std::uint32_t PerturbedTriangulation::enter_simplex(std::uint32_t base, const std::uint8_t* order) {
  std::fill(key_.begin(), key_.end(), 0);
  simplices_.set_base(key_.data(), base);
  std::uint8_t* parts = simplices_.parts_of(key_.data());
  std::uint64_t digest = mix64(base + 0x9e3779b97f4a7c15ull);
  for (int q = 0; q < d_; ++q) parts[order[q]] = static_cast<std::uint8_t>(q);
  for (const std::uint64_t word : key_) digest = mix64(digest ^ word);
  const std::uint32_t s = simplices_.intern(key_.data(), digest);
  if (s < evaluation_stamp_.size()) return s;
  const std::size_t at = corners_.size();
  corners_.resize(at + d_ + 1);
  neighbours_.resize(at + d_ + 1, kUnknown);
  evaluations_.emplace_back();
  evaluation_stamp_.push_back(0);
  std::copy_n(vertices_.coordinates(base), d_, coordinates_.begin());
  std::uint64_t form = vertices_.form(base);
  corners_[at] = base;
  for (int q = 0; q < d_; ++q) {
    ++coordinates_[order[q]];
    form += vertices_.weights()[order[q]];
    corners_[at + q + 1] = enter_vertex(coordinates_.data(), form);
  }
  for (int q = 0; q <= d_; ++q) stars_[corners_[at + q]].push_back(s);
  return s;
}

coxeter::Simplex PerturbedTriangulation::simplex(std::uint32_t s) const {
  std::vector<std::uint16_t> parts(d_ + 1);
  for (int c = 0; c < d_; ++c) parts[c] = simplices_.parts(s)[c];
  parts[d_] = static_cast<std::uint16_t>(d_);
  return {coxeter::LatticeVertex(lattice_vertex(simplices_.base(s))),
          coxeter::OrderedPartition::from_part_indices(parts)};
}

std::uint32_t PerturbedTriangulation::locate(std::span<const double> x) {
  const coxeter::Simplex found = coxeter::locate_full(triangulation_, x);
  std::array<std::uint8_t, 32> order;
  for (int q = 0; q < d_; ++q) order[q] = static_cast<std::uint8_t>(found.partition().part(q)[0]);
  const std::uint32_t base = enter_vertex(found.base().data(), vertices_.form_of(found.base().data()));
  return enter_simplex(base, order.data());
}

std::uint32_t PerturbedTriangulation::neighbour(std::uint32_t s, int q) {
  const std::uint32_t known = neighbours_[std::size_t{s} * (d_ + 1) + q];
  if (known != kUnknown) return known;
  std::array<std::uint8_t, 32> order;
  const std::uint8_t* parts = simplices_.parts(s);
  for (int c = 0; c < d_; ++c) order[parts[c]] = static_cast<std::uint8_t>(c);
  std::uint32_t base = simplices_.base(s);
  int back = q;
  if (q == 0) {
    // The parts in the order of v_1, with the two around v_0 exchanged: (p_1 .. p_(d-1), p_0, d).
    base = corners(s)[1];
    std::rotate(order.begin(), order.begin() + 1, order.begin() + d_);
    back = d_;
  } else if (q == d_) {
    std::copy_n(vertices_.coordinates(base), d_, coordinates_.begin());
    const int last = order[d_ - 1];
    --coordinates_[last];
    base = enter_vertex(coordinates_.data(), vertices_.form(base) - vertices_.weights()[last]);
    std::rotate(order.begin(), order.begin() + d_ - 1, order.begin() + d_);
    back = 0;
  } else {
    std::swap(order[q - 1], order[q]);
  }
  const std::uint32_t other = enter_simplex(base, order.data());
  neighbours_[std::size_t{s} * (d_ + 1) + q] = other;
  neighbours_[std::size_t{other} * (d_ + 1) + back] = s;
  return other;
}

std::uint64_t PerturbedTriangulation::stamp(std::uint32_t s) const {
  std::uint64_t sum = 0;
  for (int q = 0; q <= d_; ++q) sum += mix64(version_[corners(s)[q]]);
  return sum | 1;
}

bool PerturbedTriangulation::project(const double* x, double* point, double* frame, FootErrors& errors) {
  const auto d = static_cast<std::size_t>(d_);
  ++oracle_calls_;
  return oracle_.foot({x, d}, {point, d}, {frame, d * d}, errors);
}

bool PerturbedTriangulation::foot(std::uint32_t s, std::uint16_t candidate, FootView& view) {
  const std::uint32_t* corner = corners(s);
  if (candidate >= 1 && candidate <= d_ + 1) {
    const std::uint32_t v = corner[candidate - 1];
    double* record = &feet_[std::size_t{v} * (d_ + d_ * d_)];
    if (foot_version_[v] != version_[v]) {
      foot_exists_[v] = project(position(v), record, record + d_, foot_errors_[v]);
      foot_version_[v] = version_[v];
    }
    view = {record, record + d_, foot_errors_[v]};
    return foot_exists_[v];
  }
  if (candidate == 0) {
    std::fill(scratch_.begin(), scratch_.end(), 0.0);
    for (int q = 0; q <= d_; ++q)
      for (int c = 0; c < d_; ++c) scratch_[c] += position(corner[q])[c];
    for (int c = 0; c < d_; ++c) scratch_[c] /= d_ + 1;
  } else {
    int edge = candidate - (d_ + 2), i = 0;
    while (edge >= d_ - i) edge -= d_ - i++;
    const int j = i + 1 + edge;
    for (int c = 0; c < d_; ++c) scratch_[c] = (position(corner[i])[c] + position(corner[j])[c]) / 2;
  }
  view = {own_foot_.data(), own_foot_.data() + d_, {}};
  return project(scratch_.data(), own_foot_.data(), own_foot_.data() + d_, view.errors);
}

bool PerturbedTriangulation::evaluate_at(std::uint32_t s, std::uint16_t candidate, Margins& margins, double enough,
                                         double useless) {
  FootView view{};
  if (candidate == Evaluation::kNoFoot || !foot(s, candidate, view)) return false;
  for (int q = 0; q <= d_; ++q) corner_positions_[q] = position(corners(s)[q]);
  margins = certificate_.evaluate(corner_positions_.data(), view, enough, useless);
  return true;
}

void PerturbedTriangulation::forget() { std::fill(evaluation_stamp_.begin(), evaluation_stamp_.end(), 0); }

void PerturbedTriangulation::remember(std::uint32_t s, const Evaluation& evaluation) {
  evaluations_[s] = evaluation;
  evaluation_stamp_[s] = stamp(s);
}

const Evaluation& PerturbedTriangulation::evaluate(std::uint32_t s, double enough, bool with_midpoints) {
  Evaluation& best = evaluations_[s];
  if (const std::uint64_t now = stamp(s); evaluation_stamp_[s] != now) {
    best = Evaluation{};
    evaluation_stamp_[s] = now;
  }
  const int end = d_ + 2 + (with_midpoints ? d_ * (d_ + 1) / 2 : 0);
  for (; best.tried < end && best.margin < enough; ++best.tried) {
    Margins margins;
    const bool first = best.candidate == Evaluation::kNoFoot;
    if (!evaluate_at(s, best.tried, margins, enough, first ? -1 : best.margin)) continue;
    const auto margin = static_cast<float>(margins.margin());
    if (!first && margin <= best.margin) continue;
    best.margin = margin;
    best.separation = static_cast<float>(margins.separation);
    best.transversality = static_cast<float>(margins.transversality);
    best.hit_facets = margins.hit_facets;
    best.candidate = best.tried;
  }
  return best;
}

}  // namespace whitney::perturbation
