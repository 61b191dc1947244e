// SPDX-License-Identifier: MIT
// sn, cn, dn and the third-kind integral of Euler's flow, as functions of the squared rates mu =
// n^2 and nu = k^2 n^2: by series, doublings, and whole half periods that are taken off first.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "polhode/elliptic/agm.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// What decisions are made of: the nearest double of a scalar, the numbers themselves of a pack.
template <Number T>
using DecisionOf = std::conditional_t<Real<T>, double, T>;
template <Number T>
DecisionOf<T> decision_of(const T& x) {
  if constexpr (Real<T>) {
    return to_double(x);
  } else {
    return x;
  }
}

// S' = C D, C' = -mu S D, D' = -nu S C, w' = epsilon S^2 / (1 + epsilon S^2), angle = weight w.
template <Number T>
struct FlowParameters {
  T mu, nu, delta;    // delta = mu - nu, known without subtraction
  T epsilon, weight;  // the third-kind integral that the precession needs
};

template <Number T>
struct FlowFunctions {
  T S, C, D, angle;
  T whole = T(0.0);  // the angle of the half periods that were taken off the time

  // Of packs, lane by lane.
  friend FlowFunctions select(const Mask<T>& mask, const FlowFunctions& a, const FlowFunctions& b)
    requires(!Real<T>)
  {
    return {select(mask, a.S, b.S), select(mask, a.C, b.C), select(mask, a.D, b.D),
            select(mask, a.angle, b.angle), select(mask, a.whole, b.whole)};
  }
};

template <Number T, std::size_t terms>
T convolution(const std::array<T, terms>& a, const std::array<T, terms>& b, std::size_t k) {
  T s = a[0] * b[k];
  for (std::size_t i = 1; i <= k; ++i) s = s + a[i] * b[k - i];  // <= 8 trips
  return s;
}

// Taylor series of the four functions: S and angle are odd, C and D even; the powers of h are
// inside the coefficients.
template <std::size_t terms, Number T, class H>
FlowFunctions<T> flow_by_series(const FlowParameters<T>& p, const H& h) {
  std::array<T, terms> S{}, C{}, D{}, f{}, w_dot{};
  C[0] = D[0] = T(1.0);
  const H h2 = h * h;
  const T mu = p.mu * h2, nu = p.nu * h2, epsilon = p.epsilon * h2;
  for (std::size_t k = 0; k < terms; ++k) {
    const double odd = 2.0 * static_cast<double>(k) + 1.0;
    S[k] = convolution(C, D, k) * H(H(1.0) / H(odd));
    if (k + 1 == terms) break;
    const H next = H(1.0) / H(odd + 1.0);
    C[k + 1] = -(mu * (convolution(S, D, k) * next));
    D[k + 1] = -(nu * (convolution(S, C, k) * next));
    f[k + 1] = epsilon * convolution(S, S, k);
    w_dot[k + 1] = f[k + 1] - convolution(w_dot, f, k + 1);  // (1 + f) w' = f, w_dot[k + 1] = 0
  }
  FlowFunctions<T> v{S[terms - 1], C[terms - 1], D[terms - 1], T(0.0)};
  for (std::size_t k = terms - 1; k-- > 0;) {
    v.S = v.S + S[k];
    v.C = v.C + C[k];
    v.D = v.D + D[k];
    v.angle = v.angle + w_dot[k + 1] * H(H(1.0) / H(2.0 * static_cast<double>(k) + 3.0));
  }
  v.S = v.S * h;
  v.angle = p.weight * (v.angle * h);
  return v;
}

// From h to 2h. The denominators 1 - mu nu S^4 and the numerators are written as sums that do not
// cancel next to the separatrix.
template <Number T>
FlowFunctions<T> doubled(const FlowParameters<T>& p, const FlowFunctions<T>& v) {
  using std::atan2;
  const T S2 = v.S * v.S, C2 = v.C * v.C, D2 = v.D * v.D;
  const T inverse = T(1.0) / (C2 + p.mu * S2 * D2);
  FlowFunctions<T> r;
  r.S = T(2.0) * (v.S * (v.C * v.D)) * inverse;
  // C^2/N and S^2/N first: each is of order one where C^2 and D^2 underflow, on the separatrix.
  const T along = (C2 * inverse) * D2, apart = p.delta * (S2 * inverse);
  r.C = along - apart;
  r.D = along + apart;
  const T eS2 = p.epsilon * S2;
  r.angle = T(2.0) * v.angle +
            atan2(p.weight * (eS2 * r.S), T(1.0) + p.epsilon * (r.S * r.S) - eS2 * (r.C * r.D));
  return r;
}

// A bound of the rates of S, C, D.
template <Number T>
DecisionOf<T> flow_rate(const FlowParameters<T>& p) {
  using std::sqrt;
  const DecisionOf<T> mu = decision_of(p.mu), nu = decision_of(p.nu);
  return sqrt(select(mu < nu, nu, mu));
}

