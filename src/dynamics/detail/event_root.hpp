// SPDX-License-Identifier: MIT
// Where an event function vanishes inside one step.
#pragma once

#include "polhode/dynamics/event.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A root between t0 and t1, where the function has values f0 and f1 of different sign: the first
// time in the direction of t1 at which its sign is that of f1, to rounding.
double event_root(const Event& event, const DenseStep& step, double t0, double f0, double t1,
                  double f1);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
