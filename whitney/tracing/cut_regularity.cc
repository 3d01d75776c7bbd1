// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/cut_regularity.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <Eigen/QR>
#include <Eigen/SVD>

#include <coxeter/tables/vertex_table.h>

namespace whitney {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// F: R^d -> R^m in units in which its derivatives are of size 1 near a point and lengths are multiples of L: neither
/// the units of F nor those of length matter, and nothing overflows.
class ScaledMap {
 public:
  /// Rows are scaled by the power of two that is about their largest length at the start and at the 2 d points at
  /// distance L from it along the axes: at a singular point, where rows may vanish, that is how they grow.
  ScaledMap(const Function& F, const VectorXd& start, double L)
      : F_(F), L_(L), exponents_(F.codim(), std::numeric_limits<int>::min()) {
    const auto d = start.size();
    for (Eigen::Index i = 0; i <= 2 * d; ++i) {
      VectorXd x = start;
      if (i < 2 * d) x[i / 2] += i % 2 == 0 ? L : -L;
      const RowMajor J = raw_jacobian(x);
      for (Eigen::Index r = 0; r < J.rows(); ++r) {
        const double size = J.row(r).cwiseAbs().maxCoeff();
        if (std::isfinite(size) && size > 0) exponents_[r] = std::max(exponents_[r], std::ilogb(size));
      }
    }
    for (const int exponent : exponents_) regular_ = regular_ && exponent != std::numeric_limits<int>::min();
  }
  /// Whether every row has some derivative that is finite and not 0.
  bool usable() const { return regular_; }
  VectorXd value(const VectorXd& x) const {
    VectorXd values(F_.codim());
    F_.evaluate({x.data(), std::size_t(x.size())}, {values.data(), std::size_t(values.size())});
    for (Eigen::Index r = 0; r < values.size(); ++r) values[r] = std::ldexp(values[r], -exponents_[r]) / L_;
    return values;
  }
  MatrixXd jacobian(const VectorXd& x) const {
    RowMajor J = raw_jacobian(x);
    for (Eigen::Index r = 0; r < J.rows(); ++r)
      for (double& entry : J.row(r)) entry = std::ldexp(entry, -exponents_[r]);
    return J;
  }

 private:
  RowMajor raw_jacobian(const VectorXd& x) const {
    RowMajor J(F_.codim(), x.size());
    F_.jacobian({x.data(), std::size_t(x.size())}, {J.data(), std::size_t(J.size())}, L_);
    return J;
  }

