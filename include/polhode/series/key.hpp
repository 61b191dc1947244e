// SPDX-License-Identifier: MIT
// What a term is apart from its coefficient, in 128 bits.
//
// Equations   exponents and multipliers as in packed_fields.hpp; bit 0 of the multipliers is 1 for
//             a sine.
// Domain      as in symbols.hpp. The key of a term of a Series is canonical: its first multiplier
//             that is not zero is positive, and it is no sine of 0.
// Accuracy    exact.
// Errors      DomainError that names the symbol, its exponent or multiplier, and the range.
// Cost        some instructions; out_of_range looks for the symbol.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {

enum class Trigonometric : std::uint8_t { cosine = 0, sine = 1 };

struct TermKey {
  std::uint64_t exponents, multipliers;

  static constexpr std::uint64_t function_bit = 1;
  constexpr Trigonometric function() const {
    return static_cast<Trigonometric>(multipliers & function_bit);
  }
  // The multipliers without the function.
  constexpr std::uint64_t angle() const { return multipliers & ~function_bit; }
  constexpr auto operator<=>(const TermKey&) const = default;
};

template <class T>
struct Term {
  TermKey key;
  T c;
  bool operator==(const Term&) const = default;
};

// That of a constant.
inline TermKey zero_key(const Symbols& symbols) {
  return {symbols.exponents().zero(), symbols.multipliers().zero()};
}
inline int exponent(const Symbols& symbols, const TermKey& key, int variable) {
  return symbols.exponents().at(key.exponents, variable);
}
inline int multiplier(const Symbols& symbols, const TermKey& key, int angle) {
  return symbols.multipliers().at(key.multipliers, angle);
}
inline bool fits(const Symbols& symbols, const TermKey& key) {
  return symbols.exponents().fits(key.exponents) && symbols.multipliers().fits(key.angle());
}

// Checked; not canonical. A name that is there twice counts twice.
TermKey packed(const Symbols& symbols, const std::vector<std::pair<std::string, int>>& powers,
               const std::vector<std::pair<std::string, int>>& multiples, Trigonometric function);

// Throws for the first field of a key that does not fit.
[[noreturn]] void out_of_range(const Symbols& symbols, const TermKey& key);

// "e^2*G^-1*cos(2*l - g)"; "1" of a constant.
std::string text(const Symbols& symbols, const TermKey& key);

}  // namespace v0
}  // namespace polhode
