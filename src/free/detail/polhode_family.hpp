// SPDX-License-Identifier: MIT
// The one-parameter family of polhodes of a body at G = 1: from the action ratio, the ratio of
// periods, or the energy, back to the polhode. The inverse problems of Sadov's variables and of
// tumblers live on it.
//
// With w = e^v: kp2 = 1/(1 + kap2 w), r2 = w kp2, k2 = kap2 r2. v = -inf is spin about the axis of
// circulation, v = +inf the separatrix; both complements stay exact at both ends, also for kap2 =
// 0.
#pragma once

#include <cmath>

#include "polhode/elliptic/agm.hpp"
#include "polhode/free/detail/polhode_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Moments about the primed axes.
template <Real T>
struct PrimedMoments {
  T A, B, C;
};

template <Real T>
PrimedMoments<T> primed_moments(const BasicVec3<T>& sorted, bool long_axis) {
  return long_axis ? PrimedMoments<T>{sorted.z, sorted.y, sorted.x}
                   : PrimedMoments<T>{sorted.x, sorted.y, sorted.z};
}

// The axis of circulation must differ from the middle one, else the mode does not exist.
template <Real T>
bool mode_exists(const PrimedMoments<T>& I) {
  return I.C != I.B;
}

template <Real T>
T kappa_squared(const PrimedMoments<T>& I) {
  using std::abs;
  return I.C * abs(I.B - I.A) / (I.A * abs(I.C - I.B));
}

// A member of the family: r2 = (a1/a3)^2 and the complement of the modulus.
template <Real T>
struct FamilyMember {
  T r2, kp2;
};

template <Real T>
FamilyMember<T> family_member(const T& kap2, const T& v) {
  using std::exp;
  const T w = exp(v);
  const T kp2 = T(1.0) / (T(1.0) + kap2 * w);
  return {w * kp2, kp2};
}

// Discriminants for |g| = G: a1^2 = G^2 r2/(1+r2), a3^2 = G^2/(1+r2).
template <Real T>
PolhodeCurve<T> family_curve(const BasicVec3<T>& sorted, bool long_axis, const T& G,
                             const FamilyMember<T>& f) {
  using std::abs;
  const PrimedMoments<T> I = primed_moments(sorted, long_axis);
  const T CA = abs(I.C - I.A), CB = abs(I.C - I.B);
  const T a3 = G * G / (T(1.0) + f.r2);
  const T DA = CA * a3 / I.C;
  const T DC = CA * (a3 * f.r2) / I.A;
  const T D2 = f.kp2 * CB * DA / CA;
  const Discriminants<T> d =
      long_axis ? Discriminants<T>{DC, T(-D2), DA} : Discriminants<T>{DA, D2, DC};
  return polhode_curve(sorted, G, d, false);
}

// The ends of v: J = 1e-130, and kp2 = 1e-30, where the action is that of the separatrix, or (kap2
// = 0, no separatrix) J = pi/2 to 1e-87.
template <Real T>
T family_start() {
  return T(-600.0);
}
template <Real T>
T family_end(const T& kap2, double inverse_kp2 = 1e30, double most = 400.0) {
  using std::log;
  if (!(kap2 > T(0.0))) return T(400.0);
  const T end = log(T(inverse_kp2) / kap2);
  return end < T(most) ? end : T(most);
}

// 1 - I_dn/G, where I_dn is the action of the circulation: (2/pi) cf r2/(1+r2) times the complete
// integral of cn^2/(1 + r2 sn^2); a product, so it keeps its digits at both ends.
// [SA "IellSadov", "IellSadov, range"]
template <Real T>
T action_deficit(const T& kap2, const FamilyMember<T>& f) {
  using std::sqrt;
  const T one(1.0);
  const T integral = elliptic::cel(sqrt(f.kp2), one + f.r2, one, T(0.0));
  return T(2.0) / pi<T>() * sqrt((one + kap2) / (one + f.r2)) * f.r2 * integral;
}

// I_dn/G itself; small when r2 is large.
template <Real T>
T action_ratio(const T& kap2, const FamilyMember<T>& f) {
  using std::sqrt;
  const T one(1.0);
  const T integral = elliptic::cel(sqrt(f.kp2), one + kap2, one, f.kp2);
  return T(2.0) / pi<T>() * sqrt((one + kap2) / (one + f.r2)) * integral;
}

// The same of a polhode whose r2 is beyond sums.
template <Real T>
T action_ratio_across(const PolhodeCurve<T>& c) {
  using std::sqrt;
  const T one(1.0);
  const T integral = elliptic::cel(sqrt(c.kp2), one + c.kap2, one, c.kp2);
  return T(2.0) / pi<T>() * sqrt(one + c.kap2) * (c.a3 / c.a1) * integral;
}

// d(action_deficit)/dr2 = sqrt(1 + kap2) K / (pi (1 + r2)^(3/2))  [SA "dI_l/dlambda"]
template <Real T>
T action_deficit_slope(const T& kap2, const FamilyMember<T>& f) {
  using std::sqrt;
  const T one_r = T(1.0) + f.r2;
  const T K = elliptic::complete_k(elliptic::BasicModulus<T>::from_ratio(kap2 * f.r2, f.kp2));
  return sqrt(T(1.0) + kap2) * K / (pi<T>() * one_r * sqrt(one_r));
}

// v where `excess(v)`, which rises with v, crosses zero: bisection with secant (Illinois) steps.
// At most 200 trips; 15 to 40 in practice.
template <Real T, class Function>
T family_root(const Function& excess, T low, T high) {
  using std::abs;
  T f_low = excess(low), f_high = excess(high);
  if (!(f_low < T(0.0))) return low;
  if (!(f_high > T(0.0))) return high;
  int side = 0;
  for (int i = 0; i < 200; ++i) {
    T mid = T(0.5) * (low + high);
    if (i % 3 != 0) {
      const T s = (low * f_high - high * f_low) / (f_high - f_low);
      if (s > low && s < high) mid = s;
    }
    const T f = excess(mid);
    const bool below = f < T(0.0);
    if (below) {
      low = mid;
      f_low = f;
      if (side == -1) f_high = T(0.5) * f_high;
      side = -1;
    } else {
      high = mid;
      f_high = f;
      if (side == 1) f_low = T(0.5) * f_low;
      side = 1;
    }
    if (f == T(0.0)) return mid;
    if (high - low <= T(4.0 * epsilon<T>()) * (T(1.0) + abs(high))) break;
  }
  return T(0.5) * (low + high);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
