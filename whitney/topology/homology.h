// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <coxeter/base/run_control.h>
#include <whitney/topology/chain_complex.h>
#include <whitney/topology/incidence.h>

namespace whitney {

/// A finitely generated abelian group, Z^rank + Z/t1 + Z/t2 + .., with t1 > 1 and each t dividing the next.
struct HomologyGroup {
  std::size_t rank = 0;
  std::vector<std::string> torsion;  ///< t1, t2, .. in decimal digits: they can be larger than any machine integer

  bool operator==(const HomologyGroup&) const = default;
};

/// "Z^2 + Z/2", "Z", "0".
std::string to_string(const HomologyGroup& group);

struct Homology {
  std::vector<HomologyGroup> groups;  ///< H_0 .. H_n with integer coefficients; empty when the run was stopped
  /// The number of cells of each dimension that a discrete Morse function left: at least the ranks, and 2 (or 1) in all
  /// prove that a combinatorial manifold is a PL sphere (or ball) (Forman, Morse theory for cell complexes, 1998).
  std::vector<std::size_t> critical_cells;
  StopReason stop_reason = StopReason::kNone;  ///< the limit that stopped the run; then the rest is empty
};

/// Integral homology of a regular CW complex (see chain_complex.h), by coreductions (Mrozek, Batko, Coreduction
/// homology algorithm, 2009; Harker, Mischaikow, Mrozek, Nanda, Discrete Morse theoretic algorithms, 2014), which leave
/// a Morse complex of few cells with the same homology, and the Smith normal form of its boundary. Exact for any size
/// of coefficients. Linear in the number of cells where the Morse complex is small. The empty complex (no dimension)
/// has no groups. `signs` must be those of the complex; boundary_squared_is_zero tells. Throws InvalidInput when facets
/// are not well formed, an edge has not two vertices, or the signs do not fit the facets. Of `run`, the limits of time
/// and memory and `progress` (phase "homology") are asked now and then; what the reduction takes is asked for first.
Homology homology(std::span<const Incidence> facets, const IncidenceSigns& signs, const RunControl& run = {});

/// The same with the signs of regular_cell_signs, and its checks.
Homology homology(std::span<const Incidence> facets);

/// Betti numbers over Z/2 by the universal coefficient theorem: rank H_j + even torsion of H_j + even torsion of
/// H_(j-1).
std::vector<std::size_t> betti_z2(std::span<const HomologyGroup> groups);

}  // namespace whitney