// The series converges as (2 h rate / pi)^(2 terms): to 1e-36 and 1e-17 of its sum.
template <Number T, class H>
FlowFunctions<T> flow_functions(const FlowParameters<T>& p, const H& t) {
  using std::abs;
  using Decision = DecisionOf<T>;
  constexpr bool wide = RealTraits<T>::epsilon() < 1e-20;
  const Decision one(1.0), none(0.0), half(0.5), longest(wide ? 1.0 / 64.0 : 1.0 / 8.0);
  Decision halvings = none, scale = one, step = abs(decision_of(t)) * flow_rate(p);
  int trips = 0;
  const auto too_long = [&] { return step > longest; };
  for (auto more = too_long(); any(more) && trips < 1100; more = too_long(), ++trips) {
    step = select(more, Decision(half * step), step);
    scale = select(more, Decision(half * scale), scale);
    halvings = halvings + select(more, one, none);
  }
  const H h = t * H(scale);
  FlowFunctions<T> v;
  if constexpr (wide) {
    v = flow_by_series<9>(p, h);
  } else {
    v = where(
        step < Decision(1.0 / 32.0), [&] { return flow_by_series<5>(p, h); },
        [&] { return flow_by_series<8>(p, h); });
  }
  for (int i = 0; i < trips; ++i)  // <= log2(64 rate t) trips
    v = select(Decision(static_cast<double>(i)) < halvings, doubled(p, v), v);
  return v;
}

// 2K/n and the angle over that half of a period, both smooth in the parameters away from delta = 0.
template <Real T>
struct FlowHalfPeriod {
  T time, angle;
};

template <Real T>
FlowHalfPeriod<T> flow_half_period(const FlowParameters<T>& p) {
  using std::sqrt;
  const bool short_axis = to_double(p.delta) > 0.0;
  const T& larger = short_axis ? p.mu : p.nu;
  const T& smaller = short_axis ? p.nu : p.mu;
  const auto modulus =
      elliptic::BasicModulus<T>::from_ratio(smaller, T(short_axis ? p.delta : T(-p.delta)));
  const T root = sqrt(larger);
  const T ratio = p.epsilon / larger;
  const T quarter_w = elliptic::cel(T(sqrt(modulus.m1())), T(T(1.0) + ratio), T(0.0), ratio) / root;
  return {T(2.0) * elliptic::complete_k(modulus) / root, T(2.0) * p.weight * quarter_w};
}

// Squared rates that are NaN or beyond the range of a double make no modulus.
template <Real T>
bool has_half_period(const FlowParameters<T>& p) {
  const double mu = to_double(p.mu), nu = to_double(p.nu), delta = to_double(p.delta);
  const double sum = (delta > 0.0 ? nu : mu) + std::abs(delta);
  return mu >= 0.0 && nu >= 0.0 && sum > 0.0 && std::isfinite(sum);
}

// At any time: whole half periods are taken off first. Next to the separatrix an arc beyond a
// quarter of the period grows by what the rest takes away again, with the digits.
template <Real T, class S>
FlowFunctions<T> long_flow(const FlowParameters<T>& p, const S& time) {
  if (!has_half_period(p)) {
    const T none(std::numeric_limits<double>::quiet_NaN());
    return {none, none, none, none, none};
  }
  const FlowHalfPeriod<T> half = flow_half_period(p);
  const double count = std::rint(to_double(time) / to_double(half.time));
  if (count == 0.0) return flow_functions(p, time);
  FlowFunctions<T> v = flow_functions(p, T(T(time) - half.time * S(count)));
  v.whole = half.angle * S(count);
  if (std::fmod(count, 2.0) != 0.0) {  // sn, and of cn and dn the one that has zeros
    T& swinging = to_double(p.delta) > 0.0 ? v.C : v.D;
    v.S = -v.S;
    swinging = -swinging;
  }
  return v;
}

template <Number T, class S>
FlowFunctions<T> flow_over(const FlowParameters<T>& p, const S& time) {
  using std::abs;
  using Decision = DecisionOf<T>;
  // A quarter of the period is at least pi / (2 rate).
  const auto is_long = !(decision_of(p.delta) == Decision(0.0)) &&
                       abs(decision_of(time)) * flow_rate(p) > Decision(1.5);
  if (!any(is_long)) return flow_functions(p, time);
  if constexpr (Real<T>) {
    return long_flow(p, time);
  } else {
    using L = LaneTraits<T>;
    FlowFunctions<T> v = flow_functions(p, select(is_long, T(0.0), time));
    for (std::size_t i = 0; i < L::count; ++i) {  // long arcs are rare: one lane at a time
      if (!L::get_mask(is_long, i)) continue;
      const FlowParameters<ScalarOf<T>> lane{L::get(p.mu, i), L::get(p.nu, i), L::get(p.delta, i),
                                             L::get(p.epsilon, i), L::get(p.weight, i)};
      const FlowFunctions<ScalarOf<T>> f = long_flow(lane, L::get(time, i));
      L::set(v.S, i, f.S);
      L::set(v.C, i, f.C);
      L::set(v.D, i, f.D);
      L::set(v.angle, i, f.angle);
      L::set(v.whole, i, f.whole);
    }
    return v;
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
