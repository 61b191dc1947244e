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

#include "polhode/rotor/polar_factor.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

template <Real T>
struct BasicPoincareState {
  T sigma;
  T Q1;
  T Q2;
  T G;
  T P1;
  T P2;
  Pole pole_J = Pole::zero;
  Pole pole_I = Pole::zero;

  constexpr bool operator==(const BasicPoincareState&) const = default;
};
using PoincareState = BasicPoincareState<double>;

// Checked values: finite, G >= 0, Q^2 + P^2 at most 4 G (to 4 eps) for each pair.
PoincareState poincare_state(double sigma, double Q1, double Q2, double G, double P1, double P2,
                             Pole pole_J, Pole pole_I);

namespace detail {

// One pair (Q, P) with the third coordinate it needs: w = sqrt(4 G - Q^2 - P^2). The three are
// 2 sqrt(G) times (sin l', cos l') sin(J/2) and cos(J/2), counted from the pole. For G = 0 they are
// (0, 0, 1): sigma is then all that the set says of the attitude.
template <Real T>
struct PoincarePair {
  T Q;
  T P;
  T w;
};

template <Real T>
PoincarePair<T> poincare_pair(const T& Q, const T& P, const T& G) {
  using std::sqrt;
  if (G == T(0.0)) return {T(0.0), T(0.0), T(1.0)};
  const T rest = T(4.0) * G - (Q * Q + P * P);
  return {Q, P, rest < T(0.0) ? T(0.0) : T(sqrt(rest))};
}

// From the unit momentum: node = sin J e^l, e3 = cos J. 1 + e3 at the far pole comes from the node.
template <Real T>
PoincarePair<T> poincare_pair(Pole pole, const T& e3, const Phasor<T>& node, const T& G) {
  using std::abs;
  using std::sqrt;
  if (G == T(0.0)) return {T(0.0), T(0.0), T(1.0)};
  const T large = sqrt(T(T(2.0) * G * (T(1.0) + T(abs(e3)))));  // 2 sqrt(G) cos of half the angle
  const T scale = (G + G) / large;                              // from sin J to 2 sqrt(G) sin
  const bool zero = pole == Pole::zero;
  if (nearest_pole(e3) == pole) {
    const T Q = scale * node.im;
    return {zero ? T(T(0.0) - Q) : Q, scale * node.re, large};
  }
  const Phasor<T> d = direction(node);
  const T to_large = large / modulus(d);
  const T Q = to_large * d.im;
  return {zero ? T(T(0.0) - Q) : Q, to_large * d.re, scale * modulus(node)};
}

// A_I and A_J times 2 sqrt(G).
template <Real T>
PhasorPair<T> outer_factor(Pole pole, const PoincarePair<T>& p) {
  return outer_factor(pole, p.w, Phasor<T>{p.P, pole == Pole::zero ? T(-p.Q) : p.Q});
}
template <Real T>
PhasorPair<T> inner_factor(Pole pole, const PoincarePair<T>& p) {
  return inner_factor(pole, p.w, Phasor<T>{p.P, pole == Pole::zero ? T(-p.Q) : p.Q});
}

}  // namespace detail

template <Real T>
BasicRotorState<T> to_rotor(const BasicPoincareState<T>& s) {
  using namespace detail;
  const PoincarePair<T> p1 = poincare_pair(s.Q1, s.P1, s.G), p2 = poincare_pair(s.Q2, s.P2, s.G);
  const PhasorPair<T> z{phasor(T(T(0.5) * s.sigma)), Phasor<T>{T(0.0), T(0.0)}};
  const PhasorPair<T> q = outer_factor(s.pole_I, p2) * z * inner_factor(s.pole_J, p1);
  const T u = T(0.5) * p1.w, r = s.Q1 * s.Q1 + s.P1 * s.P1;
  const bool zero = s.pole_J == Pole::zero;
  const T L = s.G - T(0.5) * r;
  return {normalized(quaternion(q)),
          {zero ? T(-(s.Q1 * u)) : T(s.Q1 * u), s.P1 * u, zero ? L : T(-L)}};
}

namespace detail {

template <Real T>
BasicPoincareState<T> poincare_state(const InvariablePlane<T>& p, Pole pole_J, Pole pole_I) {
  const PoincarePair<T> p1 = poincare_pair(pole_J, p.k_B.z, p.node_l, p.G);
  const PoincarePair<T> p2 = poincare_pair(pole_I, p.k_I.z, p.node_h, p.G);
  const Phasor<T> half =
      direction(half_sigma(outer_factor(pole_I, p2), phasor_pair(p.q), inner_factor(pole_J, p1)));
  return {argument(half * half), p1.Q, p2.Q, p.G, p1.P, p2.P, pole_J, pole_I};
}

}  // namespace detail

template <Real T = double>
BasicPoincareState<T> to_poincare(const BasicRotorState<T>& s, Pole pole_J, Pole pole_I) {
  return detail::poincare_state(detail::invariable_plane(s.q, s.g), pole_J, pole_I);
}

// The set whose poles are nearest to the state: the one that is regular there.
template <Real T = double>
BasicPoincareState<T> nearest_poincare(const BasicRotorState<T>& s) {
  const detail::InvariablePlane<T> p = detail::invariable_plane(s.q, s.g);
  return detail::poincare_state(p, detail::nearest_pole(p.k_B.z), detail::nearest_pole(p.k_I.z));
}

extern template RotorState to_rotor(const PoincareState&);
extern template PoincareState to_poincare(const RotorState&, Pole, Pole);
extern template PoincareState nearest_poincare(const RotorState&);

}  // namespace v0
}  // namespace polhode
