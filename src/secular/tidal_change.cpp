// SPDX-License-Identifier: MIT
#include "polhode/secular/detail/tidal_change.hpp"

#include <cmath>

namespace polhode {
inline namespace v0 {
namespace detail {

TidalSpin tidal_change(const TidalRates& tides, double e2, const Vec3& n, const TidalSpin& at) {
  const double c = dot(at.s, n), w = tides.spin * at.spin;
  const double r = 1.0 / (1.0 - e2), r2 = r * r, r4 = r2 * r2;
  const double f = (1.0 + e2 * (3.0 + 0.375 * e2)) * r4 * std::sqrt(r);
  const double N = (1.0 + e2 * (7.5 + e2 * (5.625 + 0.3125 * e2))) * r4 * r2;
  const double root = std::sqrt(at.distance), d3 = at.distance * at.distance * at.distance;
  const double moon = tides.satellite / (d3 * d3);
  const double month = tides.satellite_orbit / (at.distance * root);
  // sums over star and satellite of K f and K N m
  const double drag = tides.star * f + moon, drive = tides.star * N * tides.orbit + moon * month;
  TidalSpin change{(drive / w - 0.5 * drag * c) * (n - c * at.s),
                   (drive * c - 0.5 * drag * w * (1.0 + c * c)) / tides.spin, 0.0};
  if (moon > 0.0) change.distance = 2.0 * root * moon * (w * c - month) / tides.satellite_momentum;
  return change;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
