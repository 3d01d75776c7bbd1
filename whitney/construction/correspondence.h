// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <whitney/manifolds/kd_tree.h>
#include <whitney/manifolds/submanifold.h>
#include <whitney/topology/mesh.h>

namespace whitney {

// The map between M and a triangulation K of it, both ways.
//
//   phi: K -> M      x |-> the foot (closest point) of x
//   its inverse      y |-> the x in K with x - y in the normal space N_y and abs(x - y) <= delta
//
// where no point of K is further than delta from M. For delta below the reach of M these x are all preimages of y: the
// points with foot y within the reach are those of N_y (Federer, Curvature measures, Theorem 4.8 (12)). So the inverse
// is one linear system of size n in each simplex near y. (BKW20, Sect. 7, compares K and M simplex by simplex along
// interpolated normals; the closest-point projection needs no choice, and tells in one go whether it is a bijection.)

/// The point of K above a point of M.
struct Preimage {
  enum class Status {
    kFound,      ///< one point
    kNone,       ///< no point of K within delta
    kAmbiguous,  ///< several: phi is not injective there; the nearest one is given
    kNoFoot,     ///< the oracle has no foot for the query
  };
  Status status = Status::kNone;
  std::uint32_t simplex = 0;        ///< of K
  std::vector<double> barycentric;  ///< n + 1 coordinates in it, >= 0, of sum 1
  std::vector<double> point;        ///< d
  double distance = 0;              ///< from M (a length)
  std::size_t num_points = 0;       ///< preimages that differ by more than 1e-7 times the longest edge

  bool found() const { return status == Status::kFound; }
};

/// K and M with an index for queries. Immutable, safe to call from several threads.
class Correspondence {
 public:
  /// mesh: K, n-simplices in R^d. distance_bound: delta (a length), no point of K is further from M; for Whitney's
  /// complex that is TriangulateResult::hausdorff_bound. A larger one only costs time as long as it is below the reach.
  /// Throws InvalidInput when the dimensions differ, the mesh is empty, an index is out of range, a coordinate is not
  /// finite, n > 15 or d > 31, or distance_bound is not finite or is negative.
  Correspondence(SimplicialMesh mesh, Submanifold manifold, double distance_bound);

  const SimplicialMesh& mesh() const { return mesh_; }
  const Submanifold& manifold() const { return manifold_; }
  double distance_bound() const { return distance_bound_; }

  /// phi: the foot of x; d. Empty when the oracle has none.
  std::vector<double> to_manifold(std::span<const double> x) const;
  /// The inverse of phi at the foot of y; y: d. Looks at the simplices with a point within delta of y: a search in
  /// a kd-tree over their barycentres, so O(log + simplices near y) when they are of similar size.
  Preimage from_manifold(std::span<const double> y) const;
  /// Carries a function from K to M: its value at y, interpolated linearly in the simplex of K above y.
  /// values: num_points x components, one row per vertex of K. Empty unless the preimage is one point. Throws
  /// InvalidInput when the sizes do not fit.
  std::optional<std::vector<double>> carry(std::span<const double> values, int components,
                                           std::span<const double> y) const;

 private:
  SimplicialMesh mesh_;
  Submanifold manifold_;
  double distance_bound_;
  std::vector<double> radius_;  // per simplex: of a ball about its barycentre
  double largest_radius_ = 0, longest_edge_ = 0;
  KdTree barycentres_;
};

struct CorrespondenceCheckOptions {
  /// A simplex is bisected at most this often until the angle with the tangent spaces is bounded on all of it.
  int max_depth = 12;
  /// Asked every few dozen simplices; false stops the check, which then shows nothing.
  std::function<bool()> keep_going{};
};

/// What check_correspondence found. The conditions, for K with every point within delta < R of M, R the reach:
///  (1) every facet lies in exactly two simplices;
///  (2) at every x in a simplex s the angle between aff s and the tangent space at phi(x) is below pi/2. Bounded from
///      the foot p of the barycentre of a piece of s of radius r: for x in it phi(x) is joined to p on M by a path of
///      length at most r R / (R - delta) (Federer, 4.8 (8)), along which the tangent space turns by at most that over
///      the curvature radius;
///  (3) the two simplices at a facet f project to different sides of f, in the tangent space at the foot of its
///      barycentre (then at all of f, by (2));
///  (4) for one point in every component of K, no other point of K has the same foot.
/// Then phi: K -> M is a homeomorphism onto the components of M that K is near, orientable or not. Proof: by (2) phi is
/// injective on each simplex (phi(x) = phi(x') = p puts x - x' into aff s and N_p), by (3) a local homeomorphism off
/// the (n-2)-skeleton, whose image does not disconnect M; so the number of preimages is constant off that image, and 1
/// by (4). A point y of the image with two preimages would give two to points near y, as each small star covers a
/// neighbourhood of y by the same argument. In floating point, not in intervals; it rests on the reach and the
/// curvature.
struct CorrespondenceCheck {
  bool homeomorphism = false;     ///< (1)-(4) hold
  bool within_reach = false;      ///< delta < R
  std::size_t components = 0;     ///< of K, connected through facets
  std::size_t bad_facets = 0;     ///< against (1)
  std::size_t steep = 0;          ///< simplices for which (2) was not shown
  std::size_t folded_facets = 0;  ///< against (3)
  std::size_t covered_twice = 0;  ///< components against (4)
  std::size_t feet_missing = 0;   ///< places without a foot
  double angle_max = 0;           ///< largest angle seen in (2) (radians)
  double angle_at_vertices_max =
      0;               ///< largest angle between a simplex and the tangent space at a foot of its vertices
  std::string reason;  ///< of the first condition that fails; empty when none does
};

/// Decides whether phi is a homeomorphism, see CorrespondenceCheck. bending: of M; the result rests on it.
/// O(simplices) calls of the oracle. Throws InvalidInput when reach is not positive or the mesh has a simplex twice.
CorrespondenceCheck check_correspondence(const Correspondence& correspondence, const Bending& bending,
                                         const CorrespondenceCheckOptions& options = {});

}  // namespace whitney
