// SPDX-License-Identifier: MIT
// Products of series, cut off at an order, and what they will take.
//
// Equations   2 cos A cos B = cos(A - B) + cos(A + B), and its three companions. The order of a
//             term is the sum of weight times exponent.
// Units       those of the symbols.
// Domain      weights are integers >= 0 for variables; a term of higher order than `order` is left
//             out of the result, and its pairs are not looked at. Negative exponents count as they
//             are.
// Accuracy    exact in Rational; else the roundings of T, in an order that is always the same.
// Errors      DomainError before it starts where the product may need more memory than most_bytes,
//             with how many pairs, terms and bytes; and for exponents and multipliers that leave
//             their range, for different symbols, and for weights that are not right.
// Cost        some 10 to 40 ns a pair of terms in double (benchmarks/series.cpp); memory at most
//             four times that of all terms of the result.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "polhode/series/detail/products.hpp"
#include "polhode/series/series.hpp"
#include "polhode/series/truncation.hpp"

namespace polhode {
inline namespace v0 {

// Upper bounds. The terms are no more than twice the pairs, and no more than the keys between the
// least and the largest exponents and multipliers that can come out.
template <Coefficient T>
ProductSize product_size(const Series<T>& a, const Series<T>& b, const Truncation& keep = {}) {
  detail::require_same(a.symbols(), b.symbols());
  return detail::Products<T>(a.symbols(), keep, {{a.terms(), b.terms(), T(1)}}).size();
}

template <Coefficient T>
Series<T> product(const Series<T>& a, const Series<T>& b, const Truncation& keep = {}) {
  detail::require_same(a.symbols(), b.symbols());
  const detail::Products<T> products(a.symbols(), keep, {{a.terms(), b.terms(), T(1)}});
  return Series<T>(a.symbols(), products.terms());
}
template <Coefficient T>
Series<T> operator*(const Series<T>& a, const Series<T>& b) {
  return product(a, b);
}

// The terms up to an order.
template <Coefficient T>
Series<T> truncated(const Series<T>& a, const Truncation& keep) {
  const detail::Orders orders(a.symbols(), keep);
  return selected(a, [&](const TermKey& key) { return !keep.cuts(orders.of(key)); });
}
// Those of one order alone.
template <Coefficient T>
Series<T> part_of_order(const Series<T>& a, const Truncation& weights, int order) {
  const detail::Orders orders(a.symbols(), weights);
  return selected(a, [&](const TermKey& key) { return orders.of(key) == order; });
}

// 1 / a, where a is one term without an angle; throws where it is not.
template <Coefficient T>
Series<T> inverse(const Series<T>& a) {
  const Symbols& symbols = a.symbols();
  if (a.size() != 1 || a.terms()[0].key.multipliers != symbols.multipliers().zero())
    throw DomainError("inverse: a series of " + std::to_string(a.size()) +
                      " terms; it must be one term without an angle");
  const Term<T>& term = a.terms()[0];
  const TermKey key{symbols.exponents().negative(term.key.exponents), term.key.multipliers};
  return Series<T>(symbols, {{key, T(1) / term.c}});
}

// a^n, n < 0 where a has an inverse. At most 30 squarings, each truncated.
template <Coefficient T>
Series<T> power(const Series<T>& a, int n, const Truncation& keep = {}) {
  Series<T> square = n < 0 ? inverse(a) : a;
  Series<T> result = truncated(constant<T>(a.symbols(), T(1)), keep);
  unsigned left = n < 0 ? 0U - static_cast<unsigned>(n) : static_cast<unsigned>(n);
  while (left != 0) {
    if (left % 2 == 1) result = product(result, square, keep);
    left /= 2;
    if (left != 0) square = product(square, square, keep);
  }
  return result;
}

}  // namespace v0
}  // namespace polhode
