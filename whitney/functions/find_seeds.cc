// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/find_seeds.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include <Eigen/LU>
#include <Eigen/QR>

#include <coxeter/base/error.h>
#include <coxeter/base/run_watch.h>

namespace whitney {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The point number `index` of a sequence that fills the unit cube evenly in every dimension: additive recurrence with
// the powers of the root of x^(d+1) = x + 1 (M. Roberts, 2018; for d = 1 the golden ratio).
VectorXd low_discrepancy(std::size_t index, int dim) {
  double root = 1.5;
  for (int i = 0; i < 60; ++i) root = std::pow(1 + root, 1.0 / (dim + 1));
  VectorXd u(dim);
  for (int c = 0; c < dim; ++c) {
    const double x = 0.5 + double(index + 1) * std::pow(root, -(c + 1));
    u[c] = x - std::floor(x);
  }
  return u;
}

/// The exponent of the power of two that brings a positive number into [1, 2).
int exponent_of(double size) { return size > 0 && std::isfinite(size) ? std::ilogb(size) : 0; }

/// 2^exponent as two factors of equal sign of the exponent: neither leaves the range of double, and where a number and
/// its multiple are normal, so is what is between them, and the multiple is exact. Faster than ldexp.
class PowerOfTwo {
 public:
  explicit PowerOfTwo(int exponent)
      : half_(std::ldexp(1.0, exponent / 2)), rest_(std::ldexp(1.0, exponent - exponent / 2)) {}
  double operator*(double x) const { return x * half_ * rest_; }

 private:
  double half_, rest_;
};

/// One search, from all start points. Lengths are in units of a power of two near the diagonal of the box, and the
/// equations are scaled by powers of two, so nothing overflows when it is squared. Powers of two in the units change no
/// result, to the last bit.
class Search {
 public:
  /// `domain` may be null; what is outside it is not found, except that inequalities in `vanishing` are not asked.
  Search(const Function& f, const Box& box, const FindSeedsOptions& options, const Domain* domain,
         const std::vector<int>& vanishing, RunWatch& watch)
      : f_(f), options_(options), domain_(domain), watch_(watch), d_(f.ambient_dim()), k_(f.codim()) {
    if (domain != nullptr) slack_.resize(domain->num_inequalities(), 0.0);
    for (int j : vanishing) slack_[j] = std::numeric_limits<double>::infinity();
    lower_ = Eigen::Map<const VectorXd>(box.lower.data(), d_);
    upper_ = Eigen::Map<const VectorXd>(box.upper.data(), d_);
    unit_ = exponent_of((upper_ * 0.5 - lower_ * 0.5).lpNorm<Eigen::Infinity>());
    for (VectorXd* corner : {&lower_, &upper_}) *corner = in_units(*corner);
    diagonal_ = (upper_ - lower_).norm();
    direction_ = low_discrepancy(17, d_).array() - 0.5;
    direction_.normalize();
  }

  FoundSeeds run() {
    try {
      for (std::size_t i = 0; i < options_.num_starts; ++i) search_from(i);
    } catch (const RunWatch::Stopped&) {
      found_.stop_reason = watch_.reason();
    }
    return std::move(found_);
  }

 private:
  /// f and Df at a point, with respect to scaled lengths; row r times 2^-exponent[r].
  struct Linearized {
    VectorXd f;
    MatrixXd J;
    std::vector<int> exponent;
  };

  void search_from(std::size_t i) {
    const VectorXd start = lower_ + low_discrepancy(i, d_).cwiseProduct(upper_ - lower_);
    ++found_.num_starts;
    const std::optional<VectorXd> point = project(start);
    if (point) accept(*point);
    if (i >= options_.num_critical || k_ == d_) return;
    ++found_.num_starts;
    const std::optional<VectorXd> critical = critical_point(point ? *point : start);
    if (critical) accept(*critical);
  }

  VectorXd in_units(const VectorXd& x) const {
    return x.unaryExpr([power = PowerOfTwo(-unit_)](double c) { return power * c; });
  }
  VectorXd in_lengths(const VectorXd& x) const {
    return x.unaryExpr([power = PowerOfTwo(unit_)](double c) { return power * c; });
  }

  bool inside(const VectorXd& x) const {
    if (domain_ != nullptr) {
      const VectorXd point = in_lengths(x);
      return domain_->contains({point.data(), std::size_t(d_)}, slack_);
    }
    return ((x - lower_).array() >= 0).all() && ((upper_ - x).array() >= 0).all();
  }

