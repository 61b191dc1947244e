// SPDX-License-Identifier: MIT
// The chart Jacobians B = d(dtheta_B, dg_B)/d(chart) on any Real: columns in closed form.
#pragma once

#include "polhode/math/matrix6.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A column of B: the change of attitude (body axes) and of body momentum with one coordinate.
template <Real T>
void set_column(BasicMatrix6<T>& B, int j, const BasicVec3<T>& theta, const BasicVec3<T>& g) {
  for (int i = 0; i < 3; ++i) {
    B(i, j) = theta[i];
    B(i + 3, j) = g[i];
  }
}

// v/s, where a component 0 stays 0 when s = 0.
template <Real T>
BasicVec3<T> divided(const BasicVec3<T>& v, const T& s) {
  return {quotient(v.x, s), quotient(v.y, s), quotient(v.z, s)};
}

// a + b, where opposite infinities, at J and I both at a pole, leave that of a.
template <Real T>
BasicVec3<T> combined(const BasicVec3<T>& a, const BasicVec3<T>& b) {
  const auto is_number = [](const T& x) { return x < T(0.0) || T(0.0) < x || x == T(0.0); };
  const auto sum = [&](const T& x, const T& y) {
    const T s = x + y;
    return !is_number(s) && is_number(x) && is_number(y) ? x : s;
  };
  return {sum(a.x, b.x), sum(a.y, b.y), sum(a.z, b.z)};
}

template <Real T>
Phasor<T> unit_direction(const Phasor<T>& a) {
  const Phasor<T> d = direction(a);
  const T n = modulus(d);
  return {d.re / n, d.im / n};
}

// The axes of the Andoyer angles in body components, and their inclinations.
template <Real T>
struct AndoyerAxes {
  T G;
  BasicVec3<T> g;
  Phasor<T> J;  // (cos J, sin J)
  Phasor<T> I;
  Phasor<T> l;      // (cos l, sin l)
  BasicVec3<T> i;   // node of the invariable plane on the inertial plane
  BasicVec3<T> s3;  // third inertial axis
};

template <Real T>
AndoyerAxes<T> andoyer_axes(const BasicRotorState<T>& s) {
  const InvariablePlane<T> p = invariable_plane(s.q, s.g);
  const Phasor<T> h = unit_direction(p.node_h);
  return {p.G,
          s.g,
          {p.k_B.z, modulus(p.node_l)},
          {p.k_I.z, modulus(p.node_h)},
          unit_direction(p.node_l),
          rotate(conj(p.q), BasicVec3<T>{h.re, h.im, T(0.0)}),
          rotation_matrix(p.q).row[2]};
}

template <Real T>
AndoyerAxes<T> andoyer_axes(const BasicAndoyerState<T>& s) {
  const auto inclination = [&s](const T& p) {
    const Phasor<T> half = half_polar_angle(p, s.G);
    return Phasor<T>{(half.re - half.im) * (half.re + half.im), T(2.0) * half.re * half.im};
  };
  const Phasor<T> J = inclination(s.L), I = inclination(s.H);
  const Phasor<T> l = phasor(s.l), g = phasor(s.g);
  // R3(l) R1(J) v
  const auto in_body = [&J, &l](const BasicVec3<T>& v) {
    const T y = J.re * v.y + J.im * v.z;
    return BasicVec3<T>{l.re * v.x + l.im * y, l.re * y - l.im * v.x, J.re * v.z - J.im * v.y};
  };
  return {s.G,
          to_rotor(s).g,
          J,
          I,
          l,
          in_body({g.re, -g.im, T(0.0)}),
          in_body({I.im * g.im, I.im * g.re, I.re})};
}

