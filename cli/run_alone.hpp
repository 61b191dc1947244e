// SPDX-License-Identifier: MIT
// Runs one member of an ensemble or one cell of a map by itself, or writes its scenario.
#pragma once

#include <string>
#include <vector>

#include "polhode/run/scenario_run.hpp"
#include "polhode/scenario/scenario.hpp"
#include "resumable_work.hpp"

namespace polhode::cli {

struct Alone {
  std::string option;    // "--member"
  std::string called;    // "member 7"
  std::string scenario;  // the name of the whole
};

// Writes the text of its scenario into each PATH.toml of --out, or prints it if --out has no path.
// Returns the other paths, which are for its rows.
std::vector<std::string> write_scenario_of(const Alone& one, const std::string& text,
                                           const WorkOptions& options);

// Throws if `failure` says why it failed.
void require_done(const Alone& one, const std::string& failure);

// Writes its rows to these paths.
void run_alone(const Alone& one, const io::Scenario& scenario, const std::vector<std::string>& rows,
               io::RunOptions how);

}  // namespace polhode::cli
