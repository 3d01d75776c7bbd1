// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <coxeter/triangulation.h>
#include <perturbation/foot_oracle.h>
#include <perturbation/perturbed_triangulation.h>
#include <whitney/functions/domain.h>
#include <whitney/manifolds/submanifold.h>

namespace whitney {

/// A submanifold and what is known of its bending, as the perturbation asks for it. Keeps references to all arguments.
class SubmanifoldOracle : public perturbation::FootOracle {
 public:
  /// box: M lies inside it, or foot() throws InvalidInput, naming the place. A foot further from x than edge_length
  /// says nothing about the part of M that is being walked along, and is not looked at.
  SubmanifoldOracle(const Submanifold& manifold, const Bending& bending, const std::optional<Box>& box,
                    double edge_length)
      : manifold_(manifold), bending_(bending), box_(box), edge_length_(edge_length) {}

  int ambient_dim() const override { return manifold_.ambient_dim(); }
  int intrinsic_dim() const override { return manifold_.intrinsic_dim(); }
  double reach() const override { return bending_.reach; }
  double curvature_radius() const override;
  perturbation::ReachSource reach_source() const override { return bending_.source; }
  FootPromise promise() const override { return manifold_.promise(); }
  bool foot(std::span<const double> x, std::span<double> point, std::span<double> frame,
            FootErrors& errors) const override;

 private:
  void check_inside(std::span<const double> x, std::span<const double> point) const;

  const Submanifold& manifold_;
  const Bending& bending_;
  const std::optional<Box>& box_;
  double edge_length_;
};

/// The d-simplices that g >= 0 may meet: no inequality is violated at all vertices, of T, not displaced. A
/// perturbation::Region; the masks of the vertices are remembered by their numbers, so one object per
/// PerturbedTriangulation. Keeps references to both arguments.
class DomainRegion {
 public:
  DomainRegion(const Domain& domain, const coxeter::Triangulation& triangulation)
      : domain_(domain), triangulation_(triangulation) {}

  /// Throws OracleError, naming the place, when an inequality is not finite.
  bool operator()(const perturbation::PerturbedTriangulation& near, std::uint32_t simplex);

 private:
  void add(const perturbation::PerturbedTriangulation& near, std::uint32_t v);

  const Domain& domain_;
  const coxeter::Triangulation& triangulation_;
  std::vector<std::uint64_t> masks_;
  std::size_t known_ = 0;
};

}  // namespace whitney