  const Function& F_;
  double L_;
  std::vector<int> exponents_;
  bool regular_ = true;
};

/// Rows of J of length 1, whatever their units; rows of zeros stay.
void normalize_rows(RowMajor& J) {
  for (Eigen::Index r = 0; r < J.rows(); ++r) {
    const double size = J.row(r).cwiseAbs().maxCoeff();
    if (!(size > 0) || !std::isfinite(size)) continue;
    for (double& entry : J.row(r)) entry = std::ldexp(entry, -std::ilogb(size));
    J.row(r).normalize();
  }
}

/// The smallest singular value of J and its left singular vector; nothing when J is not finite.
std::optional<std::pair<double, VectorXd>> smallest_singular(const MatrixXd& J) {
  if (!J.allFinite()) return std::nullopt;
  const Eigen::JacobiSVD<MatrixXd> svd(J, Eigen::ComputeThinU);
  const Eigen::Index last = J.rows() - 1;
  return std::pair(svd.singularValues()[last], VectorXd(svd.matrixU().col(last)));
}

/// Residual and derivative of F(x) = 0, DF(x)^T lambda = 0, |lambda|^2 = 1 in (x in units of L, lambda). The second
/// derivatives are differences of first ones over 1e-4 L. Not finite where F is not.
void singular_equations(const ScaledMap& map, const VectorXd& x, const VectorXd& lambda, double L, VectorXd& residual,
                        MatrixXd& system) {
  const auto d = x.size(), rows = lambda.size();
  const MatrixXd J = map.jacobian(x);
  residual.resize(rows + d + 1);
  residual << map.value(x), J.transpose() * lambda, lambda.squaredNorm() - 1;
  system = MatrixXd::Zero(rows + d + 1, d + rows);
  system.topLeftCorner(rows, d) = J;
  const double h = 1e-4 * L;
  for (Eigen::Index c = 0; c < d; ++c) {
    VectorXd ahead = x, behind = x;
    ahead[c] += h;
    behind[c] -= h;
    system.block(rows, c, d, 1) = (map.jacobian(ahead) - map.jacobian(behind)).transpose() * lambda * (L / (2 * h));
  }
  system.block(rows, d, d, rows) = J.transpose();
  system.block(rows + d, d, 1, rows) = 2 * lambda.transpose();
}

/// A singular point of F = 0 within `radius` edge lengths of the start.
std::optional<SingularCut> find_singular(const ScaledMap& map, const VectorXd& start, double L, double radius) {
  constexpr double kDependence = 1e-6, kValue = 1e-8;  // residuals, F in units of L
  if (!map.usable()) return std::nullopt;
  const auto first = smallest_singular(map.jacobian(start));
  if (!first) return std::nullopt;
  VectorXd x = start, lambda = first->second, residual;
  MatrixXd system;
  for (int step = 0; step < 40; ++step) {
    singular_equations(map, x, lambda, L, residual, system);
    if (!residual.allFinite() || !system.allFinite()) return std::nullopt;
    VectorXd move = system.completeOrthogonalDecomposition().solve(residual);
    if (!move.allFinite()) return std::nullopt;
    const double length = move.head(start.size()).norm();
    if (step == 0 && length > 4 * radius) return std::nullopt;
    if (length > 1) move /= length;
    x -= L * move.head(start.size());
    lambda -= move.tail(lambda.size());
    if ((x - start).norm() > radius * L) return std::nullopt;
    if (move.norm() < 1e-9) break;
  }
  const auto singular = smallest_singular(map.jacobian(x));
  const double dependence = (map.jacobian(x).transpose() * lambda).norm() / lambda.norm();
  if (!singular || !(map.value(x).norm() < kValue) || !(dependence < kDependence)) return std::nullopt;
  SingularCut cut;
  cut.point.assign(x.data(), x.data() + x.size());
  cut.singular_value = std::min(singular->first, dependence);
  return cut;
}

/// Whether the closed domain holds the point, but for a tenth of an edge length; not asked of the inequalities that
/// vanish there.
bool in_domain(const Domain& domain, const SingularCut& cut, double edge_length) {
  std::vector<double> slack(domain.num_inequalities());
  for (std::size_t j = 0; j < slack.size(); ++j) {
    const std::vector<double> gradient = domain.gradient(static_cast<int>(j), cut.point, edge_length);
    slack[j] = 0.1 * edge_length * Eigen::Map<const VectorXd>(gradient.data(), std::ssize(gradient)).norm();
    if (std::binary_search(cut.inequalities.begin(), cut.inequalities.end(), static_cast<int>(j)))
      slack[j] = std::numeric_limits<double>::infinity();
  }
  return domain.contains(cut.point, slack);
}

/// Whether one of the points is closer than this to x.
bool any_within(double distance, const VectorXd& x, std::span<const double> points) {
  const auto d = std::size_t(x.size());
  for (std::size_t at = 0; at < points.size(); at += d) {
    double sum = 0;
    for (std::size_t c = 0; c < d; ++c) {
      const double difference = (points[at + c] - x[c]) / distance;
      sum += difference * difference;
    }
    if (sum < 1) return true;
  }
  return false;
}

/// log2 |det A| of a k x k matrix, overwritten; -infinity when it is singular.
double log_determinant(std::vector<double>& A, int k) {
  double sum = 0;
  for (int i = 0; i < k; ++i) {
    int pivot = i;
    for (int r = i + 1; r < k; ++r)
      if (std::abs(A[r * k + i]) > std::abs(A[pivot * k + i])) pivot = r;
    if (A[pivot * k + i] == 0) return -std::numeric_limits<double>::infinity();
    if (pivot != i) std::swap_ranges(&A[i * k], &A[i * k] + k, &A[pivot * k]);
    sum += std::log2(std::abs(A[i * k + i]));
    for (int r = i + 1; r < k; ++r) {
      const double factor = A[r * k + i] / A[i * k + i];
      for (int c = i + 1; c < k; ++c) A[r * k + c] -= factor * A[i * k + c];
    }
  }
  return sum;
}

/// The simplices from which a search for singular points of f = 0 promises most, best first: see check_interior.
class Suspects {
 public:
  explicit Suspects(const TraceResult& trace)
      : trace_(trace),
        d_(trace.ambient_dim()),
        k_(trace.codim()),
        vertices_(d_),
        blocks_(d_),
        surroundings_(d_),
        exponents_(k_, 0),
        matrix_(std::size_t(k_) * k_),
        z_(d_),
        cell_(d_) {
    const std::span<const std::int32_t> coordinates = trace.vertex_coordinates();
    for (std::size_t at = 0; at < coordinates.size(); at += d_)
      vertices_.intern(&coordinates[at], vertices_.form_of(&coordinates[at]));
    std::vector<double> largest(k_, 0);
    const std::span<const double> values = trace.vertex_values();
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::isfinite(values[i])) largest[i % k_] = std::max(largest[i % k_], std::abs(values[i]));
    for (int r = 0; r < k_; ++r)
      if (largest[r] > 0) exponents_[r] = std::ilogb(largest[r]);
  }

