// SPDX-License-Identifier: MIT
// Aspect: how a point of a light curve was lit and seen, and brightness at unit distances.
//
// Equations   with s and o the unit vectors from the body to the Sun and to the observer: phase
//             angle, the angle between s and o; bisector (s + o) / |s + o|, the direction PAB of
//             asteroids. Reduced: m - 5 log10(r delta), flux (r delta)^2, where r and delta are the
//             distances in the unit that is asked for.
// Units       radians; distances in the unit of the vectors.
// Domain      vectors that are not 0; where one is, everything that needs it is NaN. The bisector
//             of opposite directions is NaN.
// Accuracy    a few roundings; small phase angles keep their digits.
// Errors      at_unit_distances: DomainError for a unit that is not above 0, or a point without
//             vectors.
// Cost        some tens of flops and an arc tangent.
#pragma once

#include <cmath>
#include <limits>

#include "polhode/light/light_curve.hpp"
#include "polhode/light/scattering.hpp"

namespace polhode {
inline namespace v0 {
namespace light {

struct Aspect {
  double sun_distance;
  double observer_distance;
  double phase_angle;
  Vec3 bisector;  // of length 1
};

inline Aspect aspect(const LightPoint& p) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const double r = norm(p.to_sun), delta = norm(p.to_observer);
  const double r1 = r > 0.0 ? r : none, delta1 = delta > 0.0 ? delta : none;
  const Vec3 s = (1.0 / r1) * p.to_sun, o = (1.0 / delta1) * p.to_observer;
  const Vec3 sum = s + o;
  const double length = norm(sum);
  return {r1, delta1, phase_angle(s, o), (1.0 / (length > 0.0 ? length : none)) * sum};
}

inline double reduced_magnitude(double magnitude, double sun_distance, double observer_distance) {
  return magnitude - 5.0 * std::log10(sun_distance * observer_distance);
}

// Fluxes as they were at distances of one `unit`, in units of the vectors, from both.
LightCurve at_unit_distances(LightCurve curve, double unit);

}  // namespace light
}  // namespace v0
}  // namespace polhode
