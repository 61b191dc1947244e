// SPDX-License-Identifier: MIT
// Bodies that tumble with two given periods: where a fit of moments and attitude starts.
//
// Equations   P_phi = 2 pi / precession_rate_long, P_psi = polhode_period (free/free_rotation.hpp)
//             depend on the momentum by its size alone, so that P_psi / P_phi is one equation for
//             the ratios I1/I3 and I2/I3 of moments I1 < I2 < I3 and for the tilt: the most that
//             the axis of circulation, long or short, leans from the momentum. A tilt picks a curve
//             in the plane of ratios, I2/I3 the point of it.
// Units       periods in the unit of time, tilt in radians; moments in units of the greatest.
// Domain      mode short_axis or long_axis, tilt in (0, pi/2), I2/I3 in (1/2, 1).
// Accuracy    budget periods_of_body in tests/budgets/fit.hpp.
// Errors      DomainError for periods that are not positive, another mode, a tilt or ratio beyond
//             the domain, and where no body of this tilt and ratio has these periods (with the
//             P_psi/P_phi that there are).
// Cost        ten to twenty preparations of a FreeRotation: tens of microseconds.
#pragma once

#include <cstddef>
#include <vector>

#include "polhode/free/free_rotation.hpp"

namespace polhode {
inline namespace v0 {

struct TumblerPeriods {
  Regime mode;  // short_axis or long_axis
  double precession_period;
  double rotation_period;
};

struct TumblingBody {
  Body body;         // I1/I3, I2/I3, 1 about b1, b2, b3
  RotorState state;  // momentum along the third inertial axis, at the tilt
};

TumblingBody body_with_periods(const TumblerPeriods& periods, double tilt, double middle);

// The curve of a tilt: those of `count` evenly spaced I2/I3 that exist; maybe none.
std::vector<TumblingBody> inertia_from_periods(const TumblerPeriods& periods, double tilt,
                                               std::size_t count);

}  // namespace v0
}  // namespace polhode
