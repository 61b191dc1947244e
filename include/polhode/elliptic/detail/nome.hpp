// SPDX-License-Identifier: MIT
// The series of the smaller nome, and the other one from it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "polhode/elliptic/detail/packs.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

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

template <Number T>
T nome(const BasicModulus<T>& mod) {
  using std::exp;
  using std::log;
  const T zero(0.0), one(1.0);
  const T &m = mod.m(), &m1 = mod.m1();
  if constexpr (Real<T>) {
    if (m < zero) return -nome(BasicModulus<T>::from_ratio(T(-m), one));
    if (m1 < zero) return m1 * T(std::numeric_limits<double>::quiet_NaN());
  } else if (!all(m >= zero && m1 >= zero)) {
    return detail::each_lane_of([](const auto& at) { return nome(at); }, mod);
  }
  // The smaller of the two; q1 above m = 1/2.
  const auto swapped = m1 < m;
  const auto [l, sum] = detail::small_nome(select(swapped, m1, m), select(swapped, m, m1));
  const T smaller = l * sum;
  if (!any(swapped)) return smaller;
  // Where q1 is next to underflow, ln q1 = ln m1 - ln 16.
  const auto tiny = detail::rounded(m1) < detail::Rounded<T>(0x1p-900);
  const auto of_other = [&]() -> T {
    const T ln_q1 = where(
        tiny, [&]() -> T { return log(m1) - log(T(16.0)); }, [&]() -> T { return log(smaller); });
    return exp(pi<T>() * pi<T>() / ln_q1);
  };
  const T other = where(
      m1 == zero, [&]() -> T { return one; }, of_other);
  return select(swapped, other, smaller);
}

template <Number T>
T complementary_nome(const BasicModulus<T>& mod) {
  return nome(mod.complement());
}

// Compiled once, in the library.
extern template double nome<double>(const BasicModulus<double>&);
extern template DoubleDouble nome<DoubleDouble>(const BasicModulus<DoubleDouble>&);

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
