// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/inside.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <coxeter/base/error.h>
#include <perturbation/interval.h>
#include <perturbation/small_inverse.h>

namespace whitney::perturbation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<const double*> corners_of(const PerturbedTriangulation& near, std::uint32_t s) {
  std::vector<const double*> corner(near.ambient_dim() + 1);
  for (int q = 0; q <= near.ambient_dim(); ++q) corner[q] = near.position(near.corners(s)[q]);
  return corner;
}

/// Whether the simplex is proved to hold a point within `radius` of `point`: the one with the given barycentric
/// coordinates, those below 0 replaced by 0.
bool comes_near(const double* const* vertices, std::span<const double> point, std::vector<double> coordinates,
                double radius) {
  const Rounding rounding;
  Interval total(0), squared(0);
  for (double& lambda : coordinates) {
    lambda = std::max(0.0, lambda);
    total += Interval(lambda);
  }
  if (!(total.inf() > 0)) return false;
  for (std::size_t c = 0; c < point.size(); ++c) {
    Interval x(0);
    for (std::size_t i = 0; i < coordinates.size(); ++i) x += Interval(coordinates[i]) * Interval(vertices[i][c]);
    const double away = above(x / total - Interval(point[c]));
    squared += Interval(away) * Interval(away);
  }
  return sqrt(squared).sup() <= radius;
}

/// The d-simplex of T~ that holds x, as floating point sees it, by a walk from the one of T.
std::uint32_t walk_to(PerturbedTriangulation& near, std::span<const double> x) {
  std::uint32_t s = near.locate(x);
  // Vertices are displaced by less than the width: a few steps will do.
  for (int step = 0; step < 1000; ++step) {
    const auto bounds = barycentric_bounds(corners_of(near, s).data(), near.ambient_dim(), x.data(), 0);
    const auto least = std::min_element(bounds.coordinates.begin(), bounds.coordinates.end());
    if (least == bounds.coordinates.end() || !(*least < 0)) break;
    s = near.neighbour(s, static_cast<int>(least - bounds.coordinates.begin()));
  }
  return s;
}

}  // namespace

bool BarycentricBounds::inside() const {
  return !coordinates.empty() &&
         std::all_of(coordinates.begin(), coordinates.end(), [&](double lambda) { return lambda > slack; });
}

BarycentricBounds barycentric_bounds(const double* const* vertices, int ambient_dim, const double* point,
                                     double error) {
  // A lambda = (1, x). With C near A^-1 and l = C (1, x): lambda - l = (C A)^-1 C ((1, x) - A l), and moving x by at
  // most `error` moves lambda by at most norm_inf((C A)^-1) times the largest row of abs(C) without its first column.
  const int m = ambient_dim + 1;
  BarycentricBounds bounds{{}, kInfinity};
  std::vector<double> A(static_cast<std::size_t>(m) * m), destroyed, C(A.size()), guess(m), x(m, 1.0);
  std::copy_n(point, ambient_dim, x.begin() + 1);
  for (int i = 0; i < m; ++i) {
    A[i] = 1;
    for (int c = 0; c < ambient_dim; ++c) A[(c + 1) * m + i] = vertices[i][c];
  }
  destroyed = A;
  if (!std::isfinite(error) || !invert(destroyed.data(), C.data(), m)) return bounds;
  for (int i = 0; i < m; ++i) {
    double sum = 0;
    for (int j = 0; j < m; ++j) {
      if (!(std::abs(C[i * m + j]) < 1e150)) return bounds;
      sum += C[i * m + j] * x[j];
    }
    guess[i] = sum;
  }
  bounds.coordinates = guess;
  const Rounding rounding;
  std::vector<Interval> residual(m);
  for (int i = 0; i < m; ++i) {
    residual[i] = Interval(x[i]);
    for (int j = 0; j < m; ++j) residual[i] -= Interval(A[i * m + j]) * Interval(guess[j]);
  }
  double departure = 0, correction = 0, spread = 0;
  for (int i = 0; i < m; ++i) {
    Interval row(0), moved(0), weight(0);
    for (int j = 0; j < m; ++j) {
      Interval entry(i == j ? 1 : 0);
      for (int l = 0; l < m; ++l) entry -= Interval(C[i * m + l]) * Interval(A[l * m + j]);
      row += Interval(above(entry));
      moved += Interval(C[i * m + j]) * residual[j];
      if (j > 0) weight += Interval(std::abs(C[i * m + j]));
    }
    departure = std::max(departure, above(row));
    correction = std::max(correction, above(moved));
    spread = std::max(spread, above(weight));
  }
  if (departure < 1)
    bounds.slack =
        above((Interval(correction) + Interval(spread) * Interval(error)) / (Interval(1) - Interval(departure)));
  return bounds;
}

bool proved_inside(const double* const* vertices, int ambient_dim, const double* point, double error) {
  return barycentric_bounds(vertices, ambient_dim, point, error).inside();
}

std::vector<std::uint32_t> proved_cover(PerturbedTriangulation& near, std::span<const double> point, double error,
                                        std::size_t max_simplices) {
  const int d = near.ambient_dim();
  if (point.size() != static_cast<std::size_t>(d))
    throw InvalidInput("proved_cover: point must have " + std::to_string(d) + " entries");
  if (!(error >= 0)) throw InvalidInput("proved_cover: error must not be negative");
  if (!std::isfinite(error)) return {};
  double size = near.triangulation().edge_length();
  for (const double c : point) size = std::max(size, std::abs(c));
  // A little more than asked: room for the roundings of comes_near.
  const double radius = 2 * error + 16 * (d + 1) * size * std::numeric_limits<double>::epsilon();

  std::vector<std::uint32_t> cover{walk_to(near, point)};
  bool met = false;
  for (std::size_t next = 0; next < cover.size(); ++next) {
    if (cover.size() > max_simplices) return {};
    const std::uint32_t s = cover[next];
    const BarycentricBounds bounds = barycentric_bounds(corners_of(near, s).data(), d, point.data(), radius);
    if (!std::isfinite(bounds.slack)) return {};
    met = met || comes_near(corners_of(near, s).data(), point, bounds.coordinates, radius);
    for (int q = 0; q <= d; ++q) {
      if (bounds.coordinates[q] > bounds.slack) continue;
      const std::uint32_t other = near.neighbour(s, q);
      if (std::find(cover.begin(), cover.end(), other) == cover.end()) cover.push_back(other);
    }
  }
  if (!met) return {};
  return cover;
}

std::vector<bool> proved_in_union(PerturbedTriangulation& near, std::span<const std::uint32_t> simplices,
                                  std::span<const double> points, std::span<const double> errors) {
  const auto d = static_cast<std::size_t>(near.ambient_dim());
  if (points.size() != errors.size() * d) throw InvalidInput("proved_in_union: points must be m x d, errors m");
  std::vector<char> member(near.num_simplices(), 0);
  for (const std::uint32_t s : simplices) member[s] = 1;
  std::vector<bool> proved;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const auto cover = proved_cover(near, points.subspan(i * d, d), errors[i]);
    proved.push_back(!cover.empty() && std::all_of(cover.begin(), cover.end(),
                                                   [&](std::uint32_t s) { return s < member.size() && member[s]; }));
  }
  return proved;
}

}  // namespace whitney::perturbation
