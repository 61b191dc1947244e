// SPDX-License-Identifier: MIT
// A run of a scenario between two steps, and how it is watched, stopped and continued.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "polhode/run/run.hpp"
#include "polhode/trajectory/state_bytes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// What the rest of the run depends on, in addition to the scenario.
struct RunState {
  static constexpr int lead_in = 0;  // to the first row, from t = 0
  static constexpr int rows = 1;     // integrated
  static constexpr int free = 2;     // exact: by the number of rows, and the search for events

  int stage = lead_in;
  double t = 0.0;
  std::int64_t pushed = 0;  // rows, into the sinks
  std::string integration;  // bytes of a Checkpoint, or of that search
  Statistics before{};      // of the lead-in
  DampedSample first{};     // where the rows start
  DampedSample latest{};    // of the rows pushed

  void transfer(StateBytes& bytes) {
    bytes.all(stage, t, pushed, integration, before, first, latest);
  }
};

struct RunControl {
  Progress progress = {};
  std::function<void(const DampedEventRecord&)> event = {};  // empty: the report has them
  std::function<bool(double t)> due = {};                    // whether to keep the state now
  std::function<void(const RunState&)> keep = {};
  const RunState* from = nullptr;
};

// What an EventTable holds: the columns of a row, with name in front and direction behind t.
std::vector<ColumnGroup> event_groups(const RowLayout& layout);

RunReport run_rows(const Scenario& scenario, const RowLayout& layout,
                   std::span<const std::unique_ptr<Sink>> sinks, const RunControl& control);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
