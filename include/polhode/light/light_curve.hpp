// SPDX-License-Identifier: MIT
// LightCurve: how bright a body was, seen from one place during one session of observation.
//
// Units       t in any unit of time from any epoch; flux in any unit, the same throughout a session
//             and, where sessions are calibrated, in all of them; to_sun and to_observer in any
//             unit of length, along the inertial axes I.
// Domain      flux > 0, or noise about it; sigma > 0, its standard deviation. Magnitudes become
//             fluxes when they are read (polhode/light/magnitudes.hpp). The vectors go from the
//             body to the Sun and to the observer at time t, 0 where they are unknown. A relative
//             session has a factor of its own, which nothing but its points determines.
// Accuracy    plain values.
// Errors      none; polhode/light/light_curve_checks.hpp says what is wrong with one.
// Cost        72 bytes a point.
#pragma once

#include <string>
#include <vector>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

struct LightPoint {
  double t = 0.0;
  double flux = 0.0;
  double sigma = 0.0;  // of the flux
  Vec3 to_sun = {};    // from the body, along I
  Vec3 to_observer = {};

  bool operator==(const LightPoint&) const = default;
};

struct LightCurve {
  std::string name;
  bool is_calibrated = false;
  std::vector<LightPoint> points;

  bool operator==(const LightCurve&) const = default;
};

}  // namespace v0
}  // namespace polhode
