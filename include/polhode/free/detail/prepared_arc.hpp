// SPDX-License-Identifier: MIT
// From a primed arc to the kernel that evaluates it: prepared in one number type, rounded to
// another.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

#include "polhode/detail/free/free_kernel.hpp"
#include "polhode/free/detail/cayley_klein_coefficients.hpp"
#include "polhode/free/detail/normalized_arc.hpp"
#include "polhode/free/detail/precession.hpp"
#include "polhode/free/detail/state_at.hpp"
#include "polhode/math/dual.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Attitude of the primed axes in the mean frame at argument u, up to a positive factor.
template <Real T>
BasicQuaternion<T> primed_attitude(const PolhodeCurve<T>& c, const CayleyKleinSeries<T>& series,
                                   const T& u) {
  const T zero(0.0);
  if (!series.hyperbolic) {
    const TwoTerms<T> x{T(0.5) * pi<T>() * u / c.K, zero};
    return trigonometric_value<WideArithmetic>(series, x);
  }
  double count = 0.0;
  T r = u;
  if (!c.separatrix) {
    count = std::rint(to_double(u) / (2.0 * to_double(c.K)));
    r = u - T(2.0 * count) * c.K;
  }
  const bool odd = std::fmod(count, 2.0) != 0.0;
  const auto [p, turn] = series_value<WideArithmetic>(series, TwoTerms<T>{r, zero}, odd);
  return rotation_z(T(T(2.0) * turn)) * p;
}

// A number prepared in P as one of T.
template <class T>
struct RoundedTo {
  template <class P>
  static T of(const P& x) {
    if constexpr (std::same_as<T, P>)
      return x;
    else
      return T(to_double(x));
  }
  template <class P>
  static TwoPartPhase<T> phase(const P& x) {
    if constexpr (std::same_as<T, double>)
      return DoubleDouble(x);
    else
      return {of(x), T(0.0)};
  }
};
template <Real S, int N>
struct RoundedTo<Dual<S, N>> {
  using T = Dual<S, N>;
  template <class P>
  static T of(const Dual<P, N>& x) {
    T r(RoundedTo<S>::of(x.value));
    for (std::size_t i = 0; i < T::size; ++i) r.derivative[i] = RoundedTo<S>::of(x.derivative[i]);
    return r;
  }
  // The two parts of each number of the phase.
  template <class P>
  static TwoPartPhase<T> phase(const Dual<P, N>& x) {
    if constexpr (std::same_as<S, P>) {
      return {x, T(0.0)};
    } else {
      T hi(x.value.hi), lo(x.value.lo);
      for (std::size_t i = 0; i < T::size; ++i) {
        hi.derivative[i] = x.derivative[i].hi;
        lo.derivative[i] = x.derivative[i].lo;
      }
      return {hi, lo};
    }
  }
};

template <Number T, class P>
BasicVec3<T> rounded(const BasicVec3<P>& v) {
  using To = RoundedTo<T>;
  return {To::of(v.x), To::of(v.y), To::of(v.z)};
}
template <Number T, class P>
BasicQuaternion<T> rounded(const BasicQuaternion<P>& q) {
  using To = RoundedTo<T>;
  return {To::of(q.w), To::of(q.x), To::of(q.y), To::of(q.z)};
}

// How many terms the series needs in T. A derivative may need those that the value does not.
template <Number T>
int terms_needed(const CayleyKleinSeries<T>& s) {
  using std::abs;
  if constexpr (derivative_order<T> > 0) {
    return s.terms;
  } else {
    const T least(0x1p-6 * epsilon<T>());
    const auto negligible = [&](std::size_t i) {
      return abs(s.A[i]) + abs(s.B[i]) < least * abs(s.A[0]) &&
             abs(s.C[i]) + abs(s.D[i]) <= least * (abs(s.C[0]) + abs(s.D[0]));
    };
    int terms = s.terms;
    while (terms > 1 && negligible(static_cast<std::size_t>(terms - 1))) --terms;
    return terms;
  }
}

// The series in T, cut where the rest is below the rounding of T; beyond that there are zeros.
template <Number T, class P>
CayleyKleinSeries<T> rounded(const CayleyKleinSeries<P>& s) {
  using To = RoundedTo<T>;
  CayleyKleinSeries<T> d;
  d.hyperbolic = s.hyperbolic;
  d.terms = s.terms;
  const auto given = static_cast<std::size_t>(s.terms);
  for (std::size_t i = 0; i < given; ++i) {
    d.A[i] = To::of(s.A[i]);
    d.B[i] = To::of(s.B[i]);
    d.C[i] = To::of(s.C[i]);
    d.D[i] = To::of(s.D[i]);
  }
  d.nome = To::of(s.nome);
  d.chi_per_u = To::of(s.chi_per_u);
  d.phase_per_u = To::of(s.phase_per_u);
  d.terms = terms_needed(d);
  for (auto i = static_cast<std::size_t>(d.terms); i < given; ++i)
    d.A[i] = d.B[i] = d.C[i] = d.D[i] = T(0.0);
  if (d.terms == 1) d.nome = T(0.0);
  return d;
}

