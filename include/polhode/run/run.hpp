// SPDX-License-Identifier: MIT
// A run: every row of a scenario, into sinks.
//
// Equations   those of the system.
// Units       those of the scenario.
// Domain      a scenario with [time]. All sinks must have been opened with
//             row_groups(scenario). A run starts at t = 0; when the first row is elsewhere, it goes
//             there first, and events are looked for from there on.
// Accuracy    that of the method, or of FreeRotation, and of the charts; times are rounded once
//             (SaveAt).
// Errors      DomainError without [time]; OutputError from the sinks. A run that cannot go on
//             returns an outcome that says why: its rows so far are in the sinks, which are not
//             finished. What `progress` throws passes through; the rows so far are in the sinks,
//             not finished either.
// Cost        one preparation, then rows in blocks: memory does not grow with their number.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/output/columns.hpp"
#include "polhode/output/sink.hpp"
#include "polhode/run/run_event.hpp"
#include "polhode/scenario/scenario.hpp"
#include "polhode/trajectory/progress.hpp"

namespace polhode {
inline namespace v0 {

// What the outputs of a scenario say of their origin.
Provenance provenance(const Scenario& scenario);
// The columns of its rows, t first.
std::vector<ColumnGroup> row_groups(const Scenario& scenario);
// Those of a rotation, and what writes them.
RowLayout row_layout(const Scenario& scenario);
RunFacts run_facts(const Scenario& scenario);

// How a scenario is propagated, in words: "exact free rotation", "adaptive, tolerance 1e-12".
std::string propagation_text(const Scenario& scenario);

struct RunReport {
  Outcome outcome;
  Statistics statistics;  // all 0 for exact free rotation
  std::vector<RunEvent> events;
  std::int64_t rows = 0;
  std::optional<double> energy_change;       // E at the end - E(0), when every term has an energy
  std::int64_t events_met = 0;               // of which `events` may hold the first ones only
  std::optional<Sample> end = std::nullopt;  // of an integrated rotation
  std::vector<std::string> warnings = {};    // "PATH: what its readers should know"
};

// Writes every row in order to each sink, then finishes them unless the run failed. Times of
// `progress` are in the core unit; of exact free rotation, one per block of rows.
RunReport run(const Scenario& scenario, std::span<const std::unique_ptr<Sink>> sinks,
              const Progress& progress = {});

// The events of a run as CSV: name, t, direction (1 rising, -1 falling, 0 touching), columns of a
// row. Opened before the run, so that a path that cannot be written is found out at once, and
// written as PATH.part until it is complete. With a position, PATH.part is cut back to it.
class EventTable {
 public:
  EventTable(const std::string& path, const Scenario& scenario,
             const std::optional<SinkPosition>& from = std::nullopt);
  ~EventTable();
  EventTable(const EventTable&) = delete;
  EventTable& operator=(const EventTable&) = delete;
  // DomainError for an event that has no row of the run.
  void push(const RunEvent& event);
  // As Sink's.
  std::optional<SinkPosition> position();
  void finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace v0
}  // namespace polhode
