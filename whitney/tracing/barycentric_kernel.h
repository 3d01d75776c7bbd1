// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace whitney {

/// One equation, one simplex: signs decide, exactly. A zero counts as negative, which is what tracing f = eps > 0
/// means.
struct SignKernel {
  /// lambda_1 of the edge with these values at its ends, which have opposite signs; NaN if both are 0.
  static double second_weight(double f0, double f1) {
    const double a = f0 < 0 ? -f0 : f0, b = f1 < 0 ? -f1 : f1;
    // f_0 - f_1 has no cancellation; halved, it cannot overflow.
    return (a / 2) / (a / 2 + b / 2);
  }
  /// The index of the vertex that leaves for w.
  static int leaving(double f0, double fw) { return (fw > 0) == (f0 > 0) ? 0 : 1; }
};

/// The linear algebra of the tracer, for kLanes k-simplices side by side (one SIMD lane each).
///
/// Notation: for a k-simplex with vertices v_0..v_k, B is the (k+1) x (k+1) matrix with columns (1, f(v_q)); M = B^-1;
/// lambda = first column of M = barycentric coordinates of the point where the interpolant vanishes. For one more
/// vertex w of a cofacet, y = M (1, f(w)), and the other k-face of the cofacet that meets the zero set is the one
/// without the vertex r that minimises lambda_r / y_r over y_r > 0 (SoCG 2021, Algorithm 1; the ratio test of linear
/// programming).
///
/// Every decision is proven or declared undecided. With the computed inverse M~ and R = I - M~ B, norm_inf(R) = rho <
/// 1:
///   M = (I - R)^-1 M~, hence |M - M~|_ij <= rho/(1-rho) max_s |M~_sj|,
/// and R itself is computed with its rounding error bounded by gamma |M~||B| (gamma = a small multiple of u (k+2)).
/// So neither the algorithm that found M~ nor its order of operations matters to correctness. Multiplying a component
/// of f by a power of two changes no result.
///
/// Results are a function of the simplex alone, not of its lane or of its neighbours in the batch.
class BarycentricKernel {
 public:
  static constexpr int kLanes = 8;
  static constexpr int kUndecided = -1;

  explicit BarycentricKernel(int codim);

  int codim() const { return size_ - 1; }

  /// Column q of B for a lane: f(v_q), k values that are finite.
  void set_vertex(int lane, int q, const double* f) {
    double* entry = matrix_.data() + std::size_t(q) * kLanes + lane;
    for (int r = 1; r < size_; ++r) entry[std::size_t(r) * size_ * kLanes] = f[r - 1];
  }

  /// Column q of B for all lanes at once: f[lane] points to f(v_q) of that lane. kSlack more values may be read.
  void set_vertices(int q, const double* const* f) { set_rows(f, matrix_.data() + (size_ + q) * kLanes, size_); }
  static constexpr int kSlack = 7;

  /// Inverts B and bounds the error in all lanes. Lanes not set hold what they held; their results mean nothing.
  void factor() { factor_(*this); }

  /// lambda_q of a lane after factor(). Accurate to error(lane) when reliable(lane).
  double weight(int lane, int q) const { return inverse_[std::size_t(q) * size_ * kLanes + lane]; }
  /// Proven bound on the absolute error of every weight of the lane; not finite or huge when B is (nearly) singular.
  double weight_error(int lane) const { return weight_error_[lane]; }
  /// Whether rho is so small that the weights can be reported (about 1e-9 or better).
  bool reliable(int lane) const { return reliable_[lane]; }

  /// The vertex w of a lane's cofacet: f(w), k values that are finite.
  void set_candidate(int lane, const double* f) {
    for (int r = 1; r < size_; ++r) candidate_[std::size_t(r) * kLanes + lane] = f[r - 1];
  }

  /// The same for all lanes at once, as set_vertices().
  void set_candidates(const double* const* f) { set_rows(f, candidate_.data() + kLanes, 1); }

  /// For every lane: the index r of the vertex that leaves, or kUndecided when rounding errors could change it.
  void pivot() { pivot_(*this); }
  int leaving(int lane) const { return leaving_[lane]; }

 private:
  template <int kSize>
  struct Impl;
  // Value r of lane l goes to to[(r * stride) * kLanes + l].
  void set_rows(const double* const* f, double* to, int stride);
  template <class T>
  struct AlignedAllocator {
    using value_type = T;
    T* allocate(std::size_t n) { return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{64})); }
    void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{64}); }
    bool operator==(const AlignedAllocator&) const { return true; }
  };
  using Buffer = std::vector<double, AlignedAllocator<double>>;

  int size_;           // k + 1
  Buffer matrix_;      // B, then scratch: [row][column][lane]
  Buffer inverse_;     // M~, same layout
  Buffer candidate_;   // (1, f(w)): [row][lane]
  Buffer column_max_;  // max_s |M~_sj|: [column j][lane]
  Buffer solution_;    // y: [row][lane]
  double weight_error_[kLanes] = {};
  double inverse_error_[kLanes] = {};  // rho / (1 - rho)
  bool reliable_[kLanes] = {};
  int leaving_[kLanes] = {};
  void (*factor_)(BarycentricKernel&) = nullptr;
  void (*pivot_)(BarycentricKernel&) = nullptr;
};

}  // namespace whitney