// [SA (dr1)]: s3 dh + i dI + k dg + j dJ + b3 dl, dJ = (cJ dG - dL)/(G sJ), dI = (cI dG - dH)/(G
// sI)
template <Real T>
BasicMatrix6<T> chart_jacobian(const AndoyerAxes<T>& a) {
  const T sJ = a.J.im, cJ = a.J.re, zero(0.0);
  const BasicVec3<T> across{a.l.im, a.l.re, zero};  // direction of the transverse momentum
  const BasicVec3<T> j{a.l.re, -a.l.im, zero}, b3{zero, zero, T(1.0)}, none{};
  const BasicVec3<T> j_per_L = divided(j, T(a.G * sJ)), i_per_H = divided(a.i, T(a.G * a.I.im));
  BasicMatrix6<T> B;
  set_column(B, 0, b3, {a.g.y, -a.g.x, zero});
  set_column(B, 1, divided(a.g, a.G), none);
  set_column(B, 2, a.s3, none);
  set_column(B, 3, -j_per_L, divided(-cJ * across, sJ) + b3);
  set_column(B, 4, combined(cJ * j_per_L, a.I.re * i_per_H), divided(across, sJ));
  set_column(B, 5, -i_per_H, none);
  return B;
}

template <Real T>
struct EulerAxes {
  T s;  // sin theta
  T c;
  Phasor<T> psi;
  BasicVec3<T> g;
};

template <Real T>
EulerAxes<T> euler_axes(const BasicRotorState<T>& s) {
  const EulerFrame<T> f = euler_frame(s.q, s.g);
  return {T(2.0) * f.s * f.c, (f.c - f.s) * (f.c + f.s), f.psi, s.g};
}

template <Real T>
EulerAxes<T> euler_axes(const BasicEulerState<T>& s) {
  const Phasor<T> half = phasor(T(T(0.5) * s.theta));
  return {T(2.0) * half.re * half.im, (half.re - half.im) * (half.re + half.im), phasor(s.psi),
          to_rotor(s).g};
}

// s3 dphi + node dtheta + b3 dpsi; momenta of [SA (25)-(27)]
template <Real T>
BasicMatrix6<T> chart_jacobian(const EulerAxes<T>& e) {
  const T zero(0.0);
  const BasicVec3<T> m{e.psi.im, e.psi.re, zero}, n{e.psi.re, -e.psi.im, zero};
  const BasicVec3<T> b3{zero, zero, T(1.0)}, none{};
  const T across = dot(e.g, m);
  BasicMatrix6<T> B;
  set_column(B, 0, e.s * m + e.c * b3, none);
  set_column(B, 1, n, T(e.g.z - quotient(T(across * e.c), e.s)) * m);
  set_column(B, 2, b3, {e.g.y, -e.g.x, zero});
  set_column(B, 3, none, divided(m, e.s));
  set_column(B, 4, none, n);
  set_column(B, 5, none, divided(-e.c * m, e.s) + b3);
  return B;
}

// q = A_I qz(sigma) A_J, each outer factor a polynomial in its pair.
template <Real T>
struct PoincareFactors {
  T G;
  PoincarePair<T> p1;
  PoincarePair<T> p2;
  Pole pole_J;
  Pole pole_I;
  Phasor<T> half;  // e^{sigma/2}
  BasicVec3<T> g;
};

template <Real T>
PoincareFactors<T> poincare_factors(const BasicRotorState<T>& s, Pole pole_J, Pole pole_I) {
  const InvariablePlane<T> p = invariable_plane(s.q, s.g);
  const PoincarePair<T> p1 = poincare_pair(pole_J, p.k_B.z, p.node_l, p.G);
  const PoincarePair<T> p2 = poincare_pair(pole_I, p.k_I.z, p.node_h, p.G);
  const Phasor<T> half =
      half_sigma(outer_factor(pole_I, p2), phasor_pair(p.q), inner_factor(pole_J, p1));
  return {p.G, p1, p2, pole_J, pole_I, unit_direction(half), s.g};
}

template <Real T>
PoincareFactors<T> poincare_factors(const BasicPoincareState<T>& s) {
  return {s.G,
          poincare_pair(s.Q1, s.P1, s.G),
          poincare_pair(s.Q2, s.P2, s.G),
          s.pole_J,
          s.pole_I,
          phasor(T(T(0.5) * s.sigma)),
          to_rotor(s).g};
}

// The rotation vectors of A^-1 dA for a factor A(Q, P, G), in the axes after A.
template <Real T>
struct FactorTurns {
  BasicVec3<T> Q;
  BasicVec3<T> P;
  BasicVec3<T> G;
};

