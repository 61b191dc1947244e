// SPDX-License-Identifier: MIT
// The Landen transformation, and other moduli led to those between 0 and 1.
#pragma once

#include <array>
#include <cmath>

#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/elliptic/detail/packs.hpp"
#include "polhode/elliptic/jacobi_values.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

namespace detail {

// u = 2 K periods + rest, |rest| <= K: the half periods of am.
template <class T>
struct HalfPeriods {
  T periods;
  T rest;
};
template <class T>
HalfPeriods<T> half_periods(const T& u, const BasicModulus<T>& mod) {
  using std::round;
  const auto on_separatrix = mod.m1() == T(0.0);
  if (all(on_separatrix)) return {T(0.0), u};
  const T whole = T(2.0) * complete_k(mod);
  const T n = round(u / whole);
  return {select(on_separatrix, T(0.0), n), select(on_separatrix, u, T(u - n * whole))};
}

// At m1 = 0.
template <class T>
Jacobi<T> jacobi_on_separatrix(const T& u) {
  using std::cosh;
  using std::tanh;
  const T sech = T(1.0) / cosh(u);
  return {tanh(u), sech, sech};
}

// The means of the transformation, and where it goes on.
template <class T>
struct LandenSteps {
  std::array<T, 16> a;
  std::array<T, 16> b;
  std::array<Mask<T>, 16> taken;
  std::size_t count = 0;
  T mean;
};
template <class T>
LandenSteps<T> landen_steps(const T& m1) {
  using std::abs;
  using std::sqrt;
  const T tolerance = sqrt(T(epsilon<T>()));
  LandenSteps<T> steps;
  T mean(1.0), other = sqrt(m1);
  Mask<T> goes_on = true;
  while (true) {  // at most 13: |ln(mean/other)| halves, then digits double
    const std::size_t i = steps.count++;
    steps.a[i] = mean;
    steps.b[i] = other;
    steps.taken[i] = goes_on;
    const T gap = mean - other;
    const T next = T(0.5) * (mean + other);
    const auto more = goes_on && abs(gap) > tolerance * mean;
    if (!any(more) || steps.count == steps.a.size()) {
      steps.mean = select(goes_on, next, mean);
      return steps;
    }
    other = select(more, T(sqrt(mean * other)), other);
    mean = select(goes_on, next, mean);
    goes_on = more;
  }
}

// A sine or cosine that rounding has carried beyond 1, as an inverse function would refuse.
template <class T>
T within_one(const T& x) {
  const T one(1.0);
  return select(one < x, one, select(x < T(-one), T(-one), x));
}

template <class T>
Jacobi<T> jacobi_of(const T& u, const BasicModulus<T>& mod) {
  using std::abs;
  using std::sqrt;
  const T zero(0.0), one(1.0);
  const auto tiny = abs(u) < T(epsilon<T>());
  if (all(tiny)) return {u, one, one};
  const auto on_separatrix = mod.m1() == zero;
  if (all(on_separatrix) && !any(tiny)) return jacobi_on_separatrix(u);
  const LandenSteps<T> steps = landen_steps(mod.m1());
  const auto [s, c] = sincos(T(steps.mean * u));
  T cot = c / s;
  T product = steps.mean * cot;
  T dn = one;
  for (std::size_t i = steps.count; i-- > 0;) {
    const auto& taken = steps.taken[i];
    const T scaled = product * cot;
    const T next_product = product * dn;
    const T next_dn = (steps.b[i] + scaled) / (steps.a[i] + scaled);
    cot = select(taken, T(next_product / steps.a[i]), cot);
    product = select(taken, next_product, product);
    dn = select(taken, next_dn, dn);
  }
  const T size = one / sqrt(product * product + one);
  const T sn = select(s < zero, T(-size), size);
  Jacobi<T> r{sn, within_one(T(product * sn)), dn};
  const auto at_zero = s == zero;
  if (any(at_zero)) r = select(at_zero, Jacobi<T>{s, c, one}, r);
  if (any(on_separatrix)) r = select(on_separatrix, jacobi_on_separatrix(u), r);
  if (any(tiny)) r = select(tiny, Jacobi<T>{u, one, one}, r);
  return r;
}

}  // namespace detail

// sn, cn, dn of u.
template <Number T>
Jacobi<T> jacobi(const T& u, const BasicModulus<T>& mod);

// am u: the angle phi with u = F(phi), continuous, odd, am(u + 2K) = am u + pi.
template <Number T>
T amplitude(const T& u, const BasicModulus<T>& mod);

