// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace whitney {

/// Points of R^d, searched for by distance. Immutable, safe to call from several threads.
///
/// Our own, being shorter than the use of a library's: CGAL's search structures want compile-time kernels and bring a
/// dependency that nothing else here needs.
class KdTree {
 public:
  struct Neighbor {
    std::size_t index;  ///< into the points given
    double squared_distance;
  };

  /// points: m x d, m >= 1, all finite, else InvalidInput.
  KdTree(std::vector<double> points, int ambient_dim);

  std::size_t size() const { return order_.size(); }
  /// The point of this index: d numbers.
  std::span<const double> point(std::size_t index) const { return {&points_[place_[index] * dim_], dim_}; }

  /// The nearest point; of several, the one of least index. x: d.
  Neighbor nearest(std::span<const double> x) const;
  /// Sets `neighbors` to the points at distance at most `radius`, nearest first, then by index.
  void within(std::span<const double> x, double radius, std::vector<Neighbor>& neighbors) const;

 private:
  struct Node {
    std::size_t begin, end;  ///< leaf: its points
    std::size_t right;       ///< inner node: its right child (the left one is the next node); leaf: 0
    std::size_t axis;
    double low, high;  ///< inner node: the largest coordinate on the left, the smallest on the right
  };

  std::size_t build(const std::vector<double>& points, std::size_t begin, std::size_t end);
  /// Calls visit(place, squared distance) for the points of a node nearer than `bound`, which visit may lower.
  template <class Visit>
  void search(std::size_t node, const double* x, double& bound, const Visit& visit) const;

  std::size_t dim_;
  std::vector<double> points_;      ///< in the order of the leaves
  std::vector<std::size_t> order_;  ///< place -> index
  std::vector<std::size_t> place_;  ///< index -> place
  std::vector<Node> nodes_;
};

}  // namespace whitney
