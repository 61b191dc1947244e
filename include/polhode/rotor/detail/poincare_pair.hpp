// SPDX-License-Identifier: MIT
// What Poincare-type sets are read from and put together with.
#pragma once

#include <cmath>

#include "polhode/rotor/detail/polar_factor.hpp"

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

// From the unit momentum: node = sin J e^l, e3 = cos J. 1 + e3 at the far pole comes from the node.
template <Number T>
PoincarePair<T> poincare_pair(Pole pole, const T& e3, const Phasor<T>& node, const T& G) {
  using std::abs;
  using std::sqrt;
  const T zero(0.0);
  const T large = sqrt(T(T(2.0) * G * (T(1.0) + T(abs(e3)))));  // 2 sqrt(G) cos of half the angle
  const T scale = (G + G) / large;                              // from sin J to 2 sqrt(G) sin
  const auto signed_Q = [pole](const T& Q) { return pole == Pole::zero ? T(T(0.0) - Q) : Q; };
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
PhasorPair<T> outer_factor(Pole pole, const PoincarePair<T>& p) {
  return outer_factor(pole, p.w, Phasor<T>{p.P, pole == Pole::zero ? T(-p.Q) : p.Q});
}
template <Number T>
PhasorPair<T> inner_factor(Pole pole, const PoincarePair<T>& p) {
  return inner_factor(pole, p.w, Phasor<T>{p.P, pole == Pole::zero ? T(-p.Q) : p.Q});
}

// The coordinates, in the order of BasicPoincareState.
template <class State, Number T>
State poincare_state(const InvariablePlane<T>& p, Pole pole_J, Pole pole_I) {
  const PoincarePair<T> p1 = poincare_pair(pole_J, p.k_B.z, p.node_l, p.G);
  const PoincarePair<T> p2 = poincare_pair(pole_I, p.k_I.z, p.node_h, p.G);
  const Phasor<T> half =
      direction(half_sigma(outer_factor(pole_I, p2), phasor_pair(p.q), inner_factor(pole_J, p1)));
  return {argument(half * half), p1.Q, p2.Q, p.G, p1.P, p2.P, pole_J, pole_I};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
