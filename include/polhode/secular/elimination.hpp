// SPDX-License-Identifier: MIT
// What a Lie transform is asked for, and what it will take.
//
// Equations   keys of order n, exponents and multipliers, are those of H_n, and those of order n - a
//             with a key of H_a, a momentum less, over a rate. Bytes: n + 3 series of each order n,
//             and the table of a product, which begins with 2^18 places.
// Units       bytes.
// Domain      as in lie_transform.hpp.
// Accuracy    terms: an upper bound, 1 to 2.5 times what is there, and 5 where few terms of H have
//             to do with each other (tests/unit/secular/transform_size.cpp). It is counted for a
//             tenth of a second; higher orders are extrapolated by a power of the order, that of
//             the dimensions of the keys. Digits of rationals on the heap come on top.
// Errors      DomainError for what a Lie transform refuses of H_0, its orders and clocks.
// Cost        20 ns a pair of keys, 2e6 pairs at most; as a rule below a tenth of the transform
//             (benchmarks/perturbation_theory.cpp).
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "polhode/secular/detail/lie_keys.hpp"
#include "polhode/secular/detail/lie_orders.hpp"
#include "polhode/series/linear_flow.hpp"
#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {

template <Coefficient T>
struct Elimination {
  Series<T> hamiltonian;
  Truncation keep;                         // the small parameters, and the highest order
  std::vector<std::string> angles;         // to be eliminated
  std::vector<Multiples> resonances = {};  // combinations of them that stay, and their multiples
  std::vector<AngleRate<T>> clocks = {};
  double least_divisor = 0.0;  // the smallest coefficient of a rate to divide by
  double slowest = 0.0;        // what turns at a rate with a smaller coefficient stays
};

// By order.
struct TransformSize {
  std::vector<double> terms;  // of a series of this order, at most
  std::vector<double> bytes;  // of memory, if this order is the last
  int counted;                // the last order that was counted; what follows is extrapolated
};

namespace detail {

// The parts of the Hamiltonian by order; throws for what breaks the domain.
template <class T>
Parts<T> checked_parts(const Elimination<T>& problem) {
  const Symbols& symbols = problem.hamiltonian.symbols();
  require_small(symbols, problem.keep);
  Parts<T> h = parts(problem.hamiltonian, problem.keep);
  require_integrable(h[0]);
  std::set<std::string> clocks;
  for (const AngleRate<T>& clock : problem.clocks) {
    require_clock(problem.hamiltonian, clock, problem.keep);
    if (!clocks.insert(clock.angle).second)
      throw DomainError("LieTransform: the clock " + clock.angle + " is there twice");
  }
  return h;
}

// Rates of the angles that turn.
template <class T>
std::vector<AngleRate<T>> angle_rates(const Series<T>& h0, std::vector<AngleRate<T>> clocks) {
  std::vector<AngleRate<T>> rates = std::move(clocks);
  for (const ConjugatePair& pair : h0.symbols().pairs())
    if (h0.symbols().has_angle(pair.coordinate))
      rates.push_back({pair.coordinate, derivative(h0, pair.momentum)});
  return rates;
}

template <class T>
LieKeys lie_keys(const Elimination<T>& problem, const Parts<T>& h) {
  Keys rates(problem.hamiltonian.symbols());
  for (const AngleRate<T>& one : angle_rates(h[0], problem.clocks))
    if (!derivative(problem.hamiltonian, one.angle).is_zero()) rates += keys_of(one.rate);
  int of_coefficients = 0;
  if constexpr (VariableCoefficient<T>) of_coefficients = T::variable_count;
  return LieKeys(keys_of(h), rates, of_coefficients);
}

template <class T>
TransformSize size_of(const KeyCount& count) {
  return {count.terms,
          bytes_by_order(count.terms, sizeof(Term<T>), sizeof(CodedTerm<std::uint64_t, T>)),
          count.counted};
}

}  // namespace detail

template <Coefficient T>
TransformSize transform_size(const Elimination<T>& problem) {
  return detail::size_of<T>(detail::lie_keys(problem, detail::checked_parts(problem)).count());
}

}  // namespace v0
}  // namespace polhode
