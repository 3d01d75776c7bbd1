// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>

#if defined(__BMI2__) || defined(__AVX2__)
#include <immintrin.h>
#endif

// The code below depends on the instructions that whoever compiles it allows. So it, and everything inline that is made
// of it, is in a namespace named after them: copies that differ have different names, and the linker never takes one
// for the other.
#if defined(__BMI2__) && defined(__AVX2__) && defined(__AVX512F__)
#define WHITNEY_INSTRUCTION_SET with_bmi2_avx512
#elif defined(__BMI2__) && defined(__AVX2__)
#define WHITNEY_INSTRUCTION_SET with_bmi2_avx2
#elif defined(__BMI2__)
#define WHITNEY_INSTRUCTION_SET with_bmi2
#elif defined(__AVX512F__)
#define WHITNEY_INSTRUCTION_SET with_avx512
#elif defined(__AVX2__)
#define WHITNEY_INSTRUCTION_SET with_avx2
#else
#define WHITNEY_INSTRUCTION_SET plain
#endif

namespace whitney::coxeter {
inline namespace WHITNEY_INSTRUCTION_SET {

/// Tells copies of a template apart that is not in this namespace.
struct InstructionSet {};

/// Sixteen numbers 0 .. 15 side by side, number i in the bits 4 i .. 4 i + 3. A set of such numbers is the word whose
/// nibble x is 15 for the members x and 0 for the others.
using Nibbles = std::uint64_t;

/// Thirty-two of them.
using NibblePair = std::uint64_t __attribute__((vector_size(16)));

/// Elements of the ordered partitions that fit: d <= 15.
inline constexpr int kMaxShortElements = 16;

/// Whether the processor compiled for does each of these operations in a few instructions.
#if defined(__BMI2__) && defined(__AVX2__)
inline constexpr bool kFastNibbles = true;
#else
inline constexpr bool kFastNibbles = false;
#endif

/// Number 15 at the place i, 0 <= i <= 15, zeros elsewhere: the set with the one member i.
inline Nibbles nibble_at(int i) { return Nibbles{15} << (4 * i); }

/// The numbers moved up by i places, 0 <= i <= 15.
inline Nibbles nibbles_up(Nibbles x, int i) { return x << (4 * i); }

/// The set of 0 .. i - 1, 0 <= i <= 16.
inline Nibbles nibbles_below(int i) { return (Nibbles{1} << (2 * i) << (2 * i)) - 1; }

/// The members of a set in increasing order, zeros behind.
inline Nibbles list_members(Nibbles set) {
#ifdef __BMI2__
  return _pext_u64(0xfedcba9876543210, set);
#else
  Nibbles list = 0;
  for (int place = 0; set != 0; ++place) {
    const int member = std::countr_zero(set) / 4;
    list |= nibbles_up(static_cast<Nibbles>(member), place);
    set &= ~nibble_at(member);
  }
  return list;
#endif
}

/// The subset whose members are the i-th of the set, for the bits i that are set in `chosen`.
inline Nibbles choose_members(Nibbles set, std::uint32_t chosen) {
  constexpr Nibbles kOnes = 0x1111111111111111;
#ifdef __BMI2__
  return _pdep_u64(chosen, set & kOnes) * 15;
#else
  Nibbles subset = 0;
  for (Nibbles rest = set & kOnes; rest != 0; rest &= rest - 1, chosen >>= 1)
    if (chosen & 1) subset |= rest & -rest;
  return subset * 15;
#endif
}

/// The set as bits: bit x for the member x.
inline std::uint32_t bits_of_set(Nibbles set) {
#ifdef __BMI2__
  return static_cast<std::uint32_t>(_pext_u64(set, 0x1111111111111111));
#else
  std::uint32_t bits = 0;
  for (int x = 0; x < 16; ++x) bits |= static_cast<std::uint32_t>(set >> (4 * x) & 1) << x;
  return bits;
#endif
}

/// Writes the numbers of a pair as values of 16 bits each, number i plus increments[i]; as few stores as possible,
/// since a wide load has to wait for narrow stores.
inline void widen_nibbles(NibblePair pair, const std::uint16_t* increments, std::uint16_t* to) {
#if defined(__AVX512F__)
  __m512i lanes = _mm512_cvtepu8_epi32(reinterpret_cast<__m128i>(pair));
  lanes = _mm512_and_si512(_mm512_or_si512(lanes, _mm512_slli_epi32(lanes, 12)), _mm512_set1_epi32(0x000f000f));
  _mm512_storeu_si512(to, _mm512_add_epi32(lanes, _mm512_loadu_si512(increments)));
#elif defined(__AVX2__)
  for (int half = 0; half < 2; ++half) {
    __m256i lanes = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(pair[half])));
    lanes = _mm256_and_si256(_mm256_or_si256(lanes, _mm256_slli_epi32(lanes, 12)), _mm256_set1_epi32(0x000f000f));
    lanes = _mm256_add_epi32(lanes, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(increments + 16 * half)));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + 16 * half), lanes);
  }
#else
  for (int i = 0; i < 32; ++i)
    to[i] = static_cast<std::uint16_t>((pair[i / 16] >> (4 * (i % 16)) & 15) + increments[i]);
#endif
}

/// Writes sixteen numbers as values of 16 bits, each plus the increment.
inline void widen_nibbles(Nibbles numbers, std::uint16_t increment, std::uint16_t* to) {
#if defined(__AVX2__)
  __m256i lanes = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(numbers)));
  lanes = _mm256_and_si256(_mm256_or_si256(lanes, _mm256_slli_epi32(lanes, 12)), _mm256_set1_epi32(0x000f000f));
  lanes = _mm256_add_epi16(lanes, _mm256_set1_epi16(static_cast<short>(increment)));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), lanes);
#else
  for (int i = 0; i < 16; ++i) to[i] = static_cast<std::uint16_t>((numbers >> (4 * i) & 15) + increment);
#endif
}

}  // namespace WHITNEY_INSTRUCTION_SET
}  // namespace whitney::coxeter
