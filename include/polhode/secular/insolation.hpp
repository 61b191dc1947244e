// SPDX-License-Identifier: MIT
// The sunlight that falls on a planet in a day.
//
// Equations   W = S / (pi rho^2) (H sin(phi) sin(delta) + cos(phi) cos(delta) sin(H)) of the
//             latitude phi, with sin(delta) = sin(obliquity) sin(lambda), cos(H) = -tan(phi)
//             tan(delta), rho = (1 - e^2) / (1 + e cos(v)), and v = lambda + pi - varpi the true
//             anomaly (Berger 1978).
// Units       rad; W in that of S, the flux at the semi-major axis.
// Domain      0 <= e < 1, latitudes from -pi/2 to pi/2, any lambda: the longitude of the star as
//             seen from the planet, from the moving equinox; pi/2 is the northern summer solstice.
// Accuracy    rounding.
// Errors      NaN for a latitude outside the domain.
// Cost        100 ns.
#pragma once

#include "polhode/secular/spin_precession.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

// Where and when, and S.
struct InsolationPlace {
  double latitude;
  double longitude;  // lambda
  double flux = 1.0;
};

// The mean over a rotation.
double daily_insolation(const SpinAngles& angles, double eccentricity,
                        const InsolationPlace& place);

}  // namespace secular
}  // namespace v0
}  // namespace polhode
