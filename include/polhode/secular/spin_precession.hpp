// SPDX-License-Identifier: MIT
// The spin axis of a planet over ages: averaged over its rotation and its orbit.
//
// Equations   H = -1/2 alpha(e) (s.n)^2 + g s.n of the unit vector s along the angular momentum, n
//             the normal of the orbit: ds/dt = (alpha(e) (s.n) - g) s x n in inertial axes
//             (Colombo 1966; Touma & Wisdom 1993). alpha(e) = star (1 - e^2)^(-3/2) + satellites,
//             g that of geodetic precession. In the axes of the moving orbit, with the canonical X
//             = cos(obliquity) = s_z and psi, the same with -mu x s, mu their rate (Laskar &
//             Robutel 1993; the Mars of section 4 of the paper). Neither has a singularity where
//             psi has one.
//             star = 3/2 gm / a^3 E / w with E = (C - (A + B)/2) / C, times 1 - 3/2 sin^2 J where
//             the figure axis is J away from s ([SA (84)], J the Andoyer angle). Satellites that
//             stay in the equator take part in the motion: star is then (1 + q / J2) / (1 + l /
//             lambda) times as large, q = 1/2 sum (m / M) (a / R)^2, l = sum (m / M) (a / R)^2 n /
//             w, lambda = C / M R^2 (Ward 1975; Ward & Hamilton 2004).
// Units       any time; rates in rad per time.
// Domain      orbits that change slowly against the rotation and the year.
// Accuracy    that of the method. Splitting keeps |s| = 1 to rounding: frozen motion is a turn
//             about n. Budgets secular_*.
// Errors      DomainError for an axis without direction, and for physical data out of range.
// Cost        100 ns for a turn with a table of elements.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/dynamics/method.hpp"
#include "polhode/frame/frame.hpp"
#include "polhode/math/instruction_set.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/secular/detail/spin_model.hpp"
#include "polhode/secular/orbit_history.hpp"
#include "polhode/secular/spin_axis.hpp"
#include "polhode/trajectory/save_at.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

// What turns a spin axis; a drift is a fraction per time, of tides.
template <Number T>
struct BasicPrecessionRates {
  T star;                 // on a circle
  T satellites = T(0.0);  // whatever the planet's e
  T geodetic = T(0.0);
  T drift = T(0.0);  // of star and satellites, from t = 0 on

  T torque(double t, double e2) const {
    const double r = 1.0 / (1.0 - e2);
    return (star * T(r) * T(std::sqrt(r)) + satellites) * (T(1.0) + drift * T(t));
  }
  // Of an axis about -n at this s.n.
  T turning(double t, double e2, const T& cosine) const {
    return torque(t, e2) * cosine - geodetic;
  }
};
using PrecessionRates = BasicPrecessionRates<double>;

// With the precession `rate` of the equinox by star and satellites at X = cos(obliquity) and e^2,
// satellites being `share` of the star.
PrecessionRates rates_of_precession(double rate, double X, double e2, double share = 0.0);
// Refuses a drift that turns the torques round between these times.
void require_drift(const PrecessionRates& rates, double first, double last);

// star, and satellites, of physical data. `ellipticity` is E.
double star_precession(double ellipticity, double spin_rate, double gm, double semi_major_axis);
// Of a satellite that goes round far outside the planet, near the plane of the planet's orbit, at
// the mean inclination i against it (Laskar & Robutel 1993).
double satellite_precession(double ellipticity, double spin_rate, double gm, double semi_major_axis,
                            double eccentricity, double inclination);
// 3/2 (gm / a)^(3/2) / (a c^2): de Sitter's, on a circle; forwards.
double geodetic_precession(double gm, double semi_major_axis, double light_speed);
// 1 - 3/2 sin^2 J.
double andoyer_factor(double J);

// A satellite that stays in the equator of the planet.
struct InnerSatellite {
  double mass;         // m / M
  double distance;     // a / R
  double mean_motion;  // n / w
};
// What star is multiplied with for them; inertia_factor is lambda.
double inner_satellites_factor(double J2, double inertia_factor,
                               std::span<const InnerSatellite> satellites);

