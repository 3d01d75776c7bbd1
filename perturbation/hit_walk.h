// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <coxeter/base/run_control.h>
#include <perturbation/perturbed_triangulation.h>

namespace whitney::perturbation {

/// Which d-simplices a walk may enter; all of them when it is empty. It must not depend on displacements.
using Region = std::function<bool(const PerturbedTriangulation&, std::uint32_t simplex)>;

struct HitWalkOptions {
  /// Feet are tried until the margin of a simplex is at least this.
  double enough = 1.02;
  /// Try the feet of the midpoints of edges too before a lower margin is accepted.
  bool with_midpoints = true;
  Region region{};
  /// Limits; looked at every few dozen simplices. max_simplices counts d-simplices; the phase is "walk".
  RunControl run{};
};

/// The d-simplices that a walk across hit facets reaches. One that is entered but hit for none of its own feet is among
/// them, and ends the walk there.
struct HitWalk {
  std::vector<std::uint32_t> simplices;  ///< in canonical order, see canonical_order
  StopReason stop_reason = StopReason::kNone;
  bool complete = true;  ///< the walk ended by itself: nothing stopped it
  Region region{};       ///< of the options: it did not go further than that
};

/// Walks from the start simplices across hit facets: V of the global theorem, if all it finds is certified.
HitWalk walk_hit_facets(PerturbedTriangulation& near, std::span<const std::uint32_t> starts,
                        const HitWalkOptions& options = {});

/// The hit simplex nearest to the one that holds x, in steps across facets; at most max_simplices are looked at. When
/// there is none, the simplex that holds x, which a certificate will then have to speak of.
std::uint32_t find_start(PerturbedTriangulation& near, std::span<const double> x, std::size_t max_simplices = 500);

/// Sorts simplices by base vertex, then by the part numbers of their coordinates, as coxeter::Simplex does.
void canonical_order(const PerturbedTriangulation& near, std::vector<std::uint32_t>& simplices);

}  // namespace whitney::perturbation