  /// Df at x, row r times 2^-exponent[r]; where `exponent` is empty, it is chosen so that the largest entry of each row
  /// is in [1, 2).
  bool jacobian(const VectorXd& x, MatrixXd& J, std::vector<int>& exponent) const {
    const VectorXd point = in_lengths(x);
    RowMajor rows(k_, d_);
    f_.jacobian({point.data(), std::size_t(d_)}, {rows.data(), std::size_t(k_ * d_)}, std::ldexp(diagonal_, unit_));
    if (!rows.allFinite()) return false;
    if (exponent.empty())
      for (int r = 0; r < k_; ++r) exponent.push_back(exponent_of(rows.row(r).lpNorm<Eigen::Infinity>()) + unit_);
    J.resize(k_, d_);
    for (int r = 0; r < k_; ++r) {
      const PowerOfTwo power(unit_ - exponent[r]);
      for (int c = 0; c < d_; ++c) J(r, c) = power * rows(r, c);
    }
    return J.allFinite();
  }

  /// f and Df at x, with the exponents given or, where there are none, those of the rows of Df. Throws
  /// RunWatch::Stopped when the run must stop.
  bool linearize(const VectorXd& x, Linearized& at) {
    if (watch_.stopped_now(0, found_.evaluations)) throw RunWatch::Stopped{};
    const VectorXd point = in_lengths(x);
    at.f.resize(k_);
    f_.evaluate({point.data(), std::size_t(d_)}, {at.f.data(), std::size_t(k_)});
    ++found_.evaluations;
    if (!at.f.allFinite() || !jacobian(x, at.J, at.exponent)) return false;
    for (int r = 0; r < k_; ++r) at.f[r] = std::ldexp(at.f[r], -at.exponent[r]);
    return at.f.allFinite();
  }

  // Newton's method with steps of least norm. Converged: a step far below the size of the box. At a regular point
  // convergence is quadratic; where the rows of Df are dependent it is linear, or the triangular factor of Df^T loses
  // rank, or (derivatives taken by differences hide the former) a row shrinks to almost nothing.
  std::optional<VectorXd> project(VectorXd x) {
    constexpr double kVanishing = -19.93;  // log2(1e-6)
    Linearized at;
    VectorXd largest_row = VectorXd::Constant(k_, -std::numeric_limits<double>::infinity());  // log2 of the norm
    double previous = 0;
    for (int i = 0; i < options_.max_iterations; ++i) {
      at.exponent.clear();
      if (!linearize(x, at)) return std::nullopt;
      bool vanishing = false;
      for (int r = 0; r < k_; ++r) {
        const double size = at.J.row(r).norm(), log_size = std::log2(size) + at.exponent[r];
        largest_row[r] = std::max(largest_row[r], log_size);
        vanishing = vanishing || log_size < largest_row[r] + kVanishing;
        if (size > 0) {
          at.J.row(r) /= size;
          at.f[r] /= size;
        }
      }
      const Eigen::ColPivHouseholderQR<MatrixXd> qr(at.J.transpose());
      const auto R = qr.matrixR().topLeftCorner(k_, k_);
      const double last_pivot = std::abs(R(k_ - 1, k_ - 1));
      if (last_pivot == 0) {
        ++found_.num_singular;
        return std::nullopt;
      }
      VectorXd step = VectorXd::Zero(d_);
      step.head(k_) = R.triangularView<Eigen::Upper>().transpose().solve(qr.colsPermutation().transpose() * at.f);
      step.applyOnTheLeft(qr.householderQ());
      const double length = step.norm();
      if (!std::isfinite(length)) return std::nullopt;
      if (length < 1e-11 * diagonal_) {
        if (!inside(x)) return std::nullopt;
        if (vanishing || last_pivot < 1e-6 || (i > 0 && length > 0.1 * previous)) {
          ++found_.num_singular;
          return std::nullopt;
        }
        return x;
      }
      previous = length;
      if (length > 0.25 * diagonal_) step *= 0.25 * diagonal_ / length;
      x -= step;
      if (is_far(x)) return std::nullopt;
    }
    return std::nullopt;
  }

  // Newton's method on the d + k equations f(x) = 0, Df(x)^T mu = g; the equations keep the scale of the first point.
  std::optional<VectorXd> critical_point(VectorXd x) {
    Linearized at;
    if (!linearize(x, at)) return std::nullopt;
    VectorXd mu = at.J.transpose().colPivHouseholderQr().solve(direction_);
    for (int i = 0; i < options_.max_iterations; ++i) {
      MatrixXd system = MatrixXd::Zero(d_ + k_, d_ + k_);
      VectorXd residual(d_ + k_);
      residual << at.f, at.J.transpose() * mu - direction_;
      system.topLeftCorner(k_, d_) = at.J;
      system.bottomRightCorner(d_, k_) = at.J.transpose();
      if (!add_second_derivatives(x, mu, at.exponent, system)) return std::nullopt;
      const VectorXd step = system.partialPivLu().solve(residual);
      const double length = step.head(d_).norm();
      if (!step.allFinite()) return std::nullopt;
      const double damping = length > 0.1 * diagonal_ ? 0.1 * diagonal_ / length : 1;
      x -= damping * step.head(d_);
      mu -= damping * step.tail(k_);
      // Projection finishes it and checks box and rank; from a little beside, so that its rate of convergence shows.
      if (length < 1e-7 * diagonal_) return project(x + 1e-3 * diagonal_ * direction_);
      if (is_far(x) || !linearize(x, at)) return std::nullopt;
    }
    return std::nullopt;
  }

