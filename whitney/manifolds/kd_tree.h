// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace whitney {

/// Points of R^d, searched for by distance. Immutable, safe to call from several threads.
/// CGAL's kd-tree behind it, which stays out of this header.
class KdTree {
 public:
  struct Neighbor {
    std::size_t index;  ///< into the points given
    double squared_distance;
  };

  /// points: m x d, m >= 1, all finite, else InvalidInput.
  KdTree(std::vector<double> points, int ambient_dim);

  std::size_t size() const { return points_->size() / dim_; }
  /// The point of this index: d numbers.
  std::span<const double> point(std::size_t index) const { return {&(*points_)[index * dim_], dim_}; }

  /// The nearest point; of several, the one of least index. x: d.
  Neighbor nearest(std::span<const double> x) const;
  /// Sets `neighbors` to the points at distance at most `radius`, nearest first, then by index.
  void within(std::span<const double> x, double radius, std::vector<Neighbor>& neighbors) const;

 private:
  struct Tree;

  std::size_t dim_;
  std::shared_ptr<const std::vector<double>> points_;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace whitney
