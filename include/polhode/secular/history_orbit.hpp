// SPDX-License-Identifier: MIT
// HistoryOrbit: where a planet is on an orbit that changes over ages, for what is not averaged over
// the year.
//
// Equations   k, h, q, p of the history at t; mean longitude = longitude + n t from axis 1 of the
//             equinoctial axes, n = sqrt(gm / a^3); Kepler's equation with e = |(k, h)|.
// Units       any time; lengths of a, gm in both.
// Domain      that of the history, NaN outside. a and n do not change, as in secular theory. T =
//             double or DoubleDouble.
// Accuracy    that of the history, and of n, which is rounded: after N turns 2 pi N roundings.
// Errors      DomainError for gm or a that is not positive, for a longitude that is not finite.
// Cost        0.3 us with a table of elements.
#pragma once

#include "polhode/math/vector.hpp"
#include "polhode/orbit/uniform_angle.hpp"
#include "polhode/secular/orbit_history.hpp"

namespace polhode {
inline namespace v0 {

class HistoryOrbit {
 public:
  HistoryOrbit(OrbitHistory elements, double gm, double semi_major_axis, double longitude = 0.0);

  const OrbitHistory& elements() const { return elements_; }
  double gm() const { return gm_; }
  double semi_major_axis() const { return a_; }
  double longitude() const { return angle_.start(); }
  double mean_motion() const { return angle_.rate(); }
  // At the pericentre of t = 0, or of the time of the history next to it.
  double time_scale() const { return time_scale_; }

  Vec3 position(double t) const;
  BasicVec3<DoubleDouble> position(const DoubleDouble& t) const;

 private:
  OrbitHistory elements_;
  double gm_, a_;
  UniformAngle angle_;
  double time_scale_;
};

}  // namespace v0
}  // namespace polhode
