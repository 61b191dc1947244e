// SPDX-License-Identifier: MIT
// Satellites and tides of the planet of kind "obliquity", with what the planet `name` fills in.
#pragma once

#include <string>
#include <vector>

#include "polhode/secular/planet.hpp"
#include "polhode/secular/tides.hpp"
#include "scenario/tables/planet.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// Refuses a planet without a name that lacks a key which satellites and tides need.
template <auto member>
[[noreturn]] void refuse_without(const Placed<PlanetTable>& planet) {
  planet.refuse("expected a key " + std::string(planet.name<member>()) +
                " or the name of a planet, for its satellites and tides");
}

class PlanetSatellites {
 public:
  // `known` is the planet `name`, or null.
  PlanetSatellites(const FileValues& file, const Placed<PlanetTable>& planet,
                   const secular::PlanetSpin* known);

  bool empty() const { return satellites_.empty(); }
  bool has_tides() const { return tides_.is_there(); }
  // The torque of the outer ones over that of the star on a circle; n of the planet's orbit.
  double outer_share(double n) const;
  // Refuses inner ones next to a constant, which includes their torques.
  void refuse_inner(const std::string& given) const;
  // The factor by which inner ones change the rate by the star, for a planet that turns at w.
  double inner_factor(double ellipticity, double w) const;
  // Requires the table of tides.
  secular::TidalRates tides(double w, double n) const;

 private:
  // In core units. The radius is 1 if the file has no unit of length.
  double gm() const;
  double radius() const;
  double inertia_factor() const;
  const Units& units() const { return planet_.at().units(); }
  bool is_scale_free() const { return units().length() == "1"; }
  double known_length(double metres) const;
  // The known planet; without one, reports the missing key.
  template <auto member>
  const secular::PlanetSpin& known_for() const {
    if (known_ == nullptr) refuse_without<member>(planet_);
    return *known_;
  }
  // The one that raises tides; mass 0 if there is none.
  secular::OuterSatellite tidal_satellite() const;

  const Placed<PlanetTable>& planet_;
  const secular::PlanetSpin* known_;
  Placed<TidesTable> tides_;
  std::vector<Placed<SatelliteTable>> satellites_;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
