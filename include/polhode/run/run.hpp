// SPDX-License-Identifier: MIT
// In this header: run_event, run, citations, disk_space.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/dynamics/problem.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/output/sink.hpp"
#include "polhode/scenario/scenario.hpp"
#include "polhode/text/citation.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// RunEvent: an event of a run of any state. Its row is what a table of events holds; its state is
// kept as bytes, and read back by whoever knows what moved.
//
// Units       t in the core unit of time; the row in the units of its columns.
// Domain      record_of: a state of the kind that event_of was given.
// Accuracy    exact: the state to the last bit.
// Errors      record_of: DomainError for bytes that end too early.
// Cost        eight bytes per number.

struct RunEvent {
  std::string name;
  double t = 0.0;
  int direction = 0;       // +1: rising through zero, -1: falling, 0: touching it
  std::string state = {};  // bytes (polhode/detail/trajectory/archive.hpp)
  // The columns of the run there, where a table of events asks for them.
  std::vector<double> row = {};

  bool operator==(const RunEvent&) const = default;
};

template <MotionState S>
RunEvent event_of(BasicEventRecord<S> record, std::vector<double> row = {}) {
  Archive bytes;
  bytes(record.s);
  return {std::move(record.name), record.t, record.direction, bytes.bytes(), std::move(row)};
}

template <MotionState S>
BasicEventRecord<S> record_of(const RunEvent& event) {
  BasicEventRecord<S> record{event.name, event.t, {}, event.direction};
  Archive bytes(event.state);
  bytes(record.s);
  return record;
}

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

// The papers that a scenario rests on.
//
// Domain      any scenario.

// In the order of their weight, each once.
std::vector<Citation> citations(const Scenario& scenario);

// Whether the files of a run find room: their bytes, as far as rows and columns tell them, against
// what is free where they lie. ScenarioRun refuses a run that does not; a program may warn of one
// that may not.
//
// Equations   bytes = rows x numbers of a row x bytes of a number (OutputFormat::number_bytes).
// Units       bytes.
// Domain      regular files of formats that tell; all else, pipes and devices, takes nothing.
// Accuracy    HDF5 to some kB; of CSV the least, and what is usual.
// Errors      none: where the room cannot be told there is enough.
// Cost        a call of the system for each file.

// Of the outputs on one disk.
struct DiskNeed {
  std::string paths;  // "a.csv, a.h5"
  double least = 0.0;
  double usual = 0.0;
  double available = 0.0;
};

// Of a run that has written `done` of its rows; files that it writes anew give up their room first.
std::vector<DiskNeed> disk_needs(const Scenario& scenario, std::span<const std::string> outputs,
                                 std::int64_t done = 0);
// Whether the run may end before its last row, by an event.
bool may_end_early(const Scenario& scenario);
// "a.h5: 80000000000 bytes needed for 1000000000 rows of 10 numbers, 5000000 bytes free there"
std::string disk_text(const Scenario& scenario, const DiskNeed& need, double bytes,
                      std::int64_t done = 0);

}  // namespace io
}  // namespace v0
}  // namespace polhode
