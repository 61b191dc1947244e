// SPDX-License-Identifier: MIT
// Exact arithmetic on doubles, and reference values: 70 digits.
#pragma once

#include <boost/math/special_functions/expm1.hpp>
#include <boost/math/special_functions/log1p.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "oracle/random_draw.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/real.hpp"

namespace polhode::test {

using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<70>,
                                            boost::multiprecision::et_off>;

inline Exact exact(double x) { return x; }
inline Exact exact(DoubleDouble x) { return Exact(x.hi) + Exact(x.lo); }

// |got - want| / |want| in units of epsilon<T>().
template <class T>
double error_units(const T& got, const Exact& want) {
  if (want == 0) return exact(got) == 0 ? 0.0 : HUGE_VAL;
  const double error = static_cast<double>(Exact(abs((exact(got) - want) / want)));
  return std::isnan(error) ? HUGE_VAL : error / epsilon<T>();
}

// 106 bits, all in use; |x| between 10^lo and 10^hi, of either sign.
inline DoubleDouble drawn(oracle::Draw& draw, double lo, double hi) {
  const double x = draw.sign() * draw.power_of_ten(lo, hi);
  return DoubleDouble::sum(x, x * std::ldexp(draw.uniform(-1.0, 1.0), -54));
}

}  // namespace polhode::test