namespace detail {

template <class T>
T amplitude_of(const T& u, const BasicModulus<T>& mod) {
  using std::atan2;
  const HalfPeriods<T> h = half_periods(u, mod);
  const Jacobi<T> j = jacobi_of(h.rest, mod);
  return h.periods * pi<T>() + atan2(j.sn, j.cn);
}

// The derivative of am(u, m), as a number of value 0.
template <class T, int N>
Dual<T, N> amplitude_shift(const Dual<T, N>& u, const BasicModulus<Dual<T, N>>& mod) {
  const auto base = values(mod);
  const HalfPeriods<T> h = half_periods(u.value, base);
  const Jacobi<T> j = jacobi(h.rest, base);
  T slope = j.sn * j.sn * j.sn * carlson_rd(T(j.cn * j.cn), T(1.0), T(j.dn * j.dn)) / 6.0;
  if (!(h.periods == T(0.0))) slope = slope + h.periods * complete_b(base) / base.m1();
  return Dual<T, N>::chained(T(0.0), j.dn, u, -j.dn * slope, mod.m());
}

template <class T, int N>
Dual<T, N> amplitude_of(const Dual<T, N>& u, const BasicModulus<Dual<T, N>>& mod) {
  const auto base = values(mod);
  return amplitude(u.value, base) + amplitude_shift(u, mod);
}

template <class T, int N>
Jacobi<Dual<T, N>> jacobi_of(const Dual<T, N>& u, const BasicModulus<Dual<T, N>>& mod) {
  using D = Dual<T, N>;
  const auto base = values(mod);
  const Jacobi<T> j = jacobi(u.value, base);
  const D shift = amplitude_shift(u, mod);
  // From dn^2 = 1 - m sn^2.
  const T by_amplitude = -(base.m() * j.sn * (j.cn / j.dn));
  const T by_m = -0.5 * (j.sn * (j.sn / j.dn));
  return {shift.chained(j.sn, j.cn), shift.chained(j.cn, -j.sn),
          D::chained(j.dn, by_amplitude, shift, by_m, mod.m())};
}

// The imaginary modulus, m < 0, led to mu = -m/m1 and k1 u.
template <class T>
struct ImaginaryModulus {
  T k1;
  T u;
  BasicModulus<T> mu;
};
template <class T>
ImaginaryModulus<T> imaginary_modulus(const T& u, const BasicModulus<T>& mod) {
  using std::sqrt;
  const T k1 = sqrt(mod.m1());
  return {k1, k1 * u, BasicModulus<T>::from_ratio(T(-mod.m()), T(1.0))};
}
// The reciprocal modulus, m > 1, led to 1/m and k u.
template <class T>
Jacobi<T> jacobi_of_reciprocal(const T& u, const BasicModulus<T>& mod) {
  using std::sqrt;
  const T k = sqrt(mod.m());
  const Jacobi<T> j = jacobi(T(k * u), BasicModulus<T>::from_ratio(T(1.0), T(-mod.m1())));
  return {j.sn / k, j.dn, j.cn};
}

}  // namespace detail

// Of packs, lane by lane where the modulus of one of them is below 0 or above 1.
template <Number T>
Jacobi<T> jacobi(const T& u, const BasicModulus<T>& mod) {
  const T zero(0.0);
  if constexpr (Real<T>) {
    if (mod.m() < zero) {
      const auto at = detail::imaginary_modulus(u, mod);
      const Jacobi<T> j = detail::jacobi_of(at.u, at.mu);
      return {detail::within_one(T(j.sn / j.dn / at.k1)), detail::within_one(T(j.cn / j.dn)),
              T(1.0) / j.dn};
    }
    if (mod.m1() < zero) return detail::jacobi_of_reciprocal(u, mod);
  } else if (!all(mod.m() >= zero && mod.m1() >= zero)) {
    using L = LaneTraits<T>;
    Jacobi<T> r{zero, zero, zero};
    for (std::size_t i = 0; i < L::count; ++i) {
      const auto one = jacobi(L::get(u, i), mod.lane(i));
      L::set(r.sn, i, one.sn);
      L::set(r.cn, i, one.cn);
      L::set(r.dn, i, one.dn);
    }
    return r;
  }
  return detail::jacobi_of(u, mod);
}

template <Number T>
T amplitude(const T& u, const BasicModulus<T>& mod) {
  using std::atan2;
  const T zero(0.0);
  if constexpr (Real<T>) {
    if (mod.m() < zero) {
      const auto at = detail::imaginary_modulus(u, mod);
      const auto h = detail::half_periods(at.u, at.mu);
      const Jacobi<T> j = detail::jacobi_of(h.rest, at.mu);
      return h.periods * pi<T>() + atan2(T(j.sn / at.k1), j.cn);
    }
    if (mod.m1() < zero) {
      const Jacobi<T> j = detail::jacobi_of_reciprocal(u, mod);
      return atan2(j.sn, j.cn);
    }
  } else if (!all(mod.m() >= zero && mod.m1() >= zero)) {
    return detail::each_lane_of([](const auto&... x) { return amplitude(x...); }, mod, u);
  }
  return detail::amplitude_of(u, mod);
}

// Compiled once, in the library.
extern template Jacobi<double> jacobi<double>(const double&, const BasicModulus<double>&);
extern template double amplitude<double>(const double&, const BasicModulus<double>&);
extern template Jacobi<DoubleDouble> jacobi<DoubleDouble>(const DoubleDouble&,
                                                          const BasicModulus<DoubleDouble>&);
extern template DoubleDouble amplitude<DoubleDouble>(const DoubleDouble&,
                                                     const BasicModulus<DoubleDouble>&);

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
