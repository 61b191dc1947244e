// SPDX-License-Identifier: MIT
// likely_periods(): which periods of a tumbler the whole Fourier series of a light curve speaks
// for.
//
// Equations   f_phi and f_psi are read from any two of the three strongest lines of the series,
//             each as one of the strong lines of a tumbler, j f_phi + k f_psi with |j|, |k| <= 2
//             and few beyond; every line of the series is then j f_phi + k f_psi for some j, k.
//             Ranked by sum p ln s, p the share of a line in the power of the series, s the share
//             that the line of these j, k has in the light of ellipsoids on average, by mode.
// Units       frequencies in turns per unit of time, periods in that unit.
// Domain      a series with two lines of different directions. In short-axis mode P_psi > P_phi. It
//             says what is likely for an ellipsoid; bodies without its symmetry have weak lines
//             where it has none, which costs ln 1000 of their share.
// Accuracy    docs/design/0053-light-labels.md has how high the true periods stand in the list.
// Errors      none; nothing is found where all amplitudes but one vanish.
// Cost        some 1000 labels looked at: a millisecond.
#pragma once

#include <vector>

#include "polhode/fit/fourier_fit.hpp"
#include "polhode/fit/inertia_from_periods.hpp"

namespace polhode {
inline namespace v0 {

struct LikelyPeriods {
  TumblerPeriods periods;
  double score;  // the mean of ln s, below 0
};

// The most likely first; those that are the same to 1e-3 once.
std::vector<LikelyPeriods> likely_periods(const FourierFit& fit);

}  // namespace v0
}  // namespace polhode
