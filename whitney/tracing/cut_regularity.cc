// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/cut_regularity.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/QR>
#include <Eigen/SVD>

namespace whitney {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

VectorXd value(const Function& F, const VectorXd& x) {
  VectorXd values(F.codim());
  F.evaluate({x.data(), std::size_t(x.size())}, {values.data(), std::size_t(values.size())});
  return values;
}

MatrixXd jacobian(const Function& F, const VectorXd& x, double length_scale) {
  RowMajor J(F.codim(), x.size());
  F.jacobian({x.data(), std::size_t(x.size())}, {J.data(), std::size_t(J.size())}, length_scale);
  return J;
}

/// The smallest singular value of J with rows of length 1, and its left singular vector; nothing when J is not finite.
std::optional<std::pair<double, VectorXd>> smallest_singular(MatrixXd J) {
  if (!J.allFinite()) return std::nullopt;
  for (Eigen::Index r = 0; r < J.rows(); ++r)
    if (J.row(r).norm() > 0) J.row(r).normalize();
  const Eigen::JacobiSVD<MatrixXd> svd(J, Eigen::ComputeThinU);
  const Eigen::Index last = J.rows() - 1;
  return std::pair(svd.singularValues()[last], VectorXd(svd.matrixU().col(last)));
}

/// A singular point of F = 0 within 2 L of the start.
std::optional<SingularCut> find_singular(const Function& map, const VectorXd& start, double L) {
  constexpr double kTolerance = 1e-6;
  const auto d = start.size();
  const Eigen::Index rows = map.codim();
  const auto first = smallest_singular(jacobian(map, start, L));
  if (!first) return std::nullopt;
  // Rows in units of their size near the start, so that F becomes lengths.
  VectorXd sizes = jacobian(map, start, L).rowwise().norm();
  const double largest = sizes.maxCoeff();
  if (!(largest > 0)) return std::nullopt;
  for (double& size : sizes) size = std::max(size, 1e-6 * largest);
  VectorXd x = start, lambda = first->second;
  for (int step = 0; step < 40; ++step) {
    const MatrixXd J = sizes.cwiseInverse().asDiagonal() * jacobian(map, x, L);
    const VectorXd F = value(map, x).cwiseQuotient(sizes) / L;
    VectorXd residual(rows + d + 1);
    residual << F, J.transpose() * lambda, lambda.squaredNorm() - 1;
    if (!residual.allFinite()) return std::nullopt;
    // Unknowns: x in units of L, lambda.
    MatrixXd system = MatrixXd::Zero(rows + d + 1, d + rows);
    system.topLeftCorner(rows, d) = J;
    const double h = 1e-4 * L;
    for (Eigen::Index c = 0; c < d; ++c) {
      VectorXd ahead = x, behind = x;
      ahead[c] += h;
      behind[c] -= h;
      const MatrixXd difference =
          sizes.cwiseInverse().asDiagonal() * (jacobian(map, ahead, L) - jacobian(map, behind, L));
      system.block(rows, c, d, 1) = difference.transpose() * lambda * (L / (2 * h));
    }
    system.block(rows, d, d, rows) = J.transpose();
    system.block(rows + d, d, 1, rows) = 2 * lambda.transpose();
    if (!system.allFinite()) return std::nullopt;
    VectorXd move = system.completeOrthogonalDecomposition().solve(residual);
    if (!move.allFinite()) return std::nullopt;
    const double length = move.head(d).norm();
    if (length > 1) move /= length;
    x -= L * move.head(d);
    lambda -= move.tail(rows);
    if ((x - start).norm() > 2 * L) return std::nullopt;
    if (move.norm() > 1e-9) continue;
    const auto singular = smallest_singular(jacobian(map, x, L));
    const VectorXd rest = value(map, x).cwiseQuotient(sizes) / L;
    const VectorXd dependence = (sizes.cwiseInverse().asDiagonal() * jacobian(map, x, L)).transpose() * lambda;
    if (!singular || !(rest.norm() < kTolerance) || !(dependence.norm() < kTolerance)) return std::nullopt;
    SingularCut cut;
    cut.point.assign(x.data(), x.data() + d);
    cut.singular_value = std::min(singular->first, dependence.norm());
    return cut;
  }
  return std::nullopt;
}

}  // namespace

CutRegularity check_cuts(const Function& f, const TraceResult& trace, double edge_length) {
  constexpr double kSuspicious = 0.3;        // singular values above it are not looked into
  constexpr std::size_t kMaxSearches = 200;  // Gauss-Newton iterations
  const std::size_t d = trace.ambient_dim();
  CutRegularity out;
  struct Candidate {
    double singular_value;
    VectorXd point;
    std::size_t stratum;
    bool operator<(const Candidate& other) const { return singular_value < other.singular_value; }
  };
  std::vector<Function> maps;  // (f, g_I) for every stratum of the trace
  std::vector<Candidate> candidates;
  for (const BoundarySimplices& stratum : trace.boundary) {
    maps.push_back(trace.domain.with_equations(f, stratum.inequalities));
    for (std::size_t i = 0; i < stratum.size(); ++i) {
      const Eigen::Map<const VectorXd> point(&stratum.points[i * d], d);
      const auto singular = smallest_singular(jacobian(maps.back(), point, edge_length));
      if (!singular) continue;
      if (out.point.empty() || singular->first < out.smallest_singular_value) {
        out.smallest_singular_value = singular->first;
        out.point.assign(point.begin(), point.end());
        out.inequalities = stratum.inequalities;
      }
      if (singular->first < kSuspicious) candidates.push_back({singular->first, point, maps.size() - 1});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end());
  std::vector<VectorXd> searched;
  for (const Candidate& candidate : candidates) {
    auto close = [&](const VectorXd& other) { return (other - candidate.point).norm() < 2 * edge_length; };
    if (searched.size() >= kMaxSearches) break;
    if (std::any_of(searched.begin(), searched.end(), close)) continue;
    searched.push_back(candidate.point);
    std::optional<SingularCut> cut = find_singular(maps[candidate.stratum], candidate.point, edge_length);
    if (!cut) continue;
    cut->inequalities = trace.boundary[candidate.stratum].inequalities;
    const Eigen::Map<const VectorXd> x(cut->point.data(), d);
    const bool known = std::any_of(out.singular.begin(), out.singular.end(), [&](const SingularCut& other) {
      return (Eigen::Map<const VectorXd>(other.point.data(), d) - x).norm() < edge_length;
    });
    // Only what lies in the closed domain is part of the boundary.
    std::vector<double> slack(trace.domain.num_inequalities());
    for (std::size_t j = 0; j < slack.size(); ++j) {
      const std::vector<double> gradient = trace.domain.gradient(static_cast<int>(j), cut->point, edge_length);
      slack[j] = 0.1 * edge_length * Eigen::Map<const VectorXd>(gradient.data(), d).norm();
      if (std::binary_search(cut->inequalities.begin(), cut->inequalities.end(), static_cast<int>(j)))
        slack[j] = std::numeric_limits<double>::infinity();
    }
    if (!known && trace.domain.contains(cut->point, slack)) out.singular.push_back(std::move(*cut));
  }
  return out;
}

}  // namespace whitney
