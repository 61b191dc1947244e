// SPDX-License-Identifier: MIT
// The spin axis of a planet averaged over its rotation, but not over its orbit: between
// SpinPrecession and the rotor itself under GravityGradient.
//
// Equations   ds/dt = -2 star (a / r)^3 (s.n) s x n of the unit vector s along the angular
//             momentum, n towards the star. star = 3/2 gm / a^3 E / w is that of PrecessionRates:
//             the mean over a Kepler orbit is SpinPrecession.
// Units       any time; star in rad per time.
// Domain      bodies that turn fast against their year.
// Accuracy    that of the method. Splitting keeps |s| = 1 to rounding: frozen motion is a turn
//             about n. Budgets averaging_*.
// Cost        0.4 us for a turn on a HistoryOrbit with a table; steps of a fiftieth of the year.
#pragma once

#include <string_view>
#include <utility>

#include "polhode/secular/detail/spin_model.hpp"
#include "polhode/secular/history_orbit.hpp"

namespace polhode {
inline namespace v0 {

struct SpinOnOrbit : detail::SpinModel {
  static constexpr std::string_view name = "a spin axis under a star";

  HistoryOrbit orbit;
  double star;

  SpinOnOrbit(HistoryOrbit path, double star_rate) : orbit(std::move(path)), star(star_rate) {}

  Values rates(const DoubleDouble& t, const Values& y) const {
    const Vec3 s{y[0], y[1], y[2]}, x = orbit.position(t.hi);
    const Vec3 ds = (-strength(x) * dot(s, x)) * cross(s, x);
    return {ds.x, ds.y, ds.z};
  }
  SpinAxis frozen(const DoubleDouble& t, const SpinAxis& axis, double h) const {
    const Vec3 x = orbit.position(t.hi);
    const double r = norm(x);
    return detail::turned(axis, (1.0 / r) * x, strength(x) * r * dot(axis.s, x) * h);
  }

 private:
  // 2 star a^3 / r^5
  double strength(const Vec3& x) const {
    const double r2 = dot(x, x), ratio2 = orbit.semi_major_axis() * orbit.semi_major_axis() / r2;
    return 2.0 * star * ratio2 * std::sqrt(ratio2) / r2;
  }
};

}  // namespace v0
}  // namespace polhode
