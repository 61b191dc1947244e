// SPDX-License-Identifier: MIT
// What tides alone do to a spin, while the orbit stays.
#pragma once

#include "polhode/secular/tides.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// How s, w and a change by tides alone.
TidalSpin tidal_change(const TidalRates& tides, double e2, const Vec3& n, const TidalSpin& at);
// The state after h of them, by one step of order 4.
TidalSpin tidal_step(const TidalRates& tides, double e2, const Vec3& n, const TidalSpin& at,
                     double h);

}  // namespace detail

}  // namespace v0
}  // namespace polhode
