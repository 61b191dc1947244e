// SPDX-License-Identifier: MIT
// Any bytes are a scenario or one ScenarioError: never a crash, never another exception. What is a
// scenario has rows, finite ones where the motion is free.
#include "polhode/scenario/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "fuzz.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/run/run.hpp"
#include "polhode/run/summary.hpp"

namespace {

using fuzz::require;

void check_message(std::string_view message) {
  require(!message.empty() && message.starts_with("fuzz:"));
  for (const char c : message) require((c >= 0x20 && c < 0x7f) || c == '\n');
}

// Axes of a body at rest are NaN, and so may be what an orbit gives at times beyond double.
bool has_every_number(const polhode::io::Scenario& scenario) {
  const auto asked = [&](const char* group) {
    return std::find(scenario.output.columns.begin(), scenario.output.columns.end(), group) !=
           scenario.output.columns.end();
  };
  return !asked("axes") && !asked("axes_rel") && scenario.rotation().orbits.empty() &&
         scenario.rotation().frame.is_inertial() && scenario.rotation().terms.empty() &&
         !scenario.rotation().damper;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polhode;
  try {
    const io::Scenario scenario = io::scenario_from_text(fuzz::text_of(data, size), "fuzz");
    const FreeRotation motion = io::free_rotation(scenario);
    require(!io::summary_table(io::summary(scenario)).empty());
    require(!io::provenance(scenario).notes.empty());
    const io::RowLayout layout = io::row_layout(scenario);
    const double last = scenario.rotation().time
                            ? (*scenario.rotation().time)[scenario.rotation().time->size() - 1]
                            : 1.0;
    const double times[] = {0.0, last};
    std::vector<double> rows(2 * layout.width());
    if (scenario.rotation().terms.empty() && scenario.rotation().frame.is_inertial() &&
        !scenario.rotation().damper) {
      layout.write_rows(motion, times, rows);
    } else {
      // the terms and the frame at both times, without the integration
      const System system = io::rotor_system(scenario);
      const RotorState s = io::initial_state(scenario);
      const SystemState damped{s.q, s.g, scenario.rotation().damper_rate};
      const Sample samples[] = {{0.0, damped}, {last, damped}};
      layout.write_rows({system, 0.0}, samples, rows);
    }
    if (has_every_number(scenario))
      for (const double number : rows) require(!std::isnan(number));
  } catch (const io::ScenarioError& error) {
    check_message(error.what());
  }
  return 0;
}
