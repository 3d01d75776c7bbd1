// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/barycentric_kernel.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

namespace whitney {
namespace {

constexpr int kLanes = BarycentricKernel::kLanes;
typedef double Lanes __attribute__((vector_size(kLanes * sizeof(double))));
typedef std::int64_t Mask __attribute__((vector_size(kLanes * sizeof(std::int64_t))));

inline Lanes splat(double x) { return Lanes{} + x; }
inline Lanes abs(Lanes x) {
  return reinterpret_cast<Lanes>(reinterpret_cast<Mask>(x) & std::int64_t{0x7fffffffffffffff});
}
inline Lanes max(Lanes a, Lanes b) { return a > b ? a : b; }
inline bool any(Mask m) {
  std::int64_t all = 0;
  for (int i = 0; i < kLanes; ++i) all |= m[i];
  return all != 0;
}
inline void swap_where(Mask m, Lanes& a, Lanes& b) {
  const Lanes t = m ? a : b;
  a = m ? b : a;
  b = t;
}

// A row is exchanged only when the pivot is this much smaller than the largest candidate: the residual proves the
// result anyway, and exchanges in lanes are the expensive part.
constexpr double kPivotThreshold = 1.0 / 64;
constexpr double kReliable = 1e-9;
constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon() / 2;

}  // namespace

// kSize = k + 1 when known at compile time, 0 otherwise.
template <int kSize>
struct BarycentricKernel::Impl {
  static int size_of(const BarycentricKernel& kernel) {
    if constexpr (kSize > 0) return kSize;
    return kernel.size_;
  }
  static Lanes* lanes(Buffer& buffer) {
    return static_cast<Lanes*>(__builtin_assume_aligned(static_cast<void*>(buffer.data()), 64));
  }

  // In-place Gauss-Jordan on A, rows exchanged where needed; the exchanges are undone on the columns at the end.
  // Candidates for a pivot are compared relative to the size of their rows of B (`weight` is the reciprocal), so that
  // the units of the components of f do not matter.
  static void invert(Lanes* A, Lanes* weight, int n) {
    struct Exchange {
      int c, r;
      Mask where;
    };
    constexpr int kInlineExchanges = 64;
    std::array<Exchange, kInlineExchanges> few;
    std::vector<Exchange> many;
    int num_exchanges = 0;

    for (int c = 0; c < n; ++c) {
      Lanes largest = abs(A[c * n + c]) * weight[c];
      const Lanes diagonal = largest;
      for (int r = c + 1; r < n; ++r) largest = max(largest, abs(A[r * n + c]) * weight[r]);
      Mask weak = diagonal < largest * kPivotThreshold;
      if (any(weak)) {
        for (int r = c + 1; r < n; ++r) {
          const Mask here = weak & (abs(A[r * n + c]) * weight[r] == largest);
          if (!any(here)) continue;
          swap_where(here, weight[c], weight[r]);
          for (int j = 0; j < n; ++j) swap_where(here, A[c * n + j], A[r * n + j]);
          if (num_exchanges < kInlineExchanges)
            few[num_exchanges] = {c, r, here};
          else
            many.push_back({c, r, here});
          ++num_exchanges;
          weak &= ~here;
        }
      }
      const Lanes inverse = 1.0 / A[c * n + c];
      for (int j = 0; j < n; ++j) A[c * n + j] *= inverse;
      A[c * n + c] = inverse;
      for (int r = 0; r < n; ++r) {
        if (r == c) continue;
        const Lanes factor = A[r * n + c];
        A[r * n + c] = Lanes{};
        for (int j = 0; j < n; ++j) A[r * n + j] -= factor * A[c * n + j];
      }
    }
    for (int e = num_exchanges - 1; e >= 0; --e) {
      const Exchange& x = e < kInlineExchanges ? few[e] : many[e - kInlineExchanges];
      for (int r = 0; r < n; ++r) swap_where(x.where, A[r * n + x.c], A[r * n + x.r]);
    }
  }

