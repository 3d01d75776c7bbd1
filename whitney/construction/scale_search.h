// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <whitney/construction/triangulate.h>

namespace whitney {

struct ScaleSearchOptions {
  TriangulateOptions triangulate;  ///< of every attempt; its time_limit is for all of them together
  /// The first edge length (a length, > 0). Without: suggested_edge_length().
  std::optional<double> first_edge_length;
  double factor = 0.75;  ///< each attempt is so much finer than the one before; in (0, 1)
  int max_attempts = 8;
};

/// One attempt of a search for a scale.
struct ScaleAttempt {
  double edge_length = 0;
  perturbation::Verdict verdict = perturbation::Verdict::kNotCertified;
  std::size_t simplices = 0, not_certified = 0;  ///< d-simplices
  double margin_min = 0;
  std::string reason;  ///< why it is not certified; empty when it is
};

struct ScaleSearchResult {
  TriangulateResult result;  ///< of the last attempt
  std::vector<ScaleAttempt> attempts;
};

/// Where a search starts: 0.9 * 0.6^(k-1) * 0.85^(n-1) times the reach. A rule of thumb from experiments with circles,
/// spheres and flat tori, a little above what the repair certifies.
double suggested_edge_length(int ambient_dim, int intrinsic_dim, double reach);

/// Triangulates at smaller and smaller edge lengths until the result is certified, or the attempts or the time are used
/// up. make_triangulation(L): the triangulation with longest edge L. A contradicted reach ends the search: no scale
/// mends it. Throws as triangulate does.
ScaleSearchResult search_scale(const Submanifold& manifold, const Bending& bending,
                               const std::function<coxeter::Triangulation(double)>& make_triangulation,
                               std::span<const double> seed_points, const ScaleSearchOptions& options = {});

}  // namespace whitney
