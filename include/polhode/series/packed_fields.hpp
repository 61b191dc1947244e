// SPDX-License-Identifier: MIT
// A row of small integers in one 64-bit word: the exponents or the multipliers of a term.
//
// Equations   a value v in a field of w bits is stored as v + 2^(w-1); the first field is the most
//             significant. So rows compare as words do, the row of zeros is one constant, and rows
//             are added by one addition of words.
// Domain      1 to 12 integers, w = min(16, 63 / count); each in [-2^(w-2), 2^(w-2) - 1]. One bit
//             of each field is left free, so that a sum or a difference of two rows never reaches
//             the next field, and whether it fits is seen by one comparison. Bit 0 of the word is
//             not used: a TermKey keeps there what function a term has.
// Accuracy    exact.
// Errors      none: fits() says whether a word holds legal values.
// Cost        one to three instructions, at() and with() included.
#pragma once

#include <cstddef>
#include <cstdint>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

class PackedFields {
 public:
  static constexpr int most = 12;

  explicit constexpr PackedFields(int count) : count_(count), width_(count < 4 ? 16 : 63 / count) {
    for (int i = 0; i < count; ++i) zero_ |= std::uint64_t{1} << (shift(i) + width_ - 1);
  }

  constexpr int count() const { return count_; }
  constexpr int least() const { return -(1 << (width_ - 2)); }
  constexpr int greatest() const { return (1 << (width_ - 2)) - 1; }

  // All zeros.
  constexpr std::uint64_t zero() const { return zero_; }
  constexpr std::uint64_t sum(std::uint64_t a, std::uint64_t b) const { return a + b - zero_; }
  constexpr std::uint64_t difference(std::uint64_t a, std::uint64_t b) const {
    return a - b + zero_;
  }
  constexpr std::uint64_t negative(std::uint64_t a) const { return 2 * zero_ - a; }
  // The first value that is not zero is negative.
  constexpr bool is_negative(std::uint64_t a) const { return a < zero_; }
  // Of legal values, of their sum, difference or negative: the two first bits of a field differ.
  constexpr bool fits(std::uint64_t a) const { return ((a ^ (a << 1)) & zero_) == zero_; }

  // Also of a word that does not fit.
  constexpr int at(std::uint64_t a, int i) const {
    const std::uint64_t mask = (std::uint64_t{1} << width_) - 1;
    return static_cast<int>((a >> shift(i)) & mask) - (1 << (width_ - 1));
  }
  // The value of field i plus n, which must be less than twice the legal range.
  constexpr std::uint64_t with(std::uint64_t a, int i, int n) const {
    return a + (static_cast<std::uint64_t>(static_cast<std::int64_t>(n)) << shift(i));
  }

 private:
  constexpr int shift(int i) const { return 64 - width_ * (i + 1); }

  int count_, width_;
  std::uint64_t zero_ = 0;
};

}  // namespace v0
}  // namespace polhode
