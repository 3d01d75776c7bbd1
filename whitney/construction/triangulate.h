// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
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
  /// The seed points were found by a search, and not given by somebody who knows the components of M.
  bool seeds_were_searched = false;
  /// Limits. max_simplices counts d-simplices, about 1 KB each. The phases are "perturb", "certify", "complex",
  /// "place". After "perturb" has been stopped, what was found by then is certified and cut out all the same, as long
  /// as that does not take much longer; what was left out is named.
  RunControl run{.max_simplices = 20'000'000};
};

/// Which components of M a verdict speaks of.
enum class Components {
  kOfGivenSeeds,     ///< those that the seed points lie on
  kOfSearchedSeeds,  ///< those that the seed points found by a search lie on: likely all of M, not proved
  kAll               ///< all of M, which is connected by its definition
};

/// "seeds_given", "seeds_searched", "connected_by_definition".
const char* to_string(Components components);

/// What a verdict rests on, besides IEEE arithmetic and what was computed from the positions as stored.
struct Ingredients {
  Bending::Source reach = Bending::Source::kCaller;  ///< who vouches for reach and curvature
  FootPromise feet;                                  ///< what the oracle vouches for; feet.errors kModelled: no proof
  Components components = Components::kOfGivenSeeds;

  /// Whether a verdict is a proof as it stands: nobody's word, no estimate, no model of errors. The components that it
  /// speaks of are a matter of their own.
  bool are_proven() const { return reach == Bending::Source::kProven && feet.errors == FootPromise::Errors::kProven; }
};

/// What the feet of the vertices near M say of the reach that was claimed (see reach_claim.h). A contradiction is a
/// proof when the feet are (Ingredients::feet); with modelled errors it may be the feet that are wrong.
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
  /// A claimed reach that the feet contradict, and a seed outside the certified simplices, make the verdict "not
  /// certified". "certified" means: K is homeomorphic to the components of M that `ingredients` names.
  perturbation::CertificateReport certificate;
  Ingredients ingredients;
  ReachCheck reach_check;
  std::vector<perturbation::RepairRound> rounds;
  /// Lattice vertices of the d-simplices that M meets, their displacements, and the d-simplices.
  std::size_t vertices_near = 0, vertices_moved = 0;
  /// A bound of the Hausdorff distance between K and the components of M that the verdict speaks of (a length), see
  /// distance_bound.h. Empty when there is none: not certified, cut, or simplices too large for it.
  std::optional<double> hausdorff_bound;
  /// Seed points whose walks were started (distinct simplices), others that led to the same simplex, and those without
  /// a foot.
  std::size_t seeds_used = 0, seeds_merged = 0, seeds_dropped = 0;
  /// m x d: seed points (as given) whose feet are not proved to lie in certified simplices, so that their component may
  /// not be the one that K is homeomorphic to.
  std::vector<double> seeds_outside;
  std::size_t oracle_evaluations = 0;
  StopReason stop_reason = StopReason::kNone;  ///< what of TriangulateOptions::run stopped it
  std::vector<std::string> left_out;           ///< phases that were not run, or not to their end, for that reason
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
/// seed_points: m x d; a trace starts near the foot of each. The result is about the components of M that these feet
/// lie on: a seed whose foot is not proved to lie in certified simplices (of T~, as displaced) is named, and nothing is
/// certified. Seeds without a foot, and those outside the inequalities, do not count.
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