  static void factor(BarycentricKernel& kernel) {
    const int n = size_of(kernel);
    const Lanes* B = lanes(kernel.matrix_);
    Lanes* M = lanes(kernel.inverse_);
    Lanes* column_max = lanes(kernel.column_max_);
    Lanes* row_sum = lanes(kernel.solution_);  // sum_j |B_lj|; free until pivot()
    Lanes* weight = column_max;                // free until the inverse is there
    for (int l = 0; l < n; ++l) {
      Lanes sum{};
      for (int j = 0; j < n; ++j) sum += abs(B[l * n + j]);
      row_sum[l] = sum;
      weight[l] = 1.0 / sum;
    }
    for (int i = 0; i < n * n; ++i) M[i] = B[i];
    invert(M, weight, n);

    const double gamma = 4 * (n + 3) * kUnitRoundoff;
    for (int l = 0; l < n; ++l) {
      Lanes largest{};
      for (int j = 0; j < n; ++j) largest = max(largest, abs(M[j * n + l]));
      column_max[l] = largest;
    }
    Lanes rho{};
    Mask failed{};  // a comparison with NaN is false: a lane whose inversion failed must not look proven
    for (int i = 0; i < n; ++i) {
      Lanes residual{}, magnitude{};
      for (int l = 0; l < n; ++l) magnitude += abs(M[i * n + l]) * row_sum[l];
      for (int j = 0; j < n; ++j) {
        Lanes entry = splat(i == j ? -1.0 : 0.0);
        for (int l = 0; l < n; ++l) entry += M[i * n + l] * B[l * n + j];
        residual += abs(entry);
      }
      residual += gamma * (magnitude + splat(1.0) + residual);
      failed |= ~(residual < 0.5);
      rho = max(rho, residual);
    }
    for (int lane = 0; lane < kLanes; ++lane) {
      const double r = rho[lane];
      const bool proven = !failed[lane];
      kernel.inverse_error_[lane] = proven ? 1.01 * r / (1 - r) : std::numeric_limits<double>::infinity();
      kernel.weight_error_[lane] =
          proven ? kernel.inverse_error_[lane] * column_max[0][lane] : std::numeric_limits<double>::infinity();
      kernel.reliable_[lane] = proven && r < kReliable;
    }
  }

  static void pivot(BarycentricKernel& kernel) {
    const int n = size_of(kernel);
    const Lanes* M = lanes(kernel.inverse_);
    const Lanes* column_max = lanes(kernel.column_max_);
    const Lanes* c = lanes(kernel.candidate_);
    Lanes* y = lanes(kernel.solution_);
    Lanes inverse_error, weight_error;
    std::memcpy(&inverse_error, kernel.inverse_error_, sizeof inverse_error);
    std::memcpy(&weight_error, kernel.weight_error_, sizeof weight_error);

    Lanes magnitude{}, y_max{};
    for (int l = 0; l < n; ++l) magnitude += column_max[l] * abs(c[l]);
    for (int r = 0; r < n; ++r) {
      Lanes sum{};
      for (int l = 0; l < n; ++l) sum += M[r * n + l] * c[l];
      y[r] = sum;
      y_max = max(y_max, abs(sum));
    }
    const double gamma = 4 * (n + 3) * kUnitRoundoff;
    const Lanes rounding = gamma * magnitude;
    const Lanes y_error = 1.01 * (inverse_error * (y_max + rounding) + rounding);

    // Ratios are compared by products: what this loop finds is proved below, and divisions are slow.
    Lanes best_y{}, best_weight = splat(1.0);
    Mask leaving = Mask{} + kUndecided;
    for (int r = 0; r < n; ++r) {
      const Lanes weight = M[r * n];
      const Mask better = (y[r] > y_error) & (weight * best_y < best_weight * y[r]);
      best_y = better ? y[r] : best_y;
      best_weight = better ? weight : best_weight;
      leaving = better ? Mask{} + r : leaving;
    }
    // theta bounds the smallest ratio from above. Any other r with y_r possibly positive must exceed it for certain.
    const Lanes slack = weight_error + 8 * kUnitRoundoff * column_max[0];
    const Lanes theta = (best_weight + slack) / (best_y - y_error) * (1 + 16 * kUnitRoundoff);
    Mask decided = leaving >= 0;
    for (int r = 0; r < n; ++r) {
      const Lanes reach = y[r] + y_error;
      const Lanes low = M[r * n] - slack;
      decided &= (leaving == r) | (reach <= 0.0) | (low > theta * reach * (1 + 4 * kUnitRoundoff));
    }
    for (int lane = 0; lane < kLanes; ++lane)
      kernel.leaving_[lane] = decided[lane] ? static_cast<int>(leaving[lane]) : kUndecided;
  }
};

// One equation: signs decide.
template <>
struct BarycentricKernel::Impl<2> {
  static void factor(BarycentricKernel& kernel) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const double w1 = SignKernel::second_weight(kernel.matrix_[2 * kLanes + lane], kernel.matrix_[3 * kLanes + lane]);
      kernel.inverse_[lane] = 1 - w1;
      kernel.inverse_[2 * kLanes + lane] = w1;
      kernel.weight_error_[lane] = 4 * kUnitRoundoff;
      kernel.reliable_[lane] = w1 == w1;
    }
  }
  static void pivot(BarycentricKernel& kernel) {
    for (int lane = 0; lane < kLanes; ++lane) {
      kernel.leaving_[lane] = SignKernel::leaving(kernel.matrix_[2 * kLanes + lane], kernel.candidate_[kLanes + lane]);
    }
  }
};

