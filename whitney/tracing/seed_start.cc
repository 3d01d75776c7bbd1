// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/seed_start.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>
#include <Eigen/QR>

#include <coxeter/base/eigen_view.h>
#include <whitney/tracing/lattice_values.h>

namespace whitney {
namespace {

using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// How far a seed point that leads nowhere may be from the manifold and still be taken for a point of it.
constexpr double kSeedSlack = 2;              // edge lengths
constexpr std::size_t kFootSimplices = 500;   // looked at around a foot
constexpr std::size_t kFinerSimplices = 200;  // looked at in a triangulation of half the edge length
constexpr int kMaxHalvings = 30;
// In more dimensions a few hundred simplices are not much of a neighbourhood, so little is tried.
constexpr std::size_t kExhaustiveDim = 6;
constexpr int kFewHalvings = 8;
constexpr double kFarthest = 0x1p28;  // in edge lengths

double distance(std::span<const double> a, std::span<const double> b) {
  double largest = 0;
  for (std::size_t c = 0; c < a.size(); ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
  if (!(largest > 0)) return 0;
  double sum = 0;
  for (std::size_t c = 0; c < a.size(); ++c) sum += (a[c] - b[c]) / largest * ((a[c] - b[c]) / largest);
  return largest * std::sqrt(sum);
}

// Brings each row of J, and the component of f, to a size of about 1 by a power of two. False where J or f is not
// finite.
bool scale_rows(RowMajor& J, VectorXd& f) {
  for (Eigen::Index r = 0; r < J.rows(); ++r) {
    const double size = J.row(r).cwiseAbs().maxCoeff();
    if (!std::isfinite(size) || !std::isfinite(f[r])) return false;
    if (size == 0) continue;
    const int exponent = -std::ilogb(size);
    for (double& entry : J.row(r)) entry = std::ldexp(entry, exponent);
    f[r] = std::ldexp(f[r], exponent);
  }
  return true;
}

}  // namespace

SeedStarter::SeedStarter(const Function& f, const Domain& domain, const coxeter::Triangulation& triangulation,
                         Inside inside)
    : f_(f),
      domain_(domain),
      triangulation_(triangulation),
      inside_(std::move(inside)),
      search_(triangulation, f.codim(),
              [this](const std::int32_t* z, double* values) { return value(triangulation_, z, values); }) {
  if (!domain_.empty())
    search_.accept_only([this](const Crossing& crossing) { return crossing_inside(triangulation_, crossing); });
}

bool SeedStarter::box_holds(std::span<const double> x, double slack) const {
  const std::optional<Box>& box = domain_.box();
  for (std::size_t c = 0; box && c < x.size(); ++c)
    if (!(x[c] >= box->lower[c] - slack && x[c] <= box->upper[c] + slack)) return false;
  return true;
}

// f at a vertex near a seed point. False where it has no value, or far outside the box.
bool SeedStarter::value(const coxeter::Triangulation& triangulation, const std::int32_t* z, double* values) const {
  const auto d = std::size_t(f_.ambient_dim());
  std::vector<double> x(d);
  triangulation.cartesian({z, d}, x);
  if (!box_holds(x, triangulation_.edge_length())) return false;
  f_.evaluate(x, {values, std::size_t(f_.codim())});
  for (int r = 0; r < f_.codim(); ++r) {
    if (std::isfinite(values[r])) continue;
    if (!box_holds(x, 0)) return false;
    throw not_finite("component " + std::to_string(r + 1) + " of f", values[r], x);
  }
  return true;
}

// Whether a simplex found near a seed point meets f = 0 inside the domain. Its vertices are not entered: they may turn
// out to be no part of the result.
bool SeedStarter::crossing_inside(const coxeter::Triangulation& triangulation, const Crossing& crossing) {
  const int m = domain_.num_inequalities(), k = f_.codim();
  std::vector<double> x(f_.ambient_dim()), rows;
  std::vector<std::int32_t> z = crossing.base;
  for (int q = 0; q <= k; ++q) {
    triangulation.cartesian(z, x);
    const std::vector<double> g = domain_.values(x);
    for (int j = 0; j < m; ++j) {
      if (!std::isfinite(g[j])) throw not_finite(domain_.name(j), g[j], x);
      rows.push_back(-g[j]);
    }
    rows.resize(rows.size() + k);
    ++other_evaluations_;
    f_.evaluate(x, {&rows[rows.size() - k], std::size_t(k)});
    for (std::size_t c = 0; c < z.size(); ++c) z[c] += crossing.parts[c] == q;
  }
  return inside_(rows);
}

// Where a simplex meets the zero set of the interpolant, but for rounding.
std::vector<double> SeedStarter::point_of(const coxeter::Triangulation& triangulation, const Crossing& crossing) {
  const int d = f_.ambient_dim(), k = f_.codim();
  std::vector<std::int32_t> z = crossing.base;
  Eigen::MatrixXd corners(d, k + 1);
  RowMajor B(k + 1, k + 1);
  VectorXd target = VectorXd::Unit(k + 1, 0);
  std::vector<double> values(k);
  for (int q = 0; q <= k; ++q) {
    triangulation.cartesian(z, {corners.col(q).data(), std::size_t(d)});
    ++other_evaluations_;
    f_.evaluate({corners.col(q).data(), std::size_t(d)}, values);
    B(0, q) = 1;
    for (int r = 0; r < k; ++r) B(r + 1, q) = values[r];
    for (int c = 0; c < d; ++c) z[c] += crossing.parts[c] == q;
  }
  VectorXd weights = VectorXd::Ones(k + 1);
  if (scale_rows(B, target)) {
    const VectorXd solution = B.partialPivLu().solve(target);
    if (solution.allFinite() && solution.cwiseMax(0).sum() > 0) weights = solution.cwiseMax(0);
  }
  const VectorXd point = corners * weights / weights.sum();
  return {point.begin(), point.end()};
}

bool SeedStarter::near(const coxeter::Triangulation& triangulation, const Crossing& crossing,
                       std::span<const double> foot) {
  return distance(point_of(triangulation, crossing), foot) <= kNear * triangulation.edge_length();
}

// Newton's method on f = 0 with steps of least norm, at most an edge length each, rows in units of their own size.
// Nothing unless it converges within 4 edge lengths, and inside the box but for half of one.
std::vector<double> SeedStarter::foot_of(std::span<const double> x) {
  const int d = f_.ambient_dim(), k = f_.codim();
  const double L = triangulation_.edge_length();
  VectorXd y = Eigen::Map<const VectorXd>(x.data(), d), f(k);
  RowMajor J(k, d);
  for (int step = 0; step < 60; ++step) {
    if (!box_holds({y.data(), std::size_t(d)}, L / 2)) return {};
    f_.evaluate({y.data(), std::size_t(d)}, {f.data(), std::size_t(k)});
    f_.jacobian({y.data(), std::size_t(d)}, {J.data(), std::size_t(k) * d}, L);
    ++other_evaluations_;
    if (!scale_rows(J, f)) return {};
    const VectorXd move = J.completeOrthogonalDecomposition().solve(f / L);  // in edge lengths
    const double length = move.norm();
    if (!std::isfinite(length)) return {};
    y -= L / std::max(1.0, length) * move;
    const std::span<const double> here(y.data(), std::size_t(d));
    if (distance(here, x) > 4 * L) return {};
    if (length < 1e-9) return {here.begin(), here.end()};
  }
  return {};
}

// Whether f = 0 can be said to pass a point that Newton's method ended in: Df has full rank there (where f stays away
// from 0 and is flat, steps grow short too), and the domain holds the point.
bool SeedStarter::claims(std::span<const double> foot) {
  const int d = f_.ambient_dim(), k = f_.codim();
  if (!domain_.contains(foot)) return false;
  VectorXd f(k);
  RowMajor J(k, d);
  ++other_evaluations_;
  f_.evaluate(foot, {f.data(), std::size_t(k)});
  f_.jacobian(foot, {J.data(), std::size_t(k) * d}, 1e-3 * triangulation_.edge_length());
  if (!scale_rows(J, f)) return false;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(J.transpose());
  return std::abs(qr.matrixR()(k - 1, k - 1)) > 1e-6 && f.norm() < 1e-6 * triangulation_.edge_length();
}

// A simplex of a triangulation that meets the zero set of the interpolant near the foot.
bool SeedStarter::find_near(const coxeter::Triangulation& triangulation, std::span<const double> foot,
                            std::size_t limit, Crossing& found) {
  SeedSearch search(triangulation, f_.codim(),
                    [&](const std::int32_t* z, double* values) { return value(triangulation, z, values); });
  search.accept_only([&](const Crossing& crossing) {
    return near(triangulation, crossing, foot) && (domain_.empty() || crossing_inside(triangulation, crossing));
  });
  std::string ignored;
  const bool is_found = search.search(foot, limit, found, ignored);
  other_evaluations_ += search.evaluations();
  return is_found;
}

SeedStart SeedStarter::find(std::span<const double> seed, std::size_t limit) {
  const double L = triangulation_.edge_length();
  SeedStart start;
  Crossing crossing;
  const bool found = search_.search(seed, limit, crossing, start.reason);
  if (found) {
    start.crossings.push_back(crossing);
    if (near(triangulation_, crossing, seed)) return start;
  }
  // Nothing was found, or that is far away: does f = 0 pass nearer?
  const std::vector<double> foot = foot_of(seed);
  if (foot.empty() || (found ? near(triangulation_, crossing, foot) : distance(foot, seed) > kSeedSlack * L))
    return start;
  if (!claims(foot)) return start;
  if (find_near(triangulation_, foot, std::min(limit, kFootSimplices), crossing)) {
    start.crossings.push_back(crossing);
    start.reason.clear();
    return start;
  }
  start.unseen = foot;
  return start;
}

// Halves the edge length until the part of f = 0 at the foot is met; for feet close together once.
double SeedStarter::finer_edge_length(std::span<const double> foot) {
  const double L = triangulation_.edge_length();
  for (const auto& [known, finer] : unseen_)
    if (distance(known, foot) < L) return finer;
  double finer = 0;
  Crossing crossing;
  double farthest = 0;
  for (std::size_t c = 0; c < foot.size(); ++c)
    farthest = std::max(farthest, std::abs(foot[c] - triangulation_.offset()[c]));
  const int most = foot.size() <= kExhaustiveDim ? kMaxHalvings : kFewHalvings;
  for (int halvings = 1; halvings <= most && finer == 0; ++halvings) {
    const double factor = std::ldexp(1.0, -halvings);
    if (!(farthest < kFarthest * factor * L)) break;  // lattice coordinates have an end
    const coxeter::Triangulation halved(factor * as_eigen(triangulation_.linear()), triangulation_.offset());
    if (find_near(halved, foot, kFinerSimplices, crossing)) finer = factor * L;
  }
  unseen_.emplace_back(std::vector<double>(foot.begin(), foot.end()), finer);
  return finer;
}

bool SeedStarter::find_full(std::span<const double> seed, std::size_t limit,
                            const std::function<bool(const coxeter::Simplex&)>& found) {
  return search_.search_full(seed, limit, found);
}

}  // namespace whitney
