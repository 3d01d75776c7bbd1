// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <coxeter/base/run_control.h>
#include <coxeter/triangulation.h>
#include <perturbation/repair.h>
#include <perturbation/sequential.h>
#include <perturbation/verdict.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/functions/domain.h>
#include <whitney/manifolds/submanifold.h>

namespace whitney {

struct TriangulateOptions {
  /// How the vertices are displaced: not at all, by repair (see perturbation/repair.h), or by the sequential scheme of
  /// BKW20 (see perturbation/sequential.h: small codimension, smaller edge lengths).
  enum class Scheme { kNone, kRepair, kSequential };
  Scheme scheme = Scheme::kRepair;
  /// No vertex moves further than this fraction of half the width of the d-simplices; below 1, so that the
  /// triangulation stays embedded.
  double displacement_fraction = 0.999;
  /// M lies inside this box, or it is an error: an unbounded manifold is found out where it leaves.
  std::optional<Box> box;
  /// g: R^d -> R^m: only the part of M near g >= 0 is triangulated and certified: d-simplices whose vertices (of T, not
  /// displaced) all violate the same inequality are not entered. The complex is made of whole simplices, so it ends
  /// beyond g = 0, by less than an edge length; it is not placed on M, and there is no Hausdorff bound from M to K.
  std::optional<Function> inequalities;
  std::uint64_t rng_seed = 1;
  int max_rounds = 16;
  /// Moves the 0-cells onto M when the result is certified (see place_on_manifold.h): without, K may have steep
  /// simplices where two of them are close together.
  bool place_on_manifold = true;
  bool check_reach = true;  ///< compare the claimed reach with all feet seen
  /// Limits. max_simplices counts d-simplices, about 1 KB each. The phases are "perturb", then "certify".
  RunControl run{.max_simplices = 20'000'000};
};

/// What the feet of the vertices near M say of the reach that was claimed (see reach_claim.h).
struct ReachCheck {
  bool consistent = true;
  double largest_possible = std::numeric_limits<double>::infinity();  ///< the largest reach that they leave possible
  std::vector<double> p, q;                                           ///< d each: the two points of M that say so
};

/// Whitney's complex of a submanifold and what is proved of it.
struct TriangulateResult {
  /// The cells M ∩ mu, replaced by polytopes: a j-cell for every (k+j)-simplex of T~ that M meets, its 0-cells points
  /// inside the hit k-simplices, on M if they were placed there. K is barycentric_subdivision(complex). Empty when
  /// nothing was found.
  CellComplex complex;
  /// A claimed reach that the feet contradict makes the verdict "not certified".
  perturbation::CertificateReport certificate;
  ReachCheck reach_check;
  std::vector<perturbation::RepairRound> rounds;
  /// Lattice vertices of the d-simplices that M meets, their displacements, and the d-simplices.
  std::size_t vertices_near = 0, vertices_moved = 0;
  /// A bound of the distance of every point of K from M (a length), and, when certified, of every point of M from K:
  /// the closest-point projection of K then covers M. Infinite when some simplex is not certified.
  double hausdorff_bound = std::numeric_limits<double>::infinity();
  std::size_t seeds_used = 0, seeds_merged = 0, seeds_dropped = 0;
  std::size_t oracle_evaluations = 0;
  StopReason stop_reason = StopReason::kNone;  ///< what of TriangulateOptions::run stopped it
  double edge_length = 0;                      ///< of the triangulation (a length)
  bool cut = false;  ///< M goes on beyond the complex, where the inequalities of the options end
  double seconds_perturb = 0, seconds_certify = 0, seconds_complex = 0;
  /// The perturbed triangulation: displacements of the lattice vertices that moved.
  perturbation::DisplacementMap displacements{1};
};

/// Whitney's construction: displaces the vertices of the triangulation until every simplex that M meets is certified,
/// proves that in interval arithmetic, and cuts out the complex. Source: BKW20; the certificate:
/// perturbation/README.md.
///
/// seed_points: m x d; a trace starts near the foot of each. The result is about the components of M that they lie on.
/// With options.inequalities, "certified" means: K is homeomorphic to the part of M in the union of the certified
/// simplices, which holds every point that a path in M joins to a seed with all d-simplices along it entered; so away
/// from the boundary the topology is right, and nothing is said of M beyond. bending: what is known of M (reach and
/// curvature); the verdict rests on it. triangulation: Coxeter or Freudenthal, moved and scaled, with d <= 31, or any
/// other affine image with d <= 12. Throws InvalidInput on sizes that do not fit, values that are not finite, or a
/// manifold that leaves options.box (the message names the place), OracleError when the oracle fails.
TriangulateResult triangulate(const Submanifold& manifold, const Bending& bending,
                              const coxeter::Triangulation& triangulation, std::span<const double> seed_points,
                              const TriangulateOptions& options = {});

}  // namespace whitney
