// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <coxeter/base/run_control.h>
#include <whitney/functions/domain.h>
#include <whitney/functions/function.h>

namespace whitney {

struct FindSeedsOptions {
  std::size_t num_starts = 400;    ///< start points, a low-discrepancy sequence in the box
  std::size_t num_critical = 100;  ///< how many of them also look for a critical point of a linear function
  int max_iterations = 60;         ///< Newton steps from each
  std::size_t max_strata = 64;  ///< with inequalities: how many strata are searched, each from 1/8 of the start points
  RunControl run{};  ///< limits of time and memory, and progress (phase "seeds"), asked before every Newton step
};

struct FoundSeeds {
  std::vector<double> points;  ///< num x d, points of f = 0 in the box, no two closer than 1e-9 of the box's diagonal
  std::size_t num_starts = 0;  ///< Newton iterations begun
  std::size_t num_converged = 0;               ///< of which reached f = 0 inside the box at a regular point
  std::size_t num_singular = 0;                ///< of which came to points where the rows of Df are linearly dependent
  std::size_t evaluations = 0;                 ///< of f; Jacobians are not counted
  StopReason stop_reason = StopReason::kNone;  ///< the limit of FindSeedsOptions::run that ended the search early
};

/// Looks for points on f = 0 in a box, with the aim of one on every component.
///
/// From many start points, Newton's method with least-squares steps; besides, critical points on f = 0 of a fixed
/// generic linear function g.x by Newton's method on f = 0, g = Df^T mu: every compact component has at least two,
/// however small it is. This is a search: it proves nothing. A component may be missed when it is small against the box
/// or when few starts lead to it; more starts or a smaller box help. Deterministic. Dense linear algebra: meant for
/// moderate d (6 or so for completeness, tens for finding something).
///
/// Units do not matter: neither that of the lengths nor those of the components of f, which may differ by hundreds of
/// orders of magnitude, as long as the values of f and of its derivatives are in the range of double.
///
/// Throws InvalidInput when the box does not fit f. Points where f is not finite are passed over.
FoundSeeds find_seeds(const Function& f, const Box& box, const FindSeedsOptions& options = {});

/// Looks for points on f = 0 in a domain that has a box, one on every component of that part of f = 0: besides the
/// search above, the same on the strata where some of the inequalities vanish (in the largest dimensions first, up to
/// max_strata of them), since a component of a compact manifold with corners has the least value of g.x on one of them.
/// Throws InvalidInput when the domain does not fit f or has no box.
FoundSeeds find_seeds(const Function& f, const Domain& domain, const FindSeedsOptions& options = {});

}  // namespace whitney
