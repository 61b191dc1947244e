// SPDX-License-Identifier: MIT
// What a body does, in a few lines: mode, periods, momentum, energy, modulus of its free motion;
// what acts on it, how it is propagated, and how a run went. An experiment from outside has the
// facts that it gives.
//
// Equations   those of FreeRotation and of the tumbler.
// Units       those of the scenario; each line names its own.
// Domain      any scenario. What does not exist is left out: psi_max outside short-axis mode,
//             periods of a motion that has none. Where something acts, mode to modulus are those of
//             the free motion through the state at t = 0.
// Accuracy    that of FreeRotation.
// Cost        negligible.
#pragma once

#include <string>
#include <vector>

#include "polhode/run/run.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

struct SummaryLine {
  std::string key;              // "precession_period"
  std::string label;            // "precession period P_phi"
  std::vector<double> numbers;  // one, or the three of a triple; none for a text
  std::string text;
  std::string unit;  // empty for pure numbers and texts
};

std::vector<SummaryLine> summary(const Scenario& scenario);

// How a run went: where it ended, what it cost, the change of energy, events. Nothing for a free
// motion without events. `events` says where all of them are, when there are many.
std::vector<SummaryLine> report_lines(const Scenario& scenario, const RunReport& report,
                                      const std::string& events);

// A number of the line `key` for people: ten digits; of psi_max, a bound, none above it, so that
// the number printed is one that is allowed.
std::string shown_number(const std::string& key, double number);
// For people: one aligned line each.
std::string summary_table(const std::vector<SummaryLine>& lines);
// For programs: { "precession_period": { "value": ..., "unit": "h" }, ... }, every digit.
std::string summary_json(const std::vector<SummaryLine>& lines);

}  // namespace io
}  // namespace v0
}  // namespace polhode
