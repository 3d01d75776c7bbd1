// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/scale_search.h>

#include <chrono>
#include <cmath>

#include <coxeter/base/error.h>

namespace whitney {

double suggested_edge_length(int ambient_dim, int intrinsic_dim, double reach) {
  return 0.9 * std::pow(0.6, ambient_dim - intrinsic_dim - 1) * std::pow(0.85, intrinsic_dim - 1) * reach;
}

ScaleSearchResult search_scale(const Submanifold& manifold, const Bending& bending,
                               const std::function<coxeter::Triangulation(double)>& make_triangulation,
                               std::span<const double> seed_points, const ScaleSearchOptions& options) {
  if (!(options.factor > 0) || !(options.factor < 1) || options.max_attempts < 1)
    throw InvalidInput("search_scale: factor must be between 0 and 1, max_attempts at least 1");
  double edge_length = options.first_edge_length.value_or(
      suggested_edge_length(manifold.ambient_dim(), manifold.intrinsic_dim(), bending.reach));
  const auto begin = std::chrono::steady_clock::now();
  ScaleSearchResult search;
  for (int attempt = 0; attempt < options.max_attempts; ++attempt, edge_length *= options.factor) {
    TriangulateOptions one = options.triangulate;
    const double used = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    one.run.time_limit = options.triangulate.run.time_limit - used;
    search.result = triangulate(manifold, bending, make_triangulation(edge_length), seed_points, one);
    const perturbation::CertificateReport& report = search.result.certificate;
    search.attempts.push_back(
        {edge_length, report.verdict, report.simplices, report.not_certified, report.margin_min, report.reason});
    if (report.verdict == perturbation::Verdict::kCertified || search.result.stop_reason != StopReason::kNone ||
        !search.result.reach_check.consistent)
      break;
  }
  return search;
}

}  // namespace whitney
