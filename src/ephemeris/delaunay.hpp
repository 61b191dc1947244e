// SPDX-License-Identifier: MIT
// Moon and Sun as functions of Delaunay's arguments, as theories of nutation need them: analysed by
// harmonics with the arguments as independent variables.
//
// Equations   arguments: mean anomaly l of the Moon and l' of the Sun, F = mean longitude of the
//             Moon less that of its node, D = Moon less Sun, Om = that of the node. Moon: series of
//             Meeus (1998), chapter 47, a truncation of ELP2000-82, with the terms that the
//             flattening of the Earth makes and without those of the planets. Sun: Kepler's ellipse
//             of the barycentre of Earth and Moon, seen from the centre of the Earth.
// Units       rad and km; T in Julian centuries of TDB from J2000.
// Domain      mean ecliptic and equinox of date, |T| up to some centuries.
// Accuracy    Moon: that of eraMoon98 to 15 arcsec, which is the term of Venus; Sun: some 20 arcsec
//             (perturbations by the planets).
// Cost        0.5 us for the Moon.
#pragma once

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace ephemeris {

struct DelaunayArguments {
  double l, lp, F, D, Om;
};

DelaunayArguments delaunay_arguments(double T);
// rad per Julian century.
DelaunayArguments delaunay_rates(double T);

struct EclipticPosition {
  double longitude, latitude, distance;
};

// Seen from the centre of the Earth. Eccentricities are those of T.
EclipticPosition moon_of_date(const DelaunayArguments& arguments, double T);
Vec3 sun_of_date(const DelaunayArguments& arguments, double T);

// Axis 1 to the equinox, axis 3 to the pole of the ecliptic.
Vec3 cartesian(const EclipticPosition& position);

}  // namespace ephemeris
}  // namespace v0
}  // namespace polhode
