// SPDX-License-Identifier: MIT
// Jacobi's zeta function of the amplitude.
//
// Equations   Z(phi|m) = E(phi|m) - (E/K) F(phi|m) [DLMF 22.16.32, at u = F(phi)]
//             = m s c D cel(k1, D^2, 0, 1)/K, (s, c) = (sin phi, cos phi), D = sqrt(c^2 + m1 s^2):
//             one term, not the difference.
// Units       none; phi in radians.
// Domain      any phi (of period pi, odd), m <= 1, m < 0 too; m > 1: NaN. At m1 = 0 its limit: s
//             for c > 0, -s for c < 0.
// Accuracy    budget elliptic_beyond: relative, for every modulus, also next to its zeros.
// Cost        one sincos, an agm and a cel.
#pragma once

#include <cmath>
#include <limits>

#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/detail/packs.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/real.hpp"
#include "polhode/math/trigonometry.hpp"
#include "polhode/math/widening.hpp"

namespace polhode {
inline namespace v0 {

// phi = atan2(s, c).
template <Number T>
T jacobi_zeta(const T& s, const T& c, const BasicModulus<T>& mod) {
  using std::sqrt;
  const T zero(0.0);
  if constexpr (Real<T>) {
    if (mod.m1() < zero) return T(std::numeric_limits<double>::quiet_NaN());
    if (mod.m1() == zero) return c < zero ? -s : (c > zero ? s : c);
  } else if (!detail::all_before_separatrix(mod) || !lanes_within(0x1p-900, 0x1p300, mod.m1()) ||
             !lanes_within(0x1p-400, 1.0, s, c)) {
    return detail::each_lane_of([](const auto&... x) { return jacobi_zeta(x...); }, mod, s, c);
  }
  if constexpr (NarrowRange<T>) {
    if (!within(0x1p-900, 0x1p300, mod.m1()) || !within(0x1p-400, 1.0, s, c)) {
      const auto wide = BasicModulus<typename Widening<T>::Wide>::from_any_pair(widened(mod.m()),
                                                                                widened(mod.m1()));
      return Widening<T>::narrowed(jacobi_zeta(widened(s), widened(c), wide));
    }
  }
  const T delta = sqrt(c * c + mod.m1() * (s * s));
  const T mean = detail::cel_loop(T(sqrt(mod.m1())), delta, zero, T(1.0)) / complete_k(mod);
  return s * (mod.m() * (c * (delta * mean)));
}

template <Number T>
T jacobi_zeta(const T& phi, const BasicModulus<T>& mod) {
  const auto [s, c] = sincos(phi);
  return jacobi_zeta(T(s), T(c), mod);
}

// Compiled once, in the library.
extern template double jacobi_zeta<double>(const double&, const double&,
                                           const BasicModulus<double>&);
extern template double jacobi_zeta<double>(const double&, const BasicModulus<double>&);
extern template DoubleDouble jacobi_zeta<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                       const BasicModulus<DoubleDouble>&);
extern template DoubleDouble jacobi_zeta<DoubleDouble>(const DoubleDouble&,
                                                       const BasicModulus<DoubleDouble>&);

}  // namespace v0
}  // namespace polhode
