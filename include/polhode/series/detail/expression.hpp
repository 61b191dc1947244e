// SPDX-License-Identifier: MIT
// An expression read as a series:
//   sum = ["-"] product {("+" | "-") product}
//   product = factor {("*" | "/") factor}
//   factor = atom ["^" integer]
//   atom = number | variable | ("cos" | "sin") "(" angles ")" | "(" sum ")"
//        | "sqrt" "(" sum ")"
//   angles = ["-"] multiple {("+" | "-") multiple}
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/series/detail/lexer.hpp"
#include "polhode/series/product.hpp"
#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

namespace roots {
using std::sqrt;
template <class N>
concept HasRoot = requires(const N& x) { sqrt(x); };
}  // namespace roots
// A function of variables, of numbers that have roots: rationals have none.
template <class T>
concept HasRoot = VariableCoefficient<T> && roots::HasRoot<typename T::Number>;

template <class T>
class Expression {
 public:
  Expression(const Symbols& symbols, std::string_view text)
      : symbols_(symbols),
        lexer_(text),
        pairs_left_(pairs_of_text + pairs_of_character * text.size()) {
    const std::size_t values = symbols.values().size();
    if (values > static_cast<std::size_t>(most_values))
      throw DomainError("series: " + std::to_string(values) + " variables have values, " +
                        symbols.values_text() + "; coefficients of this type take " +
                        std::to_string(most_values));
  }

  Series<T> series() {
    Series<T> whole = sum();
    if (!lexer_.word().empty()) lexer_.refuse("an operator, or the end");
    return whole;
  }

 private:
  static constexpr int most_values = [] {
    if constexpr (VariableCoefficient<T>) return T::variable_count;
    return 0;
  }();
  static constexpr int most_depth = 100;
  static constexpr int most_power = 1000;  // of what is no monomial
  // Pairs of terms that text may ask for: a second at most, and more for long text.
  static constexpr std::size_t pairs_of_text = 200'000, pairs_of_character = 100;

  Series<T> sum() {
    if (++depth_ > most_depth) lexer_.refuse("parentheses no deeper than 100");
    std::vector<Term<T>> terms;
    bool negative = lexer_.takes("-");
    do {
      const Series<T> one = negative ? -product() : product();
      terms.insert(terms.end(), one.terms().begin(), one.terms().end());
      negative = lexer_.word() == "-";
    } while (lexer_.takes("+") || lexer_.takes("-"));
    --depth_;
    return Series<T>(symbols_, std::move(terms));
  }

  Series<T> product() {
    Series<T> all = factor();
    for (;;) {
      if (lexer_.takes("*")) {
        if (lexer_.word() == "*") lexer_.refuse("a factor: a power is written with ^, as in G^2");
        all = times(all, factor());
      } else if (lexer_.takes("/")) {
        all = times(all, inverted(factor()));
      } else {
        return all;
      }
    }
  }

  Series<T> factor() {
    Series<T> base = atom();
    if (!lexer_.takes("^")) return base;
    const int n = lexer_.integer();
    if (n < 0) base = inverted(base);
    if (is_monomial(base)) return power(base, std::abs(n));
    if (std::abs(n) > most_power) lexer_.refuse("powers of sums and waves up to 1000 before it");
    Series<T> all = constant<T>(symbols_, T(1));
    for (int i = 0; i < std::abs(n) && !all.is_zero(); ++i) all = times(all, base);
    return all;
  }

  Series<T> atom() {
    if (lexer_.is_number()) {
      T c = CoefficientText<T>::from_text(lexer_.word());
      lexer_.advance();
      return constant<T>(symbols_, std::move(c));
    }
    if (lexer_.takes("(")) {
      Series<T> inner = sum();
      lexer_.expect(")");
      return inner;
    }
    if (lexer_.takes("cos")) return wave(Trigonometric::cosine);
    if (lexer_.takes("sin")) return wave(Trigonometric::sine);
    const std::string name(lexer_.word());
    if (name == "sqrt" && !symbols_.has_variable(name) && !symbols_.has_angle(name)) return root();
    if (symbols_.has_angle(name))
      lexer_.refuse("a variable: an angle stands in cos(...) or sin(...) alone");
    if (!symbols_.has_variable(name))
      lexer_.refuse("a number, cos, sin, a parenthesis or a variable of: " + symbols_.names());
    lexer_.advance();
    if constexpr (VariableCoefficient<T>)
      if (const auto i = static_cast<std::size_t>(symbols_.variable(name));
          i < symbols_.values().size())
        return constant<T>(symbols_,
                           T::variable(static_cast<int>(i), number_of(symbols_.values()[i])));
    return monomial<T>(symbols_, T(1), {{name, 1}});
  }

