// SPDX-License-Identifier: MIT
// A run of a scenario between two steps, and how it is watched, stopped and continued: the same of
// every experiment. What moves is in bytes that the experiment writes and reads.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/run/run.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct RunState {
  double t = 0.0;
  std::int64_t rows = 0;  // in the sinks
};
// Writes what moves, which depends on the experiment.
using WriteMotion = std::function<void(Archive&)>;

struct RunControl {
  Progress progress = {};
  std::function<void(const RunEvent&)> event = {};  // empty: the report has them
  bool events_have_rows = false;
  std::function<bool(double t)> due = {};  // whether to keep the state now
  std::function<void(const RunState&, const WriteMotion&)> keep = {};
  // If the run is resumed: the number of its rows in the sinks, and the archive that WriteMotion
  // filled.
  std::int64_t rows = 0;
  Archive* motion = nullptr;
};

// What an EventTable holds: the columns of a row, with name in front and direction behind t.
std::vector<ColumnGroup> event_groups(std::vector<ColumnGroup> of_rows);

RunReport run_rows(const Scenario& scenario, std::span<const std::unique_ptr<Sink>> sinks,
                   const RunControl& control);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
