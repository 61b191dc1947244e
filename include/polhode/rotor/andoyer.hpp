// SPDX-License-Identifier: MIT
// Andoyer variables (l, g, h, L, G, H): canonical, body-free; the angular momentum and the plane
// that it stands on.
//
// Equations   R = R3(l) R1(J) R3(g) R1(I) R3(h), cos I = H/G, cos J = L/G [SA "Rnew", (84)];
//             g_B = (G sJ sl, G sJ cl, L) [SA (1490)-(1492)]. l = atan2(g1, g2),
//             h = atan2(G1, -G2); g is what remains of q between the two.
// Corrections none needed here; [SA (79)] and the equation for Theta after (80) are misprinted.
// Units       angles in radians; L, G, H in those of the angular momentum.
// Domain      G >= 0, |L| <= G, |H| <= G. Angles returned are in (-pi, pi].
//             J = 0: l = 0 and g + l is in g; J = pi: l = 0 and g - l is in g.
//             I = 0: h = 0 and g + h is in g; I = pi: h = 0 and g - h is in g.
//             G = 0: L = H = 0, read as J = I = pi/2 (their limit), so that l, g, h hold the
//             attitude: nothing is lost.
//             |L|, |H| beyond G are taken as G; andoyer_state checks them.
// Accuracy    docs/guide/singularities.md. What L and G cannot hold is lost: near J = 0, pi the
//             transverse momentum keeps an error of at most sqrt(2 eps) G; the same for I. The
//             sum g +- l +- h that is regular at the nearest poles loses nothing.
// Errors      to_rotor and to_andoyer never throw, NaN in, NaN out; andoyer_state throws
//             DomainError.
// Cost        three sincos forth; three atan2 back.
#pragma once

#include "polhode/rotor/detail/andoyer_angles.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

template <Number T>
struct BasicAndoyerState {
  T l;
  T g;
  T h;
  T L;
  T G;
  T H;

  bool operator==(const BasicAndoyerState&) const
    requires Real<T>
  = default;
};
using AndoyerState = BasicAndoyerState<double>;

// Checked values: finite, G >= 0, |L| and |H| at most G (an excess of 4 eps is rounded away)
// [SA "constraint"].
AndoyerState andoyer_state(double l, double g, double h, double L, double G, double H);

// The product of five rotations [SA "Rnew", "v1", "v2", "v3"], and the momentum
// [SA (32), (1490)-(1492)].
template <Number T>
BasicRotorState<T> to_rotor(const BasicAndoyerState<T>& s) {
  using detail::Phasor;
  const Phasor<T> J = detail::half_polar_angle(s.L, s.G);
  const Phasor<T> I = detail::half_polar_angle(s.H, s.G);
  const Phasor<T> l = detail::phasor(T(T(0.5) * s.l));
  const Phasor<T> g = detail::phasor(T(T(0.5) * s.g));
  const Phasor<T> h = detail::phasor(T(T(0.5) * s.h));
  return detail::rotor_of_phasors(J, I, l, g, h, s.L, s.G);
}

// [SA "Rnew", (84), (128), (1490)-(1492)]; with to_euler, sides and angles of the triangle between
// the three nodes [SA (78)-(80), (A1), (A9), (A44)-(A46)].
template <Number T = double>
BasicAndoyerState<T> to_andoyer(const BasicRotorState<T>& s) {
  const detail::AndoyerPhasors<T> p = detail::andoyer_phasors(s);
  return {detail::argument(p.l), detail::argument(p.g), detail::argument(p.h), p.L, p.G, p.H};
}

extern template RotorState to_rotor(const AndoyerState&);
extern template AndoyerState to_andoyer(const RotorState&);

}  // namespace v0
}  // namespace polhode
