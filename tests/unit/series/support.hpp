// SPDX-License-Identifier: MIT
// Series drawn at random, and their values by the plain formula: exact at points whose cosines and
// sines are rational.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "polhode/series/product.hpp"
#include "polhode/series/series.hpp"

namespace series_test {

using namespace polhode;
using namespace polhode::series;

using Exact = series::Series<series::Rational>;

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  // From first to last, both among them.
  int integer(int first, int last) {
    return first + static_cast<int>(engine_() % static_cast<unsigned>(last - first + 1));
  }
  series::Rational rational() { return series::Rational(integer(-9, 9), integer(1, 9)); }

 private:
  std::mt19937 engine_;
};

// Two pairs of an angle and its momentum, and one of two variables; e and x stand alone.
inline series::Symbols some_symbols() {
  return series::Symbols({"L", "G", "p", "q", "e"}, {"l", "g", "x"},
                         {{"l", "L"}, {"g", "G"}, {"q", "p"}});
}

template <class T = series::Rational, class Coefficient>
series::Series<T> drawn(const series::Symbols& symbols, Draw& draw, int terms, int least,
                        int largest, int multiples, const Coefficient& coefficient) {
  series::Series<T> sum(symbols);
  for (int t = 0; t < terms; ++t) {
    polhode::series::Powers powers;
    polhode::series::Multiples angle;
    for (const std::string& name : symbols.variables())
      powers.emplace_back(name, draw.integer(least, largest));
    for (const std::string& name : symbols.angles())
      angle.emplace_back(name, draw.integer(-multiples, multiples));
    const T c = coefficient();
    sum += draw.integer(0, 1) == 0 ? polhode::series::cosine(symbols, c, powers, angle)
                                   : polhode::series::sine(symbols, c, powers, angle);
  }
  return sum;
}
inline Exact drawn_series(const series::Symbols& symbols, Draw& draw, int terms = 5,
                          int least = -1) {
  return drawn(symbols, draw, terms, least, 2, 2, [&] { return draw.rational(); });
}

// Variables, and the cosine and sine of each angle.
template <class X>
struct Point {
  std::vector<X> variables, cosines, sines;
};

template <class X>
X to_power(const X& x, int n) {
  X result(1);
  for (int i = 0; i < std::abs(n); ++i) result = result * x;
  return n < 0 ? X(1) / result : result;
}

// By the definition of a series, in any field of numbers.
template <class X, class T, class Convert>
X value(const series::Series<T>& a, const Point<X>& at, const Convert& convert) {
  X sum(0);
  for (const series::Term<T>& term : a.terms()) {
    X monomial = convert(term.c), c(1), s(0);
    for (std::size_t i = 0; i < at.variables.size(); ++i)
      monomial = monomial *
                 to_power(at.variables[i],
                          polhode::series::exponent(a.symbols(), term.key, static_cast<int>(i)));
    for (std::size_t i = 0; i < at.cosines.size(); ++i) {
      const int k = polhode::series::multiplier(a.symbols(), term.key, static_cast<int>(i));
      for (int turn = 0; turn < std::abs(k); ++turn) {
        const X before = c, step = k < 0 ? X(0) - at.sines[i] : at.sines[i];
        c = before * at.cosines[i] - s * step;
        s = s * at.cosines[i] + before * step;
      }
    }
    sum = sum + monomial * (term.key.function() == series::Trigonometric::sine ? s : c);
  }
  return sum;
}
inline series::Rational value(const Exact& a, const Point<series::Rational>& at) {
  return value(a, at, [](const series::Rational& c) { return c; });
}

// cos = (1 - t^2) / (1 + t^2), sin = 2 t / (1 + t^2).
inline Point<series::Rational> drawn_point(const series::Symbols& symbols, Draw& draw) {
  Point<series::Rational> at;
  for (std::size_t i = 0; i < symbols.variables().size(); ++i)
    at.variables.emplace_back(draw.integer(1, 5), draw.integer(1, 5));
  for (std::size_t i = 0; i < symbols.angles().size(); ++i) {
    const series::Rational t(draw.integer(-5, 5), draw.integer(1, 5)), one(1);
    at.cosines.push_back((one - t * t) / (one + t * t));
    at.sines.push_back(series::Rational(2) * t / (one + t * t));
  }
  return at;
}

}  // namespace series_test