  /// The derivatives of Df^T mu, by differences, into the lower left block.
  bool add_second_derivatives(const VectorXd& x, const VectorXd& mu, std::vector<int>& exponent,
                              MatrixXd& system) const {
    const double h = 1e-5 * diagonal_;
    MatrixXd ahead, behind;
    for (int c = 0; c < d_; ++c) {
      VectorXd y = x;
      y[c] += h;
      if (!jacobian(y, ahead, exponent)) return false;
      y[c] = x[c] - h;
      if (!jacobian(y, behind, exponent)) return false;
      system.block(k_, c, d_, 1) = (ahead - behind).transpose() * mu / (2 * h);
    }
    return true;
  }

  bool is_far(const VectorXd& x) const { return (x - 0.5 * (lower_ + upper_)).norm() > 2 * diagonal_; }

  /// Keeps a point unless it is close to one that is kept already. Close points have close components along g, so only
  /// few are looked at.
  void accept(const VectorXd& x) {
    ++found_.num_converged;
    const double closest = 1e-9 * diagonal_, along = direction_.dot(x);
    const double slack = closest + 1e-12 * diagonal_;  // rounding of `along`
    for (auto near = kept_.lower_bound(along - slack); near != kept_.end() && near->first <= along + slack; ++near) {
      if ((x - near->second).norm() < closest) return;
    }
    kept_.emplace(along, x);
    const VectorXd point = in_lengths(x);
    found_.points.insert(found_.points.end(), point.data(), point.data() + d_);
  }

  const Function f_;
  const FindSeedsOptions& options_;
  const Domain* domain_;
  RunWatch& watch_;
  std::vector<double> slack_;
  int d_, k_;
  int unit_ = 0;  ///< lengths are multiples of 2^unit_
  VectorXd lower_, upper_, direction_;
  double diagonal_ = 0;
  std::multimap<double, VectorXd> kept_;  ///< the points found, by g.x
  FoundSeeds found_;
};

}  // namespace

FoundSeeds find_seeds(const Function& f, const Box& box, const FindSeedsOptions& options) {
  const auto d = static_cast<std::size_t>(f.ambient_dim());
  if (box.lower.size() != d || box.upper.size() != d)
    throw InvalidInput("find_seeds: the box must have " + std::to_string(d) + " lower and upper bounds");
  RunWatch watch(options.run, "seeds");
  return Search(f, box, options, nullptr, {}, watch).run();
}

FoundSeeds find_seeds(const Function& f, const Domain& domain, const FindSeedsOptions& options) {
  if (!domain.box()) throw InvalidInput("find_seeds: the domain has no box");
  const Box& box = *domain.box();
  const int d = f.ambient_dim(), n = d - f.codim();
  RunWatch watch(options.run, "seeds");
  FoundSeeds found = Search(f, box, options, &domain, {}, watch).run();
  FindSeedsOptions fewer = options;
  fewer.num_starts = (options.num_starts + 7) / 8;
  fewer.num_critical = (options.num_critical + 7) / 8;
  std::vector<std::vector<int>> sets{{}};
  std::size_t searched = 0;
  for (int size = 1; size <= n && searched < options.max_strata; ++size) {
    std::vector<std::vector<int>> larger;
    for (const std::vector<int>& set : sets)
      for (int j = set.empty() ? 0 : set.back() + 1; j < domain.num_inequalities(); ++j) {
        if (larger.size() >= options.max_strata || (size > 1 && domain.is_box_side(j))) break;
        larger.push_back(set);
        larger.back().push_back(j);
      }
    sets = std::move(larger);
    for (const std::vector<int>& set : sets) {
      if (++searched > options.max_strata || found.stop_reason != StopReason::kNone) break;
      const FoundSeeds more = Search(domain.with_equations(f, set), box, fewer, &domain, set, watch).run();
      found.points.insert(found.points.end(), more.points.begin(), more.points.end());
      found.num_starts += more.num_starts;
      found.num_converged += more.num_converged;
      found.evaluations += more.evaluations;
      found.stop_reason = more.stop_reason;
    }
  }
  return found;
}

}  // namespace whitney
