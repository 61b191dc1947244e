// SPDX-License-Identifier: MIT
// What Andoyer's variables are read from and put together with.
#pragma once

#include <cmath>

#include "polhode/rotor/detail/polar_factor.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// p within +-G.
template <Number T>
T clamped(const T& p, const T& G) {
  return select(G < p, G, select(p < -G, T(-G), p));
}

// cos and sin of half the angle whose cosine is p/G. The differences are exact near the poles.
template <Number T>
Phasor<T> half_polar_angle(const T& p_any, const T& G) {
  using std::sqrt;
  const T p = clamped(p_any, G);
  const Phasor<T> half{sqrt(T(T(0.5) * ((G + p) / G))), sqrt(T(T(0.5) * ((G - p) / G)))};
  const auto none = G == T(0.0);
  if (!any(none)) return half;
  return select(none, Phasor<T>{sqrt(T(0.5)), sqrt(T(0.5))}, half);
}

// G e3 with the rounding of the result alone near the poles: there 1 - |e3| comes from the node.
template <Number T>
T axial_momentum(const T& G, const T& e3, const Phasor<T>& node) {
  using std::abs;
  const T size = G - G * ((node.re * node.re + node.im * node.im) / (T(1.0) + T(abs(e3))));
  return select(T(abs(e3)) < T(0.5), T(G * e3), select(e3 < T(0.0), T(-size), size));
}

// sin I sin J e^g up to a positive factor: the node j of the body equator against the node i. The
// same computed i that gives h gives g, so that g + h keeps its digits near I = 0 while h loses
// them, and so on for l and for pi.
template <Number T>
Phasor<T> andoyer_node(const InvariablePlane<T>& p) {
  Phasor<T> l = p.node_l, h = p.node_h;
  const auto moderate = is_moderate(T((l.re * l.re + l.im * l.im) * (h.re * h.re + h.im * h.im)));
  if (!all(moderate)) {
    l = select(moderate, l, direction(l));
    h = select(moderate, h, direction(h));
  }
  const BasicVec3<T> j = rotate(p.q, BasicVec3<T>{l.re, -l.im, T(0.0)});
  const BasicVec3<T>& k = p.k_I;
  return {h.re * j.x + h.im * j.y,
          k.z * (h.re * j.y - h.im * j.x) + (k.x * h.im - k.y * h.re) * j.z};
}

// The three angles of Andoyer's variables before atan2, and what goes with them.
template <Number T>
struct AndoyerPhasors {
  Phasor<T> l, g, h;
  T L, G, H;
};

template <Number T>
[[gnu::always_inline]] inline AndoyerPhasors<T> andoyer_phasors(const BasicRotorState<T>& s) {
  const InvariablePlane<T> p = invariable_plane(s.q, s.g);
  return {p.node_l, andoyer_node(p), p.node_h, s.g.z, p.G, axial_momentum(p.G, p.k_I.z, p.node_h)};
}

// The state of the cosines and sines of half of all five angles.
template <Number T>
[[gnu::always_inline]] inline BasicRotorState<T> rotor_of_phasors(
    const Phasor<T>& J, const Phasor<T>& I, const Phasor<T>& l, const Phasor<T>& g,
    const Phasor<T>& h, const T& L, const T& G) {
  const Phasor<T> a = (h * l) * (T(I.re * J.re) * g - T(I.im * J.im) * conj(g));
  const Phasor<T> b = (h * conj(l)) * (T(I.re * J.im) * g + T(I.im * J.re) * conj(g));
  const T transverse = T(2.0) * (G * J.re) * J.im;  // G sin J
  const Phasor<T> twice_l = l * l;
  return {quaternion(PhasorPair<T>{a, b}),
          {transverse * twice_l.im, transverse * twice_l.re, clamped(L, G)}};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
