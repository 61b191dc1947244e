// SPDX-License-Identifier: MIT
// What the solution of a fit says of the attitude at other times, with the error that is left: for
// observations to come, and to hold observations against that were not fitted.
//
// Equations   predicted() of polhode/fit/spin_fit.hpp, with torques or jumps that of
//             polhode/fit/driven_spin_fit.hpp: the covariance of the unknowns, carried by the
//             derivatives of the motion to the rotation vector of the attitude in body axes.
// Units       core units; texts and files in the units of the scenario.
// Domain      any times, before and after what was observed, in any order. Covariances are of first
//             order in the errors: beyond a radian they say that the attitude is not known.
// Accuracy    that of the derivatives.
// Errors      DomainError for what is no time, and where a driven motion does not reach it. Files:
//             OutputError.
// Cost        free rotation 0.1 ms and a microsecond a time; driven as an iteration of the fit.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/run/fit.hpp"
#include "polhode/run/light_report.hpp"

namespace polhode {
inline namespace v0 {

struct AttitudePrediction {
  PredictedAttitude raw;  // with errors as they were given
  // Of the solution with scaled errors; none where there is none.
  std::optional<PredictedAttitude> scaled;
};
std::vector<AttitudePrediction> fit_predictions(const FitReport& report, std::size_t solution,
                                                std::span<const double> times);
// Of light curves: along the body axes of the solution (light_report.hpp).
std::vector<AttitudePrediction> fit_predictions(const LightReport& report, std::size_t solution,
                                                std::span<const double> times);

// From words: numbers in the unit of time of the file ("1500"), dates with a time scale or in that
// of the epoch ("2004-10-07T13:56:00 UTC").
std::vector<double> prediction_times(const Scenario& scenario, std::span<const std::string> words);
// The rows of [time]; DomainError where the file has none.
std::vector<double> prediction_times(const Scenario& scenario);

// For people, of a solution: Euler angles, and errors about the three body axes.
std::string prediction_text(const Scenario& scenario,
                            std::span<const AttitudePrediction> predictions);

// A row for each time: the quaternion of the body axes of the file and the rate along them; errors
// about them and their correlations, with errors as they were given and scaled.
void write_predictions(const Scenario& scenario, std::span<const AttitudePrediction> predictions,
                       const std::string& path);

}  // namespace v0
}  // namespace polhode