template <Real T>
FactorTurns<T> factor_turns(const PhasorPair<T>& a, const PhasorPair<T>& dQ,
                            const PhasorPair<T>& dP, const PhasorPair<T>& dG, const T& G) {
  // |a|^2 = 4 G
  const auto turn = [&](const PhasorPair<T>& d) {
    const BasicQuaternion<T> p = conj(quaternion(a)) * quaternion(d);
    return T(T(0.5) / G) * BasicVec3<T>{p.x, p.y, p.z};
  };
  return {turn(dQ), turn(dP), turn(dG)};
}

template <Real T>
BasicMatrix6<T> chart_jacobian(const PoincareFactors<T>& f) {
  const T zero(0.0), one(1.0), two(2.0);
  const PoincarePair<T>&p1 = f.p1, &p2 = f.p2;
  // derivatives of (Q, P, w) by Q, P, G; w = sqrt(4 G - Q^2 - P^2)
  const auto by_Q = [&](const PoincarePair<T>& p) {
    return PoincarePair<T>{one, zero, -p.Q / p.w};
  };
  const auto by_P = [&](const PoincarePair<T>& p) {
    return PoincarePair<T>{zero, one, -p.P / p.w};
  };
  const auto by_G = [&](const PoincarePair<T>& p) {
    return PoincarePair<T>{zero, zero, two / p.w};
  };
  const auto inner = [&](const PoincarePair<T>& p) { return inner_factor(f.pole_J, p); };
  const auto outer = [&](const PoincarePair<T>& p) { return outer_factor(f.pole_I, p); };
  const FactorTurns<T> J =
      factor_turns(inner(p1), inner(by_Q(p1)), inner(by_P(p1)), inner(by_G(p1)), f.G);
  const FactorTurns<T> I =
      factor_turns(outer(p2), outer(by_Q(p2)), outer(by_P(p2)), outer(by_G(p2)), f.G);
  // A_I turns before qz(sigma) A_J: its vectors are seen through them
  const BasicQuaternion<T> after =
      normalized(quaternion(PhasorPair<T>{f.half, {zero, zero}} * inner(p1)));
  const auto seen = [&after](const BasicVec3<T>& v) { return rotate(conj(after), v); };
  // g = (-+Q w/2, P w/2, +-(G - (Q^2 + P^2)/2))
  const T sign = f.pole_J == Pole::zero ? one : T(-one);
  const T half_w = T(0.5) * p1.w, Q = p1.Q, P = p1.P, w2 = two * p1.w;
  BasicMatrix6<T> B;
  set_column(B, 0, divided(f.g, f.G), {});
  set_column(B, 1, J.Q, {-sign * (half_w - Q * Q / w2), -(P * Q / w2), -sign * Q});
  set_column(B, 2, seen(I.Q), {});
  set_column(B, 3, J.G + seen(I.G), {-sign * (Q / p1.w), P / p1.w, sign});
  set_column(B, 4, J.P, {sign * (Q * P / w2), half_w - P * P / w2, -sign * P});
  set_column(B, 5, seen(I.P), {});
  return B;
}

// B^-1 = Jc B^T Pi^-1: column j of B, times Pi^-1 from the right, is (theta x g + dg, -theta).
template <Real T>
BasicMatrix6<T> inverse_chart_jacobian(const BasicMatrix6<T>& B, const BasicVec3<T>& g_B) {
  BasicMatrix6<T> inverse;
  for (int j = 0; j < 6; ++j) {
    const BasicVec3<T> theta{B(0, j), B(1, j), B(2, j)}, g{B(3, j), B(4, j), B(5, j)};
    const BasicVec3<T> left = cross(theta, g_B) + g;
    const int row = j < 3 ? j + 3 : j - 3;
    for (int i = 0; i < 3; ++i) {
      inverse(row, i) = j < 3 ? T(-left[i]) : left[i];
      inverse(row, i + 3) = j < 3 ? theta[i] : T(-theta[i]);
    }
  }
  return inverse;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
