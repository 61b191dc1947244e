// SPDX-License-Identifier: MIT
// The series of the smaller nome, and the other one from it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

namespace detail {

// q = l sum for m <= 1/2, where l <= 0.0433.
template <class T>
struct SmallNome {
  T l;
  T sum;
};
template <class T>
SmallNome<T> small_nome(const T& m, const T& m1) {
  using std::sqrt;
  // The coefficients of l^(4j+1) [OEIS A002103].
  constexpr std::array<double, 8> coefficients{1.0,    2.0,     15.0,     150.0,
                                               1707.0, 20910.0, 268616.0, 3567400.0};
  const T one(1.0);
  const T k1 = sqrt(m1);
  const T root = sqrt(k1);
  const T l = 0.5 * m / ((one + k1) * (one + root) * (one + root));
  const T l2 = l * l;
  const T l4 = l2 * l2;
  T sum(coefficients.back());
  for (std::size_t j = coefficients.size() - 1; j-- > 0;) sum = sum * l4 + coefficients[j];
  return {l, sum};
}

}  // namespace detail

template <Real T>
T nome(const BasicModulus<T>& mod) {
  using std::exp;
  using std::log;
  const T zero(0.0);
  if (mod.m() < zero) return -nome(BasicModulus<T>::from_ratio(T(-mod.m()), T(1.0)));
  if (mod.m1() < zero) return mod.m1() * T(std::numeric_limits<double>::quiet_NaN());
  if (!(mod.m1() < mod.m())) {
    const auto [l, sum] = detail::small_nome(mod.m(), mod.m1());
    return l * sum;
  }
  if (mod.m1() == zero) return T(1.0);
  // Where q1 is next to underflow, ln q1 = ln m1 - ln 16.
  const bool tiny = to_double(mod.m1()) < 0x1p-900;
  const auto [l, sum] = detail::small_nome(mod.m1(), mod.m());
  const T ln_q1 = tiny ? log(mod.m1()) - log(T(16.0)) : T(log(l * sum));
  return exp(pi<T>() * pi<T>() / ln_q1);
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
