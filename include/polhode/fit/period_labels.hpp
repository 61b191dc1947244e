// SPDX-License-Identifier: MIT
// Labels of a pair of frequencies: which periods of precession and rotation a tumbler may have that
// shows these two lines.
//
// Equations   lines of a light curve are at |j f_phi + k f_psi|, f_phi = 1 / P_phi of the long axis
//             about the momentum, f_psi = 1 / P_psi about it (Kaasalainen 2001; Samarasinha and
//             A'Hearn 1991); a scan may also find half of that, as its series has harmonics. A body
//             with three planes of symmetry, as an ellipsoid, has those alone with k even in
//             long-axis mode, where half a turn about the long axis is half a polhode, and those
//             with j + k even in short-axis mode, where half a turn about the short axis is half a
//             polhode and turns the long axis about. In short-axis mode P_psi > P_phi: the least
//             ratio is 1 / sqrt((I3/I1 - 1)(I3/I2 - 1)), I1 < I2 < I3, which I3 <= I1 + I2 keeps
//             from falling below 1, for flat bodies. In long-axis mode it is 1 / sqrt((1 - I1/I2)(1
//             - I1/I3)) - 1 and thin bodies have any. Ellipsoids have all of the triangle but its
//             flat edge, so that the bounds are theirs, too.
// Units       frequencies in turns per unit of time, periods in that unit.
// Domain      positive frequencies.
// Accuracy    a system of two equations in double.
// Errors      DomainError for frequencies that are not positive, most below 1 or above 9.
// Cost        some (4 most + 4)^4 / 2 labels looked at: half a millisecond.
#pragma once

#include <vector>

#include "polhode/free/free_rotation.hpp"

namespace polhode {
inline namespace v0 {

// (j f_phi + k f_psi) / over, over = 1 or 2.
struct LineLabel {
  int j, k;
  int over = 1;

  bool operator==(const LineLabel&) const = default;
};

struct PeriodLabel {
  Regime mode;  // short_axis or long_axis
  double precession_period;
  double rotation_period;
  LineLabel first, second;  // what f1 and f2 are then
  bool of_ellipsoid;  // whether a body with three planes of symmetry shows both, or twice both
};

// All with |j|, |k| up to `most`, and up to most + 1 of halves. Those of ellipsoids first, then by
// how strong such lines are expected to be: 2 f_phi, 2 (f_phi +- f_psi), then simple ones, then the
// rest, then halves.
std::vector<PeriodLabel> period_labels(double f1, double f2, int most = 2);

// Whether a body can have the periods of a label in its mode.
bool allows(const Body& body, const PeriodLabel& label);

}  // namespace v0
}  // namespace polhode
