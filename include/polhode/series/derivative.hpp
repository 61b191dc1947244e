// SPDX-License-Identifier: MIT
// Partial derivatives of series, and Poisson brackets.
//
// Equations   {f, g} = sum over pairs (q, p) of df/dq dg/dp - df/dp dg/dq, so that
//             df/dt = {f, H}.
// Units       those of the symbols.
// Domain      any series; a bracket takes the pairs that the symbols declare, and is zero where
//             there are none.
// Accuracy    exact in Rational; else the roundings of T.
// Errors      DomainError for an unknown symbol, an exponent that leaves its range, different
//             symbols, and a bracket that may need more memory than the truncation allows.
// Cost        a derivative is linear in the terms; a bracket is two products a pair.
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/series/detail/partial.hpp"
#include "polhode/series/product.hpp"
#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {

// By a variable or an angle.
template <Coefficient T>
Series<T> derivative(const Series<T>& a, std::string_view name) {
  if (a.symbols().has_angle(name)) return detail::by_angle(a, a.symbols().angle(name));
  return detail::by_variable(a, a.symbols().variable(name));
}

template <Coefficient T>
Series<T> bracket(const Series<T>& a, const Series<T>& b, const Truncation& keep = {}) {
  detail::require_same(a.symbols(), b.symbols());
  std::vector<Series<T>> parts;  // four a pair
  for (const auto& [q, p] : a.symbols().pairs())
    for (const Series<T>& one :
         {derivative(a, q), derivative(b, p), derivative(a, p), derivative(b, q)})
      parts.push_back(one);
  std::vector<detail::Pairing<T>> pairings;
  for (std::size_t i = 0; i < parts.size(); i += 4) {
    pairings.push_back({parts[i].terms(), parts[i + 1].terms(), T(1)});
    pairings.push_back({parts[i + 2].terms(), parts[i + 3].terms(), T(-1)});
  }
  const detail::Products<T> products(a.symbols(), keep, std::move(pairings));
  return Series<T>(a.symbols(), products.terms());
}

}  // namespace v0
}  // namespace polhode
