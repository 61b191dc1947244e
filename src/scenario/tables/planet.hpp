// SPDX-License-Identifier: MIT
// [planet] and the tables inside it: its pole, satellites, tides, and the place of the insolation.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct PlanetTable {
  std::optional<std::string> name;
  std::string orbit;
  std::optional<double> precession_rate, precession_constant;
  std::optional<double> ellipticity, rotation_period, orbital_period;
  std::optional<double> satellites;
  std::optional<double> gm, radius, inertia_factor;
  std::optional<double> geodetic;
  double tidal_drift = 0.0;
  double J = 0.0;
};
struct PoleTable {
  std::optional<double> ra, obliquity;
  double dec = 0.0;         // with ra
  double precession = 0.0;  // with obliquity
};
struct SatelliteTable {
  enum class Kind { outer, inner };
  Kind kind = Kind::outer;
  double mass = 0.0;  // relative to the planet
  double distance = 0.0;
  double eccentricity = 0.0, inclination = 0.0;  // of an outer one
};
struct TidesTable {
  double k2 = 0.0, lag = 0.0;
};
struct InsolationTable {
  double latitude = 0.0, longitude = 0.0, flux = 0.0;
};

SchemaPart planet_keys();
Placed<PlanetTable> planet_table(const FileValues& file);
Placed<PoleTable> pole_table(const FileValues& file);
std::vector<Placed<SatelliteTable>> satellite_tables(const FileValues& file);
Placed<TidesTable> tides_table(const FileValues& file);
Placed<InsolationTable> insolation_table(const FileValues& file);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
