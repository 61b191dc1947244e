// SPDX-License-Identifier: MIT
// Progress: how far a run has come, reported while it goes on. A caller watches a long run by it,
// and stops it: what it throws ends the run.
//
// Units       the unit of time of the run.
// Domain      called with the time reached, in the order of the run: after every step of a method,
//             and after every sample inside a step; by a run of rows without steps, after every
//             block. Not called at the start. Empty: nobody watches.
// Errors      what it throws passes through unchanged, after the samples so far have been pushed.
// Cost        its own, and that of a call: a few ns a step. One that looks at a clock does so every
//             so many calls.
#pragma once

#include <functional>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

using Progress = std::function<void(double t)>;

}  // namespace v0
}  // namespace polhode
