// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/certificate_proof.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <CGAL/Interval_nt.h>

#include <perturbation/small_inverse.h>

namespace whitney::perturbation {
namespace {

/// All arithmetic on it happens while a Rounding is alive.
using Interval = CGAL::Interval_nt<false>;
using Rounding = Interval::Protector;

double above(const Interval& x) { return std::max(std::abs(x.inf()), std::abs(x.sup())); }

/// [-r, r].
Interval ball(double r) { return {-r, r}; }

/// An upper bound of norm(A) (spectral) for the rows x cols interval matrix A.
double norm_above(const std::vector<Interval>& A, int rows, int cols) {
  const int m = std::min(rows, cols);
  std::vector<Interval> gram(static_cast<std::size_t>(m) * m);
  for (int a = 0; a < m; ++a)
    for (int b = 0; b < m; ++b) {
      Interval sum(0);
      if (rows <= cols)
        for (int c = 0; c < cols; ++c) sum += A[a * cols + c] * A[b * cols + c];
      else
        for (int r = 0; r < rows; ++r) sum += A[r * cols + a] * A[r * cols + b];
      gram[a * m + b] = sum;
    }
  for (const Interval& entry : gram)
    if (!(above(entry) < 1e150)) return std::numeric_limits<double>::infinity();
  if (m == 1) return above(sqrt(Interval(above(gram[0]))));
  if (m == 2) {
    const Interval half = (gram[0] - gram[3]) / Interval(2);
    const Interval root = sqrt(Interval(above(half * half)) + Interval(above(gram[1] * gram[1])));
    return above(sqrt(Interval(above((gram[0] + gram[3]) / Interval(2) + root))));
  }
  // norm(A)^2 = norm(gram) <= norm(gram^16)_F^(1/16); gram is scaled to keep the powers in range.
  double scale = 0;
  for (const Interval& entry : gram) scale = std::max(scale, above(entry));
  if (!(scale > 0)) return 0;
  const Interval inverse = Interval(1) / Interval(scale);
  for (Interval& entry : gram) entry *= inverse;
  std::vector<Interval> square(gram.size());
  constexpr int kSquarings = 4;
  for (int s = 0; s < kSquarings; ++s) {
    for (int a = 0; a < m; ++a)
      for (int b = 0; b < m; ++b) {
        Interval sum(0);
        for (int c = 0; c < m; ++c) sum += gram[a * m + c] * gram[c * m + b];
        square[a * m + b] = sum;
      }
    gram.swap(square);
  }
  Interval sum(0);
  for (const Interval& entry : gram) sum += Interval(above(entry)) * Interval(above(entry));
  Interval root = sqrt(sum);
  for (int s = 0; s < kSquarings; ++s) root = sqrt(root);
  return above(sqrt(Interval(above(root * Interval(scale)))));
}

}  // namespace

const char* to_string(Proof::Outcome outcome) {
  switch (outcome) {
    case Proof::Outcome::kProven:
      return "proven";
    case Proof::Outcome::kFrame:
      return "the frame of the oracle is not orthonormal";
    case Proof::Outcome::kSingleSheet:
      return "single sheet (C)";
    case Proof::Outcome::kSeparation:
      return "separation (A+)";
    case Proof::Outcome::kTransversality:
      return "transversality (B)";
    default:
      return "hit or not, undecided";
  }
}

CertificateProver::CertificateProver(Certificate& certificate) : certificate_(certificate) {
  const VertexSubsets& low = certificate.low_faces();
  const VertexSubsets& high = certificate.hit_candidates();
  std::map<std::vector<std::uint8_t>, std::uint32_t> number;
  for (std::size_t f = 0; f < low.num(); ++f) number[{low[f], low[f] + low.size}] = static_cast<std::uint32_t>(f);
  for (std::size_t f = 0; f < high.num(); ++f)
    for (int omitted = 0; omitted < high.size; ++omitted) {
      std::vector<std::uint8_t> sub(high[f], high[f] + high.size);
      sub.erase(sub.begin() + omitted);
      subfaces_.push_back(number.at(sub));
    }
}

Proof CertificateProver::prove(const double* const* vertices, const FootView& foot) {
  const int d = certificate_.ambient_dim(), n = certificate_.intrinsic_dim(), k = certificate_.codim();
  const int num = certificate_.simplex_dim() + 1;
  Proof proof;
  const Margins guess = certificate_.evaluate(vertices, foot);
  proof.margins = guess;
  if (!guess.single_sheet || !std::isfinite(foot.errors.point) || !std::isfinite(foot.errors.angle)) return proof;

  const auto fail = [&](Proof::Outcome outcome, const std::uint8_t* face, int size) {
    proof.outcome = outcome;
    proof.face.assign(face, face + size);
    return proof;
  };

  // Everything that floating point guesses comes before the rounding mode changes.
  const VertexSubsets& low = certificate_.low_faces();
  const VertexSubsets& high = certificate_.hit_candidates();
  std::vector<std::vector<double>> inverses(high.num());
  std::vector<double> matrix(static_cast<std::size_t>(k) * k);
  for (std::size_t f = 0; f < high.num(); ++f) {
    if (!certificate_.face_is_hit(f)) continue;
    for (int b = 0; b < k; ++b)
      for (int j = 0; j < k; ++j)
        matrix[b * k + j] = certificate_.normal_part(high[f][j + 1])[b] - certificate_.normal_part(high[f][0])[b];
    inverses[f].resize(matrix.size());
    const bool regular = invert(matrix.data(), inverses[f].data(), k);
    if (!regular || !std::all_of(inverses[f].begin(), inverses[f].end(), [](double x) { return std::abs(x) < 1e150; }))
      return fail(Proof::Outcome::kUndecided, high[f], high.size);
  }

  const Rounding rounding;
  Interval departure(0);
  for (int a = 0; a < d; ++a)
    for (int b = 0; b <= a; ++b) {
      Interval sum(a == b ? -1 : 0);
      for (int c = 0; c < d; ++c) sum += Interval(foot.frame[a * d + c]) * Interval(foot.frame[b * d + c]);
      departure += Interval(a == b ? 1 : 2) * Interval(above(sum)) * Interval(above(sum));
    }
  const double delta = above(sqrt(departure));
  if (!(delta < 1e-3)) {
    proof.outcome = Proof::Outcome::kFrame;
    return proof;
  }
  const Interval turn = Interval(foot.errors.angle) + Interval(2.2) * Interval(delta);

  std::vector<Interval> P(static_cast<std::size_t>(num) * k), Q(static_cast<std::size_t>(num) * n), height(num);
  std::vector<double> eta(num);
  std::vector<Interval> radius(num);
  double largest_radius = 0;
  for (int i = 0; i < num; ++i) {
    std::vector<Interval> away(d);
    Interval squared(0);
    for (int c = 0; c < d; ++c) {
      away[c] = Interval(vertices[i][c]) - Interval(foot.point[c]);
      squared += Interval(above(away[c])) * Interval(above(away[c]));
    }
    eta[i] = above(Interval(foot.errors.point) + turn * sqrt(squared));
    Interval tangential(0);
    for (int a = 0; a < n; ++a) {
      Interval sum(0);
      for (int c = 0; c < d; ++c) sum += Interval(foot.frame[a * d + c]) * away[c];
      Q[i * n + a] = sum;
      tangential += Interval(above(sum)) * Interval(above(sum));
    }
    radius[i] = Interval(above(sqrt(tangential) + Interval(eta[i])));
    largest_radius = std::max(largest_radius, radius[i].sup());
    Interval normal(0);
    for (int b = 0; b < k; ++b) {
      Interval sum(0);
      for (int c = 0; c < d; ++c) sum += Interval(foot.frame[(n + b) * d + c]) * away[c];
      P[i * k + b] = sum;
      normal += Interval(above(sum)) * Interval(above(sum));
    }
    height[i] = sqrt(normal) + Interval(eta[i]);
  }

  // (C)
  const Interval R(certificate_.reach()), R_c(certificate_.curvature_radius());
  if (!(largest_radius < R.inf())) return proof;
  const Interval r(largest_radius);
  const Interval far = R + sqrt(R * R - r * r);
  for (int i = 0; i < num; ++i)
    if (!(height[i].sup() < far.inf())) return proof;

  // (A+)
  std::vector<double> weight(num);
  for (int i = 0; i < num; ++i) {
    const Interval squared = radius[i] * radius[i];
    weight[i] = above(squared / (R_c + sqrt(R_c * R_c - squared)) + Interval(eta[i]));
  }
  const auto separates = [&](const double* e, const std::uint8_t* face, int size, const std::vector<double>& distance) {
    Interval squared(0);
    for (int b = 0; b < k; ++b) {
      if (!(std::abs(e[b]) < 1e150)) return false;
      squared += Interval(e[b]) * Interval(e[b]);
    }
    const Interval length = sqrt(squared);
    for (int j = 0; j < size; ++j) {
      Interval along(0);
      for (int b = 0; b < k; ++b) along += Interval(e[b]) * P[face[j] * k + b];
      if (!((along - length * Interval(distance[face[j]])).inf() > 0)) return false;
    }
    return true;
  };
  for (std::size_t f = 0; f < low.num(); ++f)
    if (!separates(certificate_.separating_direction(f), low[f], low.size, weight))
      return fail(Proof::Outcome::kSeparation, low[f], low.size);

  // Which k-faces are hit, and (B) for those.
  const Interval ratio = R_c / r;
  std::vector<Interval> normal_edges(static_cast<std::size_t>(k) * k), residual(normal_edges.size()),
      tangent_edges(static_cast<std::size_t>(n) * k), slope(tangent_edges.size());
  const std::uint32_t all = (std::uint32_t{2} << (num - 1)) - 1;
  for (std::size_t f = 0; f < high.num(); ++f) {
    const std::uint8_t* face = high[f];
    if (!certificate_.face_is_hit(f)) {
      // The direction that separates the closest of its (k-1)-faces separates it as a whole.
      std::uint32_t closest = subfaces_[f * (k + 1)];
      for (int j = 1; j <= k; ++j)
        if (const std::uint32_t sub = subfaces_[f * (k + 1) + j];
            certificate_.separation(sub) < certificate_.separation(closest))
          closest = sub;
      bool apart = separates(certificate_.separating_direction(closest), face, k + 1, eta);
      for (int j = 0; j <= k && !apart; ++j)
        apart = separates(certificate_.separating_direction(subfaces_[f * (k + 1) + j]), face, k + 1, eta);
      if (!apart) return fail(Proof::Outcome::kUndecided, face, k + 1);
      continue;
    }
    const double* C = inverses[f].data();
    for (int b = 0; b < k; ++b)
      for (int j = 0; j < k; ++j)
        normal_edges[b * k + j] =
            P[face[j + 1] * k + b] + ball(eta[face[j + 1]]) - P[face[0] * k + b] - ball(eta[face[0]]);
    // C M = I - residual with norm_inf(residual) <= left; M C likewise with norm_F <= right.
    double left = 0;
    Interval right(0);
    for (int a = 0; a < k; ++a) {
      Interval row(0);
      for (int j = 0; j < k; ++j) {
        Interval sum(a == j ? 1 : 0), other(a == j ? 1 : 0);
        for (int b = 0; b < k; ++b) {
          sum -= Interval(C[a * k + b]) * normal_edges[b * k + j];
          other -= normal_edges[a * k + b] * Interval(C[b * k + j]);
        }
        row += Interval(above(sum));
        right += Interval(above(other)) * Interval(above(other));
      }
      left = std::max(left, row.sup());
    }
    const double right_norm = above(sqrt(right));
    if (!(left < 1) || !(right_norm < 1)) return fail(Proof::Outcome::kUndecided, face, k + 1);
    // Barycentric coordinates mu = M^-1 (-P_0) = b + error, b = C (-P_0), abs(error) <= norm(b) left / (1 - left).
    double largest = 0;
    std::vector<Interval> coordinates(k);
    for (int j = 0; j < k; ++j) {
      Interval sum(0);
      for (int b = 0; b < k; ++b) sum -= Interval(C[j * k + b]) * (P[face[0] * k + b] + ball(eta[face[0]]));
      coordinates[j] = sum;
      largest = std::max(largest, above(sum));
    }
    const double error = above(Interval(largest) * Interval(left) / (Interval(1) - Interval(left)));
    Interval first(1);
    bool inside = true;
    for (int j = 0; j < k; ++j) {
      const Interval coordinate = coordinates[j] + ball(error);
      inside = inside && coordinate.inf() > 0;
      first -= coordinate;
    }
    if (!inside || !(first.inf() > 0)) return fail(Proof::Outcome::kUndecided, face, k + 1);
    // (B)
    for (int a = 0; a < n; ++a)
      for (int j = 0; j < k; ++j)
        tangent_edges[a * k + j] =
            Q[face[j + 1] * n + a] + ball(eta[face[j + 1]]) - Q[face[0] * n + a] - ball(eta[face[0]]);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < k; ++b) {
        Interval sum(0);
        for (int j = 0; j < k; ++j) sum += tangent_edges[a * k + j] * Interval(C[j * k + b]);
        slope[a * k + b] = sum;
      }
    const double slope_norm = norm_above(slope, n, k);
    if (!std::isfinite(slope_norm)) return fail(Proof::Outcome::kTransversality, face, k + 1);
    const Interval steepest = Interval(slope_norm) / (Interval(1) - Interval(right_norm));
    const Interval sine = Interval(1) / sqrt(Interval(1) + Interval(above(steepest)) * Interval(above(steepest)));
    if (!((sine * ratio).inf() > 1)) return fail(Proof::Outcome::kTransversality, face, k + 1);
    std::uint32_t members = 0;
    for (int j = 0; j <= k; ++j) members |= std::uint32_t{1} << face[j];
    proof.hit_facets |= all & ~members;
    ++proof.num_hit;
  }
  proof.outcome = Proof::Outcome::kProven;
  return proof;
}