// In inertial axes.
template <class Elements>
struct SpinPrecession : detail::SpinModel {
  static constexpr std::string_view name = "a precessing spin axis";

  Elements orbit;
  PrecessionRates rates_of;

  SpinPrecession(Elements elements, const PrecessionRates& rates)
      : orbit(std::move(elements)), rates_of(rates) {}

  // Of the axis about -n.
  double rate(double t, const Vec3& s, const OrbitPlane& o, const Vec3& n) const {
    return rates_of.turning(t, o.e2, dot(s, n));
  }
  Values rates(const DoubleDouble& t, const Values& y) const {
    const OrbitPlane o = orbit.plane(t.hi);
    const Vec3 s{y[0], y[1], y[2]}, n = orbit_normal(o);
    const Vec3 ds = rate(t.hi, s, o, n) * cross(s, n);
    return {ds.x, ds.y, ds.z};
  }
  SpinAxis frozen(const DoubleDouble& t, const SpinAxis& axis, double h) const {
    const OrbitPlane o = orbit.plane(t.hi);
    const Vec3 n = orbit_normal(o);
    return detail::turned(axis, n, -rate(t.hi, axis.s, o, n) * h);
  }
};

// In the equinoctial axes of the orbit, which turn with it.
template <class Elements>
struct SpinInOrbitAxes : detail::SpinModel {
  static constexpr std::string_view name = "a spin axis seen from its orbit";

  Elements orbit;
  PrecessionRates rates_of;
  Frame frame;

  SpinInOrbitAxes(const Elements& elements, const PrecessionRates& rates)
      : orbit(elements), rates_of(rates), frame(Frame::from_attitude([elements](const auto& t) {
          return equinoctial_attitude(elements.at(t));
        })) {}

  Values rates(const DoubleDouble& t, const Values& y) const {
    const Vec3 s{y[0], y[1], y[2]}, mu = frame.at(t.hi).mu_S;
    const double turn = rates_of.turning(t.hi, orbit.plane(t.hi).e2, s.z);
    const Vec3 ds = turn * cross(s, Vec3{0.0, 0.0, 1.0}) - cross(mu, s);
    return {ds.x, ds.y, ds.z};
  }
};

// What an axis and an orbit are to those who read climates from them: angles in rad.
struct SpinAngles {
  double obliquity;
  // Longitude of the moving equinox in equinoctial axes, backwards: psi. NaN where the obliquity is
  // 0 or pi.
  double precession;
  // Longitude of the pericentre from the moving equinox, and e sin of it.
  double pericentre;
  double climatic_precession;
};
SpinAngles spin_angles(const SpinAxis& axis, const OrbitElements& orbit);

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

// spin_histories: the spin axes of many bodies on one orbit that changes over ages, an axis in each
// lane of the processor.
//
// Equations   those of SpinPrecession, each body with rates of its own.
// Units       any time; rates in rad per time.
// Domain      that of SpinPrecession by Splitting. Times run from the epoch away, in one direction.
// Accuracy    to the last bit that of SpinPrecession by the same method, one body at a time. It
//             does not depend on the other bodies, their number or the set of instructions.
// Errors      a body that fails, fails alone: its axes are NaN from there on, and how it ended is
//             in the list that is returned. DomainError for spans that do not fit together, for a
//             method that is out of range, and for a set that this processor lacks.
// Cost        3 ns a body for a turn, of which order 8 makes 18 a step, and 18 for a time between
//             two steps; 150 ns for the orbit, which up to 256 bodies share.

// A body that did not reach the last time.
struct LostSpin {
  std::size_t index;
  Outcome outcome;
};

// results[i times.size() + k] is the axis of body i at times[k], which was at starts[i] at the
// epoch. Rates and starts are as many as there are bodies, or one for all.
std::vector<LostSpin> spin_histories(const OrbitHistory& orbit,
                                     std::span<const PrecessionRates> rates,
                                     std::span<const SpinAxis> starts, double epoch,
                                     const SaveAt& times, const Splitting& method,
                                     std::span<SpinAxis> results, const Progress& progress = {},
                                     InstructionSet set = widest_instruction_set());

}  // namespace secular
}  // namespace v0
}  // namespace polhode
