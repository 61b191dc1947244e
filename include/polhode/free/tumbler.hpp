// SPDX-License-Identifier: MIT
// TumblerState: a free rotation as observers of asteroids describe it: pole of the angular
// momentum, precession period, rotation period, mode, and two phase angles.
//
// Equations   long-axis convention of Kaasalainen (2001): 3-1-3 angles phi, theta, psi of tumbler
//             axes (x, y, z) = (intermediate, short, long), attitude from tumbler to inertial axes
//               q = qz(longitude) qy(pi/2 - latitude) qz(phi) qx(theta) qz(psi)
//             so that the third axis of the frame of phi is the momentum and phi = 0 puts the node
//             along qz(longitude) qy(pi/2 - latitude) e_x, which points south of the pole. psi = 0
//             when the momentum lies in the long-short plane. The drawing is in
//             docs/guide/tumblers.md. P_phi is the mean period of phi, P_psi the period of psi: the
//             polhode period.
// Units       periods in the time unit, angles in radians, pole a vector of any length in inertial
//             axes.
// Domain      short_axis (SAM): psi oscillates, |psi0| <= psi_max, and `branch` = 1 | -1 picks the
//             sign of cos theta at the epoch. long_axis (LAM): psi circulates; branch is the lobe,
//             the sign of cos theta. `sense` = -1 is a SAM whose momentum is on the far side of the
//             short axis (psi about pi); the catalogues have no sign for it. Equal lesser moments
//             have no LAM, equal greater moments no SAM, a sphere neither.
//             Limit: in to_tumbler a pole along the third inertial axis, to rounding, has
//             longitude 0, and phi0 holds all of the turn.
// Accuracy    budget tumbler_round_trip for |psi| <= 0.9 psi_max; psi0 loses half its digits at
//             psi_max, and more where nearly equal lesser moments put psi_max next to pi/2:
//             sqrt(2 eps / (k + b/k)) of the momentum, k its part along the short axis and
//             b = (I2 - I1)/(I3 - I1). Next to the middle axis psi0 = psi_max holds the state down
//             to k'^2 = 1e-220.
// Errors      DomainError: periods that no motion of this body in this mode has (with the bound of
//             P_psi/P_phi) or that lie too close to the separatrix to be held, |psi0| > psi_max
//             modulo a turn and rounding (with psi_max), non-positive periods or ones beyond double
//             range, a zero pole, a branch or sense that is no sign.
// Cost        about a hundred microseconds (a root in double-double).
#pragma once

#include "polhode/free/free_rotation.hpp"

namespace polhode {
inline namespace v0 {

struct TumblerState {
  double precession_period;  // P_phi of the long axis about the momentum
  double rotation_period;    // P_psi about the long axis
  Vec3 pole;                 // direction of the momentum, inertial axes
  Regime mode;               // short_axis or long_axis
  double phi0;
  double psi0;
  int branch = 1;
  int sense = 1;

  constexpr bool operator==(const TumblerState&) const = default;
};

// The state at the epoch of the angles.
RotorState to_rotor(const Body& body, const TumblerState& s);

// The description at time t. DomainError where there is none: steady rotation, separatrix, rest.
TumblerState to_tumbler(const FreeRotation& motion, double t);

// P_phi of the long axis where that of the short one is known: 1/P_phi = 1/P_short - 1/P_psi, in
// both modes. DomainError unless 0 < P_short < P_psi.
double long_axis_period(double short_axis_period, double rotation_period);

// Between which angles the long and the short axis of the body swing about the momentum, rad; a
// whole polhode. NaN where there is none: steady rotation, separatrix, rest.
struct TumblingAngles {
  double long_least, long_most;
  double short_least, short_most;
};
TumblingAngles tumbling_angles(const FreeRotation& motion);

// Largest |psi| of a motion in short-axis mode; NaN in other regimes.
double psi_max(const FreeRotation& motion);

// The least P_psi/P_phi that the body has in a mode: small polhodes. Towards the separatrix it
// rises like a logarithm, and soon beyond what a momentum in double precision can hold. DomainError
// where the body does not have the mode.
double least_period_ratio(const Body& body, Regime mode);

}  // namespace v0
}  // namespace polhode
