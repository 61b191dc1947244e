// SPDX-License-Identifier: MIT
#include "polhode/secular/insolation.hpp"

#include <algorithm>
#include <cmath>

namespace polhode {
inline namespace v0 {

double daily_insolation(const SpinAngles& angles, double eccentricity,
                        const InsolationPlace& place) {
  const double half_turn = pi<double>();
  if (!(std::fabs(place.latitude) <= 0.5 * half_turn * (1.0 + 1e-15)) ||
      !(eccentricity >= 0.0 && eccentricity < 1.0))
    return std::nan("");
  const double sine = std::sin(angles.obliquity) * std::sin(place.longitude);
  const double sines = sine * std::sin(place.latitude);
  const double cosines = std::sqrt(std::max(0.0, 1.0 - sine * sine)) * std::cos(place.latitude);
  // cos(H) = -sines / cosines: the star stays up, or down, where that is no cosine
  const double H =
      std::fabs(sines) >= cosines ? (sines > 0.0 ? half_turn : 0.0) : std::acos(-sines / cosines);
  const double e = eccentricity, v = place.longitude + half_turn - angles.pericentre;
  // without an eccentricity the pericentre does not matter
  const double nearness = (e > 0.0 ? 1.0 + e * std::cos(v) : 1.0) / (1.0 - e * e);
  return place.flux / half_turn * nearness * nearness * (H * sines + cosines * std::sin(H));
}

}  // namespace v0
}  // namespace polhode
