// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace whitney::coxeter {

/// Sixteen bytes side by side, and sets of positions as bits. Each operation has a form in plain C++ beside the one for
/// the processor at hand.
using Bytes = std::uint8_t __attribute__((vector_size(16)));
using ByteMask = std::int8_t __attribute__((vector_size(16)));  // what a comparison gives

inline Bytes splat_byte(int x) { return Bytes{} + static_cast<std::uint8_t>(x); }

inline Bytes load_bytes(const std::uint8_t* from) {
  Bytes bytes;
  std::memcpy(&bytes, from, sizeof bytes);
  return bytes;
}

/// The positions at which a comparison is true.
inline std::uint32_t mask_of_bytes(ByteMask comparison) {
#ifdef __SSE2__
  return static_cast<std::uint32_t>(_mm_movemask_epi8(reinterpret_cast<__m128i>(comparison)));
#else
  std::uint32_t mask = 0;
  for (int i = 0; i < 16; ++i) mask |= std::uint32_t{comparison[i] != 0} << i;
  return mask;
#endif
}

/// 255 at the positions in the mask, 0 at the others.
inline Bytes bytes_of_mask(std::uint32_t mask) {
#if defined(__AVX512BW__) && defined(__AVX512VL__)
  return reinterpret_cast<Bytes>(_mm_movm_epi8(static_cast<__mmask16>(mask)));
#else
  const auto low = static_cast<std::uint8_t>(mask), high = static_cast<std::uint8_t>(mask >> 8);
  const Bytes bits{1, 2, 4, 8, 16, 32, 64, 128, 1, 2, 4, 8, 16, 32, 64, 128};
  const Bytes both{low, low, low, low, low, low, low, low, high, high, high, high, high, high, high, high};
  return reinterpret_cast<Bytes>((both & bits) == bits);
#endif
}

inline Bytes min_bytes(Bytes a, Bytes b) {
#ifdef __SSE2__
  return reinterpret_cast<Bytes>(_mm_min_epu8(reinterpret_cast<__m128i>(a), reinterpret_cast<__m128i>(b)));
#else
  return a < b ? a : b;
#endif
}

/// Every byte moved up by kShift positions, zeros before.
template <int kShift>
Bytes shift_bytes(Bytes x) {
#ifdef __SSE2__
  return reinterpret_cast<Bytes>(_mm_slli_si128(reinterpret_cast<__m128i>(x), kShift));
#else
  std::uint8_t shifted[16 + kShift] = {};
  std::memcpy(shifted + kShift, &x, sizeof x);
  return load_bytes(shifted);
#endif
}

/// Bit i of `bits` goes to the place of the i-th bit that is set in `places`.
inline std::uint32_t spread_bits(std::uint32_t bits, std::uint32_t places) {
#ifdef __BMI2__
  return _pdep_u32(bits, places);
#else
  std::uint32_t spread = 0;
  for (; places != 0; places &= places - 1, bits >>= 1) spread |= bits & 1 ? places & -places : 0;
  return spread;
#endif
}

/// The inverse: bits of `bits` at the places that are set in `places`, side by side.
inline std::uint32_t gather_bits(std::uint32_t bits, std::uint32_t places) {
#ifdef __BMI2__
  return _pext_u32(bits, places);
#else
  std::uint32_t gathered = 0;
  for (std::uint32_t bit = 1; places != 0; places &= places - 1, bit <<= 1)
    gathered |= bits & places & -places ? bit : 0;
  return gathered;
#endif
}

}  // namespace whitney::coxeter
