// SPDX-License-Identifier: MIT
// Any bytes are a scenario or one ScenarioError: never a crash, never another exception. What is a
// scenario has finite rows.
#include "polhode/io/scenario.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "polhode/io/columns.hpp"
#include "polhode/io/summary.hpp"

namespace {

void require(bool good) {
  if (!good) std::abort();
}

void check_message(std::string_view message) {
  require(!message.empty() && message.starts_with("fuzz:"));
  for (const char c : message) require((c >= 0x20 && c < 0x7f) || c == '\n');
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polhode;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const Scenario scenario = scenario_from_text(text, "fuzz");
    const FreeRotation motion = free_rotation(scenario);
    require(!summary_table(summary(scenario, motion)).empty());
    const RowLayout layout(scenario.columns, scenario.units);
    const double times[] = {0.0, scenario.time ? (*scenario.time)[scenario.time->size() - 1] : 1.0};
    std::vector<double> row(2 * layout.width());
    layout.write_rows(motion, times, row);
    for (const double number : row) require(!std::isnan(number));
  } catch (const ScenarioError& error) {
    check_message(error.what());
  }
  return 0;
}
