// SPDX-License-Identifier: MIT
// The chart Jacobians B = d(dtheta_B, dg_B)/d(chart) on any Real: columns in closed form, and their
// entries next to a pole.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "polhode/math/double_double.hpp"
#include "polhode/math/vector.hpp"
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

// What the entries of a chart are divided by at its poles: two sines, or the w of two pairs. Next
// to a pole the quotients and the terms without one are apart by more than any number type holds,
// and are computed one at a time: an infinite divisor leaves its quotients out, not whole leaves
// out the rest.
template <Real T>
struct PoleDivisors {
  T J;
  T I;
  bool whole = true;

  BasicVec3<T> kept(const BasicVec3<T>& v) const { return whole ? v : BasicVec3<T>{}; }
};

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

// [SA "dr2"]: s3 dh + i dI + k dg + j dJ + b3 dl, dJ = (cJ dG - dL)/(G sJ), dI = (cI dG - dH)/(G
// sI)
template <Real T>
BasicMatrix6<T> chart_jacobian(const AndoyerAxes<T>& a, const PoleDivisors<T>& by) {
  const T sJ = by.J, cJ = a.J.re, zero(0.0);
  const BasicVec3<T> across{a.l.im, a.l.re, zero};  // direction of the transverse momentum
  const BasicVec3<T> j{a.l.re, -a.l.im, zero}, b3{zero, zero, T(1.0)}, none{};
  const BasicVec3<T> j_per_L = divided(j, T(a.G * sJ)), i_per_H = divided(a.i, T(a.G * by.I));
  BasicMatrix6<T> B;
  set_column(B, 0, by.kept(b3), by.kept({a.g.y, -a.g.x, zero}));
  set_column(B, 1, by.kept(divided(a.g, a.G)), none);
  set_column(B, 2, by.kept(a.s3), none);
  set_column(B, 3, -j_per_L, divided(-cJ * across, sJ) + by.kept(b3));
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

// [SA "dr1"]: s3 dphi + node dtheta + b3 dpsi; momenta of [SA (25)-(27)]. The one divisor is in the
// place of J.
template <Real T>
BasicMatrix6<T> chart_jacobian(const EulerAxes<T>& e, const PoleDivisors<T>& by) {
  const T zero(0.0);
  const BasicVec3<T> m{e.psi.im, e.psi.re, zero}, n{e.psi.re, -e.psi.im, zero};
  const BasicVec3<T> b3{zero, zero, T(1.0)}, none{};
  const T across = dot(e.g, m), axial = by.whole ? e.g.z : zero;
  BasicMatrix6<T> B;
  set_column(B, 0, by.kept(e.s * m + e.c * b3), none);
  set_column(B, 1, by.kept(n), T(axial - quotient(T(across * e.c), by.J)) * m);
  set_column(B, 2, by.kept(b3), by.kept({e.g.y, -e.g.x, zero}));
  set_column(B, 3, none, divided(m, by.J));
  set_column(B, 4, none, by.kept(n));
  set_column(B, 5, none, divided(-e.c * m, by.J) + by.kept(b3));
  return B;
}

// B with the change of momentum in inertial axes, seen in body axes, theta x g + dg, in place of
// dg.
template <Real T>
BasicMatrix6<T> inertial_columns(const BasicMatrix6<T>& B, const BasicVec3<T>& g_B) {
  BasicMatrix6<T> m;
  for (int j = 0; j < 6; ++j) {
    const BasicVec3<T> theta{B(0, j), B(1, j), B(2, j)}, g{B(3, j), B(4, j), B(5, j)};
    set_column(m, j, theta, cross(theta, g_B) + g);
  }
  return m;
}

// The same without the differences that cancel next to J = 0, pi: those in the columns of the plane
// that the body has about its momentum, which leave the momentum in space as it is, and of G, whose
// change in space is given.
template <Real T>
BasicMatrix6<T> inertial_columns(const BasicMatrix6<T>& B, const BasicVec3<T>& g_B,
                                 const std::array<int, 3>& in_body, int G_column,
                                 const BasicVec3<T>& by_G) {
  BasicMatrix6<T> m = inertial_columns(B, g_B);
  for (int i = 0; i < 3; ++i) {
    for (const int j : in_body) m(i + 3, j) = T(0.0);
    m(i + 3, G_column) = by_G[i];
  }
  return m;
}
template <Real T>
BasicMatrix6<T> inertial_columns(const AndoyerAxes<T>& a, const PoleDivisors<T>& by) {
  // by G alone the momentum grows in the inertial plane
  return inertial_columns(chart_jacobian(a, by), a.g, {0, 1, 3}, 4,
                          divided(cross(a.i, a.s3), by.I));
}

// B^-1 = Jc B^T Pi^-1: a column of B, times Pi^-1 from the right, is (theta x g + dg, -theta).
template <Real T>
BasicMatrix6<T> inverse_of_columns(const BasicMatrix6<T>& inertial) {
  BasicMatrix6<T> inverse;
  for (int j = 0; j < 6; ++j) {
    const int row = j < 3 ? j + 3 : j - 3;
    for (int i = 0; i < 3; ++i) {
      const T theta = inertial(i, j), left = inertial(i + 3, j);
      inverse(row, i) = j < 3 ? T(-left) : left;
      inverse(row, i + 3) = j < 3 ? theta : T(-theta);
    }
  }
  return inverse;
}
template <Real T>
BasicMatrix6<T> inverse_chart_jacobian(const BasicMatrix6<T>& B, const BasicVec3<T>& g_B) {
  return inverse_of_columns(inertial_columns(B, g_B));
}

// Of the Poincare-type sets: q = A_I qz(sigma) A_J, each outer factor a polynomial in its pair.
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

// Of one pair, times 2 sqrt(G) and up to its order in the factors: the derivatives by Q, P, G of
// the coordinates; w = sqrt(4 G - Q^2 - P^2).
template <Real T>
struct PairDerivatives {
  PoincarePair<T> by_Q;
  PoincarePair<T> by_P;
  PoincarePair<T> by_G;
};
template <Real T>
PairDerivatives<T> pair_derivatives(const PoincarePair<T>& p, const T& w, bool whole) {
  const T zero(0.0), one(whole ? 1.0 : 0.0);
  return {{one, zero, -p.Q / w}, {zero, one, -p.P / w}, {zero, zero, T(2.0) / w}};
}

// The derivatives of the momentum of a pair, (-s Q w/2, P w/2, s (G - (Q^2 + P^2)/2)), s = -1 in a
// set for pi: J in body axes, I in inertial ones with y reversed.
template <Real T>
struct PairMomenta {
  BasicVec3<T> by_Q;
  BasicVec3<T> by_P;
  BasicVec3<T> by_G;
};
template <Real T>
PairMomenta<T> pair_momenta(Pole pole, const PoincarePair<T>& p, const T& w, bool whole) {
  const auto kept = [whole](const T& x) { return whole ? x : T(0.0); };
  const T sign = pole == Pole::zero ? T(1.0) : T(-1.0);
  const T half_w = kept(T(0.5) * p.w), Q = p.Q, P = p.P, w2 = T(2.0) * w;
  return {{-sign * (half_w - Q * Q / w2), -(P * Q / w2), kept(T(-sign * Q))},
          {sign * (Q * P / w2), half_w - P * P / w2, kept(T(-sign * P))},
          {-sign * (Q / w), P / w, kept(sign)}};
}

template <Real T>
BasicMatrix6<T> chart_jacobian(const PoincareFactors<T>& f, const PoleDivisors<T>& by) {
  const T zero(0.0);
  const PairDerivatives<T> d1 = pair_derivatives(f.p1, by.J, by.whole);
  const PairDerivatives<T> d2 = pair_derivatives(f.p2, by.I, by.whole);
  const auto inner = [&](const PoincarePair<T>& p) { return inner_factor(f.pole_J, p); };
  const auto outer = [&](const PoincarePair<T>& p) { return outer_factor(f.pole_I, p); };
  const FactorTurns<T> J =
      factor_turns(inner(f.p1), inner(d1.by_Q), inner(d1.by_P), inner(d1.by_G), f.G);
  const FactorTurns<T> I =
      factor_turns(outer(f.p2), outer(d2.by_Q), outer(d2.by_P), outer(d2.by_G), f.G);
  // A_I turns before qz(sigma) A_J: its vectors are seen through them
  const BasicQuaternion<T> after =
      normalized(quaternion(PhasorPair<T>{f.half, {zero, zero}} * inner(f.p1)));
  const auto seen = [&after](const BasicVec3<T>& v) { return rotate(conj(after), v); };
  const PairMomenta<T> g = pair_momenta(f.pole_J, f.p1, by.J, by.whole);
  BasicMatrix6<T> B;
  set_column(B, 0, by.kept(divided(f.g, f.G)), {});
  set_column(B, 1, J.Q, g.by_Q);
  set_column(B, 2, seen(I.Q), {});
  set_column(B, 3, J.G + seen(I.G), g.by_G);
  set_column(B, 4, J.P, g.by_P);
  set_column(B, 5, seen(I.P), {});
  return B;
}

template <Real T>
BasicMatrix6<T> inertial_columns(const PoincareFactors<T>& f, const PoleDivisors<T>& by) {
  const PhasorPair<T> turned{f.half, {T(0.0), T(0.0)}};
  const BasicQuaternion<T> q =
      normalized(quaternion(outer_factor(f.pole_I, f.p2) * turned * inner_factor(f.pole_J, f.p1)));
  const BasicVec3<T> v = pair_momenta(f.pole_I, f.p2, by.I, by.whole).by_G;
  return inertial_columns(chart_jacobian(f, by), f.g, {0, 1, 4}, 3,
                          rotate(conj(q), BasicVec3<T>{v.x, -v.y, v.z}));
}

// Powers of two that bring a divisor next to a pole to [1, 2); 0 farther off and exactly at it.
inline int pole_exponent(const DoubleDouble& divisor) {
  const double size = std::abs(divisor.hi);
  return size > 0.0 && size < 0x1p-300 ? -std::ilogb(size) : 0;
}

// m += terms 2^exponent; opposite infinities, at J and I both at a pole, leave that of m.
inline void add_terms(BasicMatrix6<DoubleDouble>& m, const BasicMatrix6<DoubleDouble>& terms,
                      int exponent) {
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const DoubleDouble term = ldexp(terms(i, j), exponent), sum = m(i, j) + term;
      if (!isnan(sum) || isnan(term)) m(i, j) = sum;
    }
}

// columns(PoleDivisors) where it divides by J and I, one term at a time if need be: within 2^-300
// of a pole the terms that are divided by the small number are added by themselves, in units in
// which double-double holds them.
template <class Columns>
BasicMatrix6<DoubleDouble> sum_of_terms(const DoubleDouble& J, const DoubleDouble& I,
                                        const Columns& columns) {
  using Divisors = PoleDivisors<DoubleDouble>;
  const DoubleDouble none = std::numeric_limits<double>::infinity();
  const int near_J = pole_exponent(J), near_I = pole_exponent(I);
  BasicMatrix6<DoubleDouble> m =
      columns(Divisors{near_J == 0 ? J : none, near_I == 0 ? I : none, true});
  if (near_J != 0) add_terms(m, columns(Divisors{ldexp(J, near_J), none, false}), near_J);
  if (near_I != 0) add_terms(m, columns(Divisors{none, ldexp(I, near_I), false}), near_I);
  return m;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
