// SPDX-License-Identifier: MIT
// What elements say of the motion in its own plane, in double-double.
#pragma once

#include "polhode/orbit/kepler_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

PlanarKepler::Shape kepler_shape(const KeplerElements& elements);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
