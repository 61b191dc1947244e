// SPDX-License-Identifier: MIT
#include "polhode/orbit/mean_ellipse.hpp"

#include <cmath>

#include "polhode/orbit/kepler_equation.hpp"

namespace polhode {
inline namespace v0 {

Vec3 on_ellipse(double a, double e, double mean_anomaly, double pericentre) {
  const KeplerAnomaly at = eccentric_anomaly(mean_anomaly, Eccentricity::of(e));
  // not cos E - e: cancels
  const double x = a * ((1.0 - e) - at.versine), y = a * std::sqrt((1.0 - e) * (1.0 + e)) * at.sine;
  const double c = std::cos(pericentre), s = std::sin(pericentre);
  return {c * x - s * y, s * x + c * y, 0.0};
}

}  // namespace v0
}  // namespace polhode
