// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/tape.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

/// Bytes of the widest register of the target.
#if defined(__AVX512F__)
constexpr int kRegisterBytes = 64;
#elif defined(__AVX__)
constexpr int kRegisterBytes = 32;
#else
constexpr int kRegisterBytes = 16;
#endif
constexpr int kLanesPerVector = kRegisterBytes / int(sizeof(double));
typedef double Vector __attribute__((vector_size(kRegisterBytes)));
typedef std::int64_t BitVector __attribute__((vector_size(kRegisterBytes)));

/// kLanes numbers that are computed with at once. One and many go through the same code, made of operations that round
/// correctly (a compiler that fuses a multiplication with an addition does so in all of them) and of the same functions
/// of one number, so they agree in every bit.
template <int kLanes>
struct Pack {
  static constexpr bool kIsVector = kLanes > 1;
  using Part = std::conditional_t<kIsVector, Vector, double>;
  static constexpr int kParts = kIsVector ? kLanes / kLanesPerVector : 1;

  Part part[kParts];

  Pack() = default;
  explicit Pack(double value) {
    for (Part& p : part) {
      if constexpr (kIsVector) {
        p = value - Vector{};
      } else {
        p = value;
      }
    }
  }
  double lane(int l) const {
    if constexpr (kIsVector) {
      return part[l / kLanesPerVector][l % kLanesPerVector];
    } else {
      return part[0];
    }
  }
};

/// The pack of operation(0), operation(1), .., one of each part.
template <int kLanes, class Operation>
inline Pack<kLanes> by_parts(Operation operation) {
  Pack<kLanes> result;
#pragma GCC unroll 16
  for (int p = 0; p < Pack<kLanes>::kParts; ++p) result.part[p] = operation(p);
  return result;
}
/// The pack of function(0), function(1), .., one of each lane.
template <int kLanes, class Function>
inline Pack<kLanes> by_lanes(Function function) {
  alignas(Pack<kLanes>) double lanes[kLanes];
  for (int l = 0; l < kLanes; ++l) lanes[l] = function(l);
  return std::bit_cast<Pack<kLanes>>(lanes);
}

template <int kLanes>
inline Pack<kLanes> operator+(const Pack<kLanes>& a, const Pack<kLanes>& b) {
  return by_parts<kLanes>([&](int p) { return a.part[p] + b.part[p]; });
}
template <int kLanes>
inline Pack<kLanes> operator*(const Pack<kLanes>& a, const Pack<kLanes>& b) {
  return by_parts<kLanes>([&](int p) { return a.part[p] * b.part[p]; });
}
template <int kLanes>
inline Pack<kLanes> operator/(const Pack<kLanes>& a, const Pack<kLanes>& b) {
  return by_parts<kLanes>([&](int p) { return a.part[p] / b.part[p]; });
}
template <int kLanes>
inline Pack<kLanes> sqr(const Pack<kLanes>& a) {
  return a * a;
}
template <int kLanes>
inline Pack<kLanes> pow(const Pack<kLanes>& a, int n) {
  return tape_arithmetic::repeated_squaring(a, n);
}
template <int kLanes>
inline Pack<kLanes> abs(const Pack<kLanes>& a) {
  if constexpr (kLanes == 1) {
    return Pack<1>(std::abs(a.part[0]));
  } else {
    constexpr std::int64_t kAllButSign = std::numeric_limits<std::int64_t>::max();
    return by_parts<kLanes>([&](int p) { return (Vector)((BitVector)a.part[p] & kAllButSign); });
  }
}
template <int kLanes>
inline Pack<kLanes> pow(const Pack<kLanes>& a, const Pack<kLanes>& b) {
  return by_lanes<kLanes>([&](int l) { return std::pow(a.lane(l), b.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> sqrt(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::sqrt(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> sin(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::sin(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> cos(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::cos(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> tan(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::tan(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> asin(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::asin(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> acos(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::acos(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> atan(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::atan(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> sinh(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::sinh(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> cosh(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::cosh(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> tanh(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::tanh(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> exp(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::exp(a.lane(l)); });
}
template <int kLanes>
inline Pack<kLanes> log(const Pack<kLanes>& a) {
  return by_lanes<kLanes>([&](int l) { return std::log(a.lane(l)); });
}

/// x[0], x[stride], x[2 stride], ..: built at once, as element after element is slow.
inline Vector gather(const double* x, std::size_t stride) {
  return [&]<std::size_t... l>(std::index_sequence<l...>) { return Vector{x[l * stride]...}; }
  (std::make_index_sequence<kLanesPerVector>{});
}

}  // namespace

void Tape::throw_sizes(std::size_t num_coordinates, std::size_t num_values) const {
  throw InvalidInput("tape: " + std::to_string(num_coordinates) + " coordinates and room for " +
                     std::to_string(num_values) + " values do not fit a map from R^" + std::to_string(num_inputs_) +
                     " to R^" + std::to_string(outputs_.size()));
}

template <int kLanes>
std::size_t Tape::run_groups(const double* points, double* values, std::size_t num_points) const {
  const std::size_t d = num_inputs_, k = outputs_.size();
  // Most tapes need few registers: they live on the stack.
  constexpr int kStackRegisters = 64;
  Pack<kLanes> stack[kStackRegisters];
  std::vector<Pack<kLanes>> heap(num_registers_ > kStackRegisters ? num_registers_ : 0);
  Pack<kLanes>* const r = heap.empty() ? stack : heap.data();
  std::size_t i = 0;
  for (; i + kLanes <= num_points; i += kLanes) {
    for (std::size_t j = 0; j < d; ++j) {
      const double* const x = points + i * d + j;
      if constexpr (kLanes == 1) {
        r[j] = Pack<1>(*x);
      } else {
        r[j] = by_parts<kLanes>([&](int p) { return gather(x + p * kLanesPerVector * d, d); });
      }
    }
    execute(r);
    for (std::size_t o = 0; o < k; ++o) {
      const Pack<kLanes>& result = r[outputs_[o]];
      double* const value = values + i * k + o;
      if (k == 1) {
        std::memcpy(value, &result, sizeof result);
      } else {
#pragma GCC unroll 32
        for (int l = 0; l < kLanes; ++l) value[l * k] = result.lane(l);
      }
    }
  }
  return i;
}

void Tape::run_batch(std::span<const double> points, std::span<double> values) const {
  const std::size_t d = num_inputs_, k = outputs_.size();
  // One point is common, and a division is slow.
  const std::size_t num_points = points.size() == d ? 1 : d == 0 ? 0 : points.size() / d;
  if (points.size() != num_points * d || values.size() != num_points * k) throw_sizes(points.size(), values.size());
  std::size_t done = 0;
  if (num_points >= 32) done += run_groups<32>(points.data(), values.data(), num_points);
  if (num_points - done >= 8) {
    done += run_groups<8>(points.data() + done * d, values.data() + done * k, num_points - done);
  }
  if (num_points > done) run_groups<1>(points.data() + done * d, values.data() + done * k, num_points - done);
}

}  // namespace whitney
