// SPDX-License-Identifier: MIT
// The registers of a set of instructions, and what the operators of the compiler's vectors lack.
// The only header that names instructions.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "polhode/math/instruction_set.hpp"

#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

namespace polhode {
inline namespace v0 {
namespace detail {

inline constexpr std::int64_t sign_bit = INT64_MIN;
inline constexpr std::int64_t exponent_bits = 0x7ff0000000000000;
// Less the exponent bits of a power of two: those of its inverse.
inline constexpr std::int64_t inverse_exponent = 0x7fe0000000000000;

// Eight numbers past the caches into a line of memory (`to` a multiple of 64 bytes), where the
// processor has such stores; order_streams() before anybody else reads them.
[[gnu::always_inline]] inline void stream_line(const double* from, double* to) {
#if defined(__AVX512F__)
  _mm512_stream_pd(to, _mm512_loadu_pd(from));
#elif defined(__AVX__)
  for (int i = 0; i < 8; i += 4) _mm256_stream_pd(to + i, _mm256_loadu_pd(from + i));
#elif defined(__SSE2__)
  for (int i = 0; i < 8; i += 2) _mm_stream_pd(to + i, _mm_loadu_pd(from + i));
#else
  for (int i = 0; i < 8; ++i) to[i] = from[i];
#endif
}
[[gnu::always_inline]] inline void order_streams() {
#if defined(__SSE2__)
  _mm_sfence();
#endif
}

// Those of a set are there in sources that are compiled for it.
template <InstructionSet isa>
struct Registers;

// Registers of any processor: 16 bytes, on x86-64 those of SSE2, on AArch64 those of NEON.
template <>
struct Registers<InstructionSet::baseline> {
  using Doubles = double __attribute__((vector_size(16)));
  using Bits = std::int64_t __attribute__((vector_size(16)));
  using Whole = std::uint64_t __attribute__((vector_size(16)));

  [[gnu::always_inline]] static Doubles sqrt(const Doubles& x) {
#if defined(__SSE2__)
    return _mm_sqrt_pd(x);
#elif defined(__aarch64__)
    return std::bit_cast<Doubles>(vsqrtq_f64(std::bit_cast<float64x2_t>(x)));
#else
    return Doubles{std::sqrt(x[0]), std::sqrt(x[1])};
#endif
  }
#if defined(__aarch64__)
  [[gnu::always_inline]] static Doubles rint(const Doubles& x) {
    return std::bit_cast<Doubles>(vrndxq_f64(std::bit_cast<float64x2_t>(x)));
  }
  [[gnu::always_inline]] static Doubles floor(const Doubles& x) {
    return std::bit_cast<Doubles>(vrndmq_f64(std::bit_cast<float64x2_t>(x)));
  }
#else
  // The nearest integer is what the sum with 2^52 rounds to; larger numbers are integers.
  [[gnu::always_inline]] static Doubles rint(const Doubles& x) {
    const Bits bits = std::bit_cast<Bits>(x);
    const Doubles size = std::bit_cast<Doubles>(bits & ~sign_bit);
    const Doubles integer = (size + 0x1p52) - 0x1p52;
    return size < 0x1p52 ? std::bit_cast<Doubles>(std::bit_cast<Bits>(integer) | (bits & sign_bit))
                         : x;
  }
  [[gnu::always_inline]] static Doubles floor(const Doubles& x) {
    const Doubles r = rint(x);
    return r > x ? r - 1.0 : r;
  }
#endif
  [[gnu::always_inline]] static bool any(const Bits& mask) { return (mask[0] | mask[1]) != 0; }
};

#if defined(__AVX2__) && defined(__FMA__)
template <>
struct Registers<InstructionSet::avx2> {
  using Doubles = double __attribute__((vector_size(32)));
  using Bits = std::int64_t __attribute__((vector_size(32)));
  using Whole = std::uint64_t __attribute__((vector_size(32)));

  [[gnu::always_inline]] static Doubles sqrt(const Doubles& x) { return _mm256_sqrt_pd(x); }
  [[gnu::always_inline]] static Doubles rint(const Doubles& x) {
    return _mm256_round_pd(x, _MM_FROUND_CUR_DIRECTION | _MM_FROUND_NO_EXC);
  }
  [[gnu::always_inline]] static Doubles floor(const Doubles& x) { return _mm256_floor_pd(x); }
  [[gnu::always_inline]] static Doubles fma(const Doubles& x, const Doubles& y, const Doubles& z) {
    return _mm256_fmadd_pd(x, y, z);
  }
  [[gnu::always_inline]] static bool any(const Bits& mask) {
    const auto m = std::bit_cast<__m256i>(mask);
    return _mm256_testz_si256(m, m) == 0;
  }
};

#endif
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
// Forms with a mask, of ones: GCC 12 warns of an uninitialized variable in the others.
template <>
struct Registers<InstructionSet::avx512> {
  using Doubles = double __attribute__((vector_size(64)));
  using Bits = std::int64_t __attribute__((vector_size(64)));
  using Whole = std::uint64_t __attribute__((vector_size(64)));

  [[gnu::always_inline]] static Doubles sqrt(const Doubles& x) {
    return _mm512_maskz_sqrt_pd(0xff, x);
  }
  [[gnu::always_inline]] static Doubles rint(const Doubles& x) {
    return _mm512_maskz_roundscale_pd(0xff, x, _MM_FROUND_CUR_DIRECTION | _MM_FROUND_NO_EXC);
  }
  [[gnu::always_inline]] static Doubles floor(const Doubles& x) {
    return _mm512_maskz_roundscale_pd(0xff, x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
  }
  [[gnu::always_inline]] static Doubles fma(const Doubles& x, const Doubles& y, const Doubles& z) {
    return _mm512_fmadd_pd(x, y, z);
  }
  [[gnu::always_inline]] static bool any(const Bits& mask) {
    const auto m = std::bit_cast<__m512i>(mask);
    return _mm512_test_epi64_mask(m, m) != 0;
  }
};
#endif

}  // namespace detail
}  // namespace v0
}  // namespace polhode
