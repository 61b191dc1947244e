// SPDX-License-Identifier: MIT
// In this header: coefficient, series, truncation.
#pragma once

#include <charconv>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/math/real.hpp"
#include "polhode/series/detail/canonical_terms.hpp"
#include "polhode/series/symbols.hpp"
#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace series {

// What a series asks of its coefficients, and how they are written and read.
//
// Units       none: pure numbers.
// Domain      double, Rational, DoubleDouble, and any other field of numbers with the same
//             operators, of the C++ library or of Boost.Multiprecision (cpp_bin_float_50,
//             mpfr_float_100). DoubleDouble computes, but has no text.
// Accuracy    text of a double, or of a Rational, is read back as the same number; text of other
//             types has their max_digits10 digits.
// Errors      DomainError for text that is no number or out of the range of the type.

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

// A Poisson series: sum of C a1^n1 ... am^nm cos|sin(k1 phi1 + ... + kr phir).
//
// Equations   cos(-x) = cos x, sin(-x) = -sin x, sin 0 = 0 bring every term to one form: the first
//             multiplier that is not zero is positive. Terms are sorted by their keys, no key is
//             there twice, no coefficient is zero: equal series have equal terms.
// Units       those of the symbols; angles in radians.
// Domain      any Coefficient; symbols, exponents and multipliers as in symbols.hpp.
// Accuracy    exact in Rational; else a rounding of T for every operation of coefficients.
// Errors      DomainError for symbols that are not there, exponents and multipliers out of range,
//             and two series with different symbols.
// Cost        a term is 16 bytes and its coefficient. A sum is linear in the terms, a product takes
//             all pairs (product.hpp).

template <Coefficient T>
class Series {
 public:
  using Number = T;

  // Zero.
  explicit Series(Symbols symbols) : symbols_(std::move(symbols)) {}
  // Terms in any order and form; equal ones are added up.
  Series(Symbols symbols, std::vector<Term<T>> terms)
      : symbols_(std::move(symbols)), terms_(detail::canonical(symbols_, std::move(terms))) {}

  const Symbols& symbols() const { return symbols_; }
  std::span<const Term<T>> terms() const& { return terms_; }
  // Of a temporary by value, so that `for (auto& term : product(a, b).terms())` reads what lives.
  std::vector<Term<T>> terms() && { return std::move(terms_); }
  std::size_t size() const { return terms_.size(); }
  bool is_zero() const { return terms_.empty(); }

  friend bool operator==(const Series& a, const Series& b) {
    return a.symbols_ == b.symbols_ && a.terms_ == b.terms_;
  }

  friend Series operator-(Series a) {
    for (Term<T>& term : a.terms_) term.c = -term.c;
    return a;
  }
  friend Series operator+(const Series& a, const Series& b) {
    return Series(a, detail::merged<T>(a.symbols_, b.symbols_, a.terms_, b.terms_, false));
  }
  friend Series operator-(const Series& a, const Series& b) {
    return Series(a, detail::merged<T>(a.symbols_, b.symbols_, a.terms_, b.terms_, true));
  }
  friend Series operator*(const T& c, Series a) {
    for (Term<T>& term : a.terms_) term.c = c * term.c;
    return without_zeros(std::move(a));
  }
  friend Series operator*(Series a, const T& c) { return c * std::move(a); }
  friend Series operator/(Series a, const T& c) {
    for (Term<T>& term : a.terms_) term.c = term.c / c;
    return without_zeros(std::move(a));
  }
  Series& operator+=(const Series& b) { return *this = *this + b; }
  Series& operator-=(const Series& b) { return *this = *this - b; }

 private:
  // Terms that are in order.
  Series(const Series& like, std::vector<Term<T>> terms)
      : symbols_(like.symbols_), terms_(std::move(terms)) {}
  // A product or a quotient may underflow.
  static Series without_zeros(Series a) {
    std::erase_if(a.terms_, [](const Term<T>& term) { return term.c == T(0); });
    return a;
  }

  Symbols symbols_;
  std::vector<Term<T>> terms_;
};

// How many variables, the first ones, coefficients are functions of: those with a value, if any has
// one.
template <Coefficient T>
int variables_of_coefficients(const Symbols& symbols) {
  if constexpr (VariableCoefficient<T>)
    return symbols.values().empty() ? T::variable_count : static_cast<int>(symbols.values().size());
  else
    return 0;
}

// c.
template <Coefficient T>
Series<T> constant(const Symbols& symbols, T c) {
  return Series<T>(symbols, {{zero_key(symbols), std::move(c)}});
}

// Names with an exponent or a multiplier each: {{"e", 2}, {"G", -1}}.
using Powers = std::vector<std::pair<std::string, int>>;
using Multiples = std::vector<std::pair<std::string, int>>;

// c e^2 G^-1.
template <Coefficient T>
Series<T> monomial(const Symbols& symbols, T c, const Powers& powers) {
  return Series<T>(symbols, {{packed(symbols, powers, {}, Trigonometric::cosine), std::move(c)}});
}
// c e^2 G^-1 cos(2 l - g), or sin.
template <Coefficient T>
Series<T> cosine(const Symbols& symbols, T c, const Powers& powers, const Multiples& multiples) {
  return Series<T>(symbols,
                   {{packed(symbols, powers, multiples, Trigonometric::cosine), std::move(c)}});
}
template <Coefficient T>
Series<T> sine(const Symbols& symbols, T c, const Powers& powers, const Multiples& multiples) {
  return Series<T>(symbols,
                   {{packed(symbols, powers, multiples, Trigonometric::sine), std::move(c)}});
}

// The terms that keep(key) is true of.
template <Coefficient T, class Keep>
Series<T> selected(const Series<T>& a, const Keep& keep) {
  std::vector<Term<T>> terms;
  for (const Term<T>& term : a.terms())
    if (keep(term.key)) terms.push_back(term);
  return Series<T>(a.symbols(), std::move(terms));
}

// The same series with coefficients convert(c) of another type.
template <Coefficient U, Coefficient T, class Convert>
Series<U> with_coefficients(const Series<T>& a, const Convert& convert) {
  std::vector<Term<U>> terms;
  terms.reserve(a.size());
  for (const Term<T>& term : a.terms()) terms.push_back({term.key, convert(term.c)});
  return Series<U>(a.symbols(), std::move(terms));
}
// The nearest doubles.
template <Coefficient T>
Series<double> to_doubles(const Series<T>& a) {
  return with_coefficients<double>(a, [](const T& c) { return to_double(c); });
}

// Which terms a product keeps, how much memory it may take, and how much it may need.
//
// Equations   order of a term = sum of weight times exponent.
// Units       bytes.
// Domain      weights >= 0, by the names of variables; none keeps all terms.
// Accuracy    exact orders; sizes are upper bounds.
// Errors      none here; product.hpp and its companions throw.

struct Truncation {
  std::vector<std::pair<std::string, int>> weights;
  int order = 0;                                  // the highest that is kept
  std::size_t most_bytes = std::size_t{4} << 30;  // of one product, its digits on the heap apart

  bool cuts(int of_term) const { return !weights.empty() && of_term > order; }
};

struct ProductSize {
  double pairs;  // of terms that are multiplied
  double terms;  // of the result, at most
  double bytes;  // while it is made, at most
};

}  // namespace series
}  // namespace v0
}  // namespace polhode
