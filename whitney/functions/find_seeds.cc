// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/find_seeds.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <Eigen/LU>
#include <Eigen/QR>

#include <coxeter/base/error.h>

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

class Search {
 public:
  /// `domain` may be null; what is outside it is not found, except that inequalities in `vanishing` are not asked.
  Search(const Function& f, const Box& box, const FindSeedsOptions& options, const Domain* domain,
         const std::vector<int>& vanishing)
      : f_(f), options_(options), domain_(domain), d_(f.ambient_dim()), k_(f.codim()) {
    if (domain != nullptr) slack_.resize(domain->num_inequalities(), 0.0);
    for (int j : vanishing) slack_[j] = std::numeric_limits<double>::infinity();
    lower_ = Eigen::Map<const VectorXd>(box.lower.data(), d_);
    upper_ = Eigen::Map<const VectorXd>(box.upper.data(), d_);
    diagonal_ = (upper_ - lower_).norm();
    direction_ = low_discrepancy(17, d_).array() - 0.5;
    direction_.normalize();
  }

  FoundSeeds run() {
    for (std::size_t i = 0; i < options_.num_starts && !stopped(); ++i) {
      const VectorXd start = lower_ + low_discrepancy(i, d_).cwiseProduct(upper_ - lower_);
      ++found_.num_starts;
      const std::optional<VectorXd> point = project(start);
      if (point) accept(*point);
      if (i >= options_.num_critical || k_ == d_) continue;
      ++found_.num_starts;
      const std::optional<VectorXd> critical = critical_point(point ? *point : start);
      if (critical) accept(*critical);
    }
    return std::move(found_);
  }

 private:
  bool stopped() {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    if (seconds > options_.run.time_limit)
      found_.stop_reason = StopReason::kTimeLimit;
    else if (options_.run.progress && !options_.run.progress({"seeds", 0, found_.evaluations, seconds}))
      found_.stop_reason = StopReason::kCancelled;
    return found_.stop_reason != StopReason::kNone;
  }
  bool value(const VectorXd& x, VectorXd& f) {
    f.resize(k_);
    f_.evaluate({x.data(), std::size_t(d_)}, {f.data(), std::size_t(k_)});
    ++found_.evaluations;
    return f.allFinite();
  }
  bool inside(const VectorXd& x) const {
    if (domain_ != nullptr) return domain_->contains({x.data(), std::size_t(d_)}, slack_);
    return ((x - lower_).array() >= 0).all() && ((upper_ - x).array() >= 0).all();
  }
  bool jacobian(const VectorXd& x, MatrixXd& J) const {
    RowMajor rows(k_, d_);
    f_.jacobian({x.data(), std::size_t(d_)}, {rows.data(), std::size_t(k_ * d_)}, diagonal_);
    J = rows;
    return J.allFinite();
  }

  // Newton's method with steps of least norm. Converged: a step far below the size of the box. At a regular point
  // convergence is quadratic; where the rows of Df are dependent it is linear, or the triangular factor of Df^T loses
  // rank, or (derivatives taken by differences hide the former) a row shrinks to almost nothing.
  std::optional<VectorXd> project(VectorXd x) {
    VectorXd f, largest_row = VectorXd::Zero(k_);
    bool vanishing = false;
    MatrixXd J;
    double previous = 0;
    for (int i = 0; i < options_.max_iterations; ++i) {
      if (!value(x, f) || !jacobian(x, J)) return std::nullopt;
      vanishing = false;
      for (int r = 0; r < k_; ++r) {
        const double size = J.row(r).norm();
        largest_row[r] = std::max(largest_row[r], size);
        vanishing = vanishing || size < 1e-6 * largest_row[r];
        if (size > 0) {
          J.row(r) /= size;
          f[r] /= size;
        }
      }
      const Eigen::ColPivHouseholderQR<MatrixXd> qr(J.transpose());
      const auto R = qr.matrixR().topLeftCorner(k_, k_);
      const double last_pivot = std::abs(R(k_ - 1, k_ - 1));
      if (last_pivot == 0) {
        ++found_.num_singular;
        return std::nullopt;
      }
      VectorXd step = VectorXd::Zero(d_);
      step.head(k_) = R.triangularView<Eigen::Upper>().transpose().solve(qr.colsPermutation().transpose() * f);
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
      if ((x - 0.5 * (lower_ + upper_)).norm() > 2 * diagonal_) return std::nullopt;
    }
    return std::nullopt;
  }

