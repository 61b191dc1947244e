// SPDX-License-Identifier: MIT
#include "run/detail/identity.hpp"

#include <exception>
#include <filesystem>
#include <string_view>
#include <variant>

#include "polhode/trajectory/state_bytes.hpp"
#include "polhode/version.hpp"
#include "run/detail/experiment_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

std::string fingerprint_text(std::string_view bytes) {
  return "mark " + std::to_string(fingerprint(bytes));
}

// The same text and files may mean something else to another build.
std::string surroundings_of(const Rotation& rotation) {
  const DampedProblem problem = rotor_problem(rotation);
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
std::string surroundings_of(const Obliquity& of) {
  StateBytes bytes;
  with_problem(of, [&](const auto& problem) {
    auto start = problem.system.template values<double>(problem.initial);
    for (double& x : start) bytes(x);
    for (int i = 0; i < 16; ++i) {
      auto rates = problem.system.rates(DoubleDouble(problem.stop * (i / 15.0)), start);
      for (double& x : rates) bytes(x);
    }
  });
  return fingerprint_text(bytes.bytes());
}
std::string surroundings_of(const OwnExperiment& own) { return fingerprint_text(own.identity); }

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace

Identity identity_of(const Scenario& scenario, const IdentityOutputs& outputs) {
  const Document& document = scenario.document;
  std::string files, columns;
  for (const ScenarioFile& file : document.files)
    files += (files.empty() ? "" : "; ") + file_note(file);
  for (const std::string& column : outputs.columns)
    columns += (columns.empty() ? "" : " ") + column;
  Identity identity = {
      {"version of polhode", std::string(version())},
      {"columns", columns},
      {"scenario", document.name + " " + std::to_string(document.text.size()) + " bytes, " +
                       fingerprint_text(document.text)},
      {"files of the scenario", files},
      {"method",  // the default of an older build may have been another
       std::visit([&](const auto& kind) { return propagation_text(kind, scenario.units()); },
                  scenario.experiment)},
      {surroundings_part,
       std::visit([](const auto& kind) { return surroundings_of(kind); }, scenario.experiment)}};
  for (const std::string& path : outputs.paths) identity.push_back({"outputs", file_name(path)});
  if (!outputs.events.empty())
    identity.push_back({"outputs", "events " + file_name(outputs.events)});
  return identity;
}

std::string difference(const Identity& theirs, const Identity& ours) {
  for (std::size_t i = 0; i < theirs.size() || i < ours.size(); ++i) {
    const IdentityPart was = i < theirs.size() ? theirs[i] : IdentityPart{ours[i].name, ""};
    const IdentityPart is = i < ours.size() ? ours[i] : IdentityPart{was.name, ""};
    if (was.name != is.name) return is.name + " was not kept, is \"" + is.text + "\"";
    if (was.text != is.text) return is.name + " was \"" + was.text + "\", is \"" + is.text + "\"";
  }
  return {};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
