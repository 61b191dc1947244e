// SPDX-License-Identifier: MIT
// Jacobi's elliptic functions sn, cn, dn and the amplitude.
//
// Equations   u = F(am u), sn = sin am, cn = cos am, dn = sqrt(1 - m sn^2). Descending Landen (AGM)
//             transformation with m1 alone [Bulirsch 1965]. At m1 = 0: tanh, sech, sech.
//             Derivatives by closed rules: d am = dn (du - (dF/dm) dm), with
//             dF/dm = (s^3/6) RD(c^2, 1, dn^2) over the last part of u and (dK/dm) = B/(2 m1) over
//             each of its 2N quarter periods.
// Units       u as F; the amplitude in radians, continuous over all u.
//             m < 0: sn = sd(k1 u|mu)/k1, cn = cd, dn = nd with mu = -m/m1, k1^2 = m1
//             [DLMF 22.17.7]; m > 1: sn = sn(k u|1/m)/k, cn = dn(k u|1/m), dn = cn(k u|1/m)
//             [DLMF 22.17.2-4]; am then swings between +-asin(1/k).
// Domain      any finite u (infinite u: NaN), any modulus. dn and cn keep their relative accuracy
//             for every m1: they are quotients of positive terms, never 1 - m sn^2 or 1 - sn^2.
// Accuracy    budget elliptic_jacobi: relative to u's own rounding, eps (1 + |u|) times the slope.
// Cost        jacobi: one sincos, a root and two divisions per step, 0 to 8 steps in double. The
//             amplitude: that of jacobi and of K, and one atan2.
#pragma once

#include <cmath>
#include <limits>
#include <span>

#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/detail/math/wide_range.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/detail/packs.hpp"
#include "polhode/elliptic/jacobi_values.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/instruction_set.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

// sn, cn, dn of u  [SA (A41)-(A43)].
template <Number T>
Jacobi<T> jacobi(const T& u, const BasicModulus<T>& mod);

// am u: the angle phi with u = F(phi), continuous, odd, am(u + 2K) = am u + pi  [SA (A40)].
template <Number T>
T amplitude(const T& u, const BasicModulus<T>& mod);

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

// Jacobi's sn, cn and dn of many arguments, each with a modulus of its own or all with one, in the
// lanes of the processor.
//
// Equations   1 - m >= 0.14: theta functions of the nome's square and one ascending step of
//             Landen's [DLMF 20.2, 20.7, 22.7(i)]; below, theta functions of the complementary nome
//             and an imaginary argument [DLMF 22.6(iv)].
// Units       as of jacobi.hpp.
// Domain      any u and any pair m + m1 = 1. Lanes are for 0 <= m <= 1 - 2^-500 and |u| <= 1e6;
//             the rest goes one by one through jacobi(u, modulus). NaN in, NaN out, and NaN for an
//             infinite number, in its own place. Results may be written over the arguments.
// Accuracy    budget elliptic_jacobi_lanes: some three times that of jacobi(u, modulus), whose last
//             digit may differ; the zero of sn(-0) may be positive. The bits of a result depend on
//             its own u, m and m1 alone: not on its neighbours, on how many there are, on whether
//             the modulus is given once, or on the set of instructions.
// Errors      DomainError for spans that are not as long as u, for a set that this processor lacks,
//             and for a pair that does not add up to 1, with results in part.
// Cost        docs/design/0040-jacobi-in-lanes.md; no allocation. Half as much for one modulus.

struct JacobiSpans {
  std::span<double> sn, cn, dn;
};

// m and m1 as long as u, or both of one number.
void jacobi(std::span<const double> u, std::span<const double> m, std::span<const double> m1,
            const JacobiSpans& results, InstructionSet set = widest_instruction_set());

void jacobi(std::span<const double> u, const Modulus& modulus, const JacobiSpans& results,
            InstructionSet set = widest_instruction_set());

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode

#include "polhode/elliptic/detail/jacobi.hpp"
