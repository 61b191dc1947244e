// SPDX-License-Identifier: MIT
// What Poincare-type sets are read from and put together with.
#pragma once

#include <cmath>

#include "polhode/rotor/detail/polar_factor.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// One pair (Q, P) with the third coordinate it needs: w = sqrt(4 G - Q^2 - P^2). The three are
// 2 sqrt(G) times (sin l', cos l') sin(J/2) and cos(J/2), counted from the pole. For G = 0 they are
// (0, 0, 1): sigma is then all that the set says of the attitude.
template <Number T>
struct PoincarePair {
  T Q;
  T P;
  T w;

  // Of packs, lane by lane.
  friend PoincarePair select(const Mask<T>& mask, const PoincarePair& a, const PoincarePair& b)
    requires(!Real<T>)
  {
    return {select(mask, a.Q, b.Q), select(mask, a.P, b.P), select(mask, a.w, b.w)};
  }
};

template <Number T>
PoincarePair<T> poincare_pair(const T& Q, const T& P, const T& G) {
  using std::sqrt;
  const T zero(0.0);
  const T rest = T(4.0) * G - (Q * Q + P * P);
  const T w = sqrt(select(rest < zero, zero, rest));
  const auto none = G == zero;
  return {select(none, zero, Q), select(none, zero, P), select(none, T(1.0), w)};
}

// A pole is that of a set or, of packs, that of the set of each lane: a mask that holds where it is
// pi.
constexpr bool is_pi(Pole pole) { return pole == Pole::pi; }
template <class Mask>
constexpr const Mask& is_pi(const Mask& mask) {
  return mask;
}
template <Number T>
  requires(!Real<T>)
Mask<T> is_nearest_pole(const Mask<T>& pi, const T& cosine) {
  return pi == (cosine < T(0.0));
}

// From the unit momentum: node = sin J e^l, e3 = cos J. 1 + e3 at the far pole comes from the node.
template <Number T, class PoleOf>
PoincarePair<T> poincare_pair(const PoleOf& pole, const T& e3, const Phasor<T>& node, const T& G) {
  using std::abs;
  using std::sqrt;
  const T zero(0.0);
  const T large = sqrt(T(T(2.0) * G * (T(1.0) + T(abs(e3)))));  // 2 sqrt(G) cos of half the angle
  const T scale = (G + G) / large;                              // from sin J to 2 sqrt(G) sin
  const auto signed_Q = [&pole](const T& Q) { return select(is_pi(pole), Q, T(T(0.0) - Q)); };
  const auto near = [&] {
    return PoincarePair<T>{signed_Q(T(scale * node.im)), scale * node.re, large};
  };
  const auto far = [&] {
    const Phasor<T> d = direction(node);
    const T to_large = large / modulus(d);
    return PoincarePair<T>{signed_Q(T(to_large * d.im)), to_large * d.re, scale * modulus(node)};
  };
  const PoincarePair<T> p = where(is_nearest_pole(pole, e3), near, far);
  const auto none = G == zero;
  return {select(none, zero, p.Q), select(none, zero, p.P), select(none, T(1.0), p.w)};
}

// A_I and A_J times 2 sqrt(G).
template <Number T>
  requires(!Real<T>)
PhasorPair<T> outer_factor(const Mask<T>& pi, const T& m, const Phasor<T>& e) {
  const PhasorPair<T> at_0 = outer_factor(Pole::zero, m, e), at_pi = outer_factor(Pole::pi, m, e);
  return {select(pi, at_pi.a, at_0.a), select(pi, at_pi.b, at_0.b)};
}
template <Number T>
  requires(!Real<T>)
PhasorPair<T> inner_factor(const Mask<T>& pi, const T& m, const Phasor<T>& e) {
  const PhasorPair<T> at_0 = inner_factor(Pole::zero, m, e), at_pi = inner_factor(Pole::pi, m, e);
  return {select(pi, at_pi.a, at_0.a), select(pi, at_pi.b, at_0.b)};
}
template <Number T, class PoleOf>
PhasorPair<T> outer_factor(const PoleOf& pole, const PoincarePair<T>& p) {
  return outer_factor(pole, p.w, Phasor<T>{p.P, select(is_pi(pole), p.Q, T(-p.Q))});
}
template <Number T, class PoleOf>
PhasorPair<T> inner_factor(const PoleOf& pole, const PoincarePair<T>& p) {
  return inner_factor(pole, p.w, Phasor<T>{p.P, select(is_pi(pole), p.Q, T(-p.Q))});
}

// The coordinates, but for the argument that sigma is.
template <Number T>
struct PoincarePhasor {
  Phasor<T> sigma;
  PoincarePair<T> p1, p2;
  T G;
};
template <Number T, class PoleOf>
PoincarePhasor<T> poincare_phasor(const InvariablePlane<T>& p, const PoleOf& pole_J,
                                  const PoleOf& pole_I) {
  const PoincarePair<T> p1 = poincare_pair(pole_J, p.k_B.z, p.node_l, p.G);
  const PoincarePair<T> p2 = poincare_pair(pole_I, p.k_I.z, p.node_h, p.G);
  const Phasor<T> half =
      direction(half_sigma(outer_factor(pole_I, p2), phasor_pair(p.q), inner_factor(pole_J, p1)));
  return {half * half, p1, p2, p.G};
}

// The coordinates, in the order of BasicPoincareState.
template <class State, Number T>
State poincare_state(const InvariablePlane<T>& p, Pole pole_J, Pole pole_I) {
  const PoincarePhasor<T> s = poincare_phasor(p, pole_J, pole_I);
  return {argument(s.sigma), s.p1.Q, s.p2.Q, s.G, s.p1.P, s.p2.P, pole_J, pole_I};
}

// The hub state of e^(sigma/2) and the pairs: Q and P of the first pair as they are given.
template <Number T, class PoleOf>
BasicRotorState<T> rotor_of_poincare(const Phasor<T>& half, const PoincarePair<T>& p1,
                                     const PoincarePair<T>& p2, const Phasor<T>& given, const T& G,
                                     const PoleOf& pole_J, const PoleOf& pole_I) {
  const PhasorPair<T> z{half, Phasor<T>{T(0.0), T(0.0)}};
  const PhasorPair<T> q = outer_factor(pole_I, p2) * z * inner_factor(pole_J, p1);
  const T &P1 = given.re, &Q1 = given.im;
  const T u = T(0.5) * p1.w, r = Q1 * Q1 + P1 * P1, across = Q1 * u;
  const T L = G - T(0.5) * r;
  const auto& pi = is_pi(pole_J);
  return {normalized(quaternion(q)),
          {select(pi, across, T(-across)), P1 * u, select(pi, T(-L), L)}};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
