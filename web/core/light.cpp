// SPDX-License-Identifier: MIT
// The brightness of an ellipsoid in one attitude.
#include "numbers.hpp"
#include "polhode/light/aspect.hpp"
#include "polhode/light/lommel_seeliger.hpp"
#include "polhode_web.h"

using namespace polhode;
using namespace polhode::web;

double polhode_brightness(const double* light, const double* q) {
  const Quaternion back = conj(normalized(quaternion(q)));
  return light::lommel_seeliger_brightness(light::Ellipsoid{light[0], light[1], light[2]},
                                           rotate(back, vector(light + 3)),
                                           rotate(back, vector(light + 6)));
}

double polhode_phase_angle(const double* to_sun, const double* to_observer) {
  light::LightPoint point;
  point.to_sun = vector(to_sun);
  point.to_observer = vector(to_observer);
  return light::aspect(point).phase_angle;
}
