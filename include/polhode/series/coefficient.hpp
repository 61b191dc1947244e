// SPDX-License-Identifier: MIT
// What a series asks of its coefficients, and how they are written and read.
//
// Units       none: pure numbers.
// Domain      double, Rational, DoubleDouble, and any other field of numbers with the same
//             operators, of the C++ library or of Boost.Multiprecision (cpp_bin_float_50,
//             mpfr_float_100). DoubleDouble computes, but has no text.
// Accuracy    text of a double, or of a Rational, is read back as the same number; text of other
//             types has their max_digits10 digits.
// Errors      DomainError for text that is no number or out of the range of the type.
#pragma once

#include <charconv>
#include <concepts>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/math/real.hpp"
#include "polhode/series/rational.hpp"

namespace polhode {
inline namespace v0 {

template <class T>
concept Coefficient = std::copyable<T> && std::constructible_from<T, int> && requires(T a, T b) {
  { a + b } -> std::convertible_to<T>;
  { a - b } -> std::convertible_to<T>;
  { a* b } -> std::convertible_to<T>;
  { a / b } -> std::convertible_to<T>;
  { -a } -> std::convertible_to<T>;
  { a == b } -> std::convertible_to<bool>;
  { polhode::to_double(a) } -> std::convertible_to<double>;
};

// A coefficient that itself depends on the first variables of a series (taylor_coefficient.hpp).
template <class T>
concept VariableCoefficient = Coefficient<T> && requires(const T& a, int place) {
  { T::variable_count } -> std::convertible_to<int>;
  { a.derivative(place) } -> std::convertible_to<T>;
};

// The customization point. What text is given to from_text: digits, perhaps with a point and a
// power of ten; a sign and a quotient too, in tables.
template <class T>
struct CoefficientText {
  static std::string text(const T& x) {
    std::ostringstream out;
    out.precision(std::numeric_limits<T>::max_digits10);
    out << x;
    return std::move(out).str();
  }
  static T from_text(std::string_view text) {
    std::istringstream in{std::string(text)};
    T x(0);
    char more = 0;
    if (!(in >> x) || in >> more)
      throw DomainError("coefficient: '" + std::string(text.substr(0, 40)) + "' is no number");
    return x;
  }
};

template <>
struct CoefficientText<double> {
  static std::string text(double x) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, x).ptr};
  }
  static double from_text(std::string_view text) {
    double x = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (error != std::errc{} || end != text.data() + text.size() || !(x - x == 0.0))
      throw DomainError("coefficient: '" + std::string(text.substr(0, 40)) +
                        "' is no finite number of type double");
    return x;
  }
};

template <>
struct CoefficientText<Rational> {
  static std::string text(const Rational& x) { return x.text(); }
  static Rational from_text(std::string_view text) { return Rational::from_text(text); }
};

}  // namespace v0
}  // namespace polhode
