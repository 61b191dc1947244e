// SPDX-License-Identifier: MIT
// The spin axis of a planet over ages with the tides that star and satellite raise: the spin slows
// down, the satellite goes away, the obliquity changes, and so does the precession.
//
// Equations   Tides of constant time lag (Mignard), averaged over rotation and orbits (Neron de
//             Surgy & Laskar 1997; Hut 1981 for e), c = s.n, for each body of rate K and mean
//             motion m:
//               dw/dt = -K (f(e) w (1 + c^2) / 2 - N(e) m c)
//               ds/dt = -K (f(e) c / 2 - N(e) m / w) (n - c s)
//             and for the satellite d(sqrt a)/dt = K (w c - m) / (its momentum over C at a = 1),
//             which conserves the momentum along n. K and m of the satellite go as a^-6 and
//             a^(-3/2). Precession is that of SpinPrecession; star goes as w (C - A as w^2),
//             satellites as w / a^3.
//             f = (1 + 3 e^2 + 3/8 e^4) / (1 - e^2)^(9/2), N = (1 + 15/2 e^2 + 45/8 e^4 + 5/16 e^6)
//             / (1 - e^2)^6.
// Units       any time; w in units of that at the start, a in units of that at the start.
// Domain      a satellite on a circle in the plane of the orbit of the planet; w > 0. Slow tides:
//             Splitting moves them by fourth-order steps within its turns.
// Accuracy    that of the method. Budgets tidal_*.
// Errors      DomainError for rates that are not finite or out of range, and for a drift of them,
//             which would count the tides twice.
// Cost        0.5 us for a turn with a table of elements.
#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/secular/detail/spin_model.hpp"
#include "polhode/secular/detail/tidal_change.hpp"
#include "polhode/secular/spin_precession.hpp"
#include "polhode/secular/tides.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

template <class Elements>
struct TidalPrecession {
  using State = TidalSpin;
  using Values = std::array<double, 5>;
  static constexpr std::string_view name = "a spin axis with tides";

  Elements orbit;
  PrecessionRates rates_of;
  TidalRates tides;

  TidalPrecession(Elements elements, const PrecessionRates& rates, const TidalRates& of_tides)
      : orbit(std::move(elements)), rates_of(rates), tides(of_tides) {
    require_valid(tides);
    if (rates.drift != 0.0)
      throw DomainError("TidalPrecession: expected no drift of the rates next to tides");
  }

  template <class T>
    requires std::is_same_v<T, double>
  Values values(const TidalSpin& at) const {
    return {at.s.x, at.s.y, at.s.z, at.spin, at.distance};
  }
  TidalSpin state(const Values& y) const { return {spin_axis({y[0], y[1], y[2]}).s, y[3], y[4]}; }
  TidalSpin started(const TidalSpin& at) const { return {spin_axis(at.s).s, at.spin, at.distance}; }
  double error_size(const Values& error, const Values&, const Values&) const {
    double sum = 0.0;
    for (const double x : error) sum += x * x;
    return std::sqrt(sum);
  }

  // Of the axis about -n.
  double rate(const TidalSpin& at, const OrbitPlane& o, const Vec3& n) const {
    const double d = at.distance;
    const PrecessionRates now{.star = rates_of.star * at.spin,
                              .satellites = rates_of.satellites * at.spin / (d * d * d)};
    return now.torque(0.0, o.e2) * dot(at.s, n) - rates_of.geodetic;
  }
  Values rates(const DoubleDouble& t, const Values& y) const {
    const OrbitPlane o = orbit.plane(t.hi);
    const Vec3 n = orbit_normal(o);
    const TidalSpin at{{y[0], y[1], y[2]}, y[3], y[4]};
    const TidalSpin tide = detail::tidal_change(tides, o.e2, n, at);
    const Vec3 ds = rate(at, o, n) * cross(at.s, n) + tide.s;
    return {ds.x, ds.y, ds.z, tide.spin, tide.distance};
  }
  TidalSpin frozen(const DoubleDouble& t, const TidalSpin& from, double h) const {
    const OrbitPlane o = orbit.plane(t.hi);
    const Vec3 n = orbit_normal(o);
    return detail::tidal_step(tides, o.e2, n, from, h,
                              [&](const TidalSpin& at) { return rate(at, o, n); });
  }
};

}  // namespace secular
}  // namespace v0
}  // namespace polhode
