// SPDX-License-Identifier: MIT
// Derivatives of a series by one variable, or one angle, given by its place.
#pragma once

#include <utility>
#include <vector>

#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

template <Coefficient T>
Series<T> by_variable(const Series<T>& a, int variable) {
  const PackedFields& fields = a.symbols().exponents();
  std::vector<Term<T>> terms;
  for (const Term<T>& term : a.terms()) {
    const int n = fields.at(term.key.exponents, variable);
    if constexpr (VariableCoefficient<T>)
      if (variable < variables_of_coefficients<T>(a.symbols()))
        terms.push_back({term.key, term.c.derivative(variable)});
    if (n == 0) continue;
    terms.push_back(
        {{fields.with(term.key.exponents, variable, -1), term.key.multipliers}, T(n) * term.c});
  }
  return Series<T>(a.symbols(), std::move(terms));
}

// d cos(k x) = -k sin(k x), d sin(k x) = k cos(k x).
template <Coefficient T>
Series<T> by_angle(const Series<T>& a, int angle) {
  std::vector<Term<T>> terms;
  for (const Term<T>& term : a.terms()) {
    const int k = multiplier(a.symbols(), term.key, angle);
    if (k == 0) continue;
    const bool is_sine = term.key.function() == Trigonometric::sine;
    terms.push_back({{term.key.exponents, term.key.multipliers ^ TermKey::function_bit},
                     T(is_sine ? k : -k) * term.c});
  }
  return Series<T>(a.symbols(), std::move(terms));
}

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
