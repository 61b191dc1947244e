// SPDX-License-Identifier: MIT
// The Jacobians of the Poincare-type sets on any Real.
#pragma once

#include "rotor/detail/chart_jacobian_kernel.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
