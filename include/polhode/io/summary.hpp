// SPDX-License-Identifier: MIT
// What a body does, in a few lines: mode, periods, momentum, energy, modulus.
//
// Equations   those of FreeRotation and of the tumbler.
// Units       those of the scenario; each line names its own.
// Domain      any scenario. What does not exist is left out: psi_max outside short-axis mode,
//             periods of a motion that has none.
// Accuracy    that of FreeRotation.
// Errors      none.
// Cost        negligible.
#pragma once

#include <string>
#include <vector>

#include "polhode/free/free_rotation.hpp"
#include "polhode/io/scenario.hpp"

namespace polhode {
inline namespace v0 {

struct SummaryLine {
  std::string key;              // "precession_period"
  std::string label;            // "precession period P_phi"
  std::vector<double> numbers;  // one, or the three of a triple; none for a text
  std::string text;
  std::string unit;  // empty for pure numbers and texts
};

std::vector<SummaryLine> summary(const Scenario& scenario, const FreeRotation& motion);

// For people: one aligned line each, ten digits.
std::string summary_table(const std::vector<SummaryLine>& lines);
// For programs: { "precession_period": { "value": ..., "unit": "h" }, ... }, every digit.
std::string summary_json(const std::vector<SummaryLine>& lines);

}  // namespace v0
}  // namespace polhode
