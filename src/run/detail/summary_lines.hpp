// SPDX-License-Identifier: MIT
// Lines of a summary, from numbers in core units.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "polhode/run/summary.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

class Lines {
 public:
  explicit Lines(const Units& units) : units_(units) {}

  void number(const std::string& key, const std::string& label, double core, Dimension dimension) {
    if (std::isfinite(core)) numbers(key, label, {core}, dimension);
  }
  void numbers(const std::string& key, const std::string& label, std::vector<double> core,
               Dimension dimension) {
    for (double& x : core) x = units_.from_core(x, dimension);
    const std::string unit = units_.label(dimension);
    lines_.push_back({key, label, std::move(core), {}, unit == "1" ? "" : unit});
  }
  void text(const std::string& key, const std::string& label, const std::string& value) {
    if (!value.empty()) lines_.push_back({key, label, {}, value, {}});
  }
  std::vector<SummaryLine> take() { return std::move(lines_); }

 private:
  const Units& units_;
  std::vector<SummaryLine> lines_;
};

// Mode and periods of a free rotation; `rotation` tells whether anything acts on it.
void add_mode(Lines& lines, const Rotation& rotation, const FreeRotation& motion);
void add_periods(Lines& lines, const FreeRotation& motion);
// The direction of the momentum, along the inertial axes of `rotation`.
void add_pole(Lines& lines, const Rotation& rotation, const RotorState& inertial);

// The numbers of the torques, and the values that each table of the scenario leaves to defaults.
void add_table_values(Lines& lines, const Scenario& scenario);

// Where a run ended, what it cost, its events. What was evaluated in its steps: "perturbations";
// empty where nothing was integrated.
void add_report(Lines& lines, const RunReport& report, const std::string& evaluated,
                const std::string& events);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