// Eight values of eight lanes are transposed in registers: three rounds in which pairs of rows exchange halves, of ever
// larger blocks.
void BarycentricKernel::set_rows(const double* const* f, double* to, int stride) {
  constexpr int kShortest = 4;  // below, one value after the other is as fast
  const int k = codim();
  if (k < kShortest) {
    for (int lane = 0; lane < kLanes; ++lane)
      for (int r = 0; r < k; ++r) to[std::size_t(r) * stride * kLanes + lane] = f[lane][r];
    return;
  }
  static_assert(kLanes == 8);
  for (int first = 0; first < k; first += kLanes) {
    Lanes a[kLanes], b[kLanes], out[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) std::memcpy(&a[lane], f[lane] + first, sizeof a[lane]);
    for (int i = 0; i < kLanes; i += 2) {
      b[i] = __builtin_shufflevector(a[i], a[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
      b[i + 1] = __builtin_shufflevector(a[i], a[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int half = 0; half < kLanes; half += 4)
      for (int i = half; i < half + 2; ++i) {
        a[i] = __builtin_shufflevector(b[i], b[i + 2], 0, 1, 8, 9, 4, 5, 12, 13);
        a[i + 2] = __builtin_shufflevector(b[i], b[i + 2], 2, 3, 10, 11, 6, 7, 14, 15);
      }
    for (int i = 0; i < 4; ++i) {
      out[i] = __builtin_shufflevector(a[i], a[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
      out[i + 4] = __builtin_shufflevector(a[i], a[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
    for (int r = first; r < k && r < first + kLanes; ++r)
      std::memcpy(to + std::size_t(r) * stride * kLanes, &out[r - first], sizeof out[0]);
  }
}

BarycentricKernel::BarycentricKernel(int codim)
    : size_(codim + 1),
      matrix_(std::size_t(size_) * size_ * kLanes, 0.0),
      inverse_(std::size_t(size_) * size_ * kLanes, 0.0),
      candidate_(std::size_t(size_) * kLanes, 0.0),
      column_max_(std::size_t(size_) * kLanes, 0.0),
      solution_(std::size_t(size_) * kLanes, 0.0) {
  for (int i = 0; i < size_ * kLanes; ++i) matrix_[i] = 1;
  for (int i = 0; i < kLanes; ++i) candidate_[i] = 1;

  constexpr int kLargest = 13;  // codimension 12
  factor_ = &Impl<0>::factor;
  pivot_ = &Impl<0>::pivot;
  [&]<int... kSizes>(std::integer_sequence<int, kSizes...>) {
    ((size_ == kSizes + 2 ? (factor_ = &Impl<kSizes + 2>::factor, pivot_ = &Impl<kSizes + 2>::pivot, 0) : 0), ...);
  }
  (std::make_integer_sequence<int, kLargest - 1>{});
}

}  // namespace whitney
