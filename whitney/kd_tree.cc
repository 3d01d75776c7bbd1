// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/error.h>
#include <whitney/kd_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace whitney {
namespace {

constexpr std::size_t kLeafSize = 8;

}  // namespace

KdTree::KdTree(std::vector<double> points, int ambient_dim) : dim_(static_cast<std::size_t>(ambient_dim)) {
  if (ambient_dim < 1 || points.empty() || points.size() % dim_ != 0)
    throw InvalidInput("KdTree: m x d coordinates are needed, m >= 1");
  for (const double c : points)
    if (!std::isfinite(c)) throw InvalidInput("KdTree: a coordinate is not finite");
  order_.resize(points.size() / dim_);
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  build(points, 0, order_.size());
  points_.resize(points.size());
  place_.resize(order_.size());
  for (std::size_t place = 0; place < order_.size(); ++place) {
    std::copy_n(&points[order_[place] * dim_], dim_, &points_[place * dim_]);
    place_[order_[place]] = place;
  }
}

std::size_t KdTree::build(const std::vector<double>& points, std::size_t begin, std::size_t end) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({begin, end, 0, 0, 0, 0});
  if (end - begin <= kLeafSize) return node;
  std::size_t axis = 0;
  double widest = 0;
  for (std::size_t c = 0; c < dim_; ++c) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = begin; i < end; ++i) {
      low = std::min(low, points[order_[i] * dim_ + c]);
      high = std::max(high, points[order_[i] * dim_ + c]);
    }
    if (high - low > widest) {
      widest = high - low;
      axis = c;
    }
  }
  if (!(widest > 0)) return node;  // the same point many times
  const std::size_t middle = begin + (end - begin) / 2;
  const auto first = order_.begin();
  const auto coordinate = [&](std::size_t index) { return points[index * dim_ + axis]; };
  std::nth_element(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(middle),
                   first + static_cast<std::ptrdiff_t>(end), [&](std::size_t a, std::size_t b) {
                     return coordinate(a) != coordinate(b) ? coordinate(a) < coordinate(b) : a < b;
                   });
  double low = coordinate(order_[begin]);
  for (std::size_t i = begin; i < middle; ++i) low = std::max(low, coordinate(order_[i]));
  const double high = coordinate(order_[middle]);
  build(points, begin, middle);
  const std::size_t right = build(points, middle, end);
  nodes_[node].right = right;
  nodes_[node].axis = axis;
  nodes_[node].low = low;
  nodes_[node].high = high;
  return node;
}

template <class Visit>
void KdTree::search(std::size_t index, const double* x, double& bound, const Visit& visit) const {
  const Node& node = nodes_[index];
  if (node.right == 0) {
    for (std::size_t place = node.begin; place < node.end; ++place) {
      double squared = 0;
      for (std::size_t c = 0; c < dim_; ++c) {
        const double difference = x[c] - points_[place * dim_ + c];
        squared += difference * difference;
      }
      if (squared <= bound) visit(place, squared);
    }
    return;
  }
  const double to_left = std::max(0.0, x[node.axis] - node.low), to_right = std::max(0.0, node.high - x[node.axis]);
  const bool left_first = to_left <= to_right;
  const double far = std::max(to_left, to_right);
  search(left_first ? index + 1 : node.right, x, bound, visit);
  if (far * far <= bound) search(left_first ? node.right : index + 1, x, bound, visit);
}

KdTree::Neighbor KdTree::nearest(std::span<const double> x) const {
  if (x.size() != dim_) throw InvalidInput("KdTree: x must have d coordinates");
  double bound = std::numeric_limits<double>::infinity();
  Neighbor best{order_.size(), bound};
  search(0, x.data(), bound, [&](std::size_t place, double squared) {
    if (squared == best.squared_distance && order_[place] > best.index) return;
    best = {order_[place], squared};
    bound = squared;
  });
  return best;
}

void KdTree::within(std::span<const double> x, double radius, std::vector<Neighbor>& neighbors) const {
  if (x.size() != dim_) throw InvalidInput("KdTree: x must have d coordinates");
  neighbors.clear();
  double bound = radius * radius;
  search(0, x.data(), bound, [&](std::size_t place, double squared) { neighbors.push_back({order_[place], squared}); });
  std::sort(neighbors.begin(), neighbors.end(), [](const Neighbor& a, const Neighbor& b) {
    return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance : a.index < b.index;
  });
}

}  // namespace whitney