  // Newton's method on the d + k equations f(x) = 0, Df(x)^T mu = g.
  std::optional<VectorXd> critical_point(VectorXd x) {
    VectorXd f;
    MatrixXd J, shifted;
    if (!value(x, f) || !jacobian(x, J)) return std::nullopt;
    VectorXd mu = J.transpose().colPivHouseholderQr().solve(direction_);
    const double h = 1e-5 * diagonal_;
    for (int i = 0; i < options_.max_iterations; ++i) {
      MatrixXd system = MatrixXd::Zero(d_ + k_, d_ + k_);
      VectorXd residual(d_ + k_);
      residual << f, J.transpose() * mu - direction_;
      system.topLeftCorner(k_, d_) = J;
      system.bottomRightCorner(d_, k_) = J.transpose();
      for (int c = 0; c < d_; ++c) {
        VectorXd y = x;
        y[c] += h;
        MatrixXd behind;
        if (!jacobian(y, shifted)) return std::nullopt;
        y[c] = x[c] - h;
        if (!jacobian(y, behind)) return std::nullopt;
        system.block(k_, c, d_, 1) = (shifted - behind).transpose() * mu / (2 * h);
      }
      const VectorXd step = system.partialPivLu().solve(residual);
      const double length = step.head(d_).norm();
      if (!step.allFinite()) return std::nullopt;
      const double damping = length > 0.1 * diagonal_ ? 0.1 * diagonal_ / length : 1;
      x -= damping * step.head(d_);
      mu -= damping * step.tail(k_);
      // Projection finishes it and checks box and rank; from a little beside, so that its rate of convergence shows.
      if (length < 1e-7 * diagonal_) return project(x + 1e-3 * diagonal_ * direction_);
      if ((x - 0.5 * (lower_ + upper_)).norm() > 2 * diagonal_) return std::nullopt;
      if (!value(x, f) || !jacobian(x, J)) return std::nullopt;
    }
    return std::nullopt;
  }

  void accept(const VectorXd& x) {
    ++found_.num_converged;
    for (std::size_t i = 0; i < found_.points.size(); i += d_)
      if ((x - Eigen::Map<const VectorXd>(&found_.points[i], d_)).norm() < 1e-9 * diagonal_) return;
    found_.points.insert(found_.points.end(), x.data(), x.data() + d_);
  }

  const Function f_;
  const FindSeedsOptions& options_;
  const Domain* domain_;
  std::vector<double> slack_;
  int d_, k_;
  VectorXd lower_, upper_, direction_;
  double diagonal_ = 0;
  FoundSeeds found_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

FoundSeeds find_seeds(const Function& f, const Box& box, const FindSeedsOptions& options) {
  const auto d = static_cast<std::size_t>(f.ambient_dim());
  if (box.lower.size() != d || box.upper.size() != d)
    throw InvalidInput("find_seeds: the box must have " + std::to_string(d) + " lower and upper bounds");
  return Search(f, box, options, nullptr, {}).run();
}

FoundSeeds find_seeds(const Function& f, const Domain& domain, const FindSeedsOptions& options) {
  if (!domain.box()) throw InvalidInput("find_seeds: the domain has no box");
  const Box& box = *domain.box();
  const int d = f.ambient_dim(), n = d - f.codim();
  const auto begin = std::chrono::steady_clock::now();
  FoundSeeds found = Search(f, box, options, &domain, {}).run();
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
      const double used = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      fewer.run.time_limit = options.run.time_limit - used;
      const FoundSeeds more = Search(domain.with_equations(f, set), box, fewer, &domain, set).run();
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
