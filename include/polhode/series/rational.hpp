// SPDX-License-Identifier: MIT
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
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

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

}  // namespace v0
}  // namespace polhode
