// SPDX-License-Identifier: MIT
// The entries of a chart Jacobian within 2^-300 of a pole of the chart: what is divided by the
// small number apart from the rest, in units in which double-double holds it.
#pragma once

#include <cmath>
#include <limits>

#include "polhode/math/double_double.hpp"
#include "rotor/detail/chart_jacobian_kernel.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Powers of two that bring a divisor next to a pole to [1, 2); 0 farther off and exactly at it.
inline int pole_exponent(const DoubleDouble& divisor) {
  const double size = std::abs(divisor.hi);
  return size > 0.0 && size < 0x1p-300 ? -std::ilogb(size) : 0;
}

// m += terms 2^exponent; opposite infinities, at J and I both at a pole, leave that of m.
inline void add_terms(BasicMatrix6<DoubleDouble>& m, const BasicMatrix6<DoubleDouble>& terms,
                      int exponent) {
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const DoubleDouble term = ldexp(terms(i, j), exponent), sum = m(i, j) + term;
      if (!isnan(sum) || isnan(term)) m(i, j) = sum;
    }
}

// columns(PoleDivisors) where it divides by J and I, one term at a time if need be.
template <class Columns>
BasicMatrix6<DoubleDouble> sum_of_terms(const DoubleDouble& J, const DoubleDouble& I,
                                        const Columns& columns) {
  using Divisors = PoleDivisors<DoubleDouble>;
  const DoubleDouble none = std::numeric_limits<double>::infinity();
  const int near_J = pole_exponent(J), near_I = pole_exponent(I);
  BasicMatrix6<DoubleDouble> m =
      columns(Divisors{near_J == 0 ? J : none, near_I == 0 ? I : none, true});
  if (near_J != 0) add_terms(m, columns(Divisors{ldexp(J, near_J), none, false}), near_J);
  if (near_I != 0) add_terms(m, columns(Divisors{none, ldexp(I, near_I), false}), near_I);
  return m;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