// omega constant: q(t) = q0 exp(omega (t - t0) / 2).
template <Number T, Real P>
BasicFreeKernel<T> steady_kernel(const BasicVec3<P>& moments, const BasicQuaternion<P>& q0,
                                 const BasicVec3<P>& g, const NormalizedArc<P>& arc) {
  BasicFreeKernel<T> k;
  k.steady = true;
  k.left = rounded<T>(q0);
  k.g0 = rounded<T>(g);
  const BasicVec3<P> I = scaled(moments, arc.scale.moment);
  const BasicVec3<P> w{arc.g.x / I.x, arc.g.y / I.y, arc.g.z / I.z};
  const P rate = norm(w);
  if (rate == P(0.0)) return k;
  k.axis = rounded<T>(BasicVec3<P>{w.x / rate, w.y / rate, w.z / rate});
  k.half_precession = RoundedTo<T>::phase(P(P(0.5) * rate));
  return k;
}

template <Number T, Real P>
BasicFreeKernel<T> series_kernel(const BasicQuaternion<P>& q0, const NormalizedArc<P>& arc) {
  using To = RoundedTo<T>;
  BasicFreeKernel<T> k;
  k.steady = false;
  const PolhodeCurve<P>& c = arc.curve;
  const CayleyKleinSeries<P> series = cayley_klein_series(c);
  if (series.hyperbolic) {
    k.phase0 = To::phase(arc.u0);
    k.phase_rate = To::phase(c.n);
    if (!c.separatrix) k.phase_period = To::phase(P(P(2.0) * c.K));
  } else {
    k.phase0 = To::phase(P(P(0.5) * pi<P>() * arc.u0 / c.K));
    k.phase_rate = To::phase(phase_rate(c));
    k.phase_period = whole_turn<T>();
  }
  if (k.phase_period.hi > T(0.0)) k.inverse_phase_period = T(1.0) / k.phase_period.hi;
  const BasicQuaternion<P> p = primed_attitude(c, series, arc.u0);
  const BasicQuaternion<P> right = quaternion_of<P>(arc.primed);
  k.series = rounded<T>(series);
  k.right = rounded<T>(right);
  k.left = rounded<T>(BasicQuaternion<P>(q0 * conj(right) * conj(normalized(p))));
  k.half_precession = To::phase(P(P(0.5) * precession_of_axis1(c)));
  k.to_body.set_lane(0, inverse(arc.primed));
  return k;
}

// Where the form of the arc changes at a neighbour's, its derivatives by moments and momentum are
// not those of the motion: not a number then.
template <Real P>
bool has_derivatives(const PolhodeCurve<P>& c) {
  return !c.steady && c.DC > P(0.0) && c.k2 > P(0.0) && !c.merging;
}
template <Real S, int N>
void unset_derivatives(BasicFreeKernel<Dual<S, N>>& k, const BasicVec3<Dual<S, N>>& moments,
                       const BasicVec3<Dual<S, N>>& g) {
  const S none(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t j = 0; j < Dual<S, N>::size; ++j) {
    bool moved = false;
    for (int i = 0; i < 3; ++i)
      moved = moved || !(moments[i].derivative[j] == S(0.0)) || !(g[i].derivative[j] == S(0.0));
    if (!moved) continue;
    for (Dual<S, N>* x :
         {&k.left.w, &k.left.x, &k.left.y, &k.left.z, &k.G, &k.g0.x, &k.g0.y, &k.g0.z})
      x->derivative[j] = none;
  }
}

// The kernel of normalized_arc(moments, s0.g). Moments, momentum and epoch are doubles, with
// derivatives in P.
template <Number T, Real P>
BasicFreeKernel<T> arc_kernel(const NormalizedArc<P>& arc, const BasicVec3<P>& moments,
                              const BasicRotorState<P>& s0, const T& t0) {
  using std::ldexp;
  const BasicQuaternion<P> q0 = normalized(s0.q);
  const bool has_polhode = !arc.curve.steady && arc.curve.DC > P(0.0);
  BasicFreeKernel<T> k =
      has_polhode ? series_kernel<T>(q0, arc) : steady_kernel<T>(moments, q0, s0.g, arc);
  k.epoch = t0;
  k.time_scale = T(std::ldexp(1.0, arc.scale.rate()));
  k.G = ldexp(RoundedTo<T>::of(arc.curve.G), arc.scale.momentum);
  if constexpr (derivative_order<P> > 0) {
    if (!has_derivatives(arc.curve)) unset_derivatives(k, rounded<T>(moments), rounded<T>(s0.g));
  }
  return k;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
