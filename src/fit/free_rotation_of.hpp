// SPDX-License-Identifier: MIT
#pragma once

#include "polhode/fit/spin_fit.hpp"
#include "polhode/free/free_rotation.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The free rotation of a state, in principal axes and units of Izz.
FreeRotation free_rotation_of(const SpinState& s);
// The state that it has come to at t.
SpinState spin_at(const SpinState& s, double t);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
