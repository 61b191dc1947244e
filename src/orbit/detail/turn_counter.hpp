// SPDX-License-Identifier: MIT
// The phase f t - f t_0 of a steady rotation, reduced to one turn exactly: integers modulo 2^64.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A double is m 2^k with an integer m < 2^53. The turns in 2^k times, modulo 1, are kept for every
// k of interest as 128-bit fractions, so that the turns of any time are one product, its integer
// part lost to overflow: no reduction, and errors below 2^-63 turns (those of f are the caller's).
class TurnCounter {
 public:
  // Frequency in turns per time, and the time of phase 0.
  TurnCounter(const DoubleDouble& frequency, const DoubleDouble& start)
      : first_exponent_(
            static_cast<std::uint64_t>(mantissa_zero - std::ilogb(frequency.hi) + first_turns)) {
    for (std::size_t i = 0; i < size; ++i) {
      const int k = static_cast<int>(first_exponent_ + i) - mantissa_zero - 52;
      const Wide turns = fraction(frequency.hi, k) + fraction(frequency.lo, k);
      high_[(first_exponent_ + i) % size] = static_cast<std::uint64_t>(turns >> 64);
      low_[(first_exponent_ + i) % size] = static_cast<std::uint64_t>(turns);
    }
    const DoubleDouble phase = -(frequency * start);
    at_zero_ = static_cast<std::uint64_t>((fraction(phase.hi, 0) + fraction(phase.lo, 0)) >> 64);
  }

  // Whether the exponents of such times are those of doubles.
  static bool counts(const DoubleDouble& frequency, const DoubleDouble& start) {
    const double f = std::abs(frequency.hi);
    return f > 0x1p-900 && f < 0x1p900 && f * std::abs(start.hi) < 0x1p40;
  }

  // From 2^-24 to 2^40 turns away from t = 0.
  bool counts(double t) const {
    return (std::bit_cast<std::uint64_t>(t) << 1 >> 53) - first_exponent_ < size;
  }
  // In 2^-64 turns.
  std::uint64_t phase(double t) const {
    const auto bits = std::bit_cast<std::uint64_t>(t);
    const std::size_t k = (bits >> 52) % size;
    const std::uint64_t m = (bits & (hidden_bit - 1)) | hidden_bit;
    // -n is ~(n - 1), so that both signs of t are one sum and its bits, turned over or not.
    const auto negative = static_cast<std::uint64_t>(static_cast<std::int64_t>(bits) >> 63);
    const std::uint64_t whole = m * high_[k] + (at_zero_ ^ negative);
    return (whole + static_cast<std::uint64_t>(Wide{m} * low_[k] >> 64)) ^ negative;
  }

 private:
  __extension__ using Wide = unsigned __int128;

  // x 2^k modulo 1, in 2^-128.
  static Wide fraction(double x, int k) {
    if (x == 0.0) return 0;
    const int exponent = std::ilogb(x) - 52;
    const Wide m = static_cast<Wide>(std::ldexp(std::abs(x), -exponent));
    const int shift = exponent + k + 128;
    const Wide shifted = shift >= 128 ? 0 : shift >= 0 ? m << shift : shift > -64 ? m >> -shift : 0;
    return x < 0.0 ? Wide{0} - shifted : shifted;
  }

  static constexpr std::size_t size = 64;
  static constexpr int first_turns = -24;
  static constexpr int mantissa_zero = 1023;
  static constexpr std::uint64_t hidden_bit = std::uint64_t{1} << 52;

  std::uint64_t first_exponent_;  // biased, of the shortest times
  std::uint64_t at_zero_;         // the phase at t = 0
  // Turns modulo 1 in 2^k times, in 2^-128, by the biased exponent of such times modulo `size`.
  std::array<std::uint64_t, size> high_, low_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
