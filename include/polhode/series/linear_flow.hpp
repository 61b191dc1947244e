// SPDX-License-Identifier: MIT
// Means over angles, and integrals along angles that advance at constant rates.
//
// Equations   S with sum over angles of w_i dS/dphi_i = f: cos(k.phi) -> sin(k.phi) / (k.w),
//             sin(k.phi) -> -cos(k.phi) / (k.w).
// Units       f times the unit of time of the rates.
// Domain      a rate is a series without angles: a number, or a function of variables that the flow
//             leaves alone (G / C). Angles without a rate stand still. k.w must be one term, and
//             its coefficient no smaller than the bound. Sums of different functions are one term
//             where the coefficient is a function itself (taylor_coefficient.hpp).
// Accuracy    exact in Rational; else a rounding of T a term.
// Errors      DomainError that names the combination of angles, where its rate is below the bound,
//             is zero, or is a sum of different functions; for unknown angles and different
//             symbols.
// Cost        linear in the terms, times the angles.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "polhode/series/product.hpp"
#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {
namespace series {

// The terms without the angles named: the mean over each of them.
template <Coefficient T>
Series<T> mean(const Series<T>& a, const std::vector<std::string>& angles) {
  std::vector<int> places;
  for (const std::string& name : angles) places.push_back(a.symbols().angle(name));
  return selected(a, [&](const TermKey& key) {
    for (const int i : places)
      if (multiplier(a.symbols(), key, i) != 0) return false;
    return true;
  });
}

template <Coefficient T>
struct AngleRate {
  std::string angle;
  Series<T> rate;
};

// The combination of angles of a term as text: "2*l - g".
template <Coefficient T>
std::string angle_text(const Series<T>& a, const TermKey& key) {
  const std::string whole =
      text(a.symbols(), {a.symbols().exponents().zero(), key.angle() | TermKey::function_bit});
  return whole.substr(4, whole.size() - 5);  // without "sin(" and ")"
}

// d phi / dt of the angle of a term.
template <Coefficient T>
Series<T> rate(const Series<T>& a, const TermKey& key, const std::vector<AngleRate<T>>& rates) {
  Series<T> sum(a.symbols());
  for (const AngleRate<T>& one : rates) {
    const int k = multiplier(a.symbols(), key, a.symbols().angle(one.angle));
    sum += T(k) * one.rate;
  }
  return sum;
}

// The integral of f along the flow, without a constant. least is the smallest coefficient of a rate
// k.w that it may be divided by.
template <Coefficient T>
Series<T> integral(const Series<T>& f, const std::vector<AngleRate<T>>& rates, double least) {
  const Symbols& symbols = f.symbols();
  const PackedFields& exponents = symbols.exponents();
  const auto refuse = [&](const TermKey& key, const std::string& why) {
    throw DomainError("integral: the term with " + text(symbols, key) + " turns with " +
                      angle_text(f, key) + ", whose rate " + why);
  };
  std::vector<Term<T>> terms;
  terms.reserve(f.size());
  for (const Term<T>& term : f.terms()) {
    if (term.key.angle() == symbols.multipliers().zero())
      throw DomainError("integral: the term with " + text(symbols, term.key) +
                        " has no angle; take the mean away first");
    const Series<T> w = rate(f, term.key, rates);
    if (w.is_zero()) refuse(term.key, "is 0: a resonance; keep it in the mean");
    if (w.size() > 1)
      refuse(term.key, "is a sum of " + std::to_string(w.size()) + " terms; it must be one");
    const Term<T>& divisor = w.terms()[0];
    if (divisor.key.multipliers != symbols.multipliers().zero())
      refuse(term.key, "depends on angles");
    if constexpr (VariableCoefficient<T>)
      if (to_double(divisor.c) == 0.0)
        refuse(term.key, "is 0 at the values chosen: a resonance; keep it in the mean");
    if (!(std::abs(to_double(divisor.c)) >= least))
      refuse(term.key, "has the coefficient " +
                           CoefficientText<double>::text(to_double(divisor.c)) +
                           ", below the bound " + CoefficientText<double>::text(least));
    const bool is_sine = term.key.function() == Trigonometric::sine;
    const TermKey key{exponents.difference(term.key.exponents, divisor.key.exponents),
                      term.key.multipliers ^ TermKey::function_bit};
    terms.push_back({key, is_sine ? -(term.c / divisor.c) : term.c / divisor.c});
  }
  return Series<T>(symbols, std::move(terms));
}

}  // namespace series
}  // namespace v0
}  // namespace polhode
