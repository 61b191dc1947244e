// SPDX-License-Identifier: MIT
// In this header: packed_fields, symbols, key, rational.
#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace series {

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

// The names that a series is written in: variables, which have exponents, and angles, which have
// multipliers; which of them are conjugate; and the values of momenta about which coefficients are
// expanded.
//
// Equations   a pair (q, p) has dq/dt = dH/dp, dp/dt = -dH/dq.
// Units       angles in radians; a variable has the unit that its user gives it.
// Domain      up to 12 variables and 12 angles. A name is a letter or _ and then letters, digits,
//             _ or ', and not cos or sin. A symbol is in one pair at most. A momentum is a
//             variable; a coordinate may be an angle (Andoyer's) or a variable (Poincare's).
//             Exponents and multipliers are integers of either sign, in the range of PackedFields:
//             below 2^14 up to 3 of them, 2^10 at 5, 2^5 at 9, 2^3 at 12. Variables with a value
//             come first and are no coordinates: coefficients are functions of them
//             (taylor_coefficient.hpp), and a power of one in a key is a power of its
//             displacement from the value.
// Accuracy    exact.
// Errors      DomainError for names that break this, and for one that is not there.
// Cost        a copy shares the table; equal tables made apart are equal.

struct ConjugatePair {
  std::string coordinate, momentum;
  bool operator==(const ConjugatePair&) const = default;
};

class Symbols {
 public:
  Symbols(std::vector<std::string> variables, std::vector<std::string> angles,
          std::vector<ConjugatePair> pairs = {},
          const std::vector<std::pair<std::string, double>>& values = {});

  const std::vector<std::string>& variables() const { return table_->variables; }
  const std::vector<std::string>& angles() const { return table_->angles; }
  const std::vector<ConjugatePair>& pairs() const { return table_->pairs; }
  // The values of the first variables, in order.
  const std::vector<double>& values() const { return table_->values; }
  const PackedFields& exponents() const { return table_->exponents; }
  const PackedFields& multipliers() const { return table_->multipliers; }

  bool has_variable(std::string_view name) const;
  bool has_angle(std::string_view name) const;
  // Its place among variables() or angles(); throws where there is none.
  int variable(std::string_view name) const;
  int angle(std::string_view name) const;
  // "variables e, G; angles l, g".
  std::string names() const;
  // "G = 1, L = 0.5"; empty without values.
  std::string values_text() const;

  friend bool operator==(const Symbols& a, const Symbols& b) {
    return a.table_ == b.table_ || *a.table_ == *b.table_;
  }

 private:
  struct Table {
    std::vector<std::string> variables, angles;
    std::vector<ConjugatePair> pairs;
    std::vector<double> values;
    PackedFields exponents, multipliers;
    // The fields follow from the names.
    bool operator==(const Table& b) const {
      return variables == b.variables && angles == b.angles && pairs == b.pairs &&
             values == b.values;
    }
  };
  std::shared_ptr<const Table> table_;
};

// What a term is apart from its coefficient, in 128 bits.
//
// Equations   exponents and multipliers as in packed_fields.hpp; bit 0 of the multipliers is 1 for
//             a sine.
// Domain      as in symbols.hpp. The key of a term of a Series is canonical: its first multiplier
//             that is not zero is positive, and it is no sine of 0.
// Accuracy    exact.
// Errors      DomainError that names the symbol, its exponent or multiplier, and the range.
// Cost        some instructions; out_of_range looks for the symbol.

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

// A rational number of any size: coefficients of exact series.
//
// Units       none: a pure number.
// Domain      numerators and denominators up to 300,000 binary digits; always in lowest terms,
//             with a positive denominator. Small ones (63 bits) live in the object, longer ones
//             on the heap.
// Accuracy    exact; the conversion to double is the nearest one.
// Errors      DomainError for a denominator of zero, a division by zero, a number that is too long,
//             and text that is no number.
// Cost        some 10 ns a sum or product of small ones; of longer ones an allocation too.

namespace detail {
class BigRational;
}  // namespace detail

class Rational {
 public:
  Rational() = default;
  template <std::signed_integral I>
  explicit Rational(I n) : Rational(static_cast<std::int64_t>(n), std::int64_t{1}) {}
  Rational(std::int64_t numerator, std::int64_t denominator);
  // "12", "-3/4", "0.125", "1.5e-3": what the text says, not what its double would be.
  static Rational from_text(std::string_view text);

  friend Rational operator-(const Rational& a);
  friend Rational operator+(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a, const Rational& b);
  friend Rational operator*(const Rational& a, const Rational& b);
  friend Rational operator/(const Rational& a, const Rational& b);
  Rational& operator+=(const Rational& b) { return *this = *this + b; }
  Rational& operator-=(const Rational& b) { return *this = *this - b; }
  Rational& operator*=(const Rational& b) { return *this = *this * b; }
  Rational& operator/=(const Rational& b) { return *this = *this / b; }
  friend bool operator==(const Rational& a, const Rational& b);
  friend bool operator<(const Rational& a, const Rational& b);

  explicit operator double() const;
  // "3", "-3/4".
  std::string text() const;

 private:
  friend class detail::BigRational;

  // The value is *big_ where there is one, else n_ / d_.
  std::int64_t n_ = 0, d_ = 1;
  std::shared_ptr<const detail::BigRational> big_;
};

}  // namespace series
}  // namespace v0
}  // namespace polhode
