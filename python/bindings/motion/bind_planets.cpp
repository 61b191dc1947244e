// SPDX-License-Identifier: MIT
// What planets are like: orbits that come along, poles, rates, tides, sunlight.
#include "interface/batch.hpp"
#include "interface/value.hpp"
#include "polhode/secular/insolation.hpp"
#include "polhode/secular/orbit_history.hpp"
#include "polhode/secular/planet.hpp"
#include "polhode/secular/tidal_spin.hpp"

namespace polhode::python {

namespace {

void bind_tides(nb::module_& m) {
  using T = secular::TidalRates;
  bind_value<T>(m, "TidalRates",
                R"(The tides that star and satellite raise on a planet, with a constant time lag.

Parameters
----------
spin : of the planet at the epoch, rad per time; positive.
orbit : mean motion of the planet, rad per time; positive.
star, satellite : the rates K of the tides, 1 per time; tidal_rate makes them.
satellite_orbit : mean motion of the satellite at the epoch, rad per time.
satellite_momentum : angular momentum of its orbit over the moment C of the planet, rad per time.

The satellite goes round on a circle in the plane of the planet's orbit.)",
                field("spin", &T::spin, "Of the planet at the epoch, rad per time."),
                field("orbit", &T::orbit, "Mean motion of the planet, rad per time."),
                field("star", &T::star, "K of the star, 1 per time.", 0.0),
                field("satellite", &T::satellite, "K of the satellite, 1 per time.", 0.0),
                field("satellite_orbit", &T::satellite_orbit,
                      "Mean motion of the satellite at the epoch, rad per time.", 0.0),
                field("satellite_momentum", &T::satellite_momentum,
                      "Of its orbit over C of the planet, rad per time.", 0.0));
  m.def("tidal_rate", &secular::tidal_rate, "k2"_a, "lag"_a, "gm"_a, "mass_ratio"_a, "radius"_a,
        "inertia_factor"_a, "semi_major_axis"_a,
        R"(K = 3 k2 lag gm m R^3 / (M a^6) / (C / M R^2), 1 per time.

Parameters
----------
k2, lag : Love number of the planet and its time lag, a time.
gm : of the body that raises the tide, length^3 / time^2.
mass_ratio : its mass m over that of the planet, M.
radius : R of the planet, a length.
inertia_factor : C / M R^2 of the planet.
semi_major_axis : a, a length.)");
}

// ra and dec of the equator of J2000, along ecliptic-J2000.
FloatArray pole_of(const std::string& name) {
  const secular::PlanetSpin& of = secular::known_planet(name);
  Result pole({}, {3});
  const Vec3 s = secular::planet_pole(of);
  for (int i = 0; i < 3; ++i) pole.at(0)[i] = s[i];
  return pole.take();
}

FloatArray insolation(const ArrayLike& obliquity, const ArrayLike& pericentre,
                      const ArrayLike& eccentricity, const ArrayLike& latitude,
                      const ArrayLike& longitude, const ArrayLike& flux) {
  Numbers in[] = {Numbers(obliquity, "obliquity"),       Numbers(pericentre, "pericentre"),
                  Numbers(eccentricity, "eccentricity"), Numbers(latitude, "latitude"),
                  Numbers(longitude, "longitude"),       Numbers(flux, "flux")};
  const Shape shape = broadcast(in);
  Result result(shape, {});
  for_each(size_of(shape), [&](std::size_t k) {
    const secular::SpinAngles angles{in[0][k], 0.0, in[1][k], 0.0};
    *result.at(k) = secular::daily_insolation(angles, in[2][k], {in[3][k], in[4][k], in[5][k]});
  });
  return result.take();
}

void bind_known(nb::module_& m) {
  m.def(
      "shipped_orbit",
      [](const std::string& name, double year) { return secular::shipped_orbit(name, year); },
      "name"_a, "year"_a = 1.0,
      R"(The orbit of the Earth or Mars over 20 million years on either side of J2000.

From an integration of the planets with REBOUND; the Earth stands for its barycentre with the Moon.
Axes ecliptic-J2000.

Parameters
----------
name : "earth" or "mars".
year : what a Julian year is in the unit of time wanted: 1e-3 for times in kyr.)");
  m.def(
      "planet_rates",
      [](const std::string& name, double year) {
        return secular::planet_rates(secular::known_planet(name), year);
      },
      "name"_a, "year"_a = 1.0,
      "PrecessionRates of \"earth\" or \"mars\" as published, in rad per unit of time; `year` as "
      "in "
      "shipped_orbit.");
  m.def("planet_pole", pole_of, "name"_a,
        "(3,): the north pole of \"earth\" or \"mars\" at J2000 (IAU), along ecliptic-J2000.");
  m.def("daily_insolation", insolation, "obliquity"_a, "pericentre"_a, "eccentricity"_a,
        "latitude"_a, "longitude"_a, "flux"_a = 1.0,
        R"(The sunlight of a day, the mean over a rotation (Berger 1978).

Parameters
----------
obliquity, pericentre, eccentricity : as in a SpinHistory; any shapes that broadcast.
latitude : from -pi/2 to pi/2; NaN outside.
longitude : of the star as seen from the planet, from the moving equinox; pi/2 is the northern
    summer solstice.
flux : at the semi-major axis.)");
}

}  // namespace

void bind_planet_data(nb::module_& m) {
  bind_tides(m);
  bind_known(m);
}

}  // namespace polhode::python
