// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/kd_tree.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <CGAL/Euclidean_distance.h>
#include <CGAL/Fuzzy_sphere.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits.h>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

/// A point as CGAL sees it: its coordinates stay where they are.
struct Site {
  const double* first = nullptr;
  std::size_t dim = 0;
  std::size_t index = 0;
};

struct Coordinates {
  using result_type = const double*;
  const double* operator()(const Site& site) const { return site.first; }
  const double* operator()(const Site& site, int) const { return site.first + site.dim; }
};

using Traits = CGAL::Search_traits<double, Site, const double*, Coordinates, CGAL::Dynamic_dimension_tag>;
using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;
using Sphere = CGAL::Fuzzy_sphere<Traits>;

/// In the order of the coordinates: the same bits wherever it is asked for.
double squared_distance(std::span<const double> x, const double* y) {
  double squared = 0;
  for (std::size_t c = 0; c < x.size(); ++c) squared += (x[c] - y[c]) * (x[c] - y[c]);
  return squared;
}

bool nearer(const KdTree::Neighbor& a, const KdTree::Neighbor& b) {
  return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance : a.index < b.index;
}

/// Rounding may take a distance over a bound that it does not exceed: CGAL searches a little further.
constexpr double kWider = 1 + 1e-9;

}  // namespace

struct KdTree::Tree {
  Search::Tree tree;

  explicit Tree(const std::vector<Site>& sites) : tree(sites.begin(), sites.end()) {
    tree.build();  // now, so that searches do not write
  }

  /// Adds the points within about `radius` of x, with their exact squared distances.
  void collect(std::span<const double> x, double radius, std::vector<Neighbor>& neighbors) const {
    std::vector<Site> found;
    tree.search(std::back_inserter(found), Sphere(Site{x.data(), x.size(), 0}, radius * kWider));
    for (const Site& site : found) neighbors.push_back({site.index, squared_distance(x, site.first)});
  }
};

KdTree::KdTree(std::vector<double> points, int ambient_dim) : dim_(static_cast<std::size_t>(ambient_dim)) {
  if (ambient_dim < 1 || points.empty() || points.size() % dim_ != 0)
    throw InvalidInput("KdTree: m x d coordinates are needed, m >= 1");
  for (const double c : points)
    if (!std::isfinite(c)) throw InvalidInput("KdTree: a coordinate is not finite");
  points_ = std::make_shared<const std::vector<double>>(std::move(points));
  std::vector<Site> sites;
  for (std::size_t i = 0; i < size(); ++i) sites.push_back({points_->data() + i * dim_, dim_, i});
  tree_ = std::make_shared<const Tree>(sites);
}

KdTree::Neighbor KdTree::nearest(std::span<const double> x) const {
  if (x.size() != dim_) throw InvalidInput("KdTree: x must have d coordinates");
  const Search search(tree_->tree, Site{x.data(), dim_, 0}, 2);
  const auto neighbor = [&](const Site& site) { return Neighbor{site.index, squared_distance(x, site.first)}; };
  const Neighbor first = neighbor(search.begin()->first);
  const auto next = std::next(search.begin());
  if (next == search.end() || neighbor(next->first).squared_distance > first.squared_distance * kWider) return first;
  std::vector<Neighbor> ties;
  tree_->collect(x, std::sqrt(first.squared_distance), ties);
  ties.push_back(first);
  return *std::min_element(ties.begin(), ties.end(), nearer);
}

void KdTree::within(std::span<const double> x, double radius, std::vector<Neighbor>& neighbors) const {
  if (x.size() != dim_) throw InvalidInput("KdTree: x must have d coordinates");
  neighbors.clear();
  tree_->collect(x, radius, neighbors);
  std::erase_if(neighbors, [&](const Neighbor& neighbor) { return neighbor.squared_distance > radius * radius; });
  std::sort(neighbors.begin(), neighbors.end(), nearer);
}

}  // namespace whitney
