// SPDX-License-Identifier: MIT
#include "scenario/detail/planet_satellites.hpp"

#include <cmath>

#include "polhode/secular/spin_precession.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

double mean_motion(double gm, const OuterSatellite& of) {
  const double a = of.distance;
  return std::sqrt(gm * (1.0 + of.mass) / a) / a;
}

}  // namespace

void refuse_without(const KindContext& at, const char* key) {
  refuse(at.values, "planet", at.name,
         std::string("expected a key ") + key +
             " or the name of a planet, for its satellites and tides");
}

PlanetSatellites::PlanetSatellites(const KindContext& at, const KeyValues& planet,
                                   const PlanetSpin* known)
    : at_(at), planet_(planet), known_(known) {
  for (const std::string& path : array_paths(at.values, "planet.satellite")) {
    const KeyValues table(at.values, at.units, path, at.name);
    for (const char* const key : {"mass", "distance"})
      require_range(at.values, table.key_path(key), at.name);
    const bool is_inner = table.word("kind") == "inner";
    satellites_.push_back({path, is_inner, table.number("mass"), table.number("distance"),
                           is_inner ? 0.0 : table.number("eccentricity"),
                           is_inner ? 0.0 : table.number("inclination")});
    if (!(satellites_.back().eccentricity >= 0.0 && satellites_.back().eccentricity < 1.0))
      table.refuse("eccentricity", "expected a number from 0 to below 1");
  }
  for (const char* const key : {"gm", "radius", "inertia_factor"})
    if (planet.has(key)) require_range(at.values, planet.key_path(key), at.name);
}

const PlanetSpin& PlanetSatellites::known_for(const char* key) const {
  if (known_ == nullptr) refuse_without(at_, key);
  return *known_;
}
double PlanetSatellites::known_length(double metres) const {
  return is_scale_free() ? metres / known_->radius
                         : at_.units.to_core(metres, "m", Dimension::length);
}
double PlanetSatellites::gm() const {
  if (planet_.has("gm")) return planet_.number("gm");
  const PlanetSpin& of = known_for("gm");
  if (!is_scale_free()) return at_.units.to_core(of.gm, "m3/s2", Dimension::gm);
  const double R = of.radius;
  return at_.units.to_core(of.gm / (R * R * R), "1/s2", Dimension::gm);
}
double PlanetSatellites::radius() const {
  if (planet_.has("radius")) {
    if (is_scale_free() && known_ != nullptr)
      planet_.refuse("radius", "expected a unit of length in [units] as well");
    return planet_.number("radius");
  }
  return is_scale_free() ? 1.0 : known_length(known_for("radius").radius);
}
double PlanetSatellites::inertia_factor() const {
  return planet_.has("inertia_factor") ? planet_.number("inertia_factor")
                                       : known_for("inertia_factor").inertia_factor;
}

double PlanetSatellites::outer_share(double n) const {
  double share = 0.0;
  const double of_star = star_precession(1.0, 1.0, n * n, 1.0);  // gm / a^3 is n^2
  for (const PlanetSatellite& one : satellites_)
    if (!one.is_inner)
      share += satellite_precession(1.0, 1.0, one.mass * gm(), one.distance, one.eccentricity,
                                    one.inclination) /
               of_star;
  return share;
}

void PlanetSatellites::refuse_inner(const std::string& given) const {
  for (const PlanetSatellite& one : satellites_)
    if (one.is_inner)
      refuse(at_.values, one.path + ".kind", at_.name,
             "expected no inner satellite next to " + given + ", which is that of all together");
}

double PlanetSatellites::inner_factor(double ellipticity, double w) const {
  std::vector<InnerSatellite> inner;
  for (const PlanetSatellite& one : satellites_)
    if (one.is_inner)
      inner.push_back({.mass = one.mass,
                       .distance = one.distance / radius(),
                       .mean_motion = mean_motion(gm(), {one.mass, one.distance}) / w});
  if (inner.empty()) return 1.0;
  return inner_satellites_factor(ellipticity * inertia_factor(), inertia_factor(), inner);
}

OuterSatellite PlanetSatellites::tidal_satellite() const {
  if (satellites_.empty() && known_ != nullptr)
    return {known_->satellite.mass, known_length(known_->satellite.distance)};
  OuterSatellite found;
  for (const PlanetSatellite& one : satellites_) {
    if (one.is_inner) continue;
    if (found.mass > 0.0)
      refuse(at_.values, one.path + ".kind", at_.name,
             "expected one outer satellite next to a table planet.tides");
    found = {one.mass, one.distance};
  }
  return found;
}

// Of the star, gm / a^3 is n^2, at any a.
TidalRates PlanetSatellites::tides(double w, double n) const {
  for (const char* const key : {"tides.k2", "tides.lag"})
    require_range(at_.values, planet_.key_path(key), at_.name);
  if (planet_.number("tidal_drift") != 0.0)
    planet_.refuse("tidal_drift", "expected none next to a table planet.tides");
  if (!(w > 0.0))
    planet_.refuse("rotation_period",
                   "expected a positive one next to a table planet.tides, and the pole about "
                   "which the planet turns that way");
  const double k2 = planet_.number("tides.k2"), lag = planet_.number("tides.lag");
  const double gm = this->gm(), R = radius(), factor = inertia_factor();
  TidalRates rates{
      .spin = w, .orbit = n, .star = tidal_rate(k2, lag, n * n, n * n / gm, R, factor, 1.0)};
  const OuterSatellite raising = tidal_satellite();
  if (raising.mass > 0.0 && k2 * lag > 0.0) {
    const double month = mean_motion(gm, raising), ratio = raising.distance / R;
    rates.satellite =
        tidal_rate(k2, lag, raising.mass * gm, raising.mass, R, factor, raising.distance);
    rates.satellite_orbit = month;
    rates.satellite_momentum = raising.mass / (1.0 + raising.mass) * month * ratio * ratio / factor;
  }
  return rates;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
