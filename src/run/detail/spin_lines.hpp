// SPDX-License-Identifier: MIT
// Lines of a summary about the spin of a body: where its momentum points, between which angles its
// axes swing, and what a run has made of it; and what looks like a mistake of the file.
#pragma once

#include "polhode/scenario/scenario.hpp"
#include "run/detail/summary_lines.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// At t = 0. The motion is the free one in the axes of the reference frame.
void add_spin(Lines& lines, const Rotation& rotation, const FreeRotation& motion);
// Mode, periods and pole at t = 0 and at the end of a run.
void add_change(Lines& lines, const Rotation& rotation, const Units& units,
                const DampedSample& end);
// Notes: a quaternion that looks scalar-last, an orbit that lies inside of what it goes round.
void add_doubts(Lines& lines, const Rotation& rotation, const Scenario& scenario);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
