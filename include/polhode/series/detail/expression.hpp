// SPDX-License-Identifier: MIT
// An expression read as a series:
//   sum = ["-"] product {("+" | "-") product}
//   product = factor {("*" | "/") factor}
//   factor = atom ["^" integer]
//   atom = number | variable | ("cos" | "sin") "(" angles ")" | "(" sum ")"
//   angles = ["-"] multiple {("+" | "-") multiple}
#pragma once

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
namespace detail {

template <class T>
class Expression {
 public:
  Expression(const Symbols& symbols, std::string_view text)
      : symbols_(symbols),
        lexer_(text),
        pairs_left_(pairs_of_text + pairs_of_character * text.size()) {}

  Series<T> series() {
    Series<T> whole = sum();
    if (!lexer_.word().empty()) lexer_.refuse("an operator, or the end");
    return whole;
  }

 private:
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
    if (symbols_.has_angle(name))
      lexer_.refuse("a variable: an angle stands in cos(...) or sin(...) alone");
    if (!symbols_.has_variable(name))
      lexer_.refuse("a number, cos, sin, a parenthesis or a variable of: " + symbols_.names());
    lexer_.advance();
    return monomial<T>(symbols_, T(1), {{name, 1}});
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
    if (!is_monomial(a)) lexer_.refuse("a divisor of one term without an angle before it");
    return inverse(a);
  }

  Symbols symbols_;
  Lexer lexer_;
  std::size_t pairs_left_;
  int depth_ = 0;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
