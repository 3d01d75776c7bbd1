// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <coxeter/triangulation.h>
#include <perturbation/foot_oracle.h>
#include <perturbation/perturbed_triangulation.h>

namespace whitney::perturbation {

/// A circle in the plane. Its feet, and what it says of them, can be told otherwise.
class CircleOracle : public FootOracle {
 public:
  CircleOracle(double x, double y, double radius) : x_(x), y_(y), radius_(radius) {}
  int ambient_dim() const override { return 2; }
  int intrinsic_dim() const override { return 1; }
  double reach() const override { return radius_; }
  double curvature_radius() const override { return radius_; }
  ReachSource reach_source() const override { return source; }
  FootPromise promise() const override { return promised; }
  bool foot(std::span<const double> x, std::span<double> point, std::span<double> frame,
            FootErrors& errors) const override {
    const double a = x[0] - x_, b = x[1] - y_, length = std::hypot(a, b);
    if (!(length > 1e-9)) return false;
    point[0] = x_ + radius_ * a / length;
    point[1] = y_ + radius_ * b / length;
    const double rows[] = {-b / length, a / length, a / length, b / length};
    std::copy(std::begin(rows), std::end(rows), frame.begin());
    errors = {1e-14, 1e-14};
    return true;
  }

  ReachSource source = ReachSource::kProven;
  FootPromise promised{FootPromise::Place::kGlobal, FootPromise::Errors::kProven};

 private:
  double x_, y_, radius_;
};

/// The corners of the triangle of the triangulation that holds (x, y): 3 x 2.
inline std::vector<double> triangle_at(const coxeter::Triangulation& triangulation, double x, double y) {
  const CircleOracle any(0, 0, 1);
  PerturbedTriangulation near(triangulation, any);
  const double point[] = {x, y};
  const std::uint32_t s = near.locate(point);
  std::vector<double> corners;
  for (int q = 0; q <= 2; ++q)
    corners.insert(corners.end(), near.position(near.corners(s)[q]), near.position(near.corners(s)[q]) + 2);
  return corners;
}

}  // namespace whitney::perturbation
