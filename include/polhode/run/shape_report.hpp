// SPDX-License-Identifier: MIT
// What a shape weighs and how it resists turning, in a few lines, and as the [body] table of a
// scenario.
//
// Equations   those of mass_properties.
// Units       those given, the units in which the mass properties are.
// Domain      closed shapes.
// Accuracy    every digit in the table for a scenario; ten for people.
// Cost        negligible.
#pragma once

#include <string>
#include <vector>

#include "polhode/run/summary.hpp"
#include "polhode/shape/mass_properties.hpp"
#include "polhode/text/units.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// For summary_table and summary_json.
std::vector<SummaryLine> shape_summary(const shape::FacetShape& shape,
                                       const shape::MassProperties& properties, const Units& units);
// "[body]\ntensor = ...", in the axes of the mesh; [units] must have `units.moment()`.
std::string body_table(const shape::MassProperties& properties, const Units& units);

}  // namespace io
}  // namespace v0
}  // namespace polhode
