// SPDX-License-Identifier: MIT
// VariedScenario: a scenario with other numbers at some of its keys, made again and again: a cell
// of a map, a member of an ensemble, the torques of a fit.
//
// Units       every number in the unit that its key has in the file.
// Domain      keys of numbers, "body.moments[1]", as MapPlan, EnsemblePlan and FitDrive have them.
// Accuracy    `text` reads back to the same numbers, to the last bit.
// Errors      ScenarioError, as a file with these numbers would be rejected. `text`: DomainError if
//             the text cannot hold them.
// Cost        about 20 us for an experiment: text is not read, and files, tables and meshes are
//             shared with the scenario unless a number below them varies. `text` reads the text a
//             few times for each key.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

class VariedScenario {
 public:
  // The scenario must outlive it.
  VariedScenario(const Scenario& scenario, std::span<const std::string> keys);
  ~VariedScenario();
  VariedScenario(const VariedScenario&) = delete;
  VariedScenario& operator=(const VariedScenario&) = delete;

  // All below may be called from any thread.
  Experiment experiment(std::span<const double> numbers) const;
  // The text of the file with these numbers, without [ensemble].
  std::string text(std::span<const double> numbers) const;
  // The scenario of that text, which may have comments of its own.
  Scenario scenario(std::span<const double> numbers, std::string text) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace io
}  // namespace v0
}  // namespace polhode
