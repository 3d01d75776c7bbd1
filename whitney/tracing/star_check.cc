// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/star_check.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/LU>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>

// Symbols as in CERTIFICATE.md. Rounding: every bound is a sum of products of numbers >= 0, whose relative error is
// below 2 n 2^-53 for n terms; `above` covers n up to 4000. A signed sum of n products is off by at most kGamma times
// the sum of their absolute values, n up to 2000.

namespace whitney {
namespace {

constexpr double kGamma = 1e-12 / 2;
constexpr int kLargestDim = 1000;
constexpr int kSignedColumns = 6;  // all 2^5 combinations of signs are tried; the other columns are added up

/// At least the sum of numbers >= 0 that was computed as x.
double above(double x) { return x * (1 + 1e-12) + 1e-300; }

/// The inverse of a k x k matrix by Gauss and Jordan; a guess. false: a pivot is 0 or not finite.
bool invert(const double* matrix, int k, double* inverse, std::vector<double>& scratch) {
  scratch.assign(matrix, matrix + k * k);
  double* const m = scratch.data();
  std::fill(inverse, inverse + k * k, 0.0);
  for (int i = 0; i < k; ++i) inverse[i * k + i] = 1;
  for (int c = 0; c < k; ++c) {
    int pivot = c;
    for (int i = c + 1; i < k; ++i) {
      if (std::fabs(m[i * k + c]) > std::fabs(m[pivot * k + c])) pivot = i;
    }
    const double p = m[pivot * k + c];
    if (!(std::fabs(p) > 1e-280 && std::fabs(p) < 1e280)) return false;
    for (int j = 0; j < k; ++j) {
      std::swap(m[pivot * k + j], m[c * k + j]);
      std::swap(inverse[pivot * k + j], inverse[c * k + j]);
    }
    for (int j = 0; j < k; ++j) {
      m[c * k + j] /= p;
      inverse[c * k + j] /= p;
    }
    for (int i = 0; i < k; ++i) {
      const double factor = m[i * k + c];
      if (i == c || factor == 0) continue;
      for (int j = 0; j < k; ++j) {
        m[i * k + j] -= factor * m[c * k + j];
        inverse[i * k + j] -= factor * inverse[c * k + j];
      }
    }
  }
  return true;
}

/// At least the spectral norm of a symmetric d x d matrix: the Frobenius norm of its 2^s-th power, squared s times with
/// scaling. Squaring in floating point errs by at most d^2 2^-53 relative to the Frobenius norm of the result, as that
/// is at least |A|_F^2 / sqrt(d); all s steps together by less than 1e-9 for d up to kLargestDim.
double spectral_norm_above(std::vector<double> a, int d, int s) {
  std::vector<double> square(a.size());
  double log_scale = 0, weight = 1;
  for (int step = 0;; ++step, weight /= 2) {
    double norm = 0;
    for (const double x : a) norm = std::max(norm, std::fabs(x));
    if (norm == 0) return step == 0 ? 0 : std::numeric_limits<double>::infinity();
    if (!(norm < std::numeric_limits<double>::infinity())) return std::numeric_limits<double>::infinity();
    for (double& x : a) x /= norm;
    log_scale += weight * std::log(norm);
    if (step == s) break;
    std::fill(square.begin(), square.end(), 0.0);
    for (int i = 0; i < d; ++i) {
      for (int m = 0; m < d; ++m) {
        const double x = a[i * d + m];
        if (x == 0) continue;
        for (int j = 0; j < d; ++j) square[i * d + j] += x * a[m * d + j];
      }
    }
    a.swap(square);
  }
  double frobenius = 0;
  for (const double x : a) frobenius += x * x;
  return std::exp(log_scale + weight * 0.5 * std::log(frobenius)) * (1 + 1e-8);
}

}  // namespace

StarCheck::StarCheck(const Enclosure& f, const coxeter::Triangulation& triangulation,
                     std::span<const double> value_error, std::span<const std::int32_t> sample)
    : f_(f), d_(f.ambient_dim()), k_(f.codim()), pairs_(d_ * (d_ + 1) / 2) {
  if (d_ > kLargestDim) throw InvalidInput("certificate: ambient dimensions beyond 1000 are not supported");
  const std::size_t d = d_, k = k_;
  const Eigen::MatrixXd linear = as_eigen(triangulation.linear());
  const Eigen::MatrixXd inverse = linear.inverse();
  lambda_.resize(d * d);
  inverse_.resize(d * d);
  for (int i = 0; i < d_; ++i) {
    for (int j = 0; j < d_; ++j) {
      lambda_[i * d_ + j] = linear(i, j);
      inverse_[i * d_ + j] = inverse(i, j);
    }
  }
  offset_.assign(triangulation.offset().data(), triangulation.offset().data() + d);
  reach_.resize(d);
  for (std::size_t i = 0; i < d; ++i) reach_[i] = above(range(&lambda_[i * d]));
  // Lambda e(U) is a difference of two vertices, d columns and their negative sum; edge_length() is within 1e-9.
  longest_ = triangulation.edge_length() * (1 + 1e-8);
  std::vector<double> steps(d * d);
  for (std::size_t i = 0; i < d; ++i) {
    for (std::size_t j = 0; j < d; ++j) {
      double dot = 0, sum_i = 0, sum_j = 0;
      for (std::size_t c = 0; c < d; ++c) {
        dot += lambda_[i * d + c] * lambda_[j * d + c];
        sum_i += lambda_[i * d + c];
        sum_j += lambda_[j * d + c];
      }
      steps[i * d + j] = dot + sum_i * sum_j;
    }
  }
  spread_of_simplex_ = above(double(d_) * (d_ + 2) / (12.0 * (d_ + 1)) * spectral_norm_above(steps, d_, 6));

  equations_.resize(k);
  for (int a = 0; a < k_; ++a) equations_[a].is_linear = f.degree(a) <= 1;
  vertex_box_.resize(d);
  star_box_.resize(d);
  for (auto* v : {&value_, &value_radius_, &gradient_sum_, &radius_sum_, &c_sum_, &w_, &sigma_}) v->resize(k);
  for (auto* v : {&cartesian_gradient_, &gradient_, &gradient_radius_, &c_, &c_cartesian_, &columns_}) v->resize(k * d);
  for (auto* v : {&smooth_low_, &smooth_high_, &linear_low_, &linear_high_, &mid_, &spread_, &guess_, &b_, &neumann_}) {
    v->resize(k * k);
  }
  differences_.resize(k * pairs_);
  sort_.resize(d + 1);

  // Equations are scaled by powers of 2 to gradients of about 1 over an edge.
  std::vector<double> largest(k, 0.0);
  for (std::size_t at = 0; at + d <= sample.size(); at += d) {
    enclose_vertex(sample.subspan(at, d), vertex_box_);
    f_.evaluate(vertex_box_, 1, jets_, workspace_);
    for (std::size_t a = 0; a < k; ++a) {
      for (std::size_t i = 0; i < d; ++i) {
        const double g = jets_.gradients[a * d + i].mag() * longest_;
        if (std::isfinite(g)) largest[a] = std::max(largest[a], g);
      }
    }
  }
  for (std::size_t a = 0; a < k; ++a) {
    if (largest[a] > 1e-280 && largest[a] < 1e280) equations_[a].scale = std::ldexp(1.0, -std::ilogb(largest[a]));
    equations_[a].value_error = above(value_error[a] * equations_[a].scale);
  }
}

void StarCheck::enclose_vertex(std::span<const std::int32_t> vertex, std::span<Range> box) const {
  for (int i = 0; i < d_; ++i) {
    double x = offset_[i], size = std::fabs(x);
    for (int j = 0; j < d_; ++j) {
      const double term = lambda_[i * d_ + j] * vertex[j];
      x += term;
      size += std::fabs(term);
    }
    const double error = above(size * (4 * d_ + 8) * 0x1p-53);
    box[i] = {outward::down(x - error), outward::up(x + error)};
  }
}

void StarCheck::enclose_star(std::span<const Range> vertex_box, std::span<Range> box) const {
  for (int i = 0; i < d_; ++i) box[i] = vertex_box[i] + Range(-reach_[i], reach_[i]);
}

double StarCheck::range(const double* h) const {
  double plus = 0, minus = 0;
  for (int i = 0; i < d_; ++i) (h[i] > 0 ? plus : minus) += std::fabs(h[i]);
  return std::max(plus, minus);
}

double StarCheck::half_variation(const double* c) const {
  std::copy(c, c + d_, sort_.begin());
  sort_[d_] = 0;
  std::nth_element(sort_.begin(), sort_.begin() + (d_ + 1) / 2, sort_.end());
  const double median = sort_[(d_ + 1) / 2];
  double sum = 0;
  for (int i = 0; i <= d_; ++i) sum += std::fabs(sort_[i] - median);
  return sum;
}

double StarCheck::length(const double* c) const {
  double squared = 0;
  for (int i = 0; i < d_; ++i) {
    double x = 0;
    for (int j = 0; j < d_; ++j) x += lambda_[i * d_ + j] * c[j];
    squared += x * x;
  }
  return std::sqrt(squared);
}

bool StarCheck::load(std::span<const std::int32_t> vertex) {
  enclose_vertex(vertex, vertex_box_);
  f_.evaluate(vertex_box_, 1, jets_, workspace_);
  bool is_curved = false;
  for (const Equation& equation : equations_)
    is_curved = is_curved || !(equation.is_linear || equation.is_curvature_known);
  if (is_curved) {
    enclose_star(vertex_box_, star_box_);
    f_.evaluate(star_box_, 2, star_jets_, workspace_);
  }
  for (int a = 0; a < k_; ++a) {
    Equation& equation = equations_[a];
    const Range value = equation.scale * jets_.values[a];
    if (!value.is_bounded()) return false;
    value_[a] = value.mid();
    value_radius_[a] = radius(value, value_[a]);
    double* const g = &gradient_[a * d_];
    double* const r = &gradient_radius_[a * d_];
    std::fill(g, g + d_, 0.0);
    std::fill(r, r + d_, 0.0);
    for (int i = 0; i < d_; ++i) {
      const Range slope = equation.scale * jets_.gradients[a * d_ + i];
      if (!slope.is_bounded()) return false;
      const double m = slope.mid(), size = radius(slope, m) + kGamma * std::fabs(m);
      cartesian_gradient_[a * d_ + i] = m;
      if (slope.is_zero()) continue;
      for (int j = 0; j < d_; ++j) {
        g[j] += m * lambda_[i * d_ + j];
        r[j] += size * std::fabs(lambda_[i * d_ + j]);
      }
    }
    gradient_sum_[a] = radius_sum_[a] = 0;
    for (int j = 0; j < d_; ++j) {
      r[j] = above(r[j]);
      gradient_sum_[a] += std::fabs(g[j]);
      radius_sum_[a] += r[j];
    }
    if (equation.is_linear) {
      equation.interpolation_error = above(equation.value_error);
    } else if (!equation.is_curvature_known) {
      if (!set_curvature(equation, &star_jets_.hessians[a * pairs_])) return false;
      equation.is_curvature_known = f_.degree(a) <= 2;
    }
  }
  return true;
}

bool StarCheck::set_curvature(Equation& equation, const Range* hessian) {
  const int d = d_;
  std::vector<double> mid(d * d), rad(d * d), product(d * d, 0.0);
  for (int i = 0, p = 0; i < d; ++i) {
    for (int j = i; j < d; ++j, ++p) {
      const Range h = equation.scale * hessian[p];
      if (!h.is_bounded()) return false;
      mid[i * d + j] = mid[j * d + i] = h.mid();
      rad[i * d + j] = rad[j * d + i] = radius(h, mid[i * d + j]);
    }
  }
  // Lambda^T mid Lambda, and what rounding may change in a row of it.
  equation.hessian.assign(d * d, 0.0);
  for (int i = 0; i < d; ++i) {
    for (int c = 0; c < d; ++c) {
      const double m = mid[i * d + c];
      if (m == 0) continue;
      for (int j = 0; j < d; ++j) product[i * d + j] += m * lambda_[c * d + j];
    }
  }
  for (int c = 0; c < d; ++c) {
    for (int i = 0; i < d; ++i) {
      for (int j = i; j < d; ++j) equation.hessian[i * d + j] += lambda_[c * d + i] * product[c * d + j];
    }
  }
  for (int i = 0; i < d; ++i) {
    for (int j = 0; j < i; ++j) equation.hessian[i * d + j] = equation.hessian[j * d + i];
  }
  std::vector<double> rows(d, 0.0), images(d, 0.0);
  for (int i = 0; i < d; ++i) {
    for (int j = 0; j < d; ++j) rows[i] += std::fabs(lambda_[i * d + j]);
  }
  for (int i = 0; i < d; ++i) {
    for (int c = 0; c < d; ++c) images[i] += std::fabs(mid[i * d + c]) * rows[c];
  }
  equation.column_sums.assign(d, 0.0);
  double rounding = 0;  // the largest sum of a row of errors
  for (int j = 0; j < d; ++j) {
    double error = 0;
    for (int i = 0; i < d; ++i) {
      error += std::fabs(lambda_[i * d + j]) * images[i];
      equation.column_sums[j] += std::fabs(equation.hessian[i * d + j]);
    }
    rounding = std::max(rounding, kGamma * (error + equation.column_sums[j]));
  }
  equation.rounding = rounding = above(rounding);
  // H = sum of a_ij (eps_i - eps_j)(eps_i - eps_j)^T over i < j <= d, eps_d = 0.
  equation.curvature.resize(pairs_);
  double plus = 0, minus = 0;
  for (int i = 0, p = 0; i < d; ++i) {
    for (int j = i + 1; j <= d; ++j, ++p) {
      double a = 0;
      if (j < d) {
        a = -equation.hessian[i * d + j];
      } else {
        for (int c = 0; c < d; ++c) a += equation.hessian[i * d + c];
      }
      equation.curvature[p] = 0.5 * std::fabs(a);
      (a > 0 ? plus : minus) += std::fabs(a);
    }
  }
  plus = above(plus);
  minus = above(minus);
  // The remainder: second derivatives within rad of mid.
  equation.spread.assign(d, 0.0);
  equation.lattice_spread.assign(d, 0.0);
  double rest = 0, frobenius = 0;
  for (int i = 0; i < d; ++i) {
    double s = 0;
    for (int j = 0; j < d; ++j) {
      s += rad[i * d + j] * reach_[j];
      frobenius += rad[i * d + j] * rad[i * d + j];
    }
    equation.spread[i] = above(s);
    rest += s * reach_[i];
  }
  rest = above(rest);
  frobenius = above(std::sqrt(frobenius));
  for (int j = 0; j < d; ++j) {
    double s = 0, squared = 0;
    for (int i = 0; i < d; ++i) {
      s += std::fabs(lambda_[i * d + j]) * equation.spread[i];
      double q = 0;
      for (int c = 0; c < d; ++c) q += rad[i * d + c] * std::fabs(lambda_[c * d + j]);
      squared += q * q;
    }
    equation.lattice_spread[j] = above(std::min(s, longest_ * std::sqrt(squared)) + rounding);
  }
  const double norm = spectral_norm_above(mid, d, 3);
  const double all_rounding = d * rounding;
  equation.interpolation_error =
      above(std::min(std::max(plus, minus) / 8, 0.5 * norm * spread_of_simplex_) +
            std::min(rest / 8, 0.5 * frobenius * spread_of_simplex_) + all_rounding + equation.value_error);
  const double square = longest_ * longest_, remainder = std::min(rest, frobenius * square);
  equation.quadratic_high = above(0.5 * (std::min(plus, norm * square) + remainder) + all_rounding);
  equation.quadratic_low = -above(0.5 * (std::min(minus, norm * square) + remainder) + all_rounding);
  return std::isfinite(equation.interpolation_error) && std::isfinite(equation.quadratic_high) &&
         std::isfinite(equation.quadratic_low);
}

bool StarCheck::choose_inverse() {
  // Lambda^-1 times the Cartesian pseudo-inverse of Df, by Cholesky's method. Any C may be used.
  const int d = d_, k = k_;
  std::vector<double>& n = scratch_;
  n.assign(k * k, 0.0);
  const double* const g = cartesian_gradient_.data();
  for (int a = 0; a < k; ++a) {
    for (int b = 0; b <= a; ++b) {
      double s = 0;
      for (int i = 0; i < d; ++i) s += g[a * d + i] * g[b * d + i];
      for (int q = 0; q < b; ++q) s -= n[a * k + q] * n[b * k + q];
      if (a == b) {
        if (!(s > 1e-280)) return false;
        n[a * k + a] = std::sqrt(s);
      } else {
        n[a * k + b] = s / n[b * k + b];
      }
    }
  }
  // The rows of X = N^-1 Df, in columns_.
  std::copy(g, g + k * d, columns_.begin());
  double* const x = columns_.data();
  for (int a = 0; a < k; ++a) {
    for (int q = 0; q < a; ++q) {
      for (int i = 0; i < d; ++i) x[a * d + i] -= n[a * k + q] * x[q * d + i];
    }
    for (int i = 0; i < d; ++i) x[a * d + i] /= n[a * k + a];
  }
  for (int a = k - 1; a >= 0; --a) {
    for (int q = a + 1; q < k; ++q) {
      for (int i = 0; i < d; ++i) x[a * d + i] -= n[q * k + a] * x[q * d + i];
    }
    for (int i = 0; i < d; ++i) x[a * d + i] /= n[a * k + a];
  }
  for (int b = 0; b < k; ++b) {
    c_sum_[b] = 0;
    double* const c = &c_[b * d];
    for (int j = 0; j < d; ++j) {
      double s = 0;
      for (int i = 0; i < d; ++i) s += inverse_[j * d + i] * x[b * d + i];
      if (!std::isfinite(s)) return false;
      c[j] = s;
      c_sum_[b] += std::fabs(s);
    }
    for (int i = 0; i < d; ++i) {
      double s = 0, size = 0;
      for (int j = 0; j < d; ++j) {
        s += lambda_[i * d + j] * c[j];
        size += std::fabs(lambda_[i * d + j] * c[j]);
      }
      c_cartesian_[b * d + i] = std::fabs(s) + kGamma * size;
    }
    for (int i = 0, p = 0; i < d; ++i) {
      for (int j = i + 1; j <= d; ++j, ++p) {
        differences_[b * pairs_ + p] = std::fabs(c[i] - (j < d ? c[j] : 0.0));
      }
    }
  }
  return true;
}

void StarCheck::enclose_products_of(int a) {
  const int d = d_, k = k_;
  const Equation& equation = equations_[a];
  const double* const g = &gradient_[a * d];
  const double* const g_radius = &gradient_radius_[a * d];
  std::vector<double>& h = scratch_;
  h.resize(2 * d + k);
  double *const rest = h.data() + d, *const mu = h.data() + 2 * d;
  for (int b = 0; b < k; ++b) {
    const double* const c = &c_[b * d];
    double at_vertex = 0, error = 0;  // G_a c_b
    for (int j = 0; j < d; ++j) {
      at_vertex += g[j] * c[j];
      error += g_radius[j] * std::fabs(c[j]) + kGamma * std::fabs(g[j] * c[j]);
    }
    error = above(error);
    // What differences of the tracer's values add: 2 value_error times the sum of |c|.
    const double values = above(2 * equation.value_error * c_sum_[b]);
    const std::size_t at = a * k + b;
    if (equation.is_linear) {
      smooth_low_[at] = at_vertex - error;
      smooth_high_[at] = at_vertex + error;
      linear_low_[at] = at_vertex - (error + values);
      linear_high_[at] = at_vertex + (error + values);
      continue;
    }
    // h = H c, linear forms in the shift u from v; size bounds what rounding does to a row of H c.
    double size = 0, smooth_rest = 0, linear_rest = 0, half = 0;
    for (int j = 0; j < d; ++j) {
      size += equation.column_sums[j] * std::fabs(c[j]);
      smooth_rest += equation.spread[j] * c_cartesian_[b * d + j];
      linear_rest += equation.lattice_spread[j] * std::fabs(c[j]);
    }
    for (int p = 0; p < pairs_; ++p) half += equation.curvature[p] * differences_[b * pairs_ + p];
    half = above(half);
    for (int i = 0; i < d; ++i) h[i] = 0;
    for (int j = 0; j < d; ++j) {
      const double cj = c[j];
      if (cj == 0) continue;
      for (int i = 0; i < d; ++i) h[i] += equation.hessian[j * d + i] * cj;
    }
    const double raw = above(range(h.data()) + kGamma * size + error);
    // The tube: h u = (h - G^T mu) u + mu (G u), and G u is known at zeros.
    double shift = 0, slack = 0, rounding = kGamma * size;
    std::copy(h.begin(), h.begin() + d, rest);
    for (int q = 0; q < k; ++q) {
      double m = 0;
      for (int j = 0; j < d; ++j) m += c_[q * d + j] * h[j];
      mu[q] = m;
      if (m == 0) continue;
      const Equation& other = equations_[q];
      const double value = value_[q] + 0.5 * (other.quadratic_low + other.quadratic_high);
      const double width =
          0.5 * (other.quadratic_high - other.quadratic_low) + other.interpolation_error + value_radius_[q];
      shift += value * m;
      slack += (width + kGamma * (std::fabs(value_[q]) + other.quadratic_high - other.quadratic_low)) * std::fabs(m);
      rounding += std::fabs(m) * (radius_sum_[q] + kGamma * gradient_sum_[q]);
      for (int j = 0; j < d; ++j) rest[j] -= m * gradient_[q * d + j];
    }
    const double tube = above(range(rest) + rounding + slack + error);
    // The quadratic part of Dg(z) c at zeros z in the star.
    const double low = std::max(at_vertex - raw, at_vertex - shift - tube);
    const double high = std::min(at_vertex + raw, at_vertex - shift + tube);
    // low and high are sums of three numbers.
    const double touch = 1e-14 * (std::fabs(at_vertex) + std::fabs(shift) + raw + std::fabs(tube));
    if (low - touch > high + touch) is_empty_ = true;
    const double turned = equation.rounding * c_sum_[b];
    const double smooth = above(smooth_rest + turned) + touch;
    smooth_low_[at] = low - smooth;
    smooth_high_[at] = high + smooth;
    const double linear = above(linear_rest + values + turned) + touch;
    linear_low_[at] = std::max(at_vertex - half - error, low - half) - linear;
    linear_high_[at] = std::min(at_vertex + half + error, high + half) + linear;
  }
}

bool StarCheck::enclose_products() {
  is_empty_ = false;
  for (int a = 0; a < k_; ++a) enclose_products_of(a);
  return !is_empty_;
}

bool StarCheck::conclude_piece(double begin, double end, StarReport& report, double& drop, double& displacement) {
  const int d = d_, k = k_;
  const double t = 0.5 * (begin + end);
  for (int i = 0; i < k * k; ++i) {
    const double pl = linear_low_[i], ph = linear_high_[i], sl = smooth_low_[i], sh = smooth_high_[i];
    const double low = std::min((1 - begin) * pl + begin * sl, (1 - end) * pl + end * sl);
    const double high = std::max((1 - begin) * ph + begin * sh, (1 - end) * ph + end * sh);
    mid_[i] = (1 - t) * (0.5 * pl + 0.5 * ph) + t * (0.5 * sl + 0.5 * sh);
    const double rounding = 1e-15 * (std::fabs(pl) + std::fabs(ph) + std::fabs(sl) + std::fabs(sh));
    spread_[i] = above(std::max(high - mid_[i], mid_[i] - low) + rounding);
    if (!(spread_[i] < 1e280)) return false;
  }
  if (!invert(mid_.data(), k, guess_.data(), scratch_)) return false;
  // |I - M C'| <= B with C' = C guess: the spread, and what is left of mid guess - I.
  for (int a = 0; a < k; ++a) {
    for (int b = 0; b < k; ++b) {
      double s = 0, residual = a == b ? -1 : 0, size = a == b ? 1 : 0;
      for (int q = 0; q < k; ++q) {
        const double m = mid_[a * k + q], g = guess_[q * k + b];
        s += spread_[a * k + q] * std::fabs(g);
        residual += m * g;
        size += std::fabs(m * g);
      }
      b_[a * k + b] = above(s + std::fabs(residual) + kGamma * size);
      neumann_[a * k + b] = (a == b ? 1 : 0) - b_[a * k + b];
    }
  }
  // An estimate of the spectral radius, for reports only.
  std::fill(w_.begin(), w_.end(), 1.0);
  double largest = 0;
  for (int step = 0; step < 12; ++step) {
    largest = 0;
    for (int a = 0; a < k; ++a) {
      double s = 1e-3 * w_[a];
      for (int b = 0; b < k; ++b) s += b_[a * k + b] * w_[b];
      sigma_[a] = s;
      largest = std::max(largest, s);
    }
    if (!(largest > 0 && largest < 1e280)) break;
    for (int a = 0; a < k; ++a) w_[a] = sigma_[a] / largest;
  }
  report.radius = largest < 1e280 ? std::max(report.radius, largest) : std::numeric_limits<double>::infinity();
  std::vector<double> inverse(k * k);
  if (!invert(neumann_.data(), k, inverse.data(), scratch_)) return false;
  double largest_error = 0;
  for (int a = 0; a < k; ++a) {
    w_[a] = 0;
    for (int b = 0; b < k; ++b) w_[a] += inverse[a * k + b];
    largest_error = std::max(largest_error, equations_[a].interpolation_error);
  }
  for (int a = 0; a < k; ++a) {
    double s = 0;
    for (int b = 0; b < k; ++b) s += inverse[a * k + b] * equations_[b].interpolation_error;
    sigma_[a] = s * (1 + 1e-9) + 1e-9 * largest_error * w_[a];
  }
  // w > 0 and B w < w: the spectral radius is below 1. e + B sigma <= sigma: then (I - B)^-1 e <= sigma.
  for (int a = 0; a < k; ++a) {
    double image = 0, bound = equations_[a].interpolation_error;
    for (int b = 0; b < k; ++b) {
      image += b_[a * k + b] * w_[b];
      bound += b_[a * k + b] * sigma_[b];
    }
    if (!(w_[a] > 0 && w_[a] < 1e280 && above(image) < w_[a])) return false;
    if (!(sigma_[a] >= 0 && above(bound) <= sigma_[a])) return false;
  }
  // The columns sigma_b C'_b, and what rounding does to them.
  std::vector<std::pair<double, int>> order(k);
  double rounding = 0;
  for (int b = 0; b < k; ++b) {
    double* const column = &columns_[b * d];
    std::fill(column, column + d, 0.0);
    for (int q = 0; q < k; ++q) {
      const double factor = guess_[q * k + b] * sigma_[b];
      if (factor == 0) continue;
      rounding += std::fabs(factor) * c_sum_[q];
      for (int j = 0; j < d; ++j) column[j] += c_[q * d + j] * factor;
    }
    order[b] = {-half_variation(column), b};
  }
  rounding *= 4 * kGamma;
  std::sort(order.begin(), order.end());
  const int num_signed = std::min(k, kSignedColumns);
  double rest = 0, rest_length = 0, most = 0, farthest = 0;
  for (int i = num_signed; i < k; ++i) {
    rest -= order[i].first;
    rest_length += length(&columns_[order[i].second * d]);
  }
  std::vector<double> c(d);
  for (int signs = 0; signs < 1 << (num_signed - 1); ++signs) {
    std::copy_n(&columns_[order[0].second * d], d, c.begin());
    for (int i = 1; i < num_signed; ++i) {
      const double* const column = &columns_[order[i].second * d];
      const double sign = signs >> (i - 1) & 1 ? -1 : 1;
      for (int j = 0; j < d; ++j) c[j] += sign * column[j];
    }
    most = std::max(most, half_variation(c.data()));
    farthest = std::max(farthest, length(c.data()));
  }
  // A change of c by r in the sum norm changes both the half variation and, times the longest edge, the length by r.
  drop = above((end - begin) * (rest + most + rounding) * (1 + 1e-9));
  displacement = above((end - begin) * (rest_length + farthest + rounding * longest_) * (1 + 1e-9));
  return std::isfinite(drop) && std::isfinite(displacement);
}

void StarCheck::conclude(int num_pieces, StarReport& report) {
  report = {};
  report.outcome = StarReport::Outcome::kRegular;
  for (int piece = 0; piece < num_pieces; ++piece) {
    const double begin = num_pieces == 1 ? 0 : kIsotopyTimes[piece];
    const double end = num_pieces == 1 ? 1 : kIsotopyTimes[piece + 1];
    double drop = 0, displacement = 0;
    if (!conclude_piece(begin, end, report, drop, displacement)) {
      report.outcome = StarReport::Outcome::kIrregular;
      report.radius = std::max(report.radius, 1.0);
      return;
    }
    if (num_pieces > 1) {
      report.drop[piece] = drop;
      report.displacement[piece] = displacement;
    } else {
      for (int i = 0; i < kIsotopyPieces; ++i) {
        const double share = kIsotopyTimes[i + 1] - kIsotopyTimes[i];
        report.drop[i] = above(share * drop);
        report.displacement[i] = above(share * displacement);
      }
    }
  }
}

StarReport StarCheck::operator()(std::span<const std::int32_t> vertex) {
  StarReport report;
  if (!load(vertex)) {
    report.outcome = StarReport::Outcome::kUnbounded;
    return report;
  }
  if (!choose_inverse()) {
    report.outcome = StarReport::Outcome::kSingular;
    return report;
  }
  if (!enclose_products()) {
    report.outcome = StarReport::Outcome::kEmpty;
    return report;
  }
  conclude(1, report);
  if (!report.is_regular() || report.total_drop() > 0.5) conclude(kIsotopyPieces, report);
  return report;
}

}  // namespace whitney
