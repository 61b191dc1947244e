// SPDX-License-Identifier: MIT
// ScenarioRun: a scenario's run into files that may be stopped, killed and resumed.
//
// Equations   those of the system.
// Units       t in core units; rows in those of the scenario.
// Domain      a scenario with [time]; files and checkpoints as in polhode/run/resumable_run.hpp.
// Errors      the constructor as there. run() as polhode::run, and RunInterrupted when `stop` said
//             so.
// Cost        memory does not grow with the length of the run.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "polhode/run/resumable_run.hpp"
#include "polhode/run/run.hpp"

namespace polhode {
inline namespace v0 {

struct RunFiles {
  std::vector<std::string> outputs;  // what open_sink takes
  std::string events = {};           // PATH.csv; empty: none
};

class ScenarioRun : public ResumableRun {
 public:
  // Opens every output. `scenario` must outlive it.
  ScenarioRun(const Scenario& scenario, RunFiles files, RunOptions options);

  // Once.
  RunReport run();

 private:
  class Parts;
};

}  // namespace v0
}  // namespace polhode
