// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <perturbation/hit_walk.h>

namespace whitney::perturbation {

struct SequentialOptions {
  /// The radius of the ball in which a vertex is moved (a length). 0: c~ L of BKW20 (6), as corrected, see
  /// parameters.h; meant for coxeter_a. Below half of embedding_bound().
  double max_displacement = 0;
  /// A position is accepted when its distance from every span is at least this part of the radius. 0: rho_1 of
  /// BKW20 (5), as corrected, for which such a position exists. Infinity: always the best of all candidates.
  double min_distance = 0;
  /// Positions tried for a vertex before the best of them is taken: its lattice position and random ones.
  int candidates = 64;
  std::uint64_t rng_seed = 1;
  /// Feet are tried until the margin of a simplex is at least this.
  double accept = 1.02;
  int max_rounds = 50;
  Region region{};  ///< of the traces
  /// Limits of the whole scheme. max_simplices: of each trace. The phase is "perturb".
  RunControl run{.max_simplices = 20'000'000};
};

/// One trace and what it met.
struct SequentialRound {
  std::size_t vertices = 0;                ///< lattice vertices known before the trace, all of them in their places
  std::size_t simplices = 0, failing = 0;  ///< d-simplices visited, and those with a margin below `accept`
  std::size_t hit = 0;                     ///< those of them that a tangent plane meets
  double worst_margin = 0;
};

struct SequentialResult {
  std::vector<SequentialRound> rounds;  ///< the last one is the state at the end
  std::size_t placed = 0;               ///< vertices closer to M than 3 L / 2, which were given a place
  std::size_t moved = 0;                ///< those of them that left their lattice position
  std::size_t below = 0;                ///< those of them of which no candidate had min_distance
  /// The least distance of a placed vertex from a span, over the radius.
  double least_distance = std::numeric_limits<double>::infinity();
  /// Over the simplices of the last trace, each at its best foot: see Margins.
  double worst_separation = 0, worst_transversality = 0;
  bool all_accepted = false;  ///< every simplex of the last trace has a margin of at least `accept`
  StopReason stop_reason = StopReason::kNone;
  /// Nothing stopped it, and the last trace met no vertex without a place; otherwise some stand where they stood.
  bool complete = true;
  std::size_t oracle_calls = 0;  ///< to place vertices; those of the traces are counted by `near`
};

/// The most spans a vertex may have to avoid; see sequential.
inline constexpr double kMaxSpans = 1e5;

/// The colour of a lattice vertex: the sum of its coordinates mod (d+1). Adjacent vertices have different colours, and
/// the vertices of a d-simplex have all of them.
int colour(std::span<const std::int32_t> vertex);

/// The first part of Whitney's method as in BKW20, Sect. 5.2: a vertex v of T with d(v, M) >= 3 L / 2 stays; any other
/// is moved within a ball so that it is far from span(tau', T_p M), p the foot of v, for every face tau' of dimension
/// at most k - 2 (the empty one among them) of the simplices around v, all of whose vertices have their places already.
/// Vertices are taken in the order of their colours, so that v waits for its neighbours of smaller colour only: its
/// place is a function of v and rng_seed, whatever else was asked. A larger span contains the smaller ones, so only the
/// faces with min(k - 1, colour of v) vertices are looked at.
///
/// The paper's radius, number of spans and edge length together guarantee the result. With a larger edge length there
/// is no guarantee: look at all_accepted. Traces outward from `starts` (simplices that the manifold meets; one that it
/// leaves as vertices move is replaced by the nearest that it meets) until every
/// vertex of every simplex visited has its place, and leaves the displacements in `near`.
///
/// Measured on unit spheres, with the largest displacement that embedding_bound() allows, min_distance 1, 64
/// candidates and 10 seeds: every run is accepted at L = 0.6 (S^1 in R^2), 0.4 (S^2 in R^3), 0.15 (S^1 in R^3), 0.3
/// (S^3 in R^4); 8 of 10 at 0.025 (S^1 in R^4). `repair` is, every time, at 1.0, 0.7, 0.4, 0.4 and 0.2. A span contains
/// more than the hulls that the certificate asks to be avoided, and a vertex never yields to a later one.
///
/// The number of spans grows exponentially with k: up to k! S(d+1, k) for a vertex. Throws InvalidInput when that
/// exceeds kMaxSpans (first for k = 5 at d = 7 and k = 4 at d = 8) or d > 20, unless k = 1, or when an option is out of
/// range.
SequentialResult sequential(PerturbedTriangulation& near, std::span<const std::uint32_t> starts,
                            const SequentialOptions& options = {});

}  // namespace whitney::perturbation
