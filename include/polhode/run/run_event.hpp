// SPDX-License-Identifier: MIT
// RunEvent: an event of a run of any state. Its row is what a table of events holds; its state is
// kept as bytes, and read back by whoever knows what moved.
//
// Units       t in the core unit of time; the row in the units of its columns.
// Domain      record_of: a state of the kind that event_of was given.
// Accuracy    exact: the state to the last bit.
// Errors      record_of: DomainError for bytes that end too early.
// Cost        eight bytes per number.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "polhode/dynamics/problem.hpp"
#include "polhode/trajectory/archive.hpp"

namespace polhode {
inline namespace v0 {

struct RunEvent {
  std::string name;
  double t = 0.0;
  int direction = 0;       // +1: rising through zero, -1: falling, 0: touching it
  std::string state = {};  // bytes (polhode/trajectory/archive.hpp)
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

}  // namespace v0
}  // namespace polhode
