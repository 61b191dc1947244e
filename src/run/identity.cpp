// SPDX-License-Identifier: MIT
#include "run/detail/identity.hpp"

#include <exception>
#include <string_view>

#include "polhode/trajectory/state_bytes.hpp"
#include "polhode/version.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

std::string fingerprint_text(std::string_view bytes) {
  return "mark " + std::to_string(fingerprint(bytes));
}

// The same text and files may mean something else to another build.
std::string surroundings_of(const Scenario& scenario) {
  const DampedProblem problem = rotor_problem(scenario);
  const System system = at_damper_rate(problem.system, problem.initial.damper_rate);
  StateBytes bytes;
  for (int i = 0; i < 16; ++i) {
    const double t = problem.stop * (i / 15.0);
    try {
      Effect e = effect(system, t, problem.initial.rotor);
      bytes.all(e.v, e.u);
    } catch (const std::exception&) {  // the run will say so
      double none = t;
      bytes(none);
    }
  }
  return fingerprint_text(bytes.bytes());
}

}  // namespace

Identity identity_of(const Scenario& scenario, const std::string& outputs,
                     const std::string& columns) {
  const Document& document = scenario.document;
  std::string files;
  for (const ScenarioFile& file : document.files)
    files += (files.empty() ? "" : "; ") + file_note(file);
  return {{"version of polhode", std::string(version())},
          {"outputs", outputs},
          {"columns", columns},
          {"scenario", document.name + " " + std::to_string(document.text.size()) + " bytes, " +
                           fingerprint_text(document.text)},
          {"files of the scenario", files},
          {"orbits and torques", surroundings_of(scenario)}};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
