// SPDX-License-Identifier: MIT
#include "streaming.hpp"

#include <algorithm>
#include <cstdint>

#if defined(__AVX512F__) || defined(__AVX__)
#include <immintrin.h>
#endif

namespace peers {

void stream(double* out, std::size_t count, double value) {
  std::size_t i = 0;
#if defined(__AVX512F__)
  while (i < count && reinterpret_cast<std::uintptr_t>(out + i) % 64 != 0) out[i++] = value;
  for (; i + 8 <= count; i += 8) _mm512_stream_pd(out + i, _mm512_set1_pd(value));
  _mm_sfence();
#elif defined(__AVX__)
  while (i < count && reinterpret_cast<std::uintptr_t>(out + i) % 32 != 0) out[i++] = value;
  for (; i + 4 <= count; i += 4) _mm256_stream_pd(out + i, _mm256_set1_pd(value));
  _mm_sfence();
#endif
  std::fill(out + i, out + count, value);
}

}  // namespace peers
