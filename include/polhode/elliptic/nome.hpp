// SPDX-License-Identifier: MIT
// The nome q and the complementary nome q1.
//
// Equations   q = exp(-pi K'/K), q1 = exp(-pi K/K'), ln q ln q1 = pi^2. The smaller of the two by
//             q = l + 2 l^5 + 15 l^9 + 150 l^13 + ..., l = (1 - sqrt k')/(2 (1 + sqrt k')), with
//             1 - sqrt k' from m; not from K'/K, whose exponential loses the digits of ln q.
// Units       none.
// Domain      any modulus; q = 0 at m = 0, q = 1 at m1 = 0.
// Accuracy    budget elliptic_nome: relative, however small; 1 - q near m1 = 0 is as a double is.
// Errors      none.
// Cost        two roots, a division and a polynomial; for m > 1/2 also log and exp.
#pragma once

#include <array>
#include <cmath>

#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

namespace detail {

// q for m <= 1/2, where l <= 0.0433.
template <class T>
T small_nome(const BasicModulus<T>& mod) {
  using std::sqrt;
  // The coefficients of l^(4j+1) [OEIS A002103].
  constexpr std::array<double, 8> coefficients{1.0,    2.0,     15.0,     150.0,
                                               1707.0, 20910.0, 268616.0, 3567400.0};
  const T one(1.0);
  const T k1 = sqrt(mod.m1());
  const T root = sqrt(k1);
  const T l = 0.5 * mod.m() / ((one + k1) * (one + root) * (one + root));
  const T l2 = l * l;
  const T l4 = l2 * l2;
  T sum(coefficients.back());
  for (std::size_t j = coefficients.size() - 1; j-- > 0;) sum = sum * l4 + coefficients[j];
  return l * sum;
}

}  // namespace detail

template <Real T>
T nome(const BasicModulus<T>& mod) {
  using std::exp;
  using std::log;
  if (!(mod.m1() < mod.m())) return detail::small_nome(mod);
  const T q1 = detail::small_nome(mod.complement());
  if (q1 == T(0.0)) return T(1.0);
  return exp(pi<T>() * pi<T>() / log(q1));
}

template <Real T>
T complementary_nome(const BasicModulus<T>& mod) {
  return nome(mod.complement());
}

// Compiled once, in the library.
extern template double nome<double>(const BasicModulus<double>&);
extern template DoubleDouble nome<DoubleDouble>(const BasicModulus<DoubleDouble>&);

}  // namespace v0
}  // namespace polhode
