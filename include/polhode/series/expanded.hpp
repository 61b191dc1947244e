// SPDX-License-Identifier: MIT
// A series whose coefficients are Taylor polynomials, as a series with powers of displacements: to
// be evaluated, printed or truncated.
//
// Equations   sum of c_m x^m a^n cos(k.phi): the exponents of the first variables are those of
//             their displacements.
// Units       those of the symbols.
// Domain      any series of TaylorCoefficient. most_degree cuts the polynomials.
// Accuracy    no rounding.
// Errors      DomainError for an exponent that leaves its range.
// Cost        a term for each number of a coefficient that is not zero.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "polhode/series/series.hpp"
#include "polhode/series/taylor_coefficient.hpp"

namespace polhode {
inline namespace v0 {

template <Coefficient T, int count, int degree>
Series<T> expanded(const Series<TaylorCoefficient<T, count, degree>>& a, int most_degree = degree) {
  using Taylor = TaylorCoefficient<T, count, degree>;
  const Symbols& symbols = a.symbols();
  const PackedFields& fields = symbols.exponents();
  std::vector<Term<T>> terms;
  for (const Term<Taylor>& term : a.terms())
    for (std::size_t i = 0; i < Taylor::size; ++i) {
      if (term.c.at(i) == T(0)) continue;
      const auto powers = Taylor::exponents(i);
      TermKey key = term.key;
      int order = 0;
      for (int v = 0; v < count; ++v) {
        key.exponents = fields.with(key.exponents, v, powers[static_cast<std::size_t>(v)]);
        order += powers[static_cast<std::size_t>(v)];
      }
      if (order <= most_degree) terms.push_back({key, term.c.at(i)});
    }
  return Series<T>(symbols, std::move(terms));
}

}  // namespace v0
}  // namespace polhode
