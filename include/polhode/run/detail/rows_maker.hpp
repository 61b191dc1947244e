// SPDX-License-Identifier: MIT
// The end of a run of rows, and what an CustomExperiment holds: the run of its rows, whatever its
// state.
#pragma once

#include <cstdint>
#include <functional>

#include "polhode/run/detail/row_writer.hpp"
#include "polhode/run/detail/run_state.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// The report with its counts, and the sinks finished unless the run failed.
inline RunReport completed(RunReport report, RowWriter& writer) {
  report.rows = writer.rows();
  report.events_met = static_cast<std::int64_t>(report.events.size());
  if (report.outcome.ok()) writer.finish();
  return report;
}

struct RowsMaker {
  std::function<RunReport(RowWriter&, const RunControl&)> run;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