bool proved_inside(const double* const* vertices, int ambient_dim, const double* point, double error) {
  // A lambda = (1, x). With C near A^-1 and l = C (1, x): lambda - l = (C A)^-1 C ((1, x) - A l), and moving x by at
  // most `error` moves lambda by at most norm_inf((C A)^-1) times the largest row of abs(C) without its first column.
  const int m = ambient_dim + 1;
  std::vector<double> A(static_cast<std::size_t>(m) * m), destroyed, C(A.size()), guess(m), x(m, 1.0);
  std::copy_n(point, ambient_dim, x.begin() + 1);
  for (int i = 0; i < m; ++i) {
    A[i] = 1;
    for (int c = 0; c < ambient_dim; ++c) A[(c + 1) * m + i] = vertices[i][c];
  }
  destroyed = A;
  if (!std::isfinite(error) || !invert(destroyed.data(), C.data(), m)) return false;
  for (int i = 0; i < m; ++i) {
    double sum = 0;
    for (int j = 0; j < m; ++j) {
      if (!(std::abs(C[i * m + j]) < 1e150)) return false;
      sum += C[i * m + j] * x[j];
    }
    guess[i] = sum;
  }
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
  if (!(departure < 1)) return false;
  const double slack =
      above((Interval(correction) + Interval(spread) * Interval(error)) / (Interval(1) - Interval(departure)));
  return std::all_of(guess.begin(), guess.end(), [&](double lambda) { return lambda > slack; });
}

}  // namespace whitney::perturbation
