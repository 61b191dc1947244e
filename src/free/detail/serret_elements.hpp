// SPDX-License-Identifier: MIT
// What Serret's elements and the generating function share: units, the polhode that G and T hold,
// and a place on it.
#pragma once

#include <cmath>
#include <string>

#include "free/detail/mean_frame.hpp"
#include "free/detail/sorted_state.hpp"
#include "math/number_text.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/error.hpp"
#include "polhode/free/detail/prepared_kernel.hpp"
#include "polhode/free/serret.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Powers of two that bring the moments, and G, to order 1: squares then neither overflow nor run
// out of low parts, and the scaling is exact.
struct Units {
  int momentum, time, energy;
};
inline Units units_of(const Body& body, double G) {
  const int moment = exponent_of_largest(body.moments());
  const int momentum = exponent_of_largest({G, 0.0, 0.0});
  return {momentum, moment - momentum, 2 * momentum - moment};
}

// A phase beyond 2^90 has no digit left: any point of the orbit is as good, and t0 is taken.
inline constexpr double time_limit = 0x1p90;

// The elements at a time, in scaled units.
struct ScaledSerret {
  SerretState s;
  double t;
};
inline ScaledSerret in_units(const Units& units, const SerretState& given, double t) {
  SerretState s = given;
  s.t0 = std::ldexp(s.t0, -units.time);
  s.G = std::ldexp(s.G, -units.momentum);
  s.H = std::ldexp(s.H, -units.momentum);
  s.T = std::ldexp(s.T, -units.energy);
  double now = std::ldexp(t, -units.time);
  if (std::isfinite(t) && !(std::abs(now - s.t0) < time_limit)) now = s.t0 = 0.0;
  return {s, now};
}

// Discriminants at momentum 1 and scaled moments: 1 - 2 T I / G^2, none below zero.
template <Real T>
Discriminants<T> discriminants_of(const BasicVec3<T>& I, const T& twice_energy) {
  const T one(1.0), zero(0.0);
  const T D1 = one - twice_energy * I.x, D3 = twice_energy * I.z - one;
  return {D1 < zero ? zero : D1, one - twice_energy * I.y, D3 < zero ? zero : D3};
}

// 2 T / G^2
template <Real T>
T energy_ratio(const BasicSerretState<T>& c) {
  return T(2.0) * (c.T / c.G) * (T(1.0) / c.G);
}

// Nearer than this to the separatrix T and G, both rounded, do not tell the sides apart, and the
// separatrix itself is what they mean: there u keeps its meaning up to the middle axis. Where the
// modulus would not be next to 1, of moments that are equal but for rounding, they stay as they
// are.
inline constexpr double untold_distance = 2.0 * 0x1p-52;
inline constexpr double untold_complement = 0x1p-10;

// Another value, the same derivatives.
template <Real T>
T moved_to(const T& x, const DoubleDouble& value) {
  return x + T(value - value_of(x));
}

template <Real T>
PolhodeCurve<T> curve_of(const Body& body, const BasicSerretState<T>& c) {
  const BasicVec3<DoubleDouble> sorted = sorted_moments(body);
  const BasicVec3<T> I{T(sorted.x), T(sorted.y), T(sorted.z)};
  Discriminants<T> d = discriminants_of(I, energy_ratio(c));
  const double D2 = to_double(d.D2);
  if (std::abs(D2) <= untold_distance) {
    const double DA = D2 < 0.0 ? to_double(d.D3) : to_double(d.D1);
    const double gap = to_double(D2 < 0.0 ? I.y - I.x : I.z - I.y);
    if (to_double(I.z - I.x) * std::abs(D2) < untold_complement * gap * DA) {
      // all three those of the separatrix: next to equal moments D1 or D3 has no other digits
      d.D1 = moved_to(d.D1, (sorted.y - sorted.x) / sorted.y);
      d.D2 = moved_to(d.D2, DoubleDouble(0.0));
      d.D3 = moved_to(d.D3, (sorted.z - sorted.y) / sorted.y);
    }
  }
  return polhode_curve(I, T(1.0), d, false);
}

inline BasicSerretState<DoubleDouble> widened(const SerretState& s) {
  return {s.g0, s.h, s.t0, s.G, s.H, s.T, s.sign_g1, s.sign_g3};
}

// Argument of the place on a polhode where a momentum along its primed axes is, k.x and k.z >= 0;
// on the separatrix, which may pass next to it, that of the nearest.
inline DoubleDouble place_on(const PolhodeCurve<DoubleDouble>& c,
                             const BasicVec3<DoubleDouble>& k) {
  if (c.separatrix) {
    const DoubleDouble least = 0x1p-440, one = 1.0;
    const DoubleDouble sech = (k.x * c.a1 + k.z * c.a3) / (c.a1 * c.a1 + c.a3 * c.a3);
    const DoubleDouble x = sech < least ? least : sech < one ? sech : one;
    const DoubleDouble u = log((one + sqrt(one - x * x)) / x);
    return k.y < DoubleDouble(0.0) ? -u : u;
  }
  const DoubleDouble across = k.x / c.a1, along = k.y / c.a2, r2 = across * across + along * along;
  const DoubleDouble c2 = across * across / r2, s2 = along * along / r2;
  return along / sqrt(r2) * elliptic::carlson_rf(c2, c2 + c.kp2 * s2, DoubleDouble(1.0));
}

inline void require_elements(const Body& body, const SerretState& s) {
  if (is_sphere(body))
    throw DomainError("SerretState: moment " + number_text(body.moments().x) +
                      " three times: a sphere has no Serret elements (T does not tell J)");
  const auto fail = [&](const std::string& need) {
    throw DomainError("SerretState: (g0, h, t0, G, H, T) = " +
                      tuple_text({s.g0, s.h, s.t0, s.G, s.H, s.T}) + " needs " + need);
  };
  const double slack = 1.0 + 8.0 * epsilon<double>();
  for (const double x : {s.g0, s.h, s.t0, s.G, s.H, s.T})
    if (!std::isfinite(x)) fail("finite elements");
  if (!(s.G > 0.0) || std::abs(s.H) > s.G * slack) fail("G > 0 and |H| <= G");
  for (const int sign : {s.sign_g1, s.sign_g3})
    if (sign != 1 && sign != -1) fail("signs of g1 and g3 that are 1 or -1");
  if (!std::isnormal(s.T))
    fail("T within double range: units in which G^2/2I neither overflows nor underflows");
  const Vec3 I = sorted_doubles(body);
  require_held_moments("SerretState", body);
  if (!std::isnormal(std::ldexp(1.0, -units_of(body, s.G).time)))
    fail("a rate G / I within double range");
  const double low = 0.5 * s.G * (s.G / I.z), high = 0.5 * s.G * (s.G / I.x);
  if (s.T * slack < low || s.T > high * slack)
    fail("T in [G^2/2I3, G^2/2I1] = [" + number_text(low) + ", " + number_text(high) + "]");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
