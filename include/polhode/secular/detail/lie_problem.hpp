// SPDX-License-Identifier: MIT
// An elimination, checked, and what is made of it before a Lie transform starts.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "polhode/secular/detail/lie_keys.hpp"
#include "polhode/secular/detail/lie_orders.hpp"
#include "polhode/secular/elimination.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {

// Throws for an angle that is to be eliminated and does not turn.
void require_turning(const series::Symbols& symbols, const std::vector<std::string>& angles,
                     const std::set<std::string>& clocks);
void require_bound(const char* name, double bound);

// The parts of the Hamiltonian by order; throws for what breaks the domain.
template <class T>
Parts<T> checked_parts(const Elimination<T>& problem) {
  const series::Symbols& symbols = problem.hamiltonian.symbols();
  require_small(symbols, problem.keep);
  require_bound("least_divisor", problem.least_divisor);
  require_bound("slowest", problem.slowest);
  if constexpr (series::VariableCoefficient<T>)
    for (const auto& [name, weight] : problem.keep.weights)
      if (weight != 0 && symbols.variable(name) < series::variables_of_coefficients<T>(symbols))
        throw DomainError("LieTransform: the small parameter " + name +
                          " is a variable of the coefficients, which have no order");
  Parts<T> h = parts(problem.hamiltonian, problem.keep);
  require_integrable(h[0]);
  std::set<std::string> clocks;
  for (const series::AngleRate<T>& clock : problem.clocks) {
    require_clock(problem.hamiltonian, clock, problem.keep);
    if (!clocks.insert(clock.angle).second)
      throw DomainError("LieTransform: the clock " + clock.angle + " is there twice");
  }
  require_turning(symbols, problem.angles, clocks);
  return h;
}

// Rates of the angles that turn.
template <class T>
std::vector<series::AngleRate<T>> angle_rates(const series::Series<T>& h0,
                                              std::vector<series::AngleRate<T>> clocks) {
  std::vector<series::AngleRate<T>> rates = std::move(clocks);
  for (const series::ConjugatePair& pair : h0.symbols().pairs())
    if (h0.symbols().has_angle(pair.coordinate))
      rates.push_back({pair.coordinate, series::derivative(h0, pair.momentum)});
  return rates;
}

template <class T>
LieKeys lie_keys(const Elimination<T>& problem, const Parts<T>& h) {
  Keys rates(problem.hamiltonian.symbols());
  for (const series::AngleRate<T>& one : angle_rates(h[0], problem.clocks))
    if (!series::derivative(problem.hamiltonian, one.angle).is_zero()) rates += keys_of(one.rate);
  return LieKeys(keys_of(h), rates,
                 series::variables_of_coefficients<T>(problem.hamiltonian.symbols()));
}

// Of a transform that ends at each order.
template <class T>
std::vector<double> bytes_of(const KeyCount& count) {
  return bytes_by_order(count.terms, sizeof(series::Term<T>),
                        sizeof(series::detail::CodedTerm<std::uint64_t, T>));
}

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
