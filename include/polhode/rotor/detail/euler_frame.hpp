// SPDX-License-Identifier: MIT
// What the 3-1-3 angles and their momenta are read from and put together with.
#pragma once

#include <cmath>

#include "polhode/rotor/detail/polar_factor.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// What the 3-1-3 angles of a quaternion are made of.
template <Number T>
struct EulerFrame {
  T c;  // cos(theta/2)
  T s;  // sin(theta/2)
  Phasor<T> phi;
  Phasor<T> psi;  // of length one

  // Of packs, lane by lane.
  friend EulerFrame select(const Mask<T>& mask, const EulerFrame& a, const EulerFrame& b)
    requires(!Real<T>)
  {
    return {select(mask, a.c, b.c), select(mask, a.s, b.s), select(mask, a.phi, b.phi),
            select(mask, a.psi, b.psi)};
  }
};

// transverse: the vector whose node part is kept where theta leaves the node free.
template <Number T>
EulerFrame<T> euler_frame(const BasicQuaternion<T>& q_any, const BasicVec3<T>& transverse) {
  const PhasorPair<T> q = phasor_pair(unit_attitude(q_any));
  const T c = modulus(q.a), s = modulus(q.b);
  const auto at_pole = [&] {
    const Phasor<T> d = direction(Phasor<T>{transverse.x, -transverse.y});
    const Phasor<T> psi = T(T(1.0) / modulus(d)) * d;
    const Phasor<T> at_zero = (q.a * q.a) * conj(psi), at_pi = (q.b * q.b) * psi;
    return EulerFrame<T>{c, s, select(s == T(0.0), at_zero, at_pi), psi};
  };
  const auto elsewhere = [&] {
    const auto scaled = [](const T& size, const Phasor<T>& x) {
      return where(
          is_moderate(size), [&] { return x; }, [&] { return direction(x); });
    };
    const Phasor<T> a = scaled(c, q.a), b = scaled(s, q.b), psi = a * conj(b);
    return EulerFrame<T>{c, s, a * b, T(T(1.0) / modulus(psi)) * psi};
  };
  return where(s == T(0.0) || c == T(0.0), at_pole, elsewhere);
}

// The body components of a vector with parts along (b3 x node), the node and b3.
template <Number T>
BasicVec3<T> node_to_body(const T& across, const T& along, const T& axial, const Phasor<T>& psi) {
  // 0 times an infinite part is 0: the limit along psi = 0.
  const T as = select(psi.im == T(0.0), T(0.0), T(across * psi.im));
  const T ac = select(psi.re == T(0.0), T(0.0), T(across * psi.re));
  return {as + along * psi.re, ac - along * psi.im, axial};
}

// n/d, where 0/0 stands for the part that vanishes at theta = 0 and pi.
template <Number T>
T quotient(const T& n, const T& d) {
  return select(n == T(0.0), T(0.0), T(n / d));
}

// The three angles before atan2, theta by its half, and the momenta.
template <Number T>
struct EulerPhasors {
  Phasor<T> phi, half_theta, psi;
  T Phi, Theta, Psi;
};

template <Number T>
[[gnu::always_inline]] inline EulerPhasors<T> euler_phasors(const BasicRotorState<T>& state) {
  const EulerFrame<T> f = euler_frame(state.q, state.g);
  const BasicVec3<T>& g = state.g;
  const T along = g.x * f.psi.re - g.y * f.psi.im;
  const T across = g.x * f.psi.im + g.y * f.psi.re;
  // not A stheta + Psi ctheta: near the poles Phi -+ Psi is what to_rotor needs
  const T tilt = T(2.0) * f.s * f.c * across;
  const T Phi = select(f.s < f.c, T(g.z + (tilt - T(2.0) * f.s * f.s * g.z)),
                       T((tilt + T(2.0) * f.c * f.c * g.z) - g.z));
  return {f.phi, {f.c, f.s}, f.psi, Phi, along, g.z};
}

// The state of the cosines and sines of half of all three angles, and the momenta.
template <Number T>
[[gnu::always_inline]] inline BasicRotorState<T> rotor_of_euler(const EulerPhasors<T>& e) {
  using std::abs;
  const T c = e.half_theta.re, s = e.half_theta.im;
  // not Phi - Psi ctheta: its product rounds, these differences do not where they cancel
  const auto by_difference = [&] {
    return T(quotient(T(e.Phi - e.Psi), T(T(2.0) * s * c)) + e.Psi * (s / c));
  };
  const auto by_sum = [&] {
    return T(quotient(T(e.Phi + e.Psi), T(T(2.0) * s * c)) - e.Psi * (c / s));
  };
  const T across = where(T(abs(s)) < T(abs(c)), by_difference, by_sum);
  return {quaternion(PhasorPair<T>{c * (e.phi * e.psi), s * (e.phi * conj(e.psi))}),
          node_to_body(across, e.Theta, e.Psi, e.psi * e.psi)};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
