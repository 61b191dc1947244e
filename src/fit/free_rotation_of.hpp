// SPDX-License-Identifier: MIT
#pragma once

#include "polhode/fit/spin_fit.hpp"
#include "polhode/free/free_rotation.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The free rotation of a state, in principal axes and units of Izz.
FreeRotation free_rotation_of(const SpinState& s);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
