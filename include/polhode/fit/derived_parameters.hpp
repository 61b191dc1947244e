// SPDX-License-Identifier: MIT
// DerivedParameters: what a fitted spin state is known by, with its errors: the two periods of a
// tumbler and its pole.
//
// Equations   var f = (df/dx)^T C df/dx for f = P_phi (long axis), P_psi, P_short and the pole;
//             1/P_short = 1/P_phi + 1/P_psi; df/dx by dual numbers through prepared free motion.
// Units       those of the fit; errors of the pole in rad, along the axes of the ellipse that they
//             are on the sky.
// Domain      a covariance whose unknowns have the names that fit_spin and fit_light give them,
//             about `state`; b/a and c/b change moments where `moments_of_shape` says so. Periods
//             are 0 where the regime has none; their errors are NaN where the motion is a
//             degenerate one. Errors are infinite of what depends on an unknown that the data do
//             not determine, those of the pole then both; a correlation with it is NaN.
// Accuracy    first order in the errors; budget derived_parameters in tests/budgets/fit.hpp.
// Errors      DomainError as FreeRotation; for a state without momentum.
// Cost        one preparation with dual numbers: some hundred microseconds.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "polhode/fit/inertia_from_periods.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/fit/spin_fit.hpp"

namespace polhode {
inline namespace v0 {

struct DerivedParameters {
  TumblerPeriods periods;
  double precession_error, rotation_error;
  // Of precession of the short axis, which most papers give for tumblers; 0 as those of `periods`.
  double short_period, short_error;
  double correlation;  // of the two
  // Of the periods, by the unknowns of the covariance; empty where they are 0.
  std::vector<double> precession_slope, rotation_slope;
  Vec3 pole_I;  // of length 1
  double pole_major, pole_minor;
  Vec3 major_I;  // in which direction the pole is known least
};

DerivedParameters derived_parameters(const SpinState& state, const UnknownsCovariance& covariance);
// Of an ellipsoid whose moments follow from its axes, if the fit had them so.
DerivedParameters derived_parameters(const LightSolution& solution, const LightUnknowns& unknowns);
// Of a fit of attitudes: with moments that are held, the period of a wobble has no error.
DerivedParameters derived_parameters(const SpinSolution& solution);
// Attitudes with the errors that a fit of light curves leaves.
std::vector<PredictedAttitude> predicted(const LightSolution& solution,
                                         const LightUnknowns& unknowns,
                                         std::span<const double> times);

}  // namespace v0
}  // namespace polhode
