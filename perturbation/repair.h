// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <perturbation/hit_walk.h>

namespace whitney::perturbation {

struct RepairOptions {
  /// rho: no vertex moves further than this (a length, > 0). Below half of embedding_bound().
  double max_displacement = 0;
  std::uint64_t rng_seed = 1;
  /// A simplex is repaired when its margin is below this.
  double accept = 1.02;
  /// What a sweep pushes towards, in the first two rounds and afterwards.
  double first_target = 1.3, target = 1.1;
  int sweeps = 4;
  /// Sweeps and polishes together; those after which the trace reaches 10 % further than before are not counted.
  int max_rounds = 12;
  /// Give up when after the sweeps more than this fraction of the simplices fails.
  double hopeless = 0.35;
  /// Trials of the polish per failing simplex and round.
  int trials = 60;
  Region region{};  ///< of the traces
  /// Limits of the whole repair. max_simplices: of each trace. The phase is "perturb".
  RunControl run{.max_simplices = 20'000'000};
};

/// One round of the repair, before its changes.
struct RepairRound {
  std::size_t simplices = 0, failing = 0;  ///< d-simplices visited, and those with a margin below `accept`
  double worst_margin = 0;
  bool polish = false;  ///< what the round then did: a polish with acceptance or a sweep
};

struct RepairResult {
  std::vector<RepairRound> rounds;  ///< the last one is the state at the end
  bool all_accepted = false;        ///< every simplex of the last trace has a margin of at least `accept`
  StopReason stop_reason = StopReason::kNone;
  bool complete = true;  ///< nothing stopped it
};

/// Finds displacements by repair: trace; push the vertices of every (k-1)-face that is too close to the manifold away
/// from it (a sweep, simplex after simplex in canonical order); what sweeps leave is polished: vertices of a failing
/// simplex move, by pushes and by random steps, and a move is kept only if the sum over the visited simplices around
/// them of [margin < accept] (1 + accept - margin) falls. Then trace again.
///
/// Deterministic for a given rng_seed. No proof of termination: look at all_accepted. The displacements are left in
/// `near`. starts: simplices that the manifold meets; when it meets none of them, nothing is done.
RepairResult repair(PerturbedTriangulation& near, std::span<const std::uint32_t> starts, const RepairOptions& options);

}  // namespace whitney::perturbation
