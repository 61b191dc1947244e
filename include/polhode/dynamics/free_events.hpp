// SPDX-License-Identifier: MIT
// free_events: events of the exact free rotation, found on the closed form, without steps.
//
// Equations   those of FreeRotation and of Event.
// Units       those of the motion; `interval` of an event is a time.
// Domain      any motion, from `start` to `stop` in either direction, however far from its epoch;
//             events as event.hpp has them. A frame that moves: events of the motion as seen from
//             it.
// Accuracy    times to rounding of t, and that of FreeRotation: error of the function over its rate
//             (docs/accuracy/events.md).
// Errors      DomainError for a start or stop that is not finite and an invalid event. An event
//             that is NaN ends the search with Outcome::failed, a sentence, and the time of the
//             last look before. What a function or `progress` throws passes through.
// Cost        a microsecond or two per turn between start and stop, and two calls of every function
//             per look; `progress` is called every few turns.
#pragma once

#include <vector>

#include "polhode/dynamics/event.hpp"
#include "polhode/frame/frame.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {

struct FreeEvents {
  std::vector<EventRecord> events;  // in order of time, up to the first that stops
  Outcome outcome;                  // stopped_by_event where one does
};

// `motion` is in inertial axes; states of the events are in the frame.
FreeEvents free_events(const FreeRotation& motion, const std::vector<Event>& events, double start,
                       double stop, const Frame& frame = Frame::inertial(),
                       const Progress& progress = {});

}  // namespace v0
}  // namespace polhode