  std::vector<std::size_t> list(std::size_t limit) {
    const std::size_t per_base = k_ == 1 ? 2 : 1;  // simplices looked at around a base vertex
    for (std::size_t first = 0; first < trace_.num_simplices();) {
      std::size_t last = first + 1;
      while (last < trace_.num_simplices() && trace_.base(last) == trace_.base(first)) ++last;
      const std::size_t step = std::max<std::size_t>(1, (last - first) / per_base);
      for (std::size_t i = first; i < last; i += step) enter(i);
      first = last;
    }
    return ordered(limit);
  }

 private:
  struct Block {
    double largest, least;
    std::size_t simplex;  // that has the least
    std::uint32_t surrounding;
  };

  /// Which block of side 2^bits holds the vertex z_.
  std::uint32_t block_of(coxeter::VertexTable& blocks, int bits) {
    for (int c = 0; c < d_; ++c) cell_[c] = z_[c] >> bits;
    return blocks.intern(cell_.data(), blocks.form_of(cell_.data()));
  }

  void enter(std::size_t simplex) {
    std::copy_n(&trace_.vertex_coordinates()[std::size_t{trace_.base(simplex)} * d_], d_, z_.begin());
    const std::uint32_t block = block_of(blocks_, 1), around = block_of(surroundings_, 3);
    const double* before = &trace_.vertex_values()[std::size_t{trace_.base(simplex)} * k_];
    for (int q = 0; q < k_; ++q) {
      for (int c = 0; c < d_; ++c) z_[c] += trace_.part(simplex, c) == q;
      const std::uint32_t id = vertices_.find(z_.data(), vertices_.form_of(z_.data()));
      if (id == coxeter::HashSlots::kNone) return;
      const double* here = &trace_.vertex_values()[std::size_t{id} * k_];
      for (int r = 0; r < k_; ++r)
        matrix_[q * k_ + r] = std::ldexp(here[r], -exponents_[r]) - std::ldexp(before[r], -exponents_[r]);
      before = here;
    }
    const double size = log_determinant(matrix_, k_);
    if (block == found_.size()) found_.push_back({size, size, simplex, around});
    if (around == largest_around_.size()) largest_around_.push_back(size);
    Block& entry = found_[block];
    entry.largest = std::max(entry.largest, size);
    if (size < entry.least) {
      entry.least = size;
      entry.simplex = simplex;
    }
    largest_around_[around] = std::max(largest_around_[around], size);
  }

