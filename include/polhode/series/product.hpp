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
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/series/detail/partial.hpp"
#include "polhode/series/detail/products.hpp"
#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {
namespace series {

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

}  // namespace series
}  // namespace v0
}  // namespace polhode
