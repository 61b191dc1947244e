// SPDX-License-Identifier: MIT
// The satellites of a planet, [[planet.satellite]], and the tides, [planet.tides], from the values
// of a file.
#pragma once

#include <string>
#include <vector>

#include "polhode/scenario/key_values.hpp"
#include "polhode/secular/planet.hpp"
#include "polhode/secular/tides.hpp"
#include "scenario/detail/experiment_kinds.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// In core units; mass over that of the planet.
struct PlanetSatellite {
  std::string path;
  bool is_inner;
  double mass, distance;
  double eccentricity, inclination;  // of an outer one
};

// Of a planet without name, for want of a key that satellites and tides need.
[[noreturn]] void refuse_without(const KindContext& at, const char* key);

class PlanetSatellites {
 public:
  // `known` is the planet `name`, or null.
  PlanetSatellites(const KindContext& at, const KeyValues& planet, const PlanetSpin* known);

  bool empty() const { return satellites_.empty(); }
  bool has_tides() const { return planet_.has("tides.k2"); }
  // The torque of the outer ones over that of the star on a circle; n of the planet's orbit.
  double outer_share(double n) const;
  // Where a constant is given next to inner ones, which it has in it.
  void refuse_inner(const std::string& given) const;
  // What star is multiplied with for the inner ones; of a planet that turns at w.
  double inner_factor(double ellipticity, double w) const;
  // Where there are tides.
  TidalRates tides(double w, double n) const;

 private:
  // In core units. Where files have no unit of length the radius is 1.
  double gm() const;
  double radius() const;
  double inertia_factor() const;
  bool is_scale_free() const { return at_.units.length() == "1"; }
  double known_length(double metres) const;
  // Refuses a planet that is not known, for want of the key.
  const PlanetSpin& known_for(const char* key) const;
  // The one that raises tides; mass 0 where there is none.
  OuterSatellite tidal_satellite() const;

  const KindContext& at_;
  const KeyValues& planet_;
  const PlanetSpin* known_;
  std::vector<PlanetSatellite> satellites_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
