// SPDX-License-Identifier: MIT
// A run: every row of a scenario, into sinks.
//
// Equations   none.
// Units       those of the scenario.
// Domain      a scenario with [time]. All sinks must have been opened with layout.groups().
// Accuracy    that of FreeRotation and of the charts; times are rounded once (SaveAt).
// Errors      DomainError without [time]; OutputError from the sinks.
// Cost        one preparation, then rows in blocks: memory does not grow with their number.
#pragma once

#include <memory>
#include <span>

#include "polhode/io/columns.hpp"
#include "polhode/io/scenario.hpp"
#include "polhode/io/sink.hpp"

namespace polhode {
inline namespace v0 {

// What the outputs of a scenario say of their origin.
Provenance provenance(const Scenario& scenario);

// Writes every row in order to each sink, then finishes them.
void run(const Scenario& scenario, const RowLayout& layout,
         std::span<const std::unique_ptr<Sink>> sinks);

}  // namespace v0
}  // namespace polhode
