// SPDX-License-Identifier: MIT
// Series put into series.
//
// Equations   f(x = s) by powers of s; f(phi -> sums of angles) by turning the multipliers;
//             f(x + d) = sum of d^n / n! d^n f / dx^n, x a variable or an angle.
// Units       those of the symbols.
// Domain      substituted: a negative exponent needs an s that is one term without an angle; no
//             variable that the coefficients depend on (taylor_coefficient.hpp).
//             displaced: it ends where the derivatives do (a polynomial in x), or where the
//             truncation cuts d^n off, and so d needs an order above 0 for an angle. Order n of the
//             truncation is that of the result.
// Accuracy    exact in Rational; else the roundings of T.
// Errors      DomainError for unknown symbols, an inverse that is not there, a displacement that
//             does not end, and all that a product refuses.
// Cost        as many products as there are different exponents, or orders.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/series/derivative.hpp"
#include "polhode/series/product.hpp"

namespace polhode {
inline namespace v0 {

// The variable `name` replaced by s.
template <Coefficient T>
Series<T> substituted(const Series<T>& a, std::string_view name, const Series<T>& s,
                      const Truncation& keep = {}) {
  const Symbols& symbols = a.symbols();
  detail::require_same(symbols, s.symbols());
  const int variable = symbols.variable(name);
  if constexpr (VariableCoefficient<T>)
    if (variable < variables_of_coefficients<T>(symbols))
      throw DomainError("substituted: " + std::string(name) +
                        " is a variable of the coefficients too; it can be displaced alone");
  std::map<int, std::vector<Term<T>>> by_exponent;
  for (const Term<T>& term : a.terms()) {
    const int n = exponent(symbols, term.key, variable);
    const auto rest = symbols.exponents().with(term.key.exponents, variable, -n);
    by_exponent[n].push_back({{rest, term.key.multipliers}, term.c});
  }
  Series<T> sum(symbols);
  for (auto& [n, terms] : by_exponent)
    sum += product(Series<T>(symbols, std::move(terms)), power(s, n, keep), keep);
  return sum;
}

// One angle as a sum of multiples of angles, of the same symbols.
struct AngleSum {
  std::string angle;
  Multiples sum;
};
// All of the angles named are replaced at once; the others stay.
template <Coefficient T>
Series<T> angles_replaced(const Series<T>& a, const std::vector<AngleSum>& sums) {
  const Symbols& symbols = a.symbols();
  std::map<int, const Multiples*> replaced;
  for (const AngleSum& one : sums)
    if (!replaced.emplace(symbols.angle(one.angle), &one.sum).second)
      throw DomainError("angles_replaced: " + one.angle + " is there twice");
  std::vector<Term<T>> terms;
  for (const Term<T>& term : a.terms()) {
    Multiples multiples;
    for (int i = 0; i < symbols.multipliers().count(); ++i) {
      const int k = multiplier(symbols, term.key, i);
      if (k == 0) continue;
      const auto found = replaced.find(i);
      if (found == replaced.end()) {
        multiples.emplace_back(symbols.angles()[static_cast<std::size_t>(i)], k);
        continue;
      }
      // Multipliers stay below 2^14, so that products of legal ones are in range.
      for (const auto& [name, n] : *found->second) {
        if (n > symbols.multipliers().greatest() || n < symbols.multipliers().least())
          throw DomainError("angles_replaced: the multiplier " + std::to_string(n) + " of " + name +
                            " is out of range");
        multiples.emplace_back(name, k * n);
      }
    }
    const TermKey key = packed(symbols, {}, multiples, term.key.function());
    terms.push_back({{term.key.exponents, key.multipliers}, term.c});
  }
  return Series<T>(symbols, std::move(terms));
}

// The variable or angle `name` replaced by itself and d. At most 200 orders.
template <Coefficient T>
Series<T> displaced(const Series<T>& a, std::string_view name, const Series<T>& d,
                    const Truncation& keep = {}) {
  constexpr int most_orders = 200;
  Series<T> sum = truncated(a, keep), derivatives = a;
  Series<T> factor = truncated(constant<T>(a.symbols(), T(1)), keep);
  for (int n = 1; n <= most_orders; ++n) {
    derivatives = derivative(derivatives, name);
    factor = product(factor, d, keep) / T(n);
    if (derivatives.is_zero() || factor.is_zero()) return sum;
    sum += product(derivatives, factor, keep);
  }
  throw DomainError("displaced: the series in the displacement of " + std::string(name) +
                    " has not ended after " + std::to_string(most_orders) +
                    " orders; its displacement needs a weight above 0 in the truncation");
}

}  // namespace v0
}  // namespace polhode