  std::vector<std::size_t> ordered(std::size_t limit) const {
    std::vector<std::uint32_t> by_size(found_.size());
    std::iota(by_size.begin(), by_size.end(), 0u);
    std::vector<std::uint32_t> by_ratio = by_size;
    auto ratio = [&](std::uint32_t i) {
      return std::isfinite(found_[i].largest) ? found_[i].largest - largest_around_[found_[i].surrounding]
                                              : found_[i].largest;
    };
    const auto end = std::min<std::size_t>(limit, by_size.size());
    std::partial_sort(by_size.begin(), by_size.begin() + end, by_size.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(found_[a].largest, a) < std::pair(found_[b].largest, b);
    });
    std::partial_sort(by_ratio.begin(), by_ratio.begin() + end, by_ratio.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(ratio(a), a) < std::pair(ratio(b), b);
    });
    std::vector<std::size_t> simplices;
    for (std::size_t i = 0; i < end; ++i) {
      simplices.push_back(found_[by_size[i]].simplex);
      simplices.push_back(found_[by_ratio[i]].simplex);
    }
    return simplices;
  }

  const TraceResult& trace_;
  int d_, k_;
  coxeter::VertexTable vertices_, blocks_, surroundings_;
  std::vector<int> exponents_;  // of the largest |f_r|
  std::vector<Block> found_;
  std::vector<double> largest_around_;
  std::vector<double> matrix_;
  std::vector<std::int32_t> z_, cell_;
};

bool is_known(const SingularCut& cut, const CutRegularity& found, double edge_length) {
  const Eigen::Map<const VectorXd> x(cut.point.data(), std::ssize(cut.point));
  return std::any_of(found.singular.begin(), found.singular.end(),
                     [&](const SingularCut& other) { return any_within(edge_length, x, other.point); });
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
      RowMajor J(maps.back().codim(), point.size());
      maps.back().jacobian({point.data(), d}, {J.data(), std::size_t(J.size())}, edge_length);
      normalize_rows(J);
      const auto singular = smallest_singular(J);
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
    const Function& map = maps[candidate.stratum];
    std::optional<SingularCut> cut =
        find_singular(ScaledMap(map, candidate.point, edge_length), candidate.point, edge_length, 2);
    if (!cut) continue;
    cut->inequalities = trace.boundary[candidate.stratum].inequalities;
    // Only what lies in the closed domain is part of the boundary.
    if (!is_known(*cut, out, edge_length) && in_domain(trace.domain, *cut, edge_length))
      out.singular.push_back(std::move(*cut));
  }
  return out;
}

CutRegularity check_interior(const Function& f, const TraceResult& trace, double edge_length) {
  constexpr int kMaxSize = 64;              // Gauss-Newton solves systems of this many unknowns
  constexpr std::size_t kMaxSingular = 16;  // listed
  constexpr std::size_t kMinSearches = 40, kMaxSearches = 200, kSimplicesPerSearch = 2000;
  constexpr double kRadius = 4;  // edge lengths
  CutRegularity out;
  out.searched = trace.ambient_dim() + trace.codim() <= kMaxSize;
  if (!out.searched || trace.num_simplices() == 0) return out;
  const auto searches = std::clamp(trace.num_simplices() / kSimplicesPerSearch, kMinSearches, kMaxSearches);
  std::vector<double> searched;
  std::size_t left = searches;
  for (const std::size_t simplex : Suspects(trace).list(8 * searches)) {
    const VectorXd start = Eigen::Map<const VectorXd>(trace.point(simplex).data(), trace.ambient_dim());
    if (left == 0 || out.singular.size() >= kMaxSingular) break;
    if (any_within(2 * edge_length, start, searched)) continue;
    --left;
    searched.insert(searched.end(), start.begin(), start.end());
    const ScaledMap map(f, start, edge_length);
    if (!map.usable()) continue;
    const auto here = smallest_singular(map.jacobian(start));
    if (here && (out.point.empty() || here->first < out.smallest_singular_value)) {
      out.smallest_singular_value = std::min(1.0, here->first);
      out.point.assign(start.begin(), start.end());
    }
    std::optional<SingularCut> cut = find_singular(map, start, edge_length, kRadius);
    if (!cut || is_known(*cut, out, edge_length)) continue;
    const Eigen::Map<const VectorXd> x(cut->point.data(), std::ssize(cut->point));
    if (any_within(3 * edge_length, x, trace.points()) && in_domain(trace.domain, *cut, edge_length))
      out.singular.push_back(std::move(*cut));
  }
  return out;
}

}  // namespace whitney
