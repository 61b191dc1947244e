// SPDX-License-Identifier: MIT
// A point of a Kepler ellipse by its mean anomaly, where the anomaly is an argument of its own and
// no function of time: theories by harmonics ask for it on grids.
//
// Equations   r = a (cos E - e, sqrt(1 - e^2) sin E), E - e sin E = M, turned by the longitude of
//             the pericentre.
// Units       those of a; radians.
// Domain      0 <= e < 1, any finite angles.
// Accuracy    budget kepler_*.
// Errors      none: NaN for e < 0, e >= 1 and NaN.
// Cost        150 ns.
#pragma once

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

// In the plane of axes 1 and 2; `pericentre` is its longitude, from axis 1.
Vec3 on_ellipse(double a, double e, double mean_anomaly, double pericentre);

}  // namespace v0
}  // namespace polhode
