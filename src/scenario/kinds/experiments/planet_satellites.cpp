// SPDX-License-Identifier: MIT
#include "scenario/kinds/experiments/planet_satellites.hpp"

#include <cmath>

#include "polhode/secular/spin_precession.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

bool is_inner(const Placed<SatelliteTable>& one) {
  return one->kind == SatelliteTable::Kind::inner;
}

double mean_motion(double gm, double mass, double distance) {
  return std::sqrt(gm * (1.0 + mass) / distance) / distance;
}

}  // namespace

PlanetSatellites::PlanetSatellites(const FileValues& file, const Placed<PlanetTable>& planet,
                                   const secular::PlanetSpin* known)
    : planet_(planet),
      known_(known),
      tides_(tides_table(file)),
      satellites_(satellite_tables(file)) {
  for (const Placed<SatelliteTable>& one : satellites_)
    if (!(one->eccentricity < 1.0))
      one.refuse<&SatelliteTable::eccentricity>("expected a number from 0 to below 1");
}

double PlanetSatellites::known_length(double metres) const {
  return is_scale_free() ? metres / known_->radius
                         : units().to_core(metres, "m", Dimension::length);
}
double PlanetSatellites::gm() const {
  if (planet_->gm) return *planet_->gm;
  const secular::PlanetSpin& of = known_for<&PlanetTable::gm>();
  if (!is_scale_free()) return units().to_core(of.gm, "m3/s2", Dimension::gm);
  const double R = of.radius;
  return units().to_core(of.gm / (R * R * R), "1/s2", Dimension::gm);
}
double PlanetSatellites::radius() const {
  if (!planet_->radius)
    return is_scale_free() ? 1.0 : known_length(known_for<&PlanetTable::radius>().radius);
  if (is_scale_free() && known_ != nullptr)
    planet_.refuse<&PlanetTable::radius>("expected a unit of length in [units] as well");
  return *planet_->radius;
}
double PlanetSatellites::inertia_factor() const {
  return planet_->inertia_factor ? *planet_->inertia_factor
                                 : known_for<&PlanetTable::inertia_factor>().inertia_factor;
}

double PlanetSatellites::outer_share(double n) const {
  double share = 0.0;
  const double of_star = secular::star_precession(1.0, 1.0, n * n, 1.0);  // gm / a^3 is n^2
  for (const Placed<SatelliteTable>& one : satellites_)
    if (!is_inner(one))
      share += secular::satellite_precession(1.0, 1.0, one->mass * gm(), one->distance,
                                             one->eccentricity, one->inclination) /
               of_star;
  return share;
}

void PlanetSatellites::refuse_inner(const std::string& given) const {
  for (const Placed<SatelliteTable>& one : satellites_)
    if (is_inner(one))
      one.refuse<&SatelliteTable::kind>("expected no inner satellite next to " + given +
                                        ", which is that of all together");
}

double PlanetSatellites::inner_factor(double ellipticity, double w) const {
  std::vector<secular::InnerSatellite> inner;
  for (const Placed<SatelliteTable>& one : satellites_)
    if (is_inner(one))
      inner.push_back({.mass = one->mass,
                       .distance = one->distance / radius(),
                       .mean_motion = mean_motion(gm(), one->mass, one->distance) / w});
  if (inner.empty()) return 1.0;
  return secular::inner_satellites_factor(ellipticity * inertia_factor(), inertia_factor(), inner);
}

secular::OuterSatellite PlanetSatellites::tidal_satellite() const {
  if (satellites_.empty() && known_ != nullptr)
    return {known_->satellite.mass, known_length(known_->satellite.distance)};
  secular::OuterSatellite found;
  for (const Placed<SatelliteTable>& one : satellites_) {
    if (is_inner(one)) continue;
    if (found.mass > 0.0)
      one.refuse<&SatelliteTable::kind>(
          "expected one outer satellite next to a table planet.tides");
    found = {one->mass, one->distance};
  }
  return found;
}

// For the star, gm / a^3 = n^2 for any a.
secular::TidalRates PlanetSatellites::tides(double w, double n) const {
  if (planet_->tidal_drift != 0.0)
    planet_.refuse<&PlanetTable::tidal_drift>("expected none next to a table planet.tides");
  if (!(w > 0.0))
    planet_.refuse<&PlanetTable::rotation_period>(
        "expected a positive one next to a table planet.tides, and the pole about which the planet "
        "turns that way");
  const double k2 = tides_->k2, lag = tides_->lag;
  const double gm = this->gm(), R = radius(), factor = inertia_factor();
  secular::TidalRates rates{
      .spin = w,
      .orbit = n,
      .star = secular::tidal_rate(k2, lag, n * n, n * n / gm, R, factor, 1.0)};
  const secular::OuterSatellite raising = tidal_satellite();
  if (raising.mass > 0.0 && k2 * lag > 0.0) {
    const double month = mean_motion(gm, raising.mass, raising.distance),
                 ratio = raising.distance / R;
    rates.satellite =
        secular::tidal_rate(k2, lag, raising.mass * gm, raising.mass, R, factor, raising.distance);
    rates.satellite_orbit = month;
    rates.satellite_momentum = raising.mass / (1.0 + raising.mass) * month * ratio * ratio / factor;
  }
  return rates;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
