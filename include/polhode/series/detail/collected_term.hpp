// SPDX-License-Identifier: MIT
// A term in powers of displacements, as a term with a Taylor polynomial.
#pragma once

#include <string>

#include "polhode/error.hpp"
#include "polhode/series/series.hpp"
#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

template <class Taylor>
Term<Taylor> collected_term(const Symbols& symbols, const Term<typename Taylor::Number>& term) {
  Term<Taylor> out{term.key, Taylor(term.c)};
  int order = 0;
  for (int v = 0; v < variables_of_coefficients<Taylor>(symbols); ++v) {
    const int n = exponent(symbols, term.key, v);
    order += n;
    if (n < 0 || order > Taylor::highest_degree)
      throw DomainError("collected: the term with " + text(symbols, term.key) +
                        ": powers of displacements are in [0, " +
                        std::to_string(Taylor::highest_degree) + "] together");
    for (int k = 0; k < n; ++k) out.c = out.c * Taylor::displacement(v);
    out.key.exponents = symbols.exponents().with(out.key.exponents, v, -n);
  }
  return out;
}

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
