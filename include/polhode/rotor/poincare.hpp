// SPDX-License-Identifier: MIT
// The four Poincare-type sets (sigma, Q1, Q2, G, P1, P2): canonical, and regular where Andoyer's
// variables are not, J and I near 0 or pi.
//
// Equations   sigma = g + s_J l + s_I h, s = 1 in a set for J or I near 0, -1 near pi, and the
//             pairs Q = -s sqrt(2(G - s L)) sin l, P = sqrt(2(G - s L)) cos l (with H, h for the
//             second), evaluated without l and h:
//             J near 0:  Q1 = -g1 sqrt(2/(G+L)), P1 = g2 sqrt(2/(G+L));
//             J near pi: Q1 =  g1 sqrt(2/(G-L)), P1 = g2 sqrt(2/(G-L));
//             I near 0:  Q2 = -G1 sqrt(2/(G+H)), P2 = -G2 sqrt(2/(G+H));
//             I near pi: Q2 =  G1 sqrt(2/(G-H)), P2 = -G2 sqrt(2/(G-H)).
// Corrections none: the sets are not in the paper.
// Units       sigma in radians; G angular momentum; Q, P its square root.
// Domain      G >= 0, Q^2 + P^2 <= 4 G for each pair. sigma in (-pi, pi]. At the far pole of a pair
//             (J = pi in a set for 0, ...) Q = 0 and P = 2 sqrt(G): l = 0 or h = 0, as in Andoyer's
//             limits. G = 0: Q = P = 0 and sigma alone remains of the attitude.
// Accuracy    docs/guide/singularities.md: nothing is lost within 90 degrees of the set's poles.
// Errors      to_rotor and to_poincare never throw, NaN in, NaN out; poincare_state throws
//             DomainError.
// Cost        one sincos and three square roots forth; one atan2 and a few square roots back.
#pragma once

#include "polhode/rotor/detail/poincare_pair.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

template <Number T>
struct BasicPoincareState {
  T sigma;
  T Q1;
  T Q2;
  T G;
  T P1;
  T P2;
  Pole pole_J = Pole::zero;
  Pole pole_I = Pole::zero;

  bool operator==(const BasicPoincareState&) const
    requires Real<T>
  = default;
};
using PoincareState = BasicPoincareState<double>;

// Checked values: finite, G >= 0, Q^2 + P^2 at most 4 G (to 4 eps) for each pair.
PoincareState poincare_state(double sigma, double Q1, double Q2, double G, double P1, double P2,
                             Pole pole_J, Pole pole_I);

template <Number T>
BasicRotorState<T> to_rotor(const BasicPoincareState<T>& s) {
  using namespace detail;
  const PoincarePair<T> p1 = poincare_pair(s.Q1, s.P1, s.G), p2 = poincare_pair(s.Q2, s.P2, s.G);
  return rotor_of_poincare(phasor(T(T(0.5) * s.sigma)), p1, p2, Phasor<T>{s.P1, s.Q1}, s.G,
                           s.pole_J, s.pole_I);
}

template <Number T = double>
BasicPoincareState<T> to_poincare(const BasicRotorState<T>& s, Pole pole_J, Pole pole_I) {
  return detail::poincare_state<BasicPoincareState<T>>(detail::invariable_plane(s.q, s.g), pole_J,
                                                       pole_I);
}

// The set whose poles are nearest to the state: the one that is regular there. (A pack of states is
// in one set: to_poincare.)
template <Real T = double>
BasicPoincareState<T> nearest_poincare(const BasicRotorState<T>& s) {
  const detail::InvariablePlane<T> p = detail::invariable_plane(s.q, s.g);
  return detail::poincare_state<BasicPoincareState<T>>(p, detail::nearest_pole(p.k_B.z),
                                                       detail::nearest_pole(p.k_I.z));
}

extern template RotorState to_rotor(const PoincareState&);
extern template PoincareState to_poincare(const RotorState&, Pole, Pole);
extern template PoincareState nearest_poincare(const RotorState&);

}  // namespace v0
}  // namespace polhode
