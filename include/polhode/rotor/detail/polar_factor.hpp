// SPDX-License-Identifier: MIT
// How an attitude factors through the invariable plane: q = A_I qz(sigma) A_J without loss at any
// J, I, by sums and products of numbers of one sign. The charts are written with it.
//
// q = qz(h) qx(I) qz(g) qx(J) qz(l) [SA (2), section 3.2]. With C, S = cos, sin of half the polar
// angle and q = a + b i, a = w + z k, b = x + y k:
//   pole 0:   A_I = (a, b) = (C, S e^h),   A_J = (C, S e^-l):  sigma = g + h + l;
//   pole pi:  A_I = (C e^h, S),            A_J = (C e^l, S):   sigma = g - h - l.
#pragma once

#include <cmath>
#include <concepts>

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A complex number: a direction in a plane, times a positive scale where one is of no interest.
template <Number T>
struct Phasor {
  T re = T(1.0);
  T im = T(0.0);

  // Of packs, lane by lane.
  friend Phasor select(const Mask<T>& mask, const Phasor& a, const Phasor& b)
    requires(!Real<T>)
  {
    return {select(mask, a.re, b.re), select(mask, a.im, b.im)};
  }
};
template <Number T>
constexpr Phasor<T> operator*(const Phasor<T>& a, const Phasor<T>& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
template <Number T>
constexpr Phasor<T> operator+(const Phasor<T>& a, const Phasor<T>& b) {
  return {a.re + b.re, a.im + b.im};
}
template <Number T>
constexpr Phasor<T> operator-(const Phasor<T>& a, const Phasor<T>& b) {
  return {a.re - b.re, a.im - b.im};
}
template <Number T>
constexpr Phasor<T> operator*(const T& s, const Phasor<T>& a) {
  return {s * a.re, s * a.im};
}
template <Number T>
constexpr Phasor<T> conj(const Phasor<T>& a) {
  return {a.re, -a.im};
}
template <Number T>
Phasor<T> phasor(const T& angle) {
  using std::cos;
  using std::sin;
  if constexpr (!Real<T> && requires { sincos(angle); }) {
    const auto both = sincos(angle);
    return {both.cos, both.sin};
  } else {
    return {cos(angle), sin(angle)};
  }
}

// Whether squares and their inverse square root are far from overflow and underflow.
template <Number T>
constexpr Mask<T> is_moderate(const T& square) {
  return T(1e-200) < square && square < T(1e200);
}

// |a|; scaled where 1e-200 or 1e200 would lose its digits.
template <Number T>
T modulus(const Phasor<T>& a) {
  using std::abs;
  using std::sqrt;
  const T square = a.re * a.re + a.im * a.im;
  // A copy: `a` by reference would be in memory, not in registers.
  const auto scaled = [re = a.re, im = a.im] {
    const T x = abs(re), y = abs(im);
    const T big = select(x < y, y, x);
    const T u = re / big, v = im / big;
    return select(big == T(0.0), T(x + y), T(big * sqrt(u * u + v * v)));  // at 0: 0, or NaN
  };
  return where(
      is_moderate(square), [&] { return T(sqrt(square)); }, scaled);
}

// Direction of a, scaled to between 1 and sqrt 2; the real axis for a = 0.
template <Number T>
Phasor<T> direction(const Phasor<T>& a) {
  using std::abs;
  const T x = abs(a.re), y = abs(a.im);
  const T big = select(x < y, y, x);
  const auto none = big == T(0.0);
  return {select(none, T(1.0), T(a.re / big)), select(none, T(0.0), T(a.im / big))};
}

// Argument in (-pi, pi]: atan2 answers -pi on the lower edge of its cut. 0 for a = 0, whatever the
// signs of its zeros.
template <Number T>
T argument(const Phasor<T>& a) {
  using std::atan2;
  const auto none = a.re == T(0.0) && a.im == T(0.0);
  T angle = atan2(a.im, a.re);
  if constexpr (std::same_as<ScalarOf<T>, double>)
    angle = select(angle == -pi<T>(), pi<T>(), angle);
  return select(none, T(0.0), angle);
}

// A quaternion as two complex numbers, q = a + b i with a = w + z k, b = x + y k: rotations about
// the third axis multiply a and b by phases.
template <Number T>
struct PhasorPair {
  Phasor<T> a;
  Phasor<T> b;
};
template <Number T>
constexpr PhasorPair<T> phasor_pair(const BasicQuaternion<T>& q) {
  return {{q.w, q.z}, {q.x, q.y}};
}
template <Number T>
constexpr BasicQuaternion<T> quaternion(const PhasorPair<T>& p) {
  return {p.a.re, p.b.re, p.b.im, p.a.im};
}
template <Number T>
constexpr PhasorPair<T> operator*(const PhasorPair<T>& p, const PhasorPair<T>& r) {
  return {p.a * r.a - p.b * conj(r.b), p.a * r.b + p.b * conj(r.a)};
}

// A_I and A_J, up to a positive factor, from m = 1 + |e3| seen from the pole and the node phasor
// e = sin(polar angle) e^h, e^l.
template <Number T>
constexpr PhasorPair<T> outer_factor(Pole pole, const T& m, const Phasor<T>& e) {
  const Phasor<T> real{m, T(0.0)};
  return pole == Pole::zero ? PhasorPair<T>{real, e} : PhasorPair<T>{e, real};
}
template <Number T>
constexpr PhasorPair<T> inner_factor(Pole pole, const T& m, const Phasor<T>& e) {
  const Phasor<T> real{m, T(0.0)};
  return pole == Pole::zero ? PhasorPair<T>{real, conj(e)} : PhasorPair<T>{e, real};
}

// e^{sigma/2} of q = A_I qz(sigma) A_J, up to a positive factor: the phasor a of A_I^-1 q A_J^-1.
template <Number T>
constexpr Phasor<T> half_sigma(const PhasorPair<T>& A_I, const PhasorPair<T>& q,
                               const PhasorPair<T>& A_J) {
  const Phasor<T> ta = conj(A_I.a) * q.a + A_I.b * conj(q.b);
  const Phasor<T> tb = conj(A_I.a) * q.b - A_I.b * conj(q.a);
  return ta * conj(A_J.a) + tb * conj(A_J.b);
}

// q/|q|. Attitudes mostly are of unit length to rounding: then no root and no quotient.
template <Number T>
BasicQuaternion<T> unit_attitude(const BasicQuaternion<T>& q) {
  using std::abs;
  const T off = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - T(1.0);
  const auto corrected = [&] {
    const T r = T(1.0) - T(0.5) * off;
    return BasicQuaternion<T>{r * q.w, r * q.x, r * q.y, r * q.z};
  };
  return where(T(abs(off)) < T(16.0 * epsilon<T>()), corrected, [&] { return normalized(q); });
}

// The invariable plane seen from both sides: unit momentum in body and inertial axes with its node
// phasors. For G = 0 the direction is the node of the body equator on the inertial plane, J = I =
// pi/2: there l, g and h hold every attitude.
template <Number T>
struct InvariablePlane {
  T G;
  BasicQuaternion<T> q;  // unit attitude
  BasicVec3<T> k_B;      // G_vec / G
  BasicVec3<T> k_I;
  Phasor<T> node_l;  // sin J e^l
  Phasor<T> node_h;  // sin I e^h
};

// A direction for the momentum 0, perpendicular to both third axes.
template <Number T>
BasicVec3<T> common_node(const BasicQuaternion<T>& q) {
  const Phasor<T> n =
      direction(Phasor<T>{T(2.0) * (q.y * q.z + q.w * q.x), T(2.0) * (q.w * q.y - q.x * q.z)});
  const T length = modulus(n);
  return {n.re / length, n.im / length, T(0.0)};
}

template <Number T>
InvariablePlane<T> invariable_plane(const BasicQuaternion<T>& q_any, const BasicVec3<T>& g) {
  using std::sqrt;
  const BasicQuaternion<T> q = unit_attitude(q_any);
  const T square = dot(g, g);
  const auto moderate = is_moderate(square);
  const T G = where(
      moderate, [&] { return T(sqrt(square)); }, [&] { return norm(g); });
  BasicVec3<T> k = where(
      moderate, [&] { return T(T(1.0) / G) * g; },
      [&] {
        return BasicVec3<T>{g.x / G, g.y / G, g.z / G};
      });
  const auto none = G == T(0.0);
  if (any(none)) k = select(none, common_node(q), k);
  BasicVec3<T> K = rotate(q, k);
  if (any(none)) K.z = select(none, T(0.0), K.z);
  return {G, q, k, K, {k.y, k.x}, {-K.y, K.x}};
}

template <Real T>
constexpr Pole nearest_pole(const T& cosine) {
  return cosine < T(0.0) ? Pole::pi : Pole::zero;
}

// The same lane by lane: whether a pole is the nearest.
template <Number T>
constexpr Mask<T> is_nearest_pole(Pole pole, const T& cosine) {
  const auto at_pi = cosine < T(0.0);
  return pole == Pole::pi ? at_pi : !at_pi;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