  // By its text, so that rationals are those of its digits.
  static auto number_of(double value) {
    return CoefficientText<typename T::Number>::from_text(CoefficientText<double>::text(value));
  }

  Series<T> root() {
    if constexpr (HasRoot<T>) {
      if (!symbols_.values().empty()) {
        lexer_.advance();
        lexer_.expect("(");
        const Series<T> inner = sum();
        if (inner.size() > 1 || (inner.size() == 1 && inner.terms()[0].key != zero_key(symbols_)))
          lexer_.refuse("a root of a function of " + functions_of() +
                        " before it, without angles and other variables");
        if (inner.is_zero() || is_rounded_zero(inner.terms()[0].c) ||
            !(to_double(inner.terms()[0].c) > 0.0))
          lexer_.refuse("a root of a function that is positive at " + symbols_.values_text() +
                        " before it");
        Series<T> found = constant<T>(symbols_, sqrt(inner.terms()[0].c));
        require_finite(found);
        lexer_.expect(")");
        return found;
      }
    }
    lexer_.refuse(
        "a number, cos, sin, a parenthesis or a variable: a root needs symbols with values of the "
        "momenta in it");
  }

  // True when c is 0 at the given values, up to the rounding of sums such as G^2 - L^2.
  bool is_rounded_zero(const T& c) const {
    constexpr double rounding = 1e-14;
    double scale = 0.0;
    for (std::size_t i = 1; i < T::size; ++i) {
      double size = std::abs(to_double(c.at(i)));
      for (std::size_t v = 0; v < symbols_.values().size(); ++v)
        size *= std::pow(std::abs(symbols_.values()[v]), T::exponents(i)[v]);
      scale += size;
    }
    const double value = std::abs(to_double(c));
    return value == 0.0 || value < rounding * scale;
  }
  // "L, G".
  std::string functions_of() const {
    std::string names;
    for (std::size_t i = 0; i < symbols_.values().size(); ++i)
      names += (i == 0 ? "" : ", ") + symbols_.variables()[i];
    return names;
  }
  void require_finite(const Series<T>& a) const {
    for (const Term<T>& term : a.terms())
      for (std::size_t i = 0; i < T::size; ++i)
        if (!std::isfinite(to_double(term.c.at(i))))
          lexer_.refuse("a function whose Taylor polynomial is finite at " +
                        symbols_.values_text() + " before it");
  }

  Series<T> wave(Trigonometric function) {
    lexer_.expect("(");
    Multiples multiples;
    bool negative = lexer_.takes("-");
    do {
      multiples.push_back(multiple(negative));
      negative = lexer_.word() == "-";
    } while (lexer_.takes("+") || lexer_.takes("-"));
    if (lexer_.word() == "/")
      lexer_.refuse("whole multiples of angles: for cos(g/2) make half of g an angle of its own");
    if (lexer_.word() == "*") lexer_.refuse("the number before the angle, as in 2*g");
    lexer_.expect(")");
    return Series<T>(symbols_, {{packed(symbols_, {}, multiples, function), T(1)}});
  }

  std::pair<std::string, int> multiple(bool negative) {
    int n = 1;
    if (lexer_.is_number()) {
      n = whole();
      lexer_.expect("*");
    }
    const std::string name(lexer_.word());
    if (!symbols_.has_angle(name)) lexer_.refuse("an angle of: " + symbols_.names());
    lexer_.advance();
    return {name, negative ? -n : n};
  }

  int whole() {
    if (lexer_.word().find_first_of(".eE") != std::string_view::npos)
      lexer_.refuse("an integer: angles stand with whole multiples");
    return lexer_.integer();
  }

  Series<T> times(const Series<T>& a, const Series<T>& b) {
    const std::size_t pairs = a.size() * b.size();
    if (pairs > pairs_left_) lexer_.refuse("fewer products of long sums before it");
    pairs_left_ -= pairs;
    return a * b;
  }
  bool is_monomial(const Series<T>& a) const {
    return a.size() == 1 && a.terms()[0].key.multipliers == symbols_.multipliers().zero();
  }
  Series<T> inverted(const Series<T>& a) const {
    const bool has_values = !symbols_.values().empty();
    if (!is_monomial(a))
      lexer_.refuse(has_values ? "a divisor without an angle before it: a function of " +
                                     functions_of() + ", times powers of other variables"
                               : "a divisor of one term without an angle before it; quotients by "
                                 "sums need symbols with values of the momenta in them");
    if constexpr (VariableCoefficient<T>) {
      if (is_rounded_zero(a.terms()[0].c))
        lexer_.refuse("a divisor that is not 0 at " + symbols_.values_text() + " before it");
      Series<T> found = inverse(a);
      require_finite(found);
      return found;
    }
    return inverse(a);
  }

  Symbols symbols_;
  Lexer lexer_;
  std::size_t pairs_left_;
  int depth_ = 0;
};

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
