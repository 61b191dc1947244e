// SPDX-License-Identifier: MIT
// Mean rates of a polhode: the phase x = pi u / (2K), and the precession of both primed axes.
#pragma once

#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/free/detail/polhode_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// dx/dt; 0 on the separatrix.
template <Real T>
T phase_rate(const PolhodeCurve<T>& c) {
  return c.separatrix ? T(0.0) : T(T(0.5) * pi<T>() * c.n / c.K);
}

// (1/K) times the integral over a quarter period of (cn^2 + b sn^2)/(cn^2 + p sn^2); b/p on the
// separatrix, where sn^2 = 1 in the mean. A sum of positive terms: at k = 1 the integral is b/p K +
// (1 - b/p) RC(1, p), and RC <= 1.
template <Real T>
T polhode_mean(const PolhodeCurve<T>& c, const T& b, const T& p) {
  using std::sqrt;
  if (c.separatrix) return b / p;
  if (c.merging) {
    const T outside = elliptic::carlson_rc(T(1.0), p) / c.K;
    return b / p * (T(1.0) - outside) + outside;
  }
  return elliptic::cel(sqrt(c.kp2), p, T(1.0), b) / c.K;
}

// Precession about the momentum of primed axes 1 and 3, (G/C) <(1 + r2 (C/A) sn^2)/(1 + r2 sn^2)>
// and (G/A) <(1 + kap2 (A/C) sn^2)/(1 + kap2 sn^2)>: they differ by dx/dt, but neither is formed
// from the other, which would cancel for a needle.
template <Real T>
T precession_of_axis1(const PolhodeCurve<T>& c) {
  // C/A + (1 - C/A) Pi(-r2)/K, and Pi is pi/(2 r) but for 1/r of itself
  if (is_across(c))
    return c.G / c.A + c.G * (c.A - c.C) / c.A * (T(0.5) * pi<T>() / c.K * (c.a3 / c.a1) / c.C);
  return c.G / c.C * polhode_mean(c, T(T(1.0) + c.r2 * (c.C / c.A)), T(T(1.0) + c.r2));
}
template <Real T>
T precession_of_axis3(const PolhodeCurve<T>& c) {
  return c.G / c.A * polhode_mean(c, T(T(1.0) + c.kap2 * (c.A / c.C)), T(T(1.0) + c.kap2));
}

// The axis of least moment, the long one, is primed axis 3 in long-axis mode and 1 in short-axis
// mode.
template <Real T>
T precession_of_long_axis(const PolhodeCurve<T>& c) {
  return c.long_axis ? precession_of_axis3(c) : precession_of_axis1(c);
}
template <Real T>
T precession_of_short_axis(const PolhodeCurve<T>& c) {
  return c.long_axis ? precession_of_axis1(c) : precession_of_axis3(c);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
