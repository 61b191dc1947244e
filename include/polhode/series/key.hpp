// SPDX-License-Identifier: MIT
// What a term is apart from its coefficient, in 128 bits.
//
// Equations   exponents and multipliers as in packed_fields.hpp; bit 0 of the multipliers is 1 for
//             a sine.
// Units       none.
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

enum class Function : std::uint8_t { cosine = 0, sine = 1 };

struct Key {
  std::uint64_t exponents, multipliers;

  static constexpr std::uint64_t function_bit = 1;
  constexpr Function function() const { return static_cast<Function>(multipliers & function_bit); }
  // The multipliers without the function.
  constexpr std::uint64_t angle() const { return multipliers & ~function_bit; }
  constexpr auto operator<=>(const Key&) const = default;
};

template <class T>
struct Term {
  Key key;
  T c;
  bool operator==(const Term&) const = default;
};

// That of a constant.
inline Key zero_key(const Symbols& symbols) {
  return {symbols.exponents().zero(), symbols.multipliers().zero()};
}
inline int exponent(const Symbols& symbols, const Key& key, int variable) {
  return symbols.exponents().at(key.exponents, variable);
}
inline int multiplier(const Symbols& symbols, const Key& key, int angle) {
  return symbols.multipliers().at(key.multipliers, angle);
}
inline bool fits(const Symbols& symbols, const Key& key) {
  return symbols.exponents().fits(key.exponents) && symbols.multipliers().fits(key.angle());
}

// Checked; not canonical. A name that is there twice counts twice.
Key packed(const Symbols& symbols, const std::vector<std::pair<std::string, int>>& powers,
           const std::vector<std::pair<std::string, int>>& multiples, Function function);

// Throws for the first field of a key that does not fit.
[[noreturn]] void out_of_range(const Symbols& symbols, const Key& key);

// "e^2*G^-1*cos(2*l - g)"; "1" of a constant.
std::string text(const Symbols& symbols, const Key& key);

}  // namespace v0
}  // namespace polhode
