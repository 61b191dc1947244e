// SPDX-License-Identifier: MIT
// Kepler's equation: the eccentric anomaly of a mean anomaly, for ellipses and hyperbolas.
//
// Equations   M = E - e sin E (e < 1), M = e sinh H - H (e > 1); solved as M = |1 - e| E + e (E -
//             sin E), a sum of terms of one sign, which keeps its digits where e is next to 1.
//             Starter and fifth-order correction for ellipses: Markley (1995); for hyperbolas the
//             root of the cubic that bounds the equation from below, carried through asinh, and
//             Halley's steps.
// Units       radians.
// Domain      any finite M and 0 <= e < 1 or e > 1. NaN for e = 1, e < 0 and NaN.
// Accuracy    budget kepler_*: a few roundings of E, sin E and 1 - cos E, each relative, times what
//             a rounding of M does.
// Cost        about 120 ns for ellipses, 250 ns for hyperbolas; 1 us in double-double. A fixed
//             number of steps, whatever the arguments.
#pragma once

#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {

// e with |1 - e|, which subtraction could not give where e was itself computed.
template <Real T>
struct BasicEccentricity {
  T e;
  T complement;

  static BasicEccentricity of(const T& e) {
    const T one(1.0);
    return {e, e < one ? one - e : e - one};
  }
};
using Eccentricity = BasicEccentricity<double>;

template <Real T>
struct BasicKeplerAnomaly {
  T anomaly;  // E, with the turns of M; or H
  T sine;     // sin E or sinh H
  T versine;  // 1 - cos E or cosh H - 1
};
using KeplerAnomaly = BasicKeplerAnomaly<double>;

KeplerAnomaly eccentric_anomaly(double M, const Eccentricity& e);
BasicKeplerAnomaly<DoubleDouble> eccentric_anomaly(const DoubleDouble& M,
                                                   const BasicEccentricity<DoubleDouble>& e);

}  // namespace v0
}  // namespace polhode
