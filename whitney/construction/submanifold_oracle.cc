// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/submanifold_oracle.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

std::string place(std::span<const double> x) {
  std::ostringstream text;
  for (std::size_t c = 0; c < x.size(); ++c) text << (c == 0 ? "(" : ", ") << x[c];
  return text.str() + ")";
}

}  // namespace

double SubmanifoldOracle::curvature_radius() const { return std::max(bending_.reach, bending_.curvature_radius); }

bool SubmanifoldOracle::foot(std::span<const double> x, std::span<double> point, std::span<double> frame,
                             FootErrors& errors) const {
  if (!manifold_.project(x, point, frame, errors)) return false;
  if (box_) check_inside(x, point);
  return true;
}

void SubmanifoldOracle::check_inside(std::span<const double> x, std::span<const double> point) const {
  const double rounding = 1e-9 * edge_length_;
  bool inside = true;
  double squared = 0;
  for (std::size_t c = 0; c < x.size(); ++c) {
    inside = inside && point[c] >= box_->lower[c] - rounding && point[c] <= box_->upper[c] + rounding;
    squared += (x[c] - point[c]) * (x[c] - point[c]);
  }
  if (!inside && squared <= edge_length_ * edge_length_)
    throw InvalidInput("the manifold leaves the box, at " + place(point) +
                       ": only a closed manifold inside its box can be triangulated; make the box larger");
}

bool DomainRegion::operator()(const perturbation::PerturbedTriangulation& near, std::uint32_t simplex) {
  const std::size_t words = domain_.num_words();
  std::vector<std::uint64_t> all(words, ~std::uint64_t{0});
  for (int q = 0; q <= near.ambient_dim(); ++q) {
    const std::uint32_t v = near.corners(simplex)[q];
    for (; known_ <= v; ++known_) add(near, static_cast<std::uint32_t>(known_));
    for (std::size_t word = 0; word < words; ++word) all[word] &= masks_[v * words + word];
  }
  return std::all_of(all.begin(), all.end(), [](std::uint64_t bits) { return bits == 0; });
}

void DomainRegion::add(const perturbation::PerturbedTriangulation& near, std::uint32_t v) {
  std::vector<double> x(near.ambient_dim());
  triangulation_.cartesian(near.lattice_vertex(v), x);
  const std::vector<double> g = domain_.values(x);
  for (std::size_t j = 0; j < g.size(); ++j)
    if (!std::isfinite(g[j])) throw OracleError(domain_.name(static_cast<int>(j)) + " is not finite at " + place(x));
  masks_.resize(masks_.size() + domain_.num_words());
  domain_.set_mask(x.data(), g.data(), &masks_[masks_.size() - domain_.num_words()]);
}

}  // namespace whitney
