// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/place_on_manifold.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <whitney/construction/distance_bound.h>

namespace whitney {
namespace {

using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

class Placer {
 public:
  Placer(const Submanifold& manifold, const Bending& bending)
      : manifold_(manifold),
        d_(manifold.ambient_dim()),
        n_(manifold.intrinsic_dim()),
        bending_(bending),
        point_(d_),
        frame_(static_cast<std::size_t>(d_) * d_) {}

  /// M ∩ sigma near x; corners: d x (k+1).
  std::optional<Eigen::VectorXd> place(const Eigen::MatrixXd& corners, Eigen::VectorXd x) {
    const int k = d_ - n_;
    const double size = (corners.colwise() - corners.col(0)).colwise().norm().maxCoeff();
    Eigen::MatrixXd system(k + 1, k + 1);
    system.row(0).setOnes();
    Eigen::VectorXd right = Eigen::VectorXd::Zero(k + 1);
    right(0) = 1;
    double previous = std::numeric_limits<double>::infinity();
    bool inside = false;
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      if (!foot(x)) return std::nullopt;
      const Eigen::Map<const Eigen::VectorXd> p(point_.data(), d_);
      const double distance = (x - p).norm();
      if (inside && (distance <= 1e-14 * size || (distance <= 1e-8 * size && distance >= previous / 2))) return x;
      previous = distance;
      system.bottomRows(k) = Rows(frame_.data(), d_, d_).bottomRows(k) * (corners.colwise() - p);
      const Eigen::VectorXd lambda = system.partialPivLu().solve(right);
      inside = (lambda.array() > 0).all();  // not for NaN
      if (!lambda.allFinite()) return std::nullopt;
      x = corners * lambda;
    }
    return std::nullopt;
  }

  /// See PlacedComplex::distance_bound; points: d x any.
  std::optional<double> distance_bound(const Eigen::MatrixXd& points) {
    const std::span<const double> all(points.data(), static_cast<std::size_t>(points.size()));
    for (Eigen::Index from = -1; from < points.cols(); ++from) {
      const Eigen::VectorXd x = from < 0 ? Eigen::VectorXd(points.rowwise().mean()) : Eigen::VectorXd(points.col(from));
      if (!foot(x)) continue;
      if (const auto bound = distance_from_manifold(all, d_, n_, {point_.data(), frame_.data(), errors_}, bending_))
        return bound;
    }
    return std::nullopt;
  }

 private:
  static constexpr int kMaxIterations = 20;

  bool foot(const Eigen::VectorXd& x) {
    return manifold_.project({x.data(), static_cast<std::size_t>(d_)}, point_, frame_, errors_);
  }

  const Submanifold& manifold_;
  int d_, n_;
  Bending bending_;
  std::vector<double> point_, frame_;
  FootErrors errors_;
};

/// The 0-cells of every n-cell.
Incidence corners_of(const CellComplex& complex) {
  Incidence corners;
  std::vector<std::uint32_t> cells, below;
  for (std::uint32_t i = 0; i < complex.num_cells(complex.intrinsic_dim); ++i) {
    cells = {i};
    for (int j = complex.intrinsic_dim; j > 0; --j) {
      below.clear();
      for (const std::uint32_t cell : cells)
        below.insert(below.end(), complex.facets[j][cell].begin(), complex.facets[j][cell].end());
      std::sort(below.begin(), below.end());
      below.erase(std::unique(below.begin(), below.end()), below.end());
      cells.swap(below);
    }
    corners.index.insert(corners.index.end(), cells.begin(), cells.end());
    corners.offset.push_back(static_cast<std::uint32_t>(corners.index.size()));
  }
  return corners;
}

}  // namespace

PlacedComplex place_on_manifold(CellComplex complex, const coxeter::Triangulation& triangulation,
                                const perturbation::DisplacementMap& displacements, const Submanifold& manifold,
                                const Bending& bending, const std::function<bool()>& keep_going) {
  const int d = complex.ambient_dim, k = d - complex.intrinsic_dim;
  if (manifold.ambient_dim() != d || manifold.codim() != k || triangulation.ambient_dim() != d ||
      displacements.ambient_dim() != d)
    throw InvalidInput("place_on_manifold: the arguments have different dimensions");
  if (!(bending.reach > 0)) throw InvalidInput("place_on_manifold: reach must be positive");
  PlacedComplex result;
  const auto go_on = [&](std::size_t i) {
    if (i % 64 == 63 && keep_going && !keep_going()) result.complete = false;
    return result.complete;
  };
  Placer placer(manifold, bending);
  Eigen::MatrixXd corners(d, k + 1);
  for (std::size_t i = 0; i < complex.num_cells(0) && go_on(i); ++i) {
    const coxeter::Simplex simplex = complex.simplex(0, i);
    for (int q = 0; q <= k; ++q)
      corners.col(q) = as_eigen(perturbation::position(triangulation, displacements, simplex.vertex(q)));
    Eigen::Map<Eigen::VectorXd> x(&complex.points[i * d], d);
    if (const auto placed = placer.place(corners, x)) {
      x = *placed;
      ++result.placed;
    } else {
      ++result.kept;
    }
  }
  const Incidence cells = corners_of(complex);
  Eigen::MatrixXd points;
  std::optional<double> largest = 0;
  for (std::size_t i = 0; i < cells.size() && largest && go_on(i); ++i) {
    points.resize(d, static_cast<Eigen::Index>(cells[i].size()));
    for (Eigen::Index q = 0; q < points.cols(); ++q)
      points.col(q) = Eigen::Map<const Eigen::VectorXd>(&complex.points[std::size_t{cells[i][q]} * d], d);
    const std::optional<double> bound = placer.distance_bound(points);
    largest = bound ? std::optional(std::max(*largest, *bound)) : std::nullopt;
  }
  if (result.complete) result.distance_bound = largest;
  result.complex = std::move(complex);
  return result;
}

}  // namespace whitney
